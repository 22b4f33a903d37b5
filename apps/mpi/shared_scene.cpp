#include "apps/mpi/shared_scene.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <utility>

#include "apps/mpi/picked_triangles.h"
#include "apps/shell/known_files.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

bool can_be_streamed(const SceneOptions& options) {
  const ReadOptions reading = options.read_options();
  return std::ranges::all_of(options.files,
                             [&](const std::string& file) { return is_streamable(file, reading); });
}

/// A part of a mesh that is in memory, or of one in a file.
Mesh part_of(const Scene& scene, const StreamedScene* streamed, std::uint32_t object,
             std::uint32_t first, std::uint32_t count) {
  if (!streamed) {
    std::vector<std::uint32_t> numbers(count);
    for (std::uint32_t i = 0; i < count; ++i) numbers[i] = first + i;
    return TrianglePicker(scene.meshes[scene.objects[object].mesh]).picked(numbers);
  }
  TriangleChunk chunk = streamed->streams[streamed->objects[object].mesh]->read(first, count);
  if (chunk.mesh.face_of_triangle.empty()) {
    for (std::uint32_t i = 0; i < count; ++i) chunk.mesh.face_of_triangle.push_back(first + i);
  }
  return std::move(chunk.mesh);
}

}  // namespace

SharedScene::SharedScene(const SceneOptions& options, const Kept& kept, const Console& console) {
  if (std::ranges::count(options.files, "-") > 0) {
    throw UsageError("SCENE: '-', standard input, reaches one rank only; expected files");
  }
  for (const std::string& file : options.files) {
    std::error_code none;
    if (std::filesystem::exists(file, none) && !std::filesystem::is_regular_file(file, none))
      throw UsageError("SCENE: " + file + " is no regular file, which all ranks could read");
  }
  if (kept.segments || kept.normals || !can_be_streamed(options)) {
    scene_ = options.read(
        console, {.hash = kept.hash, .attributes = kept.normals, .segments = kept.segments});
  } else {
    Warnings warnings;
    ReadOptions reading = options.read_options();
    reading.hash = kept.hash;
    reading.check_when_opened = false;
    streamed_ = stream_scene({options.files.begin(), options.files.end()}, reading, warnings);
    console.warn(warnings);
    for (const std::string& file : options.files) note_input(file);
    scene_ = outline_of(*streamed_);
  }
  for (const Object& object : scene_.objects) {
    const std::uint64_t count = streamed_ ? streamed_->streams[object.mesh]->triangle_count()
                                          : scene_.meshes[object.mesh].triangles.size();
    first_numbers_.push_back(first_numbers_.back() + count);
  }
}

void SharedScene::place(const MotionOptions& motion) {
  if (streamed_ && motion.is_given()) {
    throw UsageError("--motion is not for binary STL and PLY, which stay in their files");
  }
  scene_ = motion.placed(std::move(scene_));
}

TriangleSource SharedScene::triangles() const {
  return streamed_ ? TriangleSource(*streamed_) : TriangleSource(scene_);
}

ScenePart SharedScene::part(std::uint64_t first, std::uint64_t end) const {
  ScenePart part;
  part.scene.sources = scene_.sources;
  for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) {
    const std::uint64_t from = std::max(first, first_numbers_[i]);
    const std::uint64_t to = std::min(end, first_numbers_[i + 1]);
    if (from >= to) continue;
    const auto first_of_mesh = static_cast<std::uint32_t>(from - first_numbers_[i]);
    Object object = scene_.objects[i];
    object.mesh = part.scene.meshes.size();
    part.scene.objects.push_back(std::move(object));
    part.scene.meshes.push_back(part_of(scene_, streamed_ ? &*streamed_ : nullptr, i, first_of_mesh,
                                        static_cast<std::uint32_t>(to - from)));
    part.from.push_back({i, first_of_mesh});
  }
  return part;
}

void SharedScene::find_bounds(const Ranks& ranks, const ScenePart& part) {
  if (!streamed_) return;
  constexpr double none = std::numeric_limits<double>::infinity();
  constexpr std::size_t size = 6;
  // The least coordinates, and the greatest with the other sign: both are found as the least.
  std::vector<double> least(size * scene_.objects.size(), none);
  for (std::size_t i = 0; i < part.from.size(); ++i) {
    double* const of_object = &least[size * part.from[i].object];
    for (const MeshPoint& p : std::as_const(part.scene.meshes[i].vertices)) {
      const std::array<double, size> candidates{p.x, p.y, p.z, -p.x, -p.y, -p.z};
      for (std::size_t k = 0; k < size; ++k) of_object[k] = std::min(of_object[k], candidates[k]);
    }
  }
  ranks.take_least(least);
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    Mesh& mesh = scene_.meshes[scene_.objects[i].mesh];
    const double* const b = &least[size * i];
    if (!mesh.triangles.empty() || b[0] == none) continue;
    mesh.vertices = {MeshPoint{b[0], b[1], b[2]}, MeshPoint{-b[3], -b[4], -b[5]}};
    mesh.triangles = {{0, 1, 1}};
    mesh.face_count = 1;
  }
}

std::string SharedScene::description() const {
  std::string text;
  for (const Source& source : scene_.sources) {
    std::error_code none;
    text += std::to_string(std::filesystem::file_size(source.path, none)) + " ";
  }
  for (const std::uint64_t number : first_numbers_) text += std::to_string(number) + " ";
  return text;
}

}  // namespace fathom::app
