#pragma once

#include <string>
#include <vector>

#include "tests/inputs/mesh_variants.h"

namespace fathom::test {

/// Adds the mesh as other programs write it and as the formats do not quite have it, but so that
/// nothing is in doubt: it is read without a warning.
void add_habits(const Mesh& mesh, std::vector<MeshFile>& files);

/// A file whose geometry is clear and which is read with one warning.
struct WarnedMeshFile {
  MeshFile file;
  /// A part of the warning.
  std::string warning;
};

/// The mesh in files that have something beside it that cannot be used.
std::vector<WarnedMeshFile> warned_variants_of(const Mesh& mesh);

}  // namespace fathom::test
