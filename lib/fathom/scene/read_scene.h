#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "fathom/mesh_files/read_options.h"
#include "fathom/scene/scene.h"

namespace fathom {

/// Reads meshes (OBJ, PLY, STL, OFF, glTF/GLB) and scene files (JSON) in the order given into one
/// scene. Formats are recognised by content, regardless of the suffix. "-" is standard input.
///
/// Fails    InputError: one line, "FILE: line N: the fault and the expectation" (text), or
///          "FILE: byte N: …" (binary). More than 2³² − 2 triangles in all are an error.
///          UsageError for a number of threads that is out of range.
Scene read_scene(const std::vector<std::filesystem::path>& files, const ReadOptions& options,
                 Warnings& warnings);
/// The same of a file that has been read already; `name` is its path, for messages and to find the
/// files that it names.
Scene read_scene(std::span<const std::byte> bytes, const std::filesystem::path& name,
                 const ReadOptions& options, Warnings& warnings);

}  // namespace fathom
