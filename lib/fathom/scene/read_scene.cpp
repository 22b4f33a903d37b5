#include "fathom/scene/read_scene.h"

#include <future>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"
#include "fathom/files/sha256.h"
#include "fathom/mesh/mesh_faces.h"
#include "fathom/mesh_files/expansion_budget.h"
#include "fathom/mesh_files/foreign_formats.h"
#include "fathom/mesh_files/mesh_formats.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/scene_json.h"
#include "fathom/text/printable.h"
#include "fathom/threads/meanwhile.h"
#include "fathom/threads/threads.h"

namespace fathom {
using namespace mesh;
using namespace mesh_files;
using namespace scene;
using namespace files;
using namespace text;

namespace {

/// Reads files one after the other into one scene.
class SceneReader {
 public:
  SceneReader(const ReadOptions& options, Warnings& warnings)
      : options_(options), warnings_(warnings) {}

  void add_file(const std::filesystem::path& path) {
    const InputFile input(path, reading_of(options_));
    add_input(input, path);
    input.expect_unchanged();
  }

  void add_input(const InputFile& input, const std::filesystem::path& path) {
    const std::string file = path.string();
    const FileFormat format = options_.format ? *options_.format : recognise(input, path);
    if (format != FileFormat::scene_json) {
      const std::size_t first = scene_.objects.size();
      add_mesh_file(format, input, path);
      check_objects(first, file);
      return;
    }
    add_source(file, options_.hash ? sha256(input.bytes()) : "");
    Placements placements{{}, ExpansionBudget(file, options_.max_expansion)};
    placements.budget.add_input(input.bytes().size());
    for (const PlacedFile& placed : read_scene_json(input.text(), path))
      add_placed(placed, placements);
  }

  Scene finish() {
    if (!scene_.draw_states.empty()) scene_.draw_states.resize(scene_.objects.size());
    return std::move(scene_);
  }

 private:
  /// The objects that a scene file has placed so far.
  struct Placements {
    /// A mesh file that is placed more than once is read once; these are its objects as read.
    std::map<std::string, std::vector<Object>> known;
    /// What placing may cost: a few bytes of the scene file can place any number of objects.
    ExpansionBudget budget;
  };

  FileFormat recognise(const InputFile& input, const std::filesystem::path& path) const {
    if (input.bytes().empty())
      throw InputError((path == "-" ? "standard input" : path.string()) +
                       ": is empty, expected a mesh or a scene file");
    if (const auto format = recognise_format(input.bytes(), path)) return *format;
    throw InputError(
        path.string() + ": its format is not recognised, expected " + names_of_mesh_formats() +
        ", a scene file (JSON), or the suffix of a format that assimp reads (.fbx, .dae, .3ds, "
        ".3mf, …)");
  }

  void add_source(const std::string& path, std::string hash) {
    for (const Source& source : scene_.sources)
      if (source.path == path && source.sha256 == hash) return;
    scene_.sources.push_back({path, std::move(hash)});
  }

  /// The hash is computed during the reading.
  void add_mesh_file(FileFormat format, const InputFile& input, const std::filesystem::path& path) {
    std::future<std::string> hash;
    if (options_.hash) hash = meanwhile([&input] { return sha256(input.bytes()); });
    const std::string file = path.string();
    const std::size_t source = scene_.sources.size(), first = scene_.objects.size();
    scene_.sources.push_back({file, ""});
    if (format == FileFormat::gltf) {
      GltfAsset asset = read_gltf(input.bytes(), path, options_, warnings_);
      scene_.sources[source].reader = std::move(asset.reader);
      append(std::move(asset.meshes), std::move(asset.objects));
      std::move(asset.buffers.begin(), asset.buffers.end(), std::back_inserter(scene_.sources));
    } else if (format == FileFormat::foreign) {
      ForeignMeshes foreign = read_by_assimp(input.bytes(), path, options_, warnings_);
      scene_.sources[source].reader = std::move(foreign.reader);
      append(std::move(foreign.meshes), std::move(foreign.objects));
    } else {
      if (input.bytes().empty()) throw InputError(file + ": is empty, expected a mesh");
      Mesh mesh = read_mesh(format, input, file, options_, warnings_);
      leave_out_odd_attributes(mesh, file, warnings_);
      if (mesh.is_empty() && !options_.clouds) warnings_.push_back(file + ": has no faces");
      Object object;
      object.mesh = scene_.meshes.size();
      object.name = file == "-" ? file : path.stem().string();
      scene_.meshes.push_back(std::move(mesh));
      scene_.objects.push_back(std::move(object));
    }
    for (std::size_t i = first; i < scene_.objects.size(); ++i) scene_.objects[i].source = source;
    if (hash.valid()) scene_.sources[source].sha256 = hash.get();
  }

  /// Objects whose numbers of meshes count from the first of these.
  void append(std::vector<Mesh> meshes, std::vector<Object> objects) {
    for (Object& object : objects) {
      object.mesh += scene_.meshes.size();
      scene_.objects.push_back(std::move(object));
    }
    std::move(meshes.begin(), meshes.end(), std::back_inserter(scene_.meshes));
  }

  /// The objects from `first` on, which come from this file.
  void check_objects(std::size_t first, const std::string& file) {
    for (std::size_t i = first; i < scene_.objects.size(); ++i) {
      const Object& object = scene_.objects[i];
      if (const auto fault = find_fault(object.world_from_mesh))
        throw InputError(file + ": object " + printable(object.name) + ": " + *fault);
      triangles_ += triangles_of(object);
      expect_countable(triangles_, "triangles in all", file);
    }
  }

  [[nodiscard]] std::uint64_t triangles_of(const Object& object) const {
    return scene_.meshes[object.mesh].triangles.size();
  }

  void add_placed(const PlacedFile& placed, Placements& placements) {
    const std::string file = placed.file.string();
    const std::size_t first = scene_.objects.size();
    if (const auto found = placements.known.find(file); found != placements.known.end()) {
      scene_.objects.insert(scene_.objects.end(), found->second.begin(), found->second.end());
    } else {
      const InputFile input(placed.file, files::boundaries_of(options_.confine),
                            reading_of(options_));
      const FileFormat format = recognise(input, placed.file);
      if (format == FileFormat::scene_json)
        throw InputError(file + ": is no mesh, expected a mesh file");
      placements.budget.add_input(input.bytes().size());
      add_mesh_file(format, input, placed.file);
      input.expect_unchanged();
      placements.known[file].assign(scene_.objects.begin() + static_cast<std::ptrdiff_t>(first),
                                    scene_.objects.end());
    }
    place(placed, first, placements.budget);
    if (options_.segments) name_segments(placed, first, placements.budget);
    if (!is_default(placed.draw)) {
      scene_.draw_states.resize(first);
      scene_.draw_states.resize(scene_.objects.size(), placed.draw);
    }
    check_objects(first, file);
  }

  /// Names and places the objects from `first` on, which come from one mesh file.
  void place(const PlacedFile& placed, std::size_t first, ExpansionBudget& budget) {
    const bool single = scene_.objects.size() == first + 1;
    for (std::size_t i = first; i < scene_.objects.size(); ++i) {
      Object& object = scene_.objects[i];
      if (placed.name) object.name = single ? *placed.name : *placed.name + "/" + object.name;
      if (placed.transform) {
        object.world_from_mesh = compose(*placed.transform, object.world_from_mesh);
        object.placed_as_is = false;
      }
      budget.take_object(bytes_of(object), triangles_of(object));
    }
  }

  /// Gives the objects from `first` on the material and the label that the scene file gives them.
  void name_segments(const PlacedFile& placed, std::size_t first, ExpansionBudget& budget) {
    if (!placed.material && !placed.label) return;
    std::shared_ptr<const ObjectSegments> before, after;
    for (std::size_t i = first; i < scene_.objects.size(); ++i) {
      Object& object = scene_.objects[i];
      if (i == first || object.segments != before) {  // instances share theirs
        before = object.segments;
        ObjectSegments segments = before ? *before : ObjectSegments();
        if (placed.material) segments.names[Segmentation::material] = *placed.material;
        if (placed.label) segments.label = placed.label;
        budget.take(1, sizeof(ObjectSegments) + placed.material.value_or("").size());
        after = std::make_shared<const ObjectSegments>(std::move(segments));
      }
      object.segments = after;
    }
  }

  const ReadOptions& options_;
  Warnings& warnings_;
  Scene scene_;
  std::uint64_t triangles_ = 0;
};

}  // namespace

Scene read_scene(const std::vector<std::filesystem::path>& files, const ReadOptions& options,
                 Warnings& warnings) {
  const StandardArithmetic standard;
  require_thread_count(options.threads);
  SceneReader reader(options, warnings);
  for (const std::filesystem::path& file : files) reader.add_file(file);
  return reader.finish();
}

Scene read_scene(std::span<const std::byte> bytes, const std::filesystem::path& name,
                 const ReadOptions& options, Warnings& warnings) {
  const StandardArithmetic standard;
  require_thread_count(options.threads);
  SceneReader reader(options, warnings);
  reader.add_input(InputFile(bytes), name);
  return reader.finish();
}

}  // namespace fathom
