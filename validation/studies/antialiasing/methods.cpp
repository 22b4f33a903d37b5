#include "validation/studies/antialiasing/methods.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "fathom/pipeline/render_pipeline.h"
#include "validation/studies/picture.h"
#include "validation/studies/pipeline_scenes.h"

namespace fathom::studies {
namespace {

using pipeline::AntialiasMethod;
using pipeline::ColourImage;
using pipeline::PipelineOptions;
using pipeline::TextureFilter;

struct Method {
  const char* name;
  pipeline::Antialias antialias;
  int samples_kept;  ///< of colour and depth, for each pixel
};

const std::vector<Method>& methods() {
  static const std::vector<Method> all{{"none", {AntialiasMethod::none, 1}, 1},
                                       {"ssaa 2x2", {AntialiasMethod::ssaa, 2}, 4},
                                       {"ssaa 4x4", {AntialiasMethod::ssaa, 4}, 16},
                                       {"msaa 2", {AntialiasMethod::msaa, 2}, 2},
                                       {"msaa 4", {AntialiasMethod::msaa, 4}, 4},
                                       {"msaa rotated grid", {AntialiasMethod::msaa, 4, true}, 4},
                                       {"msaa 8", {AntialiasMethod::msaa, 8}, 8},
                                       {"msaa 16", {AntialiasMethod::msaa, 16}, 16},
                                       {"jitter 4", {AntialiasMethod::jitter, 4}, 4},
                                       {"jitter 16", {AntialiasMethod::jitter, 16}, 16},
                                       {"fxaa", {AntialiasMethod::fxaa, 1}, 1},
                                       {"taa 8", {AntialiasMethod::taa, 8}, 2},
                                       {"area", {AntialiasMethod::area, 1}, 1}};
  return all;
}

std::string file_name(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

PipelineOptions textured(TextureFilter filter) {
  PipelineOptions options = precise_options();
  options.texture = "checker";
  options.filter = filter;
  return options;
}

void add_error(MethodError& row, const ColourImage& image, const ColourImage& truth) {
  const auto n = static_cast<double>(image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const double error = std::abs(image.pixels[i][0] - truth.pixels[i][0]);
    row.mean += error / n;
    row.rms += error * error / n;
    row.greatest = std::max(row.greatest, error);
  }
  row.rms = std::sqrt(row.rms);
}

double mean_error(const ColourImage& image, const ColourImage& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    sum += std::abs(image.pixels[i][0] - truth.pixels[i][0]);
  return sum / static_cast<double>(image.pixels.size());
}

Scene star() {
  return siemens_star(36, 60, 64.3, 63.8);
}

ColourImage plane(const PipelineOptions& options) {
  return render_frame(ground(60, 3, 1), front_camera(240, 160, 0.5, 100), options, true).picture;
}

MethodError measure(const Method& method, const ColourImage& truth, const ColourImage& plane_truth,
                    std::vector<StudyFile>& files) {
  MethodError row{method.name};
  PipelineOptions options = precise_options();
  options.antialias = method.antialias;
  const auto start = std::chrono::steady_clock::now();
  const auto frame = render_frame(star(), window_camera(128, 128), options, true);
  row.ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  row.shaded = frame.statistics.shaded;
  add_error(row, frame.picture, truth);
  row.megabytes = 128.0 * 128 * method.samples_kept * sizeof(pipeline::StoredSample) / 1e6;
  files.push_back(
      picture_file("star-" + file_name(method.name), pipeline::to_rgb(frame.picture), 3));
  PipelineOptions on_plane = textured(TextureFilter::nearest);
  on_plane.antialias = method.antialias;
  row.texture_mean = mean_error(plane(on_plane), plane_truth);
  return row;
}

ColourImage facing_texture(AntialiasMethod method) {
  Scene scene = scene_of({{-2, -2, 2}, {2, -2, 2}, {2, 2, 2}, {-2, 2, 2}}, {{0, 1, 2}, {0, 2, 3}});
  scene.meshes[0].texture_coordinates = {{0, 0}, {0.9, 0.2}, {0.7, 1.1}, {-0.2, 0.9}};
  PipelineOptions options = textured(TextureFilter::nearest);
  options.antialias.method = method;
  return render_frame(scene, front_camera(96, 96, 1, 10), options, true).picture;
}

double share_changed(const ColourImage& before, const ColourImage& after) {
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.pixels.size(); ++i)
    changed += before.pixels[i] != after.pixels[i];
  return static_cast<double>(changed) / static_cast<double>(before.pixels.size());
}

void measure_filters(AntialiasingMethods& result, const ColourImage& truth) {
  for (const auto& [name, filter] : {std::pair("nearest", TextureFilter::nearest),
                                     std::pair("bilinear", TextureFilter::bilinear),
                                     std::pair("trilinear", TextureFilter::trilinear),
                                     std::pair("anisotropic", TextureFilter::anisotropic)}) {
    const ColourImage image = plane(textured(filter));
    result.pictures.push_back(
        picture_file(std::string("plane-") + name, pipeline::to_rgb(image), 2));
    result.filters.push_back({name, mean_error(image, truth)});
  }
  result.pictures.push_back(picture_file("plane-truth", pipeline::to_rgb(truth), 2));
}

}  // namespace

AntialiasingMethods measure_antialiasing(const std::function<void(double)>& tick) {
  AntialiasingMethods result;
  PipelineOptions exact = precise_options();
  exact.antialias.method = AntialiasMethod::area;
  const ColourImage truth = render_frame(star(), window_camera(128, 128), exact, true).picture;
  PipelineOptions fine = textured(TextureFilter::nearest);
  fine.antialias = {AntialiasMethod::ssaa, 16};
  const ColourImage plane_truth = plane(fine);
  tick(0.2);
  for (const Method& method : methods()) {
    result.methods.push_back(measure(method, truth, plane_truth, result.pictures));
    tick(0.2 +
         0.7 * static_cast<double>(result.methods.size()) / static_cast<double>(methods().size()));
  }
  measure_filters(result, plane_truth);
  const ColourImage before = facing_texture(AntialiasMethod::none);
  const ColourImage after = facing_texture(AntialiasMethod::fxaa);
  result.texture_changed_by_fxaa = share_changed(before, after);
  result.pictures.push_back(picture_file("texture-none", pipeline::to_rgb(before), 3));
  result.pictures.push_back(picture_file("texture-fxaa", pipeline::to_rgb(after), 3));
  tick(1);
  return result;
}

}  // namespace fathom::studies
