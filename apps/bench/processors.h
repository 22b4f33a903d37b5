#pragma once

namespace fathom::bench {

/// Processors that this process may run on.
int processor_count();

/// Restricts this process and its threads to at most `count` processors, on separate cores as far
/// as there are enough, so that all renderers have the same resources however many threads they
/// start. Does nothing if the system does not allow it.
void keep_to_processors(int count);

}  // namespace fathom::bench
