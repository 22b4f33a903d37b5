#pragma once

namespace fathom {

/// How many threads the system lets this process start beside those that it has, up to `most`:
/// that many are started, do nothing, and have ended when this returns.
int startable_threads(int most);

}  // namespace fathom
