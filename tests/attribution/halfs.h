#pragma once

namespace fathom::test {

/// The number of binary16 that is nearest to x, of two that are as near the one whose last bit is
/// 0: looked up in a table of all of them, for |x| up to 65504.
double nearest_half(double x);

}  // namespace fathom::test
