#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "bindings.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/files/file_bytes.h"
#include "fathom/image/convert.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/files/renamed_channels.h"
#include "fathom/image/map_files.h"
#include "fathom/image/png_files.h"
#include "fathom/image/point_cloud.h"
#include "fathom/image/preview.h"
#include "fathom/image/surface.h"
#include "fathom/rendering/options.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
namespace {

/// The channels as arrays of height × width, each of which owns its memory; the map keeps none.
py::dict take_channels(DepthMap& map) {
  py::dict arrays;
  const Shape shape{map.height, map.width};
  for (ImageChannel& channel : map.channels) {
    arrays[py::str(channel.name)] = std::visit(
        [&](auto& values) { return array_of(std::move(values), shape); }, channel.values);
  }
  map.channels.clear();
  return arrays;
}

template <class T>
bool add_if_of(DepthMap& map, const std::string& name, const py::array& array) {
  if (!py::isinstance<ContiguousArray<T>>(array)) return false;
  const auto values = py::reinterpret_borrow<ContiguousArray<T>>(array);
  const T* const first = values.data();
  map.channels.push_back({name, Samples<T>(first, first + values.size())});
  return true;
}

/// The same map with these channels. Python has made sure of their shapes and order.
SharedMap with_channels(const DepthMap& map, std::uint32_t height, std::uint32_t width,
                        const std::vector<std::pair<std::string, py::array>>& channels) {
  auto result = std::make_shared<DepthMap>(map);
  result->channels.clear();
  result->height = height;
  result->width = width;
  for (const auto& [name, array] : channels) {
    if (!add_if_of<float>(*result, name, array) && !add_if_of<double>(*result, name, array) &&
        !add_if_of<std::uint16_t>(*result, name, array) &&
        !add_if_of<std::uint32_t>(*result, name, array)) {
      throw py::type_error("channel " + name +
                           ": expected float32, float64, uint16 or uint32, found " +
                           std::string(py::str(array.dtype())));
    }
  }
  return result;
}

SharedMap read(const std::filesystem::path& path) {
  return run([&](const auto&) { return std::make_shared<DepthMap>(read_map(path)); });
}

void write(const SharedMap& map, const std::filesystem::path& path, const std::string& channel,
           const std::string& compression, int threads,
           const std::vector<std::pair<std::string, std::string>>& names,
           const std::optional<Camera>& camera, int normal_bits, const std::string& normal_axes) {
  const MapFormat format = require_map_format(path);
  WriteOptions options;
  options.channel = channel;
  options.camera = camera;
  options.threads = threads;
  options.normals = {normal_bits, named_value("normal_axes", all_normal_axes, normal_axes)};
  options.compression = named_value("compression", all_compressions, compression);
  std::vector<ChannelName> others;
  others.reserve(names.size());
  for (const auto& [own, in_file] : names) others.push_back({own, in_file});
  run([&](const auto&) {
    if (others.empty()) return write_map(*map, path, format, options);
    write_map(with_channel_names(*map, others), path, format, options);
  });
}

SharedMap convert(const SharedMap& map, const std::string& from, const std::string& to,
                  const Camera& camera, std::optional<double> baseline, double doffs,
                  std::optional<double> background) {
  std::optional<StereoRig> rig;
  if (baseline) rig = StereoRig{*baseline, doffs};
  const DepthQuantity source = named_value("from", all_depth_quantities, from);
  const DepthQuantity target = named_value("to", all_depth_quantities, to);
  return run([&](const auto&) {
    return std::make_shared<DepthMap>(
        convert_quantity(*map, source, target, camera, rig, background));
  });
}

SharedMap store(const DepthMap& map, const std::string& channel, const std::string& type,
                std::optional<double> scale) {
  const StoredType stored = named_value("dtype", all_stored_types, type);
  return run([&](const auto&) {
    return std::make_shared<DepthMap>(with_storage(map, channel, stored, scale));
  });
}

void write_mask(const SharedMap& map, const std::filesystem::path& path,
                std::optional<std::uint32_t> object) {
  run([&](const auto&) { files::write_file(path, encode_mask(*map, path.string(), object)); });
}

/// One cloud of the points of all maps; of a stack each point has the number of its view.
void write_points(const std::vector<SharedMap>& maps, const std::vector<Camera>& cameras,
                  const std::filesystem::path& path, const std::string& frame, bool binary64,
                  bool is_stack) {
  const PointFrame chosen = named_value("frame", all_point_frames, frame);
  run([&](const auto&) {
    PointCloud cloud({.frame = chosen, .binary64 = binary64, .numbers_views = is_stack});
    for (std::size_t i = 0; i < maps.size(); ++i) {
      cloud.add(*maps[i], cameras[i], "view " + std::to_string(i));
    }
    files::write_file(path, cloud.encode());
  });
}

/// N×3.
py::array points(const SharedMap& map, const Camera& camera, const std::string& frame) {
  const auto found = run([&](const auto&) {
    return points_of(*map, camera, named_value("frame", all_point_frames, frame));
  });
  Samples<double> flat(3 * found.size());
  for (std::size_t i = 0; i < flat.size(); ++i) flat[i] = found[i / 3][i % 3];
  return array_of(std::move(flat), {static_cast<py::ssize_t>(found.size()), 3});
}

template <class T>
bool lend_if_of(DepthMap& map, const std::string& name, py::array array) {
  if (!py::isinstance<ContiguousArray<T>>(array)) return false;
  map.channels.push_back({name, Samples<T>::lent(static_cast<T*>(array.mutable_data()),
                                                 static_cast<std::size_t>(array.size()))});
  return true;
}

/// Changes the arrays of a map that was rendered, and returns its texts.
std::map<std::string, std::string> set_background(
    const DepthMap& description, std::uint32_t height, std::uint32_t width,
    const std::vector<std::pair<std::string, py::array>>& channels, double value) {
  DepthMap map = description;
  map.height = height;
  map.width = width;
  for (const auto& [name, array] : channels) {
    if (!lend_if_of<float>(map, name, array) && !lend_if_of<double>(map, name, array))
      lend_if_of<std::uint32_t>(map, name, array);
  }
  constexpr double rendered = std::numeric_limits<double>::infinity();
  return run([&](const auto&) { return with_background(std::move(map), value, rendered).texts; });
}

}  // namespace

void bind_maps(Module& core) {
  Class<DepthMap, SharedMap>(core, "Map")
      .def(py::init<>())
      .def_readonly("width", &DepthMap::width)
      .def_readonly("height", &DepthMap::height)
      .def_property_readonly("camera", [](const DepthMap& map) { return map.camera; })
      .def_readwrite("texts", &DepthMap::texts)
      .def_readwrite("object_names", &DepthMap::object_names)
      .def_readwrite("tables", &DepthMap::tables)
      .def_readwrite("png_scale", &DepthMap::png_scale)
      .def("texts_of_file", &texts_of)
      .def("take_channels", &take_channels)
      .def("with_channels", &with_channels);
  core.def("read_map", &read);
  core.def("write_map", &write);
  core.def("require_map_name", [](const std::filesystem::path& path) { require_map_format(path); });
  core.def("convert_quantity", &convert);
  core.def("with_storage",
           [](const SharedMap& map, const std::string& channel, const std::string& type,
              std::optional<double> scale) { return store(*map, channel, type, scale); });
  core.def("points", &points);
  core.def("set_background", &set_background);
  core.def("write_mask", &write_mask);
  core.def("write_point_cloud", &write_points);
  core.attr("background_text") = background_text;
  core.attr("camera_text") = camera_text;
  core.attr("normals_text") = normals_text;
  core.attr("compressions") = names_of(all_compressions);
  core.attr("quantities") = names_of(all_depth_quantities);
  core.attr("point_frames") = names_of(all_point_frames);
  core.attr("normal_axes") = names_of(all_normal_axes);
}

// Pictures of maps as arrays of colours, and as PNG.

namespace {

using Picture = ContiguousArray<std::uint8_t>;

/// Python has made sure of the shape.
RgbImage image_of(const Picture& array) {
  RgbImage image(static_cast<std::uint32_t>(array.shape(1)),
                 static_cast<std::uint32_t>(array.shape(0)));
  std::memcpy(image.pixels.data(), array.data(), static_cast<std::size_t>(array.size()));
  return image;
}

py::array draw(const SharedMap& map, const std::string& channel,
               const std::optional<std::string>& colours, const std::string& scale,
               std::optional<double> low, std::optional<double> high, const std::string& unit) {
  PreviewOptions options;
  options.channel = channel;
  if (colours) options.colours = named_value("colormap", all_colour_maps, *colours);
  options.scale = named_value("scale", all_colour_scales, scale);
  options.low = low;
  options.high = high;
  options.unit = unit;
  return array_of(run([&](const auto&) { return draw_preview(*map, options); }));
}

}  // namespace

py::array array_of(const RgbImage& picture) {
  static_assert(sizeof(Rgb) == 3);
  Samples<std::uint8_t> bytes(3 * picture.pixels.size());
  std::memcpy(bytes.data(), picture.pixels.data(), bytes.size());
  return array_of(std::move(bytes), {static_cast<py::ssize_t>(picture.height),
                                     static_cast<py::ssize_t>(picture.width), 3});
}

void bind_pictures(Module& core) {
  core.attr("color_maps") = names_of(all_colour_maps);
  core.attr("color_scales") = names_of(all_colour_scales);
  core.def("draw_preview", &draw);
  core.def("write_png", [](const Picture& picture, const std::filesystem::path& path) {
    const RgbImage image = image_of(picture);
    run([&](const auto&) { write_png(image, path); });
  });
  core.def("encode_png", [](const Picture& picture) {
    const RgbImage image = image_of(picture);
    const auto bytes = run([&](const auto&) { return encode_png(image, "picture"); });
    return py::bytes(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  });
}

}  // namespace fathom::python
