#include "apps/study/antialiasing/methods.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "apps/study/effort.h"
#include "apps/study/pipeline_scenes.h"
#include "apps/study/plot.h"
#include "apps/study/study_scene.h"
#include "fathom/pipeline/render_pipeline.h"

namespace fathom::studies {
namespace {

/// Of the texture `checker`, which has eight squares each way, and starts black.
constexpr int squares_of_texture = 8;
bool is_white(int column, int row) {
  return (column + row) % 2 != 0;
}

/// Quadrangles, two triangles each.
class Tiles {
 public:
  void add(const std::array<MeshPoint, 4>& corners) {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    vertices_.insert(vertices_.end(), corners.begin(), corners.end());
    triangles_.push_back({first, first + 1, first + 2});
    triangles_.push_back({first, first + 2, first + 3});
  }
  [[nodiscard]] Scene scene() const { return scene_of(vertices_, triangles_); }

 private:
  std::vector<MeshPoint> vertices_;
  std::vector<CornerIndices> triangles_;
};

Judged judged_by_itself(Scene scene, const Camera& camera) {
  pipeline::ColourImage truth = exact_picture(scene, camera);
  return {std::move(scene), camera, false, std::move(truth)};
}

/// A sheet from corner to corner, in 8 × 8 parts of 2 triangles.
void add_sheet(Tiles& tiles, const std::array<MeshPoint, 3>& corners) {
  constexpr int parts = 8;
  const MeshPoint &o = corners[0], &p = corners[1], &q = corners[2];
  const auto at = [&](int i, int j) {
    const double s = static_cast<double>(i) / parts, t = static_cast<double>(j) / parts;
    return MeshPoint{o.x + s * (p.x - o.x) + t * (q.x - o.x),
                     o.y + s * (p.y - o.y) + t * (q.y - o.y),
                     o.z + s * (p.z - o.z) + t * (q.z - o.z)};
  };
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts; ++j)
      tiles.add({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
}

constexpr std::string_view letters[] = {
    "####...##...#####..#..#...##...#...#", "#.....#..#....#....#..#..#..#..##.##",
    "###...####....#....####..#..#..#.#.#", "#.....#..#....#....#..#..#..#..#...#",
    "#.....#..#....#....#..#...##...#...#"};

}  // namespace

Judged star() {
  return judged_by_itself(siemens_star(36, 60, 64.3, 63.8), window_camera(128, 128));
}

Judged crossing_sheets() {
  Tiles tiles;
  add_sheet(tiles, {{{-1.1, -1, 3}, {0.9, -0.9, 5.1}, {-0.9, 1.2, 3.4}}});
  add_sheet(tiles, {{{-1, -1.1, 5}, {1.1, -0.8, 3}, {-1.2, 0.9, 4.7}}});
  Scene scene = tiles.scene();
  paint_each_triangle(scene);
  return judged_by_itself(std::move(scene), front_camera(128, 128, 0.5, 100));
}

Judged checkered_plane() {
  constexpr double size = 60, tile = 3, height = 1, square = tile / squares_of_texture;
  constexpr int columns = static_cast<int>(size / square);
  const Camera camera = front_camera(240, 160, 0.5, 100);
  Tiles tiles;
  for (int i = -columns; i < columns; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (!is_white(i, j)) continue;
      const double x = i * square, z = j == 0 ? 0.1 : j * square, end = (j + 1) * square;
      tiles.add(
          {{{x, height, z}, {x + square, height, z}, {x + square, height, end}, {x, height, end}}});
    }
  }
  return {ground(size, tile, height), camera, true, exact_picture(tiles.scene(), camera)};
}

Judged checkered_wall() {
  // (u, v) = (0.35, 0.55) + (0.225 x − 0.05 y, 0.05 x + 0.225 y): corners from (0, 0) on.
  Scene scene = scene_of({{-2, -2, 2}, {2, -2, 2}, {2, 2, 2}, {-2, 2, 2}}, {{0, 1, 2}, {0, 2, 3}});
  scene.meshes[0].texture_coordinates = {{0, 0}, {0.9, 0.2}, {0.7, 1.1}, {-0.2, 0.9}};
  const auto place = [](int column, int row) {
    const double u = static_cast<double>(column) / squares_of_texture - 0.35;
    const double v = static_cast<double>(row) / squares_of_texture - 0.55;
    constexpr double determinant = 0.225 * 0.225 + 0.05 * 0.05;
    return MeshPoint{(0.225 * u + 0.05 * v) / determinant, (0.225 * v - 0.05 * u) / determinant, 2};
  };
  Tiles tiles;
  for (int i = -4; i < 12; ++i) {
    for (int j = -2; j < 12; ++j) {
      if (is_white(i, j))
        tiles.add({place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)});
    }
  }
  const Camera camera = front_camera(96, 96, 1, 10);
  return {std::move(scene), camera, true, exact_picture(tiles.scene(), camera)};
}

Judged text() {
  Tiles tiles;
  double y = 3;
  for (const std::string_view row : letters) {
    double x = 4;
    for (const char dot : row) {
      if (dot == '#')
        tiles.add({{{x, y, 0.5}, {x + 1, y, 0.5}, {x + 1, y + 1, 0.5}, {x, y + 1, 0.5}}});
      ++x;
    }
    ++y;
  }
  return judged_by_itself(tiles.scene(), window_camera(44, 11));
}

namespace {

using pipeline::Antialias;
using pipeline::AntialiasMethod;
using pipeline::ColourImage;
using pipeline::PipelineOptions;
using pipeline::TextureFilter;

struct Method {
  const char* name;
  Antialias antialias;
  pipeline::Precision precision = pipeline::Precision::binary32;
  int subpixel_bits = 8;
};

/// The thresholds that are published for high quality; and without the removal of small details.
constexpr pipeline::FxaaSettings sensitive{0.125, 0.0625, 0.75}, edges_alone{0.166, 0.0833, 0};

const std::vector<Method>& methods() {
  static const std::vector<Method> all{
      {"none", {AntialiasMethod::none, 1}},
      {"ssaa 2x2", {AntialiasMethod::ssaa, 2}},
      {"ssaa 4x4", {AntialiasMethod::ssaa, 4}},
      {"ssaa 16x16", {AntialiasMethod::ssaa, 16}},
      {"msaa 2", {AntialiasMethod::msaa, 2}},
      {"msaa 4", {AntialiasMethod::msaa, 4}},
      {"msaa rotated grid", {AntialiasMethod::msaa, 4, true, {}}},
      {"msaa 8", {AntialiasMethod::msaa, 8}},
      {"msaa 16", {AntialiasMethod::msaa, 16}},
      {"jitter 4", {AntialiasMethod::jitter, 4}},
      {"jitter 16", {AntialiasMethod::jitter, 16}},
      {"fxaa", {AntialiasMethod::fxaa, 1}},
      {"fxaa 0.125,0.0625,0.75", {AntialiasMethod::fxaa, 1, false, sensitive}},
      {"fxaa 0.166,0.0833,0", {AntialiasMethod::fxaa, 1, false, edges_alone}},
      {"taa 8", {AntialiasMethod::taa, 8}},
      {"area", {AntialiasMethod::area, 1}},
      {"area, 4 bits", {AntialiasMethod::area, 1}, pipeline::Precision::binary32, 4},
      {"area, binary64, 16 bits", {AntialiasMethod::area, 1}, pipeline::Precision::binary64, 16}};
  return all;
}

/// "msaa-4", "area-4-bits" and "fxaa-0.125-0.0625-0.75".
std::string file_name(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const bool separates = c == ' ' || c == ',';
    if (!separates) result += c;
    if (separates && result.back() != '-') result += '-';
  }
  return result;
}

PipelineOptions options_of(const Judged& judged, TextureFilter filter = TextureFilter::nearest) {
  PipelineOptions options;
  options.shading = pipeline::Shading::none;
  options.filter = filter;
  if (judged.textured) options.texture = "checker";
  return options;
}

struct JudgedScenes {
  Judged star = studies::star(), sheets = crossing_sheets(), plane = checkered_plane(),
         wall = checkered_wall(), text = studies::text();
  /// Larger, so that memory is that of pixels.
  Judged large_star{siemens_star(36, 90, 96.3, 95.8), window_camera(192, 192), false, {}};
};

using Pictures = std::vector<std::pair<StudyFile, std::uint32_t>>;

pipeline::PipelineFrame draw(const Judged& judged, const Method& method) {
  PipelineOptions options = options_of(judged);
  options.antialias = method.antialias;
  options.precision = method.precision;
  options.subpixel_bits = method.subpixel_bits;
  return render_frame(judged.scene, judged.camera, options, true);
}

void add_picture(Pictures& pictures, const std::string& name, const ColourImage& image,
                 std::uint32_t scale) {
  pictures.emplace_back(picture_file(file_name(name), pipeline::to_rgb(image)),
                        scale * image.width);
}

MethodError measure(const Method& method, const JudgedScenes& judged, Pictures& pictures) {
  MethodError row;
  row.name = method.name;
  const auto judge = [&](const Judged& scene, const char* name, std::uint32_t scale) {
    const ColourImage image = draw(scene, method).picture;
    add_picture(pictures, std::string(name) + "-" + method.name, image, scale);
    return error_of(image, scene.truth);
  };
  const auto [ms, frame] = least_time([&] { return draw(judged.star, method); });
  row.ms = ms;
  row.shaded = frame.statistics.shaded;
  const Camera& large = judged.large_star.camera;
  if (const auto bytes = peak_bytes([&] { draw(judged.large_star, method); }))
    row.bytes_a_pixel =
        static_cast<double>(*bytes) / (static_cast<double>(large.width) * large.height);
  row.star = judge(judged.star, "star", 3);
  row.sheets = judge(judged.sheets, "sheets", 3);
  row.plane = judge(judged.plane, "plane", 2);
  row.wall = judge(judged.wall, "wall", 3);
  row.text = judge(judged.text, "text", 6);
  return row;
}

double share_changed(const ColourImage& before, const ColourImage& after) {
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.pixels.size(); ++i)
    changed += before.pixels[i] != after.pixels[i];
  return static_cast<double>(changed) / static_cast<double>(before.pixels.size());
}

void measure_filters(AntialiasingMethods& result, const Judged& plane) {
  for (const auto& [name, filter] : {std::pair("nearest", TextureFilter::nearest),
                                     std::pair("bilinear", TextureFilter::bilinear),
                                     std::pair("trilinear", TextureFilter::trilinear),
                                     std::pair("anisotropic", TextureFilter::anisotropic)}) {
    const ColourImage image =
        render_frame(plane.scene, plane.camera, options_of(plane, filter), true).picture;
    add_picture(result.pictures, std::string("filter-") + name, image, 2);
    result.filters.push_back({name, error_of(image, plane.truth).mean});
  }
}

}  // namespace

PictureError error_of(const ColourImage& image, const ColourImage& truth) {
  PictureError error;
  const auto n = 3 * static_cast<double>(image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double e = std::abs(image.pixels[i][k] - truth.pixels[i][k]);
      error.mean += e / n;
      error.rms += e * e / n;
      error.greatest = std::max(error.greatest, e);
    }
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

AntialiasingMethods measure_antialiasing(const std::function<void(double)>& tick) {
  AntialiasingMethods result;
  const JudgedScenes judged;
  tick(0.3);
  for (const Method& method : methods()) {
    result.methods.push_back(measure(method, judged, result.pictures));
    tick(0.3 +
         0.7 * static_cast<double>(result.methods.size()) / static_cast<double>(methods().size()));
  }
  measure_filters(result, judged.plane);
  const Method plain{"", {AntialiasMethod::none, 1}}, filtered{"", {AntialiasMethod::fxaa, 1}};
  result.texture_changed_by_fxaa =
      share_changed(draw(judged.wall, plain).picture, draw(judged.wall, filtered).picture);
  add_picture(result.pictures, "star-truth", judged.star.truth, 3);
  add_picture(result.pictures, "sheets-truth", judged.sheets.truth, 3);
  add_picture(result.pictures, "plane-truth", judged.plane.truth, 2);
  add_picture(result.pictures, "wall-truth", judged.wall.truth, 3);
  add_picture(result.pictures, "text-truth", judged.text.truth, 6);
  for (const auto& [name, scene] :
       {std::pair("star", &judged.star), std::pair("sheets", &judged.sheets),
        std::pair("plane", &judged.plane), std::pair("wall", &judged.wall),
        std::pair("text", &judged.text)})
    for (StudyFile& file : scene_files(name, scene->scene, scene->camera).files)
      result.files.push_back(std::move(file));
  tick(1);
  return result;
}

}  // namespace fathom::studies
