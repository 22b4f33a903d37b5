#pragma once

namespace fathom::bench {

/// Processors that this process may run on.
int processor_count();

/// From now on this process and its threads run on `count` processors at most, on cores of their
/// own as far as there are enough: so all renderers have the same, whatever threads they start.
/// Does nothing where the system does not allow it.
void keep_to_processors(int count);

}  // namespace fathom::bench
