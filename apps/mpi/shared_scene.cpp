#include "apps/mpi/shared_scene.h"

#include <array>
#include <limits>
#include <numeric>
#include <utility>

#include "apps/mpi/together.h"
#include "apps/mpi/triangle_mail.h"
#include "apps/render/render_plan.h"
#include "apps/render/render_report.h"
#include "apps/shell/known_files.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/render.h"

namespace fathom::app {
namespace {

bool can_be_streamed(const SceneOptions& options) {
  const ReadOptions reading = options.read_options();
  return std::ranges::all_of(options.files,
                             [&](const std::string& file) { return is_streamable(file, reading); });
}

/// A part of a mesh that is in memory, or of one in a file.
Mesh mesh_part(const Scene& scene, const StreamedScene* streamed, std::uint32_t object,
               std::uint32_t first, std::uint32_t count) {
  if (streamed) {
    Mesh mesh =
        std::move(streamed->streams[streamed->objects[object].mesh]->read(first, count).mesh);
    mesh.face_of_triangle = {};
    return mesh;
  }
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), first);
  return TrianglePicker(scene.meshes[scene.objects[object].mesh]).picked(numbers);
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
  if (kept.whole || kept.segments || kept.normals || !can_be_streamed(options)) {
    scene_ = options.read(
        console, {.hash = kept.hash, .attributes = kept.normals, .segments = kept.segments});
  } else {
    files_.assign(options.files.begin(), options.files.end());
    reading_ = options.read_options();
    reading_.hash = kept.hash;
    open(false, console);
    for (const std::string& file : options.files) note_input(file);
  }
  number_triangles();
}

SharedScene::SharedScene(StreamedScene scene) : streamed_(std::move(scene)) {
  scene_ = outline_of(*streamed_);
  number_triangles();
}

void SharedScene::open(bool check, const Console& console) {
  Warnings warnings;
  reading_.check_when_opened = check;
  streamed_ = stream_scene(files_, reading_, warnings);
  std::erase_if(warnings, [&](const std::string& w) { return std::ranges::count(told_, w) > 0; });
  console.warn(warnings);
  told_.insert(told_.end(), warnings.begin(), warnings.end());
  scene_ = outline_of(*streamed_);
}

void SharedScene::check_files(const Ranks& ranks, const Console& console) {
  const auto self = static_cast<std::uint64_t>(ranks.self());
  const auto count = static_cast<std::uint64_t>(ranks.count());
  bool holds = true;
  together(ranks, [&] {
    if (!streamed_) return;
    for (const auto& stream : streamed_->streams) holds = stream->check_part(self, count) && holds;
  });
  if (ranks.least(holds ? 1 : 0) == 1) return;
  together(ranks, [&] {
    if (files_.empty()) return;
    open(true, console);
    number_triangles();
  });
}

void SharedScene::number_triangles() {
  first_numbers_ = {0};
  for (const Object& object : scene_.objects) {
    const std::uint64_t count = streamed_ ? streamed_->streams[object.mesh]->triangle_count()
                                          : scene_.meshes[object.mesh].triangles.size();
    first_numbers_.push_back(first_numbers_.back() + count);
  }
}

void SharedScene::place(const MotionOptions& motion) {
  scene_ = motion.placed(std::move(scene_));
}

TriangleSource SharedScene::triangles() const {
  return streamed_ ? TriangleSource(*streamed_) : TriangleSource(scene_);
}

Rendered SharedScene::render(const Camera& camera, const RenderOptions& options) const {
  return streamed_ ? fathom::render(*streamed_, camera, options, stream_limits(camera, options))
                   : fathom::render(scene_, camera, options);
}

TriangleRange SharedScene::part_of(const Ranks& ranks) const {
  const auto count = static_cast<std::uint64_t>(ranks.count());
  const auto self = static_cast<std::uint64_t>(ranks.self());
  const std::uint64_t triangles = first_numbers_.back();
  return {triangles * self / count, triangles * (self + 1) / count};
}

std::vector<SomeTriangles> SharedScene::read(const TriangleRange& range) const {
  std::vector<SomeTriangles> lists;
  for (std::uint32_t i = 0; i < scene_.objects.size(); ++i) {
    const std::uint64_t from = std::max(range.first, first_numbers_[i]);
    const std::uint64_t to = std::min(range.end, first_numbers_[i + 1]);
    if (from >= to) continue;
    lists.push_back({i,
                     mesh_part(scene_, streamed_ ? &*streamed_ : nullptr, i,
                               static_cast<std::uint32_t>(from - first_numbers_[i]),
                               static_cast<std::uint32_t>(to - from)),
                     static_cast<std::uint32_t>(from),
                     {}});
  }
  return lists;
}

namespace {

/// Bounds of an object before any of its triangles is read.
constexpr double no_coordinate = std::numeric_limits<double>::infinity();

/// The least coordinates, and the greatest with the other sign: both are found as the least.
using LeastCoordinates = std::array<double, 6>;

void look_at(const Mesh& mesh, LeastCoordinates& least) {
  for (const MeshPoint& p : mesh.vertices) {
    const LeastCoordinates candidates{p.x, p.y, p.z, -p.x, -p.y, -p.z};
    for (std::size_t k = 0; k < least.size(); ++k) least[k] = std::min(least[k], candidates[k]);
  }
}

}  // namespace

void SharedScene::find_bounds(const Ranks& ranks, std::uint32_t triangles_at_once) {
  if (!streamed_) return;
  constexpr std::size_t size = LeastCoordinates().size();
  std::vector<double> least(size * scene_.objects.size(), no_coordinate);
  together(ranks, [&] {
    const TriangleRange own = part_of(ranks);
    for (std::uint64_t from = 0; from < own.count(); from += triangles_at_once) {
      for (const SomeTriangles& some : read(own.part(from, triangles_at_once))) {
        LeastCoordinates of_object;
        std::copy_n(&least[size * some.object], size, of_object.begin());
        look_at(some.mesh, of_object);
        std::ranges::copy(of_object, &least[size * some.object]);
      }
    }
  });
  ranks.take_least(least);
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    Mesh& mesh = scene_.meshes[scene_.objects[i].mesh];
    const double* const b = &least[size * i];
    if (!mesh.triangles.empty() || b[0] == no_coordinate) continue;
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

SharedScene open_scene(const Ranks& ranks, const RenderArguments& arguments,
                       const SharedScene::Kept& kept, const Console& console) {
  std::optional<SharedScene> opened;
  together(ranks, [&] { opened.emplace(arguments.scene, kept, console); });
  opened->check_files(ranks, console);
  require_same<InputError>(ranks, opened->description(), "the ranks read different files");
  return std::move(*opened);
}

std::vector<Camera> cameras_of(const Ranks& ranks, const RenderArguments& arguments,
                               const std::vector<Channel>& channels, SharedScene& scene,
                               const Console& console) {
  std::vector<Camera> cameras;
  together(ranks, [&] {
    cameras = arguments.camera.get(scene.outline(), arguments.scene.limits, console);
    scene.place(arguments.motion);
    warn_of_missing_segments(scene.triangles(), channels, console);
  });
  require_same<InputError>(ranks, to_json(cameras), "the ranks have different cameras");
  return cameras;
}

}  // namespace fathom::app
