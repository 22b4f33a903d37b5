#include "maps.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "arrays.h"
#include "bindings.h"
#include "fathom/camera/camera.h"
#include "fathom/image/compare.h"
#include "fathom/image/convert.h"
#include "fathom/image/map_files.h"
#include "fathom/image/point_cloud.h"
#include "fathom/image/preview.h"
#include "fathom/numeric/errors.h"
#include "running.h"

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

void write(const DepthMap& map, const std::filesystem::path& path, const std::string& channel,
           const std::string& compression, int threads) {
  const auto format = map_format_of(path);
  if (!format) {
    throw UsageError(path.string() + ": expected a name that ends in .exr, .pfm, .png or .npy");
  }
  WriteOptions options;
  options.channel = channel;
  options.threads = threads;
  const std::pair<const char*, Compression> names[] = {{"none", Compression::none},
                                                       {"rle", Compression::rle},
                                                       {"zips", Compression::zips},
                                                       {"zip", Compression::zip},
                                                       {"piz", Compression::piz}};
  const auto* const found = std::find_if(std::begin(names), std::end(names), [&](const auto& each) {
    return compression == each.first;
  });
  if (found == std::end(names))
    throw UsageError("compression: expected none, rle, zips, zip or piz");
  options.compression = found->second;
  run([&](const auto&) { write_map(map, path, *format, options); });
}

MapView view_of(const Camera& camera) {
  MapView view;
  view.orthographic = camera.projection == Projection::orthographic;
  view.fx = camera.fx;
  view.fy = camera.fy;
  view.cx = camera.cx;
  view.cy = camera.cy;
  view.skew = camera.skew;
  view.pixel_centre = camera.pixel_centre;
  view.world_to_camera = camera.world_to_camera;
  return view;
}

DepthQuantity quantity_named(const std::string& name) {
  for (const DepthQuantity each :
       {DepthQuantity::planar_depth, DepthQuantity::ray_distance, DepthQuantity::disparity})
    if (channel_of(each) == name) return each;
  throw UsageError("expected Z, distance or disparity, found " + name);
}

SharedMap convert(const DepthMap& map, const std::string& from, const std::string& to,
                  const Camera& camera, std::optional<double> baseline, double doffs) {
  std::optional<StereoRig> rig;
  if (baseline) rig = StereoRig{*baseline, doffs};
  const DepthQuantity source = quantity_named(from), target = quantity_named(to);
  return run([&](const auto&) {
    return std::make_shared<DepthMap>(convert_quantity(map, source, target, view_of(camera), rig));
  });
}

SharedMap store(const DepthMap& map, const std::string& channel, const std::string& type,
                std::optional<double> scale) {
  const StoredType stored = type == "float32"   ? StoredType::binary32
                            : type == "float64" ? StoredType::binary64
                                                : StoredType::scaled_unorm16;
  return run([&](const auto&) {
    return std::make_shared<DepthMap>(with_storage(map, channel, stored, scale));
  });
}

void write_points(const DepthMap& map, const Camera& camera, const std::filesystem::path& path,
                  bool in_camera_frame, bool binary64) {
  PointCloudOptions options;
  options.frame = in_camera_frame ? PointFrame::camera : PointFrame::world;
  options.binary64 = binary64;
  run([&](const auto&) { write_point_cloud(map, view_of(camera), path, options); });
}

void bind_comparison(py::module_& core) {
  py::class_<DifferenceSummary>(core, "DifferenceSummary")
      .def_readonly("max", &DifferenceSummary::max)
      .def_readonly("mean", &DifferenceSummary::mean)
      .def_readonly("p50", &DifferenceSummary::p50)
      .def_readonly("p90", &DifferenceSummary::p90)
      .def_readonly("p99", &DifferenceSummary::p99)
      .def_readonly("p99_9", &DifferenceSummary::p99_9)
      .def_property_readonly("worst", [](const DifferenceSummary& summary) {
        return std::pair(summary.worst.x, summary.worst.y);
      });
  py::class_<ChannelComparison>(core, "ChannelComparison")
      .def_readonly("truth_channel", &ChannelComparison::truth_channel)
      .def_readonly("other_channel", &ChannelComparison::other_channel)
      .def_readonly("pixels", &ChannelComparison::pixels)
      .def_readonly("both", &ChannelComparison::both)
      .def_readonly("only_truth", &ChannelComparison::only_truth)
      .def_readonly("only_other", &ChannelComparison::only_other)
      .def_readonly("neither", &ChannelComparison::neither)
      .def_readonly("compared", &ChannelComparison::compared)
      .def_readonly("bit_equal", &ChannelComparison::bit_equal)
      .def_readonly("incommensurable", &ChannelComparison::incommensurable)
      .def_readonly("different_identifiers", &ChannelComparison::different_identifiers)
      .def_readonly("beyond_tolerance", &ChannelComparison::beyond_tolerance)
      .def_readonly("absolute", &ChannelComparison::absolute)
      .def_readonly("relative", &ChannelComparison::relative)
      .def_readonly("ulp", &ChannelComparison::ulp)
      .def_readonly("notes", &ChannelComparison::notes)
      .def_property_readonly("within_tolerance", &ChannelComparison::within_tolerance);
  py::class_<MapComparison>(core, "MapComparison")
      .def_readonly("channels", &MapComparison::channels)
      .def_readonly("only_in_truth", &MapComparison::only_in_truth)
      .def_readonly("only_in_other", &MapComparison::only_in_other)
      .def_readonly("notes", &MapComparison::notes)
      .def_property_readonly("within_tolerance", &MapComparison::within_tolerance);
  core.def("compare_maps",
           [](const SharedMap& truth, const SharedMap& other, double tolerance_ulp,
              const std::string& channel, const std::string& other_channel,
              std::optional<double> truth_background, std::optional<double> other_background) {
             const CompareOptions options{tolerance_ulp, channel, other_channel, truth_background,
                                          other_background};
             return run([&](const auto&) { return compare_maps(*truth, *other, options); });
           });
}

}  // namespace

void bind_maps(py::module_& core) {
  py::class_<DepthMap, SharedMap>(core, "Map")
      .def(py::init<>())
      .def_readonly("width", &DepthMap::width)
      .def_readonly("height", &DepthMap::height)
      .def_readwrite("texts", &DepthMap::texts)
      .def_readwrite("object_names", &DepthMap::object_names)
      .def_readwrite("png_scale", &DepthMap::png_scale)
      .def("take_channels", &take_channels)
      .def("with_channels", &with_channels);
  core.def("read_map", &read);
  core.def("write_map", [](const SharedMap& map, const std::filesystem::path& path,
                           const std::string& channel, const std::string& compression,
                           int threads) { write(*map, path, channel, compression, threads); });
  core.def("convert_quantity",
           [](const SharedMap& map, const std::string& from, const std::string& to,
              const Camera& camera, std::optional<double> baseline,
              double doffs) { return convert(*map, from, to, camera, baseline, doffs); });
  core.def("with_storage",
           [](const SharedMap& map, const std::string& channel, const std::string& type,
              std::optional<double> scale) { return store(*map, channel, type, scale); });
  core.def("write_point_cloud",
           [](const SharedMap& map, const Camera& camera, const std::filesystem::path& path,
              bool in_camera_frame,
              bool binary64) { write_points(*map, camera, path, in_camera_frame, binary64); });
  bind_comparison(core);
}

}  // namespace fathom::python
