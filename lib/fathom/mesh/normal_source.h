#pragma once

#include <string_view>

namespace fathom {

/// Where the normals of corners come from: the file, or `vertex` where it has none; sums over the
/// triangles at a vertex; or over those at all vertices of the mesh that lie at one place. A sum is
/// that of the triangles' (B − A) × (C − A), so that each counts as much as its area.
enum class NormalSource { file, vertex, place };
/// "file", "vertex" or "place".
std::string_view name_of(NormalSource source);

}  // namespace fathom
