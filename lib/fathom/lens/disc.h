#pragma once

#include <optional>

#include "fathom/lens/stage.h"

namespace fathom::lens {

/// The disc |m|² ≤ Q on which a stage is used (specification, section 2): Q is the greatest
/// binary64 number such that on it the stage is defined and the symmetric part of its Jacobian is
/// positive definite, so that it is one to one. +∞ if there is no bound.
///
/// Exact    the bound of a radial stage, always. Otherwise, if the Jacobian's determinant touches 0
///          without a change of sign, or if |m|² = Q would need numbers that are not searched, the
///          number may be smaller than the greatest one: it is proved to be good in any case.
double greatest_disc(const StageNumbers<double>& numbers);

}  // namespace fathom::lens
