#include "validation/studies/antialiasing/methods.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "fathom/pipeline/render_pipeline.h"
#include "validation/studies/antialiasing/judged_scenes.h"
#include "validation/studies/picture.h"

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
  int samples_kept;  ///< of colour and depth, for each pixel
  pipeline::Precision precision = pipeline::Precision::binary32;
  int subpixel_bits = 8;
};

/// The thresholds that are published for high quality; and without the removal of small details.
constexpr pipeline::FxaaSettings sensitive{0.125, 0.0625, 0.75}, edges_alone{0.166, 0.0833, 0};

const std::vector<Method>& methods() {
  static const std::vector<Method> all{
      {"none", {AntialiasMethod::none, 1}, 1},
      {"ssaa 2x2", {AntialiasMethod::ssaa, 2}, 4},
      {"ssaa 4x4", {AntialiasMethod::ssaa, 4}, 16},
      {"ssaa 16x16", {AntialiasMethod::ssaa, 16}, 256},
      {"msaa 2", {AntialiasMethod::msaa, 2}, 2},
      {"msaa 4", {AntialiasMethod::msaa, 4}, 4},
      {"msaa rotated grid", {AntialiasMethod::msaa, 4, true, {}}, 4},
      {"msaa 8", {AntialiasMethod::msaa, 8}, 8},
      {"msaa 16", {AntialiasMethod::msaa, 16}, 16},
      {"jitter 4", {AntialiasMethod::jitter, 4}, 4},
      {"jitter 16", {AntialiasMethod::jitter, 16}, 16},
      {"fxaa", {AntialiasMethod::fxaa, 1}, 1},
      {"fxaa 0.125,0.0625,0.75", {AntialiasMethod::fxaa, 1, false, sensitive}, 1},
      {"fxaa 0.166,0.0833,0", {AntialiasMethod::fxaa, 1, false, edges_alone}, 1},
      {"taa 8", {AntialiasMethod::taa, 8}, 2},
      {"area", {AntialiasMethod::area, 1}, 1},
      {"area, 4 bits", {AntialiasMethod::area, 1}, 1, pipeline::Precision::binary32, 4},
      {"area, binary64, 16 bits",
       {AntialiasMethod::area, 1},
       1,
       pipeline::Precision::binary64,
       16}};
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
};

pipeline::PipelineFrame draw(const Judged& judged, const Method& method) {
  PipelineOptions options = options_of(judged);
  options.antialias = method.antialias;
  options.precision = method.precision;
  options.subpixel_bits = method.subpixel_bits;
  return render_frame(judged.scene, judged.camera, options, true);
}

void add_picture(std::vector<StudyFile>& files, const std::string& name, const ColourImage& image,
                 std::uint32_t scale) {
  files.push_back(picture_file(file_name(name), pipeline::to_rgb(image), scale));
}

MethodError measure(const Method& method, const JudgedScenes& judged,
                    std::vector<StudyFile>& files) {
  MethodError row;
  row.name = method.name;
  const auto judge = [&](const Judged& scene, const char* name, std::uint32_t scale) {
    const ColourImage image = draw(scene, method).picture;
    add_picture(files, std::string(name) + "-" + method.name, image, scale);
    return error_of(image, scene.truth);
  };
  const auto start = std::chrono::steady_clock::now();
  row.shaded = draw(judged.star, method).statistics.shaded;
  row.ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  row.megabytes = 128.0 * 128 * method.samples_kept * sizeof(pipeline::StoredSample) / 1e6;
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
  const Method plain{"", {AntialiasMethod::none, 1}, 1},
      filtered{"", {AntialiasMethod::fxaa, 1}, 1};
  result.texture_changed_by_fxaa =
      share_changed(draw(judged.wall, plain).picture, draw(judged.wall, filtered).picture);
  add_picture(result.pictures, "star-truth", judged.star.truth, 3);
  add_picture(result.pictures, "sheets-truth", judged.sheets.truth, 3);
  add_picture(result.pictures, "plane-truth", judged.plane.truth, 2);
  add_picture(result.pictures, "wall-truth", judged.wall.truth, 3);
  add_picture(result.pictures, "text-truth", judged.text.truth, 6);
  tick(1);
  return result;
}

}  // namespace fathom::studies
