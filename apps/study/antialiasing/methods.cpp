#include "apps/study/antialiasing/methods.h"

#include <algorithm>
#include <cmath>

#include "apps/study/antialiasing/judged_scenes.h"
#include "apps/study/drawn_files.h"
#include "apps/study/effort.h"
#include "apps/study/pipeline_scenes.h"
#include "apps/study/scene_files.h"
#include "fathom/pipeline/render_pipeline.h"

namespace fathom::studies {
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
