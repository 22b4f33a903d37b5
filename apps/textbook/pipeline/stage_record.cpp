#include "apps/textbook/pipeline/stage_record.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/text/counted.h"

namespace fathom::app::stages {

using cases::Json;
using pipeline::PipelineOptions;

namespace {

/// The size of the image: the camera's, or "width" and "height".
std::array<std::int64_t, 2> image_size(const Json& record) {
  if (const auto camera = camera_of(record)) return {camera->width, camera->height};
  for (const char* key : {"width", "height"}) cases::member(record, key);
  return {whole(record, "width", 0, 1, 1 << 20), whole(record, "height", 0, 1, 1 << 20)};
}

std::optional<pipeline::WindowRectangle> rectangle(const Json& record, const std::string& key) {
  if (!record.contains(key)) return std::nullopt;
  const auto r = cases::numbers(record[key], key, 4, 4);
  for (const double x : r)
    if (x != std::floor(x) || std::abs(x) > 1e9)
      throw InputError(fmt::format("\"{}\": {} is not a whole number of pixels", key, x));
  const auto at = [&](std::size_t i) { return static_cast<std::int64_t>(r[i]); };
  return pipeline::WindowRectangle{at(0), at(1), at(2), at(3)};
}

/// The value of a word of the record, read by `parse`, which fails with UsageError.
template <class Parse>
auto named(const Json& record, const std::string& key, const std::string& otherwise,
           const Parse& parse) {
  const auto found = record.find(key);
  if (found != record.end() && !found->is_string())
    throw InputError(fmt::format("\"{}\": expected a word, found {}", key, found->dump()));
  try {
    return parse(found == record.end() ? otherwise : found->get<std::string>());
  } catch (const UsageError& error) {
    throw InputError(fmt::format("\"{}\": {}", key, error.what()));
  }
}

pipeline::WireLine line_of(const Json& record) {
  using pipeline::WireLine;
  const std::string name =
      cases::word(record, "line", {"bresenham", "explicit", "dda", "midpoint", "diamond-exit"});
  return name == "explicit"    ? WireLine::explicit_equation
         : name == "dda"       ? WireLine::dda
         : name == "midpoint"  ? WireLine::midpoint
         : name == "bresenham" ? WireLine::bresenham
                               : WireLine::diamond_exit;
}

}  // namespace

void expect_known_keys(const Json& record) {
  cases::expect_only(
      record,
      {"primitive",     "vertices",   "indices",   "primitives", "number",        "camera",
       "transform",     "near",       "far",       "mapping",    "world",         "eye",
       "clip",          "depths",     "colours",   "ndc",        "inverse_w",     "front_face",
       "cull",          "facing",     "culled",    "viewport",   "width",         "height",
       "depth_range",   "stretched",  "window",    "snapped",    "subpixel_bits", "line",
       "interpolation", "scissor",    "fragments", "storage",    "depth_test",    "depth_write",
       "blend",         "background", "buffer",    "merged"},
      "a stage");
}

double number(const Json& record, const std::string& key, double otherwise) {
  const auto found = record.find(key);
  if (found == record.end()) return otherwise;
  if (!found->is_number()) throw InputError(fmt::format("\"{}\": expected a number", key));
  return found->get<double>();
}

std::int64_t whole(const Json& record, const std::string& key, std::int64_t otherwise, double least,
                   double most) {
  const double value = number(record, key, static_cast<double>(otherwise));
  if (value != std::floor(value) || value < least || value > most)
    throw InputError(fmt::format("\"{}\" is {}; expected a whole number from {:.0f} to {:.0f}", key,
                                 value, least, most));
  return static_cast<std::int64_t>(value);
}

std::optional<Camera> camera_of(const Json& record) {
  if (!record.contains("camera")) return std::nullopt;
  const auto cameras = read_cameras(record["camera"].dump(), "camera");
  if (cameras.size() != 1) throw InputError("\"camera\": expected one camera");
  return cameras[0];
}

Camera image_of(const Json& record) {
  const auto [width, height] = image_size(record);
  Camera camera = camera_of(record).value_or(Camera());
  camera.width = static_cast<std::uint32_t>(width);
  camera.height = static_cast<std::uint32_t>(height);
  return camera;
}

PipelineOptions options_of(const Json& record, pipeline::Precision precision) {
  using pipeline::Culling;
  PipelineOptions options;
  options.precision = precision;
  options.depth_format.mapping = named(record, "mapping", "standard", mapping_named);
  options.depth_format.storage = named(record, "storage", "float32", storage_named);
  options.depth_format.near = number(record, "near", 0);
  options.depth_format.far = number(record, "far", 0);
  options.viewport = rectangle(record, "viewport");
  options.scissor = rectangle(record, "scissor");
  if (record.contains("depth_range")) {
    const auto range = cases::numbers(record["depth_range"], "depth_range", 2, 2);
    options.depth_range = {range[0], range[1]};
  }
  if (cases::word(record, "front_face", {"ccw", "cw"}) == "cw")
    options.front_face = pipeline::FrontFace::clockwise;
  const std::string cull = cases::word(record, "cull", {"none", "back", "front"});
  options.culling = cull == "none"   ? Culling::none
                    : cull == "back" ? Culling::back
                                     : Culling::front;
  options.subpixel_bits = static_cast<int>(
      whole(record, "subpixel_bits", options.subpixel_bits, 0, pipeline::most_subpixel_bits));
  if (cases::word(record, "interpolation", {"perspective", "affine"}) == "affine")
    options.interpolation = pipeline::Interpolation::affine;
  options.wire_line = line_of(record);
  try {
    pipeline::require_meaningful(options);
  } catch (const UsageError& error) {
    throw InputError(error.what());
  }
  return options;
}

std::vector<std::vector<double>> beside(const Json& record, const std::string& key,
                                        std::size_t corners, std::size_t each) {
  auto values = cases::points(record, key, each, each);
  if (values.size() != corners)
    throw InputError(fmt::format("\"{}\": {} for {}", key, text::counted(values.size(), "value"),
                                 text::counted(corners, "corner")));
  return values;
}

std::vector<double> numbers_beside(const Json& record, const std::string& key,
                                   std::size_t corners) {
  auto values = cases::numbers(record[key], key, 0, unlimited);
  if (values.size() != corners)
    throw InputError(fmt::format("\"{}\": {} for {}", key, text::counted(values.size(), "number"),
                                 text::counted(corners, "corner")));
  return values;
}

}  // namespace fathom::app::stages
