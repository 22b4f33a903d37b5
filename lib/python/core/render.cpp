#include "fathom/render.h"

#include <pybind11/stl.h>

#include <array>
#include <cstddef>

#include "bindings.h"
#include "fathom/failures/errors.h"
#include "fathom/image/channel_names.h"
#include "fathom/image/depth_map.h"
#include "fathom/memory/available_memory.h"
#include "fathom/rendering/options.h"
#include "fathom/rendering/segment_channels.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/scene/view_warnings.h"
#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {

RenderOptions options_of(const std::string& cull, int threads) {
  RenderOptions options;
  options.cull = named_value("cull", all_culls, cull);
  options.threads = threads;
  return options;
}

namespace {

/// Options from the arguments of Python, which has checked the names.
RenderOptions make_options(const std::vector<std::string>& channels, const std::string& cull,
                           const std::string& type, double scale, const std::string& engine,
                           int threads, const std::string& normals) {
  RenderOptions options;
  options.channels.clear();
  for (const std::string& name : channels) {
    const auto channel = channel_named(name);
    if (!channel) {
      throw UsageError(std::string("channels: ") + unknown_channel(name).what());
    }
    options.channels.push_back(*channel);
  }
  options.cull = named_value("cull", all_culls, cull);
  options.depth_encoding.type = named_value("dtype", all_stored_types, type);
  options.depth_encoding.scale = scale;
  options.engine = named_value("engine", all_engines, engine);
  options.threads = threads;
  options.normals = named_value("normals", all_normal_sources, normals);
  require_meaningful(options);
  return options;
}

/// NumPy's type for a channel; "" if it is the requested type.
std::string numpy_type_of(ChannelType type) {
  if (type == ChannelType::identifier) return "uint32";
  return type == ChannelType::binary32 ? std::string(name_of(StoredType::binary32)) : "";
}

/// The destination of one channel of all maps: a Python array of the channel's type. The first
/// index is the number of the camera, if there are several, and the last index is the part, if the
/// channel has several.
struct Target {
  Target(const Channel channel, py::array& array)
      : names(part_names(channel)),
        data(static_cast<std::byte*>(array.mutable_data())),
        bytes_of_value(static_cast<std::size_t>(array.itemsize())) {}

  /// The place where the values of a map begin. A channel with one part is written there directly.
  [[nodiscard]] std::byte* of_map(std::size_t number, std::size_t pixels) const {
    return data + number * pixels * names.size() * bytes_of_value;
  }

  std::vector<std::string> names;  // of the channels of a map
  std::byte* data;
  std::size_t bytes_of_value;
};

/// Interleaves the parts of a channel, which are separate in maps and together in arrays. They are
/// binary32.
void interleave(const Target& target, const DepthMap& map, std::size_t number) {
  const std::size_t parts = target.names.size();
  const std::size_t width = map.width;
  auto* const place = reinterpret_cast<float*>(target.of_map(number, width * map.height));
  parallel_for(std::uint32_t{0}, map.height, [&](std::uint32_t row) {
    for (std::size_t part = 0; part < parts; ++part) {
      const float* const source = map.values<float>(target.names[part])->data() + row * width;
      float* const values = place + row * width * parts + part;
      for (std::size_t x = 0; x < width; ++x) values[x * parts] = source[x];
    }
  });
}

/// A map without its channels, and warnings about its view.
struct Described {
  DepthMap map;
  std::vector<ViewWarning> warnings;
};

/// Renders one map into its place in the arrays.
Described render_into(const Scene& scene, const Camera& camera, const RenderOptions& options,
                      RenderContext context, const std::vector<Target>& targets,
                      std::size_t number) {
  const std::size_t pixels = std::size_t{camera.width} * camera.height;
  context.memory = [&](const std::string& name) -> void* {
    for (const Target& target : targets)
      if (target.names.size() == 1 && target.names[0] == name) return target.of_map(number, pixels);
    return nullptr;
  };
  Rendered rendered = render(scene, camera, options, context);
  with_threads(options.threads, [&] {
    for (const Target& target : targets)
      if (target.names.size() > 1) interleave(target, rendered.map, number);
  });
  rendered.map.channels.clear();
  return {std::move(rendered.map),
          view_warnings(scene, camera, rendered.statistics.pixels_with_surface)};
}

/// Whether each thread should render its own maps, instead of all threads sharing a map. Threads
/// then do not wait for each other, but each has its own projected vertices of the whole scene.
bool one_thread_each(const Scene& scene, std::size_t cameras, int threads) {
  constexpr std::size_t most_triangles = 1U << 20;
  return threads != 1 && cameras >= 16 && triangle_count(scene) <= most_triangles;
}

std::vector<Described> render_all(const Scene& scene, const std::vector<Camera>& cameras,
                                  const RenderOptions& options,
                                  const std::function<void(double)>& progress,
                                  const std::vector<Target>& targets) {
  std::vector<Described> rendered(cameras.size());
  if (!one_thread_each(scene, cameras.size(), options.threads)) {
    RenderMemory memory;
    const RenderContext together{.kept = &memory, .progress = progress};
    for (std::size_t i = 0; i < cameras.size(); ++i)
      rendered[i] = render_into(scene, cameras[i], options, together, targets, i);
    return rendered;
  }
  RenderOptions alone = options;
  alone.threads = 1;
  Progress done(progress, cameras.size());
  PerThread<RenderMemory> memories;
  with_threads(options.threads, [&] {
    parallel_for(std::size_t{0}, cameras.size(), [&](std::size_t i) {
      rendered[i] = render_into(scene, cameras[i], alone, {.kept = &memories.local()}, targets, i);
      done.part_done();
    });
  });
  return rendered;
}

/// Python has made an array of the right type, shape and order for each requested channel, in the
/// order of the channels.
std::vector<Target> targets_of(const RenderOptions& options, std::vector<py::array>& arrays) {
  std::vector<Target> targets;
  targets.reserve(arrays.size());
  for (std::size_t i = 0; i < arrays.size(); ++i)
    targets.emplace_back(options.channels.at(i), arrays[i]);
  return targets;
}

std::pair<SharedMap, Warnings> render_one(const SharedScene& shared, const Camera& camera,
                                          const RenderOptions& options,
                                          std::vector<py::array> arrays) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const std::vector<Target> targets = targets_of(options, arrays);
  return run([&](const auto& progress) {
    Described rendered = render_into(*scene, camera, options, {.progress = progress}, targets, 0);
    const std::array warnings{std::move(rendered.warnings)};
    return std::pair(std::make_shared<DepthMap>(std::move(rendered.map)), told_once(warnings));
  });
}

std::pair<std::vector<SharedMap>, Warnings> render_stack(const SharedScene& shared,
                                                         const std::vector<Camera>& cameras,
                                                         const RenderOptions& options,
                                                         std::vector<py::array> arrays) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  const std::vector<Target> targets = targets_of(options, arrays);
  return run([&](const auto& progress) {
    std::vector<SharedMap> maps;
    std::vector<std::vector<ViewWarning>> warnings;
    for (Described& each : render_all(*scene, cameras, options, progress, targets)) {
      maps.push_back(std::make_shared<DepthMap>(std::move(each.map)));
      warnings.push_back(std::move(each.warnings));
    }
    return std::pair(std::move(maps), told_once(warnings));
  });
}

/// Refuses sizes that would end the process. Raises MemoryError, as if the machine had run out of
/// memory.
void require_bytes(const std::string& what, double bytes) {
  try {
    require_memory(what, bytes, available_memory());
  } catch (const InputError& error) {
    PyErr_SetString(PyExc_MemoryError, error.what());
    throw py::error_already_set();
  }
}

}  // namespace

void bind_render(Module& core) {
  Class<RenderOptions>(core, "RenderOptions").def(py::init(&make_options));
  core.def("render_one", &render_one);
  core.def("render_stack", &render_stack);
  core.def("require_bytes", &require_bytes);
  core.def("array_in_small_pages", &array_in_small_pages);
  core.def("unknown_contents",
           [](const std::string& name) { return std::string(unknown_contents(name).what()); });
  py::dict contents;
  for (const ContentsName& each : contents_table)
    contents[py::str(std::string(each.name))] = std::string(description_of(each.channel).name);
  core.attr("most_pixels") = most_pixels_of_image;
  core.attr("too_many_pixels") = too_many_pixels;
  core.attr("contents") = contents;
  core.attr("png_scale") = DepthEncoding{}.scale;
  core.def("channels", [] {
    py::dict channels;
    for (const ChannelDescription& each : channel_table)
      channels[py::str(std::string(each.name))] =
          py::make_tuple(std::string(each.parts), numpy_type_of(each.type));
    return channels;
  });
  core.attr("culls") = names_of(all_culls);
  core.attr("engines") = names_of(all_engines);
  core.attr("normal_sources") = names_of(all_normal_sources);
  core.attr("stored_types") = names_of(all_stored_types);
  py::list segments;
  for (const Channel each : segment_channels) segments.append(description_of(each).name);
  core.attr("segment_channels") = segments;
  core.attr("no_surface") = no_surface;
  core.attr("no_segment") = no_segment;
}

}  // namespace fathom::python
