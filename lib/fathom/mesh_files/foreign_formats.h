#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/mesh/mesh.h"
#include "fathom/mesh/object.h"
#include "fathom/mesh_files/read_options.h"

/// Formats that assimp, the Open Asset Import Library, reads for us.
namespace fathom::mesh_files {

/// The suffixes by which they are recognised: of files that hold polygons by themselves. Not among
/// them: what we read ourselves, motion, terrain, solids that would have to be tessellated (IFC,
/// STEP), scenes whose meshes are in other files.
inline constexpr std::array<std::string_view, 36> foreign_suffixes{
    "3ds",  "3mf", "ac",  "ac3d", "acc", "amf", "ase", "ask",     "b3d", "blend", "cob",  "dae",
    "dxf",  "fbx", "iqm", "lwo",  "lxo", "md2", "md3", "md5mesh", "mdc", "mdl",   "ms3d", "ndo",
    "ogex", "pmx", "q3o", "q3s",  "scn", "sib", "smd", "x",       "x3d", "xgl",   "zae",  "zgl"};

/// `suffix` in small letters and without its point.
inline bool is_foreign_suffix(std::string_view suffix) {
  return std::ranges::find(foreign_suffixes, suffix) != foreign_suffixes.end();
}

/// The placed meshes of a foreign file.
struct ForeignMeshes {
  std::vector<Mesh> meshes;
  /// Object::mesh counts from the first of `meshes`; Object::source is not set.
  std::vector<Object> objects;
  /// The library that read them and its version: "assimp 5.2.4".
  std::string reader;
};

/// Reads a file by assimp, in the program fathom-formats: one object per node with a mesh, depth
/// first. Fathom takes assimp's results as they are: its numbers are binary32 and not always
/// nearest to the decimals of the file; most of its readers turn the file's frame so that y is up.
/// Polygons are cut as in any other format, and the transforms of nodes are composed exactly.
///
/// `path` names the file in messages, and its suffix selects assimp's reader. The readers have no
/// access to any other file.
/// Fails    InputError: "FILE: assimp could not read it: …"; also where it crashes, or takes more
///          memory or time than formats_program/process.h allows.
/// Ignored  with a warning: points and lines; silently: skins, morph targets, animations, cameras,
///          lights, materials.
ForeignMeshes read_by_assimp(std::span<const std::byte> bytes, const std::filesystem::path& path,
                             const ReadOptions& options, Warnings& warnings);

}  // namespace fathom::mesh_files
