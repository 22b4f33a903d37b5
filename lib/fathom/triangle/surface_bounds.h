#pragma once

// Constants of the channels' bounds, in units of ε times the magnitudes of the terms; their
// derivations are where they are used. validation/proofs/channels/surface_*.gappa.in proves each,
// in the arithmetic of binary64 and in that of double-words.
namespace fathom::triangle::surface_bounds {

/// n = p × r; placed by cofactors; n·t; forms c + b·v + a·u; n·d for the turn of a normal.
inline constexpr double normal = 4, placed_normal = 8, constant_form = 9, form = 12, turn = 15;
/// The root of n·n, besides what the errors of the components do.
inline constexpr double length = 3;
/// Origin + direction·D; √(x² + y² + 1), in units of X̄² + Ȳ² + 1 (one more, and of the value).
inline constexpr double position = 6, ray_length = 6;

/// Greatest sizes of a normal's components whose squares stay in range.
inline constexpr double least_normal = 0x1p-250, greatest_normal = 0x1p450;

}  // namespace fathom::triangle::surface_bounds
