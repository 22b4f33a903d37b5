#include "validation/studies/antialiasing/antialiasing_methods.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "fathom/pipeline/render_pipeline.h"
#include "validation/studies/page.h"
#include "validation/studies/picture.h"
#include "validation/studies/pipeline_scenes.h"
#include "validation/studies/plot.h"

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

PipelineOptions plain() {
  PipelineOptions options;
  options.precision = pipeline::Precision::binary64;
  options.subpixel_bits = 16;
  options.shading = pipeline::Shading::none;
  return options;
}

PipelineOptions textured(TextureFilter filter) {
  PipelineOptions options = plain();
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
  PipelineOptions options = plain();
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

/// The frequency, in cycles a pixel, that is strongest in a grating's samples.
double apparent_frequency(double frequency, double offsets) {
  constexpr int n = 512;
  std::vector<double> samples(n);
  const auto looks = static_cast<int>(offsets);
  for (int x = 0; x < n; ++x)
    for (int k = 0; k < looks; ++k)
      samples[static_cast<std::size_t>(x)] +=
          std::cos(2 * std::numbers::pi * frequency * (x + (k + 0.5) / looks)) / looks;
  double best = 0, strongest = -1;
  for (int bin = 0; bin <= n / 2; ++bin) {
    double c = 0, s = 0;
    for (int x = 0; x < n; ++x) {
      const double angle = 2 * std::numbers::pi * bin * x / n;
      c += samples[static_cast<std::size_t>(x)] * std::cos(angle);
      s += samples[static_cast<std::size_t>(x)] * std::sin(angle);
    }
    if (c * c + s * s <= strongest) continue;
    strongest = c * c + s * s;
    best = static_cast<double>(bin) / n;
  }
  return best;
}

Plot nyquist() {
  Plot plot{"nyquist", "What frequency a grating seems to have", "cycles a pixel",
            "cycles a pixel, seen"};
  plot.series = {{"sampled once a pixel", {}}, {"the truth", {}}};
  for (int i = 1; i <= 60; ++i) {
    const double f = i / 40.0;
    plot.series[0].points.emplace_back(f, apparent_frequency(f, 1));
    plot.series[1].points.emplace_back(f, f);
  }
  return plot;
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
  PipelineOptions exact = plain();
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

void add_to_summary(const AntialiasingMethods& measured, nlohmann::ordered_json& summary) {
  for (const MethodError& r : measured.methods)
    summary["methods"].push_back({{"method", r.name},
                                  {"mean", r.mean},
                                  {"rms", r.rms},
                                  {"greatest", r.greatest},
                                  {"texture_mean", r.texture_mean},
                                  {"shaded", r.shaded},
                                  {"ms", r.ms},
                                  {"megabytes", r.megabytes}});
  for (const FilterError& f : measured.filters)
    summary["filters"].push_back({{"filter", f.filter}, {"mean_error", f.mean}});
  summary["texture_changed_by_fxaa"] = measured.texture_changed_by_fxaa;
}

void add_to_page(const AntialiasingMethods& measured, Page& page) {
  page.heading("Pictures, by every kind of antialiasing");
  page.paragraph(
      "A star of 36 rays has edges of all slopes, finer than pixels in the middle. Its exact "
      "picture is known: in each pixel the area that is covered (method 'area'). The table gives "
      "each method's error against it, in units of full white, its time and shaded fragments here, "
      "and the memory of its samples. The column 'on texture' is a checkerboard plane that runs to "
      "the horizon, its texture looked up at the nearest texel, against 16 by 16 samples a pixel: "
      "methods that shade once a pixel do nothing for it.");
  std::vector<std::vector<std::string>> table;
  for (const MethodError& r : measured.methods)
    table.push_back({r.name, fmt::format("{:.4f}", r.mean), fmt::format("{:.4f}", r.rms),
                     fmt::format("{:.3f}", r.greatest), fmt::format("{:.4f}", r.texture_mean),
                     fmt::format("{}", r.shaded), fmt::format("{:.1f}", r.ms),
                     fmt::format("{:.2f}", r.megabytes)});
  page.table({"method", "mean error", "rms", "greatest", "on texture", "shaded", "ms", "MB"},
             table);
  for (const char* name : {"none", "msaa 4", "jitter 4", "fxaa", "area"})
    page.picture("star-" + file_name(name), name);
  page.heading("FXAA sees edges, not triangles");
  page.paragraph(fmt::format(
      "A texture that fills the picture, without the edge of any triangle: {:.1f} % of its pixels "
      "are changed all the same, because a filter over the finished picture takes the texture's "
      "steps for jagged outlines.",
      100 * measured.texture_changed_by_fxaa));
  page.picture("texture-none", "as the texture is").picture("texture-fxaa", "after FXAA");
  page.heading("Moiré, and filters");
  std::vector<std::vector<std::string>> errors;
  for (const FilterError& f : measured.filters)
    errors.push_back({f.filter, fmt::format("{:.4f}", f.mean)});
  page.table({"filter", "mean error, one sample a pixel"}, errors);
  for (const auto& [name, caption] :
       {std::pair("plane-nearest", "nearest texel: moiré towards the horizon"),
        std::pair("plane-trilinear", "trilinear mip maps: isotropic, blurred along the view"),
        std::pair("plane-anisotropic", "anisotropic: up to 16 looks along the longer axis"),
        std::pair("plane-truth", "16 by 16 samples a pixel")})
    page.picture(name, caption);
  page.heading("Nyquist");
  page.plot("nyquist",
            "Above half a cycle a pixel a grating is seen as a coarser one: that is aliasing");
}

std::vector<StudyFile> files_of(const AntialiasingMethods& measured) {
  std::string csv = "method,mean,rms,greatest,texture_mean,shaded,ms,megabytes\n";
  for (const MethodError& r : measured.methods)
    csv += fmt::format("{},{:.17g},{:.17g},{:.17g},{:.17g},{},{:.17g},{:.17g}\n", r.name, r.mean,
                       r.rms, r.greatest, r.texture_mean, r.shaded, r.ms, r.megabytes);
  std::vector<StudyFile> files = measured.pictures;
  files.push_back({"methods.csv", csv});
  for (StudyFile& file : draw(nyquist())) files.push_back(std::move(file));
  return files;
}

}  // namespace fathom::studies
