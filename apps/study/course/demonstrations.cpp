#include "apps/study/course/demonstrations.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "apps/study/antialiasing/curve.h"
#include "apps/study/pipeline_scenes.h"
#include "fathom/pipeline/scan/area_fill.h"
#include "fathom/pipeline/scan/edge_function.h"
#include "fathom/render_by_pipeline.h"
#include "fathom/scene/motion.h"

namespace fathom::studies {
namespace {

using pipeline::PipelineOptions;

constexpr std::uint32_t wheel_side = 96, course_spokes = 12;
constexpr double hub = wheel_side / 2.0;

/// Dark, the first spoke red.
Scene spoked_wheel() {
  Scene scene = siemens_star(course_spokes, hub - 2, hub, hub);
  Mesh& mesh = scene.meshes[0];
  // The middle belongs to all spokes, so that the red one needs one of its own.
  mesh.vertices.push_back(mesh.vertices[0]);
  mesh.triangles[0][0] = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  mesh.colours.assign(mesh.vertices.size(), {0.15F, 0.15F, 0.15F, 1});
  for (const std::uint32_t corner : mesh.triangles[0]) mesh.colours[corner] = {0.8F, 0.1F, 0.1F, 1};
  return scene;
}

/// A keyframe for each degree, about the middle.
StudyFile turning() {
  std::string keyframes;
  for (int degrees = 0; degrees <= wheel_degrees * wheel_pictures; ++degrees) {
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    keyframes += fmt::format(
        "{}\n  {{\"time\": {}, \"transform\": [[{}, {}, 0, {}], [{}, {}, 0, {}], [0, 0, 1, 0]]}}",
        degrees == 0 ? "" : ",", static_cast<double>(degrees) / wheel_degrees, c, -s,
        hub - c * hub + s * hub, s, c, hub - s * hub - c * hub);
  }
  return {"wheel-motion.json",
          "{\"objects\": [{\"name\": \"wheel\", \"keyframes\": [" + keyframes + "]}]}\n"};
}

PipelineOptions flat_colours() {
  PipelineOptions options;
  options.shading = pipeline::Shading::none;
  options.background = {0.92, 0.92, 0.92};
  return options;
}

struct MovingWheel {
  MovingScene scene;
  Camera camera;
};
MovingWheel moving_wheel() {
  const SceneFiles files = wheel_files();
  const StudyFile& motion = files.files.back();
  return {MovingScene(files.view.scene, read_motion(motion.content, motion.name)),
          files.view.camera};
}

}  // namespace

DrawnCurve curve_at(std::uint32_t size) {
  Scene scene = heart_scene(size, 0.025);
  scene.meshes[0].colours.assign(scene.meshes[0].vertices.size(), {0.16F, 0.31F, 0.63F, 1});
  DrawnCurve result{scene_files("curve-" + std::to_string(size), scene, window_camera(size, size)),
                    {}};
  PipelineOptions options = flat_colours();
  options.background = {1, 1, 1};
  result.picture = pipeline_picture(result.files.view, options);
  return result;
}

SceneFiles wheel_files() {
  SceneFiles result = scene_files("wheel", spoked_wheel(), window_camera(wheel_side, wheel_side));
  result.files.push_back(turning());
  return result;
}

std::vector<RgbImage> wheel_at_instants() {
  MovingWheel wheel = moving_wheel();
  std::vector<RgbImage> pictures;
  for (int time = 0; time < wheel_pictures; ++time) {
    const SceneView view{"wheel", wheel.scene.at(time), wheel.camera};
    pictures.push_back(pipeline_picture(view, flat_colours()));
  }
  return pictures;
}

std::vector<RgbImage> wheel_with_open_shutter() {
  MovingWheel wheel = moving_wheel();
  PipelineOptions options = flat_colours();
  options.antialias = {pipeline::AntialiasMethod::temporal, 16};
  std::vector<RgbImage> pictures;
  for (int time = 0; time < wheel_pictures; ++time) {
    const pipeline::Shutter shutter{static_cast<double>(time), static_cast<double>(time + 1)};
    pictures.push_back(
        render_by_pipeline(wheel.scene, wheel.camera, options, shutter, {}, true).picture);
  }
  return pictures;
}

namespace {

using pipeline::Exact;
using pipeline::Pixel;

struct Corner {
  double x, y;
  int value;
};
using CornerRing = std::vector<Corner>;
constexpr std::uint32_t window_side = 61;
constexpr Pixel middle_pixel{30, 30};

/// The exact value at each pixel's centre, row by row; none where nothing is covered.
using Values = std::vector<std::optional<Exact>>;
constexpr std::size_t index_of(const Pixel& pixel) {
  return static_cast<std::size_t>(pixel.y * window_side + pixel.x);
}

struct Square {
  int degrees;
  CornerRing corners;
};
/// Sides of 41; of that turned by 45 degrees the diagonals are 58, so that its corners are exact:
/// it is larger by 1/1681.
std::vector<Square> squares() {
  return {{0, {{10, 10, 0}, {51, 10, 1}, {51, 51, 0}, {10, 51, 0}}},
          {45, {{30.5, 1.5, 0}, {59.5, 30.5, 1}, {30.5, 59.5, 0}, {1.5, 30.5, 0}}},
          {90, {{51, 10, 0}, {51, 51, 1}, {10, 51, 0}, {10, 10, 0}}}};
}

std::array<CornerRing, 2> halves(const CornerRing& square) {
  return {{{square[0], square[1], square[2]}, {square[0], square[2], square[3]}}};
}

constexpr pipeline::PixelWindow whole_window{0, 0, window_side, window_side};

void add_by_scan_lines(const CornerRing& outline, Values& values) {
  pipeline::FillPolygon<Exact> polygon(1);
  for (const Corner& c : outline) polygon[0].push_back({Exact(c.x), Exact(c.y), {Exact(c.value)}});
  pipeline::fill_polygon<Exact>(polygon, pipeline::FillRule::even_odd, whole_window,
                                [&](const auto& line) {
                                  for (const auto& span : line.spans) {
                                    std::int64_t x = span.pixels.x_begin;
                                    for (const auto& value : values_along(span))
                                      values[index_of({x++, line.y})] = value[0];
                                  }
                                });
}

void add_by_weights(const CornerRing& t, Values& values) {
  pipeline::rasterize_triangle<Exact>({{{Exact(t[0].x), Exact(t[0].y)},
                                        {Exact(t[1].x), Exact(t[1].y)},
                                        {Exact(t[2].x), Exact(t[2].y)}}},
                                      whole_window,
                                      [&](const pipeline::CoveredPixel<Exact>& covered) {
                                        Exact sum(0);
                                        for (std::size_t k = 0; k < 3; ++k)
                                          sum += covered.barycentric[k] * Exact(t[k].value);
                                        values[index_of(covered.pixel)] = sum;
                                      });
}

RgbImage picture_of(const Values& values) {
  RgbImage image(window_side, window_side, {255, 255, 255});
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!values[i]) continue;
    const auto tenths = static_cast<int>(pipeline::floor_of(Exact(10) * *values[i]));
    const auto mixed = [&](int dark, int bright) {
      return static_cast<std::uint8_t>(dark + (bright - dark) * tenths / 10);
    };
    image.pixels[i] = {mixed(30, 255), mixed(50, 225), mixed(120, 60)};
  }
  return image;
}

/// A polygon is a list of rings, a triangle is one.
std::string case_line(const char* kind, const CornerRing& outline) {
  std::string corners, values;
  for (const Corner& c : outline) {
    corners += fmt::format("{}[{},{}]", corners.empty() ? "" : ",", c.x, c.y);
    values += fmt::format("{}[{}]", values.empty() ? "" : ",", c.value);
  }
  const bool is_ring = outline.size() == 4;
  return fmt::format(R"({{"{}": {}[{}]{}, "attributes": [{}], "width": {}, "height": {}}})", kind,
                     is_ring ? "[" : "", corners, is_ring ? "]" : "", values, window_side,
                     window_side) +
         "\n";
}

}  // namespace

std::vector<TurnedSquare> turned_squares() {
  std::vector<TurnedSquare> result;
  for (const Square& square : squares()) {
    Values whole(std::size_t{window_side} * window_side);
    Values by_scan_lines = whole, by_weights = whole;
    add_by_scan_lines(square.corners, whole);
    for (const CornerRing& triangle : halves(square.corners)) {
      add_by_scan_lines(triangle, by_scan_lines);
      add_by_weights(triangle, by_weights);
    }
    const auto at_middle = [](const Values& values) {
      return pipeline::to_binary64(values[index_of(middle_pixel)].value());
    };
    result.push_back({square.degrees, at_middle(whole), at_middle(by_scan_lines),
                      at_middle(by_weights), picture_of(whole), picture_of(by_scan_lines)});
  }
  return result;
}

std::vector<StudyFile> square_files() {
  StudyFile whole{"squares.jsonl", ""}, cut{"triangles.jsonl", ""};
  for (const Square& square : squares()) {
    whole.content += case_line("polygon", square.corners);
    for (const CornerRing& triangle : halves(square.corners))
      cut.content += case_line("triangle", triangle);
  }
  return {whole, cut};
}

}  // namespace fathom::studies
