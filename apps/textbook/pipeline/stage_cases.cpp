#include "apps/textbook/pipeline/stage_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/textbook/cases/case_answers.h"
#include "apps/textbook/pipeline/pipeline_report.h"
#include "fathom/camera/camera_files.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/pipeline/fragments/fragment.h"
#include "fathom/pipeline/geometry/back_face_culling.h"
#include "fathom/pipeline/geometry/window_triangle.h"
#include "fathom/pipeline/rasterization/rasterizer.h"
#include "fathom/text/counted.h"

namespace fathom::app {
namespace {

using cases::Json;
using pipeline::PipelineOptions;
using pipeline::attribute::colour;
using pipeline::attribute::depth;

constexpr std::size_t unlimited = std::size_t{1} << 20;

/// Accepts the keys of all stages, because the answer of a stage is the record of the next stage.
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

/// The size of the image: the camera's, or "width" and "height".
std::array<std::int64_t, 2> image_size(const Json& record) {
  if (const auto camera = camera_of(record)) return {camera->width, camera->height};
  for (const char* key : {"width", "height"}) cases::member(record, key);
  return {whole(record, "width", 0, 1, 1 << 20), whole(record, "height", 0, 1, 1 << 20)};
}

Camera image_of(const Json& record) {
  const auto [width, height] = image_size(record);
  Camera camera = camera_of(record).value_or(Camera());
  camera.width = static_cast<std::uint32_t>(width);
  camera.height = static_cast<std::uint32_t>(height);
  return camera;
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

/// A member with a list for each corner; it must have as many lists as there are corners.
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

/// The attributes of each corner: depth along the view and colour, white where there is none.
template <class Real>
std::vector<std::vector<Real>> attributes_of(const Json& record, std::size_t corners) {
  std::vector<std::vector<Real>> result(corners, std::vector<Real>(pipeline::attribute::count));
  for (auto& a : result) std::fill_n(a.begin() + colour, 3, Real(1));
  if (record.contains("colours")) {
    const auto colours = beside(record, "colours", corners, 3);
    for (std::size_t k = 0; k < corners; ++k)
      for (std::size_t i = 0; i < 3; ++i) result[k][colour + i] = static_cast<Real>(colours[k][i]);
  }
  if (record.contains("depths")) {
    const auto depths = numbers_beside(record, "depths", corners);
    for (std::size_t k = 0; k < corners; ++k) result[k][depth] = static_cast<Real>(depths[k]);
  }
  return result;
}

/// Writes the attributes back into the record, if it has attributes.
template <class Corners>
void put_attributes(Json& record, const Corners& corners) {
  if (record.contains("depths")) {
    record["depths"] = Json::array();
    for (const auto& c : corners)
      record["depths"].push_back(static_cast<double>(c.attributes[depth]));
  }
  if (!record.contains("colours")) return;
  record["colours"] = Json::array();
  for (const auto& c : corners)
    record["colours"].push_back({static_cast<double>(c.attributes[colour]),
                                 static_cast<double>(c.attributes[colour + 1]),
                                 static_cast<double>(c.attributes[colour + 2])});
}

template <class... Reals>
Json list_of(Reals... values) {
  return Json::array({static_cast<double>(values)...});
}

Json primitive_assembly(Json record, pipeline::Precision) {
  const auto vertices = cases::points(record, "vertices", 3, 3);
  std::vector<std::uint32_t> indices;
  for (const double i : cases::numbers(cases::member(record, "indices"), "indices", 0, unlimited)) {
    if (i != std::floor(i) || i < 0 || i >= static_cast<double>(vertices.size()))
      throw InputError(fmt::format("indices: {} is not the number of one of {}", i,
                                   text::counted(vertices.size(), "vertex", "vertices")));
    indices.push_back(static_cast<std::uint32_t>(i));
  }
  record["primitives"] = Json::array();
  const auto put = [&](const auto& primitives) {
    for (const auto& primitive : primitives) {
      Json& corners = record["primitives"].emplace_back(Json{{"vertices", Json::array()}});
      for (const std::uint32_t v : primitive) corners["vertices"].push_back(vertices[v]);
    }
  };
  const std::string kind = cases::word(record, "primitive", {"triangles", "lines", "points"});
  if (kind == "triangles") put(pipeline::assemble<3>(indices));
  if (kind == "lines") put(pipeline::assemble<2>(indices));
  if (kind == "points") put(pipeline::assemble<1>(indices));
  return record;
}

/// "transform", 3 × 4; the identity where it is missing.
Object object_of(const Json& record) {
  Object object;
  if (!record.contains("transform")) return object;
  const auto rows = cases::points(record, "transform", 4, 4);
  if (rows.size() != 3) throw InputError("transform: expected three rows of four numbers");
  object.placed_as_is = false;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 4; ++k) object.world_from_mesh.rows[i][k] = Dyadic(rows[i][k]);
  return object;
}

template <class Real>
Json vertex_transform(Json record, pipeline::Precision precision) {
  const auto vertices = cases::points(record, "vertices", 3, 3);
  cases::member(record, "camera");
  const Camera camera = *camera_of(record);
  PipelineOptions options = options_of(record, precision);
  Scene scene;
  scene.meshes.emplace_back();
  for (const auto& v : vertices) scene.meshes[0].vertices.push_back({v[0], v[1], v[2]});
  scene.objects.push_back(object_of(record));
  try {
    pipeline::fill_in_range(scene, camera, options.depth_format);
  } catch (const UsageError& error) {
    throw InputError(error.what());
  }
  record["near"] = options.depth_format.near;
  record["far"] = options.depth_format.far;
  const pipeline::VertexTransform<Real> transform(camera, scene.objects[0], options);
  for (const char* key : {"world", "eye", "clip", "depths"}) record[key] = Json::array();
  for (const auto& v : vertices) {
    const auto world = transform.to_world(MeshPoint{v[0], v[1], v[2]});
    const auto eye = transform.to_eye(world);
    const auto clip = transform.to_clip(eye);
    record["world"].push_back(list_of(world.x, world.y, world.z));
    record["eye"].push_back(list_of(eye.x, eye.y, eye.z));
    record["clip"].push_back(list_of(clip.x, clip.y, clip.z, clip.w));
    record["depths"].push_back(-static_cast<double>(eye.z));
  }
  return record;
}

template <class Real>
std::vector<pipeline::ClipVertex<Real>> clip_corners(const Json& record) {
  const auto positions = cases::points(record, "clip", 4, 4);
  auto attributes = attributes_of<Real>(record, positions.size());
  std::vector<pipeline::ClipVertex<Real>> corners;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const auto& p = positions[k];
    corners.push_back({{static_cast<Real>(p[0]), static_cast<Real>(p[1]), static_cast<Real>(p[2]),
                        static_cast<Real>(p[3])},
                       std::move(attributes[k])});
  }
  return corners;
}

/// A point, a line or a polygon, by its number of corners.
template <class Real>
std::vector<pipeline::ClipVertex<Real>> clipped(
    const std::vector<pipeline::ClipVertex<Real>>& corners, clipping::Volume volume) {
  if (corners.size() > 2) return pipeline::clip_triangle(corners, volume);
  if (corners.size() < 2) {
    if (corners.empty() || !pipeline::is_inside(corners[0], volume)) return {};
    return corners;
  }
  const auto line = pipeline::clip_line(corners[0], corners[1], volume);
  if (!line) return {};
  return {(*line)[0], (*line)[1]};
}

template <class Real>
Json clipping_stage(Json record, pipeline::Precision precision) {
  const auto volume = pipeline::volume_of(options_of(record, precision).depth_format.mapping);
  const auto corners = clipped(clip_corners<Real>(record), volume);
  record["clip"] = Json::array();
  for (const auto& c : corners)
    record["clip"].push_back(list_of(c.position.x, c.position.y, c.position.z, c.position.w));
  put_attributes(record, corners);
  return record;
}

template <class Real>
Json perspective_division(Json record, pipeline::Precision) {
  record["ndc"] = Json::array();
  Json inverse_w = Json::array();
  for (const auto& corner : clip_corners<Real>(record)) {
    if (corner.position.w == 0)
      throw InputError("clip: a corner has w = 0, which no division takes; clip it first");
    const auto ndc = pipeline::divide(corner);
    record["ndc"].push_back(list_of(ndc.x, ndc.y, ndc.z));
    inverse_w.push_back(static_cast<double>(ndc.inverse_w));
  }
  record["inverse_w"] = std::move(inverse_w);
  return record;
}

/// The corners in the space that `key` names, with 1/w (1 where it is missing) and attributes.
template <class Vertex, class Real>
std::vector<Vertex> corners_of(const Json& record, const std::string& key) {
  const auto positions = cases::points(record, key, 3, 3);
  const auto attributes = attributes_of<Real>(record, positions.size());
  std::vector<double> inverse_w(positions.size(), 1);
  if (record.contains("inverse_w"))
    inverse_w = numbers_beside(record, "inverse_w", positions.size());
  std::vector<Vertex> corners;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const auto& p = positions[k];
    Vertex vertex{static_cast<Real>(p[0]),
                  static_cast<Real>(p[1]),
                  static_cast<Real>(p[2]),
                  static_cast<Real>(inverse_w[k]),
                  {}};
    std::copy(attributes[k].begin(), attributes[k].end(), vertex.attributes.begin());
    if (!record.contains("depths") && inverse_w[k] != 0)
      vertex.attributes[depth] = Real(1) / vertex.inverse_w;
    corners.push_back(vertex);
  }
  return corners;
}

template <class Real>
Json back_face_culling(Json record, pipeline::Precision precision) {
  const PipelineOptions options = options_of(record, precision);
  constexpr const char* names[] = {"front", "back", "edge on"};
  Json facing = Json::object();
  std::optional<pipeline::Facing> decisive;
  const auto look = [&](const char* space, const auto& corners, const auto& test) {
    if (corners.size() < 3) return;
    decisive = test({corners[0], corners[1], corners[2]}, options.front_face);
    facing[space] = names[static_cast<std::size_t>(*decisive)];
  };
  if (!record.contains("ndc") && !record.contains("window"))
    throw InputError("\"ndc\" or \"window\" is missing");
  if (record.contains("ndc"))
    look("ndc", corners_of<pipeline::NdcVertex<Real>, Real>(record, "ndc"),
         pipeline::facing_in_ndc<Real>);
  if (record.contains("window"))
    look("window", corners_of<pipeline::WindowVertex<Real>, Real>(record, "window"),
         pipeline::facing_in_window<Real>);
  record["facing"] = facing;
  record["culled"] = decisive && pipeline::is_culled(*decisive, options.culling);
  return record;
}

template <class Real>
Json viewport(Json record, pipeline::Precision precision) {
  const PipelineOptions options = options_of(record, precision);
  const Camera image = image_of(record);
  const pipeline::Viewport to_window = pipeline::viewport_of(image, options);
  Json window = Json::array();
  for (const auto& ndc : corners_of<pipeline::NdcVertex<Real>, Real>(record, "ndc")) {
    const auto p = to_window(ndc);
    window.push_back(list_of(p.x, p.y, p.z));
  }
  record["window"] = std::move(window);
  record["stretched"] = pipeline::is_stretched(image, options);
  return record;
}

double fragments_at_most(const pipeline::PixelWindow& box) {
  return std::max(0.0, static_cast<double>(box.x_end - box.x_begin)) *
         std::max(0.0, static_cast<double>(box.y_end - box.y_begin));
}

pipeline::PixelWindow overlap(const pipeline::PixelWindow& a, const pipeline::PixelWindow& b) {
  return {std::max(a.x_begin, b.x_begin), std::max(a.y_begin, b.y_begin),
          std::min(a.x_end, b.x_end), std::min(a.y_end, b.y_end)};
}

template <class Real>
void put_fragments(Json& list, const pipeline::WindowTriangle<Real>& part,
                   const PipelineOptions& options, const pipeline::PixelWindow& window) {
  const auto t = pipeline::Interpolator<Real>::of(part, options);
  if (!t) return;
  const pipeline::PixelWindow box = overlap(t->grid().bounding_box(), window);
  cases::check_effort<double>(fragments_at_most(box) * 16, "steps of the triangle's box",
                              "\"scissor\" limits them");
  for (std::int64_t y = box.y_begin; y < box.y_end; ++y) {
    const pipeline::Span span = t->grid().span_of_row(y, window);
    for (std::int64_t x = span.x_begin; x < span.x_end; ++x) {
      const pipeline::GridPoint sample = pipeline::sample_of({x, y});
      pipeline::Fragment fragment = t->depths_at(sample);
      t->complete(fragment, sample);
      const auto weights = t->linear_weights(sample);
      // As shading ends: rounding may have left the range.
      const auto shown = [&](std::size_t i) {
        return std::clamp(fragment.attributes[colour + i], 0.0, 1.0);
      };
      list.push_back({{"pixel", {x, y}},
                      {"weights", list_of(weights[0], weights[1], weights[2])},
                      {"window_z", fragment.window_z},
                      {"depth", fragment.depth},
                      {"colour", list_of(shown(0), shown(1), shown(2))}});
    }
  }
}

/// The fragments of a line or a point that reach an empty frame buffer.
template <class Real>
void put_fragments(Json& list, const std::vector<pipeline::WindowVertex<Real>>& corners,
                   const PipelineOptions& options, const Camera& image,
                   const pipeline::PixelWindow& window) {
  cases::check_effort<double>(fragments_at_most(window), "pixels in the window",
                              "\"scissor\" limits them");
  pipeline::FrameBuffer buffer(image.width, image.height, 1, {});
  const std::vector<pipeline::DrawRules> rules(1);
  const auto centre = pipeline::GridSamples::centre();
  const pipeline::ObserveMerge observe = [&](const pipeline::MergeStep& step) {
    list.push_back({{"pixel", {step.pixel.x, step.pixel.y}},
                    {"window_z", step.fragment.window_z},
                    {"depth", step.fragment.depth},
                    {"colour", step.colour}});
  };
  const pipeline::RasterizerSettings settings{
      options, rules, centre, pipeline::ShadingRate::per_sample, true, window, &observe};
  pipeline::PipelineStatistics uncounted;
  if (corners.size() == 2)
    pipeline::rasterize_lines<Real>({{0, {corners[0], corners[1]}, 0}}, settings, buffer,
                                    uncounted);
  else
    pipeline::rasterize_points<Real>({{0, corners[0], 0}}, settings, buffer, uncounted);
}

template <class Real>
Json scan_conversion(Json record, pipeline::Precision precision) {
  const PipelineOptions options = options_of(record, precision);
  const Camera image = image_of(record);
  const pipeline::PixelWindow window = pipeline::drawable_window(image, options);
  const auto corners = corners_of<pipeline::WindowVertex<Real>, Real>(record, "window");
  for (const auto& c : corners)
    if (!(std::abs(c.x) <= pipeline::greatest_coordinate &&
          std::abs(c.y) <= pipeline::greatest_coordinate))
      throw InputError("window: a corner lies beyond 2^31 pixels; clip it first");
  Json fragments = Json::array();
  const bool drawn = !cases::flag(record, "culled") && !corners.empty() && !window.is_empty();
  if (drawn && corners.size() < 3) put_fragments<Real>(fragments, corners, options, image, window);
  if (drawn)
    for (std::size_t i = 2; i < corners.size(); ++i)
      put_fragments<Real>(fragments, {0, {corners[0], corners[i - 1], corners[i]}}, options,
                          window);
  record["fragments"] = std::move(fragments);
  return record;
}

/// [x, y], a pixel of the image.
pipeline::Pixel pixel_of(const Json& object, const Camera& image) {
  const auto p = cases::numbers(cases::member(object, "pixel"), "pixel", 2, 2);
  if (p[0] != std::floor(p[0]) || p[1] != std::floor(p[1]) || p[0] < 0 || p[1] < 0 ||
      p[0] >= image.width || p[1] >= image.height)
    throw InputError(fmt::format("pixel: {}, {} is no pixel of the image of {}x{}", p[0], p[1],
                                 image.width, image.height));
  return {static_cast<std::int64_t>(p[0]), static_cast<std::int64_t>(p[1])};
}

pipeline::Colour colour_of(const Json& object, const char* key) {
  const auto c = cases::numbers(cases::member(object, key), key, 3, 3);
  return {c[0], c[1], c[2]};
}

pipeline::DrawRules rules_of(const Json& record) {
  pipeline::DrawRules rules;
  const std::string test = cases::word(
      record, "depth_test",
      {"nearer", "never", "less", "equal", "lequal", "greater", "notequal", "gequal", "always"});
  rules.depth_test = comparison_named(test);
  if (record.contains("depth_write")) rules.depth_write = cases::flag(record, "depth_write");
  if (!record.contains("blend")) return rules;
  rules.alpha = number(record, "blend", 1);
  if (!(*rules.alpha >= 0 && *rules.alpha <= 1))
    throw InputError("\"blend\": expected an opacity from 0 to 1");
  return rules;
}

/// The initial frame buffer: the background, and the pixels of "buffer".
pipeline::FrameBuffer buffer_of(const Json& record, const PipelineOptions& options,
                                const Camera& image) {
  const pipeline::DepthTest test(options);
  const StoredDepth greatest = greatest_stored(options.depth_format.storage);
  const pipeline::Colour background =
      record.contains("background") ? colour_of(record, "background") : pipeline::Colour{};
  pipeline::FrameBuffer buffer(image.width, image.height, 1, background, 0,
                               test.is_nearer(greatest, {}) ? StoredDepth() : greatest);
  if (!record.contains("buffer")) return buffer;
  for (const Json& each : cases::list(record["buffer"], "buffer")) {
    pipeline::StoredSample& sample = buffer.at(pixel_of(each, image), 0);
    const pipeline::Colour c = colour_of(each, "colour");
    for (std::size_t k = 0; k < 3; ++k) sample.colour[k] = static_cast<float>(c[k]);
    sample.stored = pipeline::store(options.depth_format.storage, number(each, "window_z", 0));
    sample.depth = number(each, "depth", 0);
    sample.id = static_cast<std::uint32_t>(whole(each, "primitive", 0, 0, 4294967294.0));
    sample.depth_written = true;
  }
  return buffer;
}

Json output_merger(Json record, pipeline::Precision precision) {
  const PipelineOptions options = options_of(record, precision);
  const Camera image = image_of(record);
  cases::check_effort<double>(static_cast<double>(image.width) * image.height,
                              "pixels of the frame buffer", "merge a smaller image");
  const pipeline::DrawRules rules = rules_of(record);
  pipeline::FrameBuffer buffer = buffer_of(record, options, image);
  const Storage storage = options.depth_format.storage;
  Json merged = Json::array();
  const pipeline::ObserveMerge observe = [&](const pipeline::MergeStep& step) {
    merged.push_back(merge_json(step, storage));
  };
  pipeline::PipelineStatistics uncounted;
  pipeline::OutputMerger merger(options, true, buffer, uncounted, &observe);
  merger.begin(rules);
  const auto primitive = static_cast<std::uint32_t>(whole(record, "number", 0, 0, 4294967294.0));
  for (const Json& each : cases::list(cases::member(record, "fragments"), "fragments")) {
    const pipeline::Pixel pixel = pixel_of(each, image);
    pipeline::Fragment fragment;
    fragment.window_z = std::clamp(number(each, "window_z", 0), 0.0, 1.0);
    fragment.depth = number(each, "depth", 0);
    const StoredDepth stored = merger.stored(fragment);
    const pipeline::Outcome outcome = merger.test(pixel, 0, stored);
    merger.merge(pixel, 0, {primitive, stored, fragment.depth, fragment.window_z},
                 colour_of(each, "colour"), outcome);
  }
  record["merged"] = std::move(merged);
  Json pixels = Json::array();
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const pipeline::StoredSample& sample = buffer.at({x, y}, 0);
      if (sample.id == no_surface && !sample.depth_written) continue;
      pixels.push_back({{"pixel", {x, y}},
                        {"primitive", sample.id},
                        {"window_z", stored_number(storage, sample.stored)},
                        {"depth", sample.depth},
                        {"colour", sample.colour}});
    }
  record["buffer"] = std::move(pixels);
  return record;
}

/// A stage, for each precision.
using Stage = Json (*)(Json, pipeline::Precision);
struct NamedStage {
  StageDescription description;
  Stage binary32, binary64;
};

#define FATHOM_STAGE(name) name<float>, name<double>
const std::vector<NamedStage>& stages() {
  static const std::vector<NamedStage> all{
      {{"primitive-assembly", "vertices, indices, primitive", "primitives"},
       primitive_assembly,
       primitive_assembly},
      {{"vertex-transform", "vertices, camera, transform", "world, eye, clip, depths"},
       FATHOM_STAGE(vertex_transform)},
      {{"clipping", "clip", "clip"}, FATHOM_STAGE(clipping_stage)},
      {{"perspective-division", "clip", "ndc, inverse_w"}, FATHOM_STAGE(perspective_division)},
      {{"back-face-culling", "ndc or window, front_face, cull", "facing, culled"},
       FATHOM_STAGE(back_face_culling)},
      {{"viewport", "ndc, width, height, viewport, depth_range", "window, stretched"},
       FATHOM_STAGE(viewport)},
      {{"scan-conversion", "window, inverse_w, width, height", "fragments"},
       FATHOM_STAGE(scan_conversion)},
      {{"output-merger", "fragments, width, height, buffer, depth_test, blend", "merged, buffer"},
       output_merger,
       output_merger}};
  return all;
}
#undef FATHOM_STAGE

}  // namespace

const std::vector<StageDescription>& pipeline_stages() {
  static const std::vector<StageDescription> descriptions = [] {
    std::vector<StageDescription> list;
    for (const NamedStage& stage : stages()) list.push_back(stage.description);
    return list;
  }();
  return descriptions;
}

Json run_stage(const std::string& name, const Json& record, pipeline::Precision precision) {
  const StandardArithmetic standard;
  expect_known_keys(record);
  for (const NamedStage& stage : stages())
    if (stage.description.name == name)
      return (precision == pipeline::Precision::binary32 ? stage.binary32 : stage.binary64)(
          record, precision);
  throw UsageError("there is no stage " + name);
}

}  // namespace fathom::app
