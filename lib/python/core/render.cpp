#include "fathom/render.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cstring>

#include "arrays.h"
#include "bindings.h"
#include "fathom/image/depth_map.h"
#include "fathom/memory/available_memory.h"
#include "fathom/numeric/errors.h"
#include "fathom/threads/threads.h"
#include "maps.h"
#include "running.h"
#include "scene.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

/// Options as Python's code has them, with names that it has checked.
RenderOptions make_options(const std::vector<std::string>& channels, const std::string& cull,
                           const std::string& type, double scale, const std::string& engine,
                           int threads) {
  RenderOptions options;
  options.channels.clear();
  for (const std::string& name : channels) {
    const auto channel = channel_named(name);
    if (!channel) {
      throw UsageError("channels: there is no '" + name + "', expected some of " + channel_names());
    }
    options.channels.push_back(*channel);
  }
  options.cull = cull == "back" ? Cull::back : cull == "front" ? Cull::front : Cull::none;
  options.depth_encoding.type = type == "float64"  ? StoredType::binary64
                                : type == "uint16" ? StoredType::scaled_unorm16
                                                   : StoredType::binary32;
  options.depth_encoding.scale = scale;
  options.engine = engine == "reference" ? Engine::reference : Engine::fast;
  options.threads = threads;
  require_meaningful(options);
  return options;
}

/// Element k of each of `count` groups of `parts` values is value k of part `part`.
void interleave(const float* values, std::size_t count, std::size_t part, std::size_t parts,
                float* target) {
  for (std::size_t i = 0; i < count; ++i) target[i * parts + part] = values[i];
}

/// What one channel is in Python: an array with a last axis for its parts, if it has several.
struct Target {
  std::vector<std::string> names;  // of the channels in the map
  std::variant<Samples<float>, Samples<double>, Samples<std::uint16_t>, Samples<std::uint32_t>>
      values;
};

template <class Result, class Source>
auto samples_like(const Source& source, std::size_t count) -> Result {
  return std::visit(
      [&](const auto& values) -> Result { return std::decay_t<decltype(values)>(count); }, source);
}

/// Room for `maps` of a channel, of the type that it has in `map`.
Target make_target(const DepthMap& map, Channel channel, std::size_t maps) {
  Target target{part_names(channel), {}};
  const std::size_t pixels = std::size_t{map.width} * map.height;
  target.values = samples_like<decltype(target.values)>(map.find(target.names.front())->values,
                                                        pixels * target.names.size() * maps);
  return target;
}

void copy_into(Target& target, const DepthMap& map, std::size_t number) {
  const std::size_t parts = target.names.size();
  const std::size_t pixels = std::size_t{map.width} * map.height;
  for (std::size_t part = 0; part < parts; ++part) {
    std::visit(
        [&](auto& values) {
          using T = typename std::decay_t<decltype(values)>::value_type;
          const T* const source = map.values<T>(target.names[part])->data();
          T* const place = values.data() + number * pixels * parts;
          if (parts == 1) {
            std::memcpy(place, source, pixels * sizeof(T));
          } else if constexpr (std::is_same_v<T, float>) {
            interleave(source, pixels, part, parts, place);
          }
        },
        target.values);
  }
}

py::array as_array(Target&& target, Shape shape) {
  if (target.names.size() > 1) shape.push_back(static_cast<py::ssize_t>(target.names.size()));
  return std::visit([&](auto& values) { return array_of(std::move(values), shape); },
                    target.values);
}

/// One map, and its channels: a channel of one part is not copied.
std::pair<SharedMap, py::dict> render_one(const SharedScene& shared, const Camera& camera,
                                          const RenderOptions& asked) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  std::vector<Target> targets;
  auto map = run([&](const auto& progress) {
    RenderOptions options = asked;
    options.progress = progress;
    auto rendered = std::make_shared<DepthMap>(render(*scene, camera, options));
    for (const Channel channel : options.channels) {
      const auto names = part_names(channel);
      if (names.size() == 1) {
        targets.push_back({names, std::move(rendered->find(names.front())->values)});
      } else {
        targets.push_back(make_target(*rendered, channel, 1));
        copy_into(targets.back(), *rendered, 0);
      }
    }
    rendered->channels.clear();
    return rendered;
  });
  py::dict arrays;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    arrays[py::str(std::string(description_of(asked.channels[i]).name))] =
        as_array(std::move(targets[i]), {camera.height, camera.width});
  }
  return {std::move(map), std::move(arrays)};
}

/// Whether each thread had better render maps of its own than all of them a map together: so they
/// need not wait for each other, but each has its own vertices of the whole scene in the image.
bool one_thread_each(const Scene& scene, std::size_t cameras, int threads) {
  constexpr std::size_t most_triangles = 1U << 20;
  return threads != 1 && cameras >= 16 && triangle_count(scene) <= most_triangles;
}

/// Many maps of one size, as arrays with the number of the camera in front.
py::dict render_stack(const SharedScene& shared, const std::vector<Camera>& cameras,
                      const RenderOptions& asked) {
  const std::shared_ptr<const Scene> scene = shared.scene;
  std::vector<Target> targets;
  run([&](const auto& progress) {
    const bool each = one_thread_each(*scene, cameras.size(), asked.threads);
    RenderOptions options = asked;
    if (each) options.threads = 1;
    const auto render_into = [&](std::size_t number) {
      const DepthMap map = render(*scene, cameras[number], options);
      for (Target& target : targets) copy_into(target, map, number);
    };
    // The first one says what the others are like.
    {
      RenderOptions first = asked;
      first.progress = progress;
      const DepthMap map = render(*scene, cameras.front(), first);
      for (const Channel channel : options.channels) {
        targets.push_back(make_target(map, channel, cameras.size()));
        copy_into(targets.back(), map, 0);
      }
    }
    if (each) {
      Progress done(progress, cameras.size());
      with_threads(asked.threads, [&] {
        parallel_for(std::size_t{1}, cameras.size(), [&](std::size_t number) {
          render_into(number);
          done.part_done();
        });
      });
    } else {
      options.progress = progress;
      for (std::size_t number = 1; number < cameras.size(); ++number) render_into(number);
    }
  });
  py::dict arrays;
  const Camera& camera = cameras.front();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    arrays[py::str(std::string(description_of(asked.channels[i]).name))] =
        as_array(std::move(targets[i]),
                 {static_cast<py::ssize_t>(cameras.size()), camera.height, camera.width});
  }
  return arrays;
}

/// Refuses what would end the process. As the machine's lack of memory does, it says MemoryError.
void require_bytes(const std::string& what, double bytes) {
  try {
    require_memory(what, bytes, available_memory());
  } catch (const InputError& error) {
    PyErr_SetString(PyExc_MemoryError, error.what());
    throw py::error_already_set();
  }
}

}  // namespace

void bind_render(py::module_& core) {
  py::class_<RenderOptions>(core, "RenderOptions").def(py::init(&make_options));
  core.def("render_one", &render_one);
  core.def("render_stack", &render_stack);
  core.def("require_bytes", &require_bytes);
  core.def("channels", [] {
    py::dict channels;
    for (const ChannelDescription& each : channel_table)
      channels[py::str(std::string(each.name))] =
          py::make_tuple(std::string(each.parts), std::string(each.meaning));
    return channels;
  });
  core.attr("no_surface") = no_surface;
}

}  // namespace fathom::python
