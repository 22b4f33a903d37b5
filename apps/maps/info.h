#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/image/deep_map.h"
#include "fathom/image/depth_map.h"
#include "fathom/scene/scene.h"

/// The answer of `fathom info` for a file.
namespace fathom::app {

enum class FileKind { mesh, scene, camera, map };

/// Detected from the content of a file. JSON with `meshes` is a scene file unless it is glTF, which
/// has `asset`. Any other file counts as a mesh, or as a camera if it looks like JSON; the reader
/// reports its fault.
FileKind kind_of(std::string_view content);

/// A line of `fathom info` with the first names of a list, and how many more there are; nothing for
/// an empty list.
std::string name_line(const std::string& what, const std::vector<std::string>& names);

enum class AnswerForm { text, json };

/// Size, and per channel its type, how many pixels show a surface and the range of its finite
/// values there; object names; the texts of the header.
std::string info_of_map(const DepthMap& map, const std::string& file, AnswerForm form);

/// The same of a deep map: of all its samples, with how many there are, and at how many pixels.
std::string info_of_deep_map(const DeepMap& deep, const std::string& file, AnswerForm form);

/// Vertices, faces, triangles, bounds, the objects and the sources of a mesh or a scene file. A
/// mesh file with only vertices is a point cloud; its bounds contain all vertices.
std::string info_of_scene(Scene scene, FileKind kind, const std::string& file, AnswerForm form);

/// Where the camera of the file stands and looks, and its numbers; of several cameras a table.
std::string info_of_cameras(const std::vector<Camera>& cameras, const std::string& file,
                            AnswerForm form);

}  // namespace fathom::app
