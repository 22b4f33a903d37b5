// Pictures of maps as arrays of colours, and as PNG.

#include "pictures.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstring>
#include <optional>
#include <string>

#include "bindings.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/image/preview.h"
#include "objects.h"
#include "options.h"
#include "running.h"
#include "values.h"

namespace py = pybind11;

namespace fathom::python {
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
