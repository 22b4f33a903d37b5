#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/mesh_files/read_options.h"

/// The mesh formats that Fathom reads without assimp: the only place that defines their names and
/// suffixes. Help and messages take them from this table; read_mesh.h has a reader for each row,
/// and foreign_formats.h the suffixes of assimp's formats.
namespace fathom::mesh_files {

struct MeshFormatDescription {
  FileFormat format;
  /// In messages.
  std::string_view name;
  /// Of the option --mesh-format. The second may be empty.
  std::array<std::string_view, 2> words;
  /// Of files' names, in small letters. The second and the third may be empty.
  std::array<std::string_view, 3> suffixes;
  /// Whether a triangle stream can leave the mesh in its file, if the file is binary.
  bool can_be_streamed = false;
};

inline constexpr auto mesh_format_table = std::to_array<MeshFormatDescription>({
    {.format = FileFormat::obj, .name = "OBJ", .words = {"obj"}, .suffixes = {".obj"}},
    {.format = FileFormat::ply,
     .name = "PLY",
     .words = {"ply"},
     .suffixes = {".ply"},
     .can_be_streamed = true},
    {.format = FileFormat::stl,
     .name = "STL",
     .words = {"stl"},
     .suffixes = {".stl"},
     .can_be_streamed = true},
    {.format = FileFormat::off,
     .name = "OFF",
     .words = {"off"},
     .suffixes = {".off", ".coff", ".noff"}},
    {.format = FileFormat::gltf,
     .name = "glTF",
     .words = {"gltf", "glb"},
     .suffixes = {".gltf", ".glb"}},
});

/// The format of a word of --mesh-format; nullopt if none.
std::optional<FileFormat> mesh_format_named(std::string_view word);

/// The format of a suffix in small letters, with its point; nullopt if none.
std::optional<FileFormat> mesh_format_of_suffix(std::string_view suffix);

bool can_be_streamed(FileFormat format);

/// "obj", "ply", …, "gltf" and "glb".
std::vector<std::string> words_of_mesh_formats();

/// "OBJ, PLY, STL, OFF, glTF"
std::string names_of_mesh_formats();

}  // namespace fathom::mesh_files
