#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "fathom/failures/errors.h"

namespace fathom {

/// The format of a file. `foreign` is any format that assimp reads (mesh_files/foreign_formats.h).
enum class FileFormat { obj, ply, stl, off, gltf, foreign, scene_json };

/// Options of readers.
struct ReadOptions {
  /// The format of every mesh file: obj, ply, stl, off or gltf. Without one, each file's format is
  /// recognised by its content or suffix.
  std::optional<FileFormat> format;
  /// Threads to use; 0: all.
  int threads = 0;
  /// Keep texture coordinates, normals and colours; depth maps do not need them.
  bool attributes = false;
  /// Keep lines and points: OBJ's l and p, PLY's edges, glTF's modes 0 to 3.
  bool primitives = false;
  /// Vertices without faces are a cloud of points: no warning that a file has no faces.
  bool clouds = false;
  /// Keep the segments of triangles: OBJ's usemtl, g and o; the materials, meshes and nodes of
  /// glTF; a PLY's labels. Takes at most 4 bytes for each triangle and segmentation, plus the
  /// names.
  bool segments = false;
  /// For a binary STL or PLY that stays in its file: check all of it when it is opened. Otherwise
  /// each triangle is checked when it is read, and the stream has no bounds. This applies to STL,
  /// and to a PLY without labels whose size fits a file in which all faces are triangles;
  /// TriangleStream::check_part() checks whether they are. Other PLY files are always checked.
  bool check_when_opened = true;
  /// Compute Source::sha256.
  bool hash = true;
  /// Files that are named by other files (a scene file's meshes, a glTF asset's buffers) must lie
  /// in this folder, where their symbolic links have led; empty: anywhere.
  std::filesystem::path confine;
  /// Returns the path of the program fathom-formats, which runs third-party libraries; called when
  /// a file first needs it. Without this function the program is looked for next to the running
  /// program.
  std::function<std::filesystem::path()> formats_program;
  /// A glTF asset may name files outside the folder in which it lies; by default none, since an
  /// asset that comes from elsewhere could name anything that its reader may read.
  bool outside_files = false;
  /// The greatest memory of a mesh, or of a scene file with its meshes, as a multiple of the bytes
  /// of its files, in addition to 64 MiB; more is an error. See expansion_budget.h.
  std::uint64_t max_expansion = 64;
  /// Map files of more than 64 MiB, and the vertices of a PLY that stays in its file, instead of
  /// reading them into memory. Only for programs that handle the signal SIGBUS
  /// (files/mapped_file.h): they get it where another program cuts a mapped file short meanwhile.
  /// Without mapping, that is an InputError.
  bool map_large_files = false;
};

}  // namespace fathom
