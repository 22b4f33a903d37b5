#pragma once

#include "fathom/lens/stage.h"

namespace fathom::lens {

/// The disc |m|² ≤ Q on which a stage is used (specification, section 2): Q is the greatest
/// binary64 number such that on it the stage is defined and the symmetric part of its Jacobian is
/// positive definite, so that it is one to one. +∞ if there is no bound.
///
/// Exact    always for a radial stage. For others the number is proved to be good, and to be the
///          greatest one if the determinant of the symmetric part changes its sign at the edge, or
///          if D has a root there that is none of N. Otherwise it may be smaller.
/// Cost     milliseconds; up to a minute where it may be smaller.
double greatest_disc(const StageNumbers<double>& numbers);

}  // namespace fathom::lens
