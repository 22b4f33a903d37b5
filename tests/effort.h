#pragma once

namespace fathom::checks {

/// Sanitizers make the code ten to fifty times slower: fewer of the random cases are run under
/// them, of the same kinds.
#if defined(FATHOM_SANITIZED)
inline constexpr int effort = 20;
#else
inline constexpr int effort = 1;
#endif

}  // namespace fathom::checks
