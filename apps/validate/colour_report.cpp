#include "apps/validate/colour_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "fathom/image/rgb_image.h"
#include "fathom/pipeline/render_pipeline.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;
using validation::ColourComparison;
using validation::UnexplainedPixel;

constexpr std::size_t most_shown = 5;

std::string line_of(const ColourCase& c) {
  if (!c.theirs) return fmt::format("{}: {}: {}\n", c.scene, c.pair->name, c.failure);
  const ColourComparison& f = c.found;
  std::string text = fmt::format(
      "{}: {}: {} inside, {} of them equal, at most {} apart (bounds: {} of at most 1, mean "
      "{:.2f}, greatest {}); {} edge, {} background, {} unexplained\n",
      c.scene, c.pair->name, f.inside, f.equal, f.greatest_difference, f.within_one, f.mean_bound,
      f.greatest_bound, f.edge, f.background, f.unexplained.size());
  for (std::size_t i = 0; i < std::min(most_shown, f.unexplained.size()); ++i) {
    const UnexplainedPixel& p = f.unexplained[i];
    text += fmt::format("  pixel ({}, {}): ours {}, expected {} to {}; VTK {}, expected {} to {}\n",
                        p.x, p.y, p.ours, p.expected_of_ours.least, p.expected_of_ours.greatest,
                        p.theirs, p.expected_of_theirs.least, p.expected_of_theirs.greatest);
  }
  return text;
}

Json to_json(const ColourCase& c) {
  Json json{{"scene", c.scene}, {"pair", c.pair->name}};
  if (!c.theirs) {
    json["failure"] = c.failure;
    return json;
  }
  const ColourComparison& f = c.found;
  json["version"] = c.theirs->version;
  json["pixels"] = {{"inside", f.inside},
                    {"edge", f.edge},
                    {"background", f.background},
                    {"unexplained", f.unexplained.size()}};
  json["equal"] = f.equal;
  json["greatest_difference"] = f.greatest_difference;
  json["bounds"] = {
      {"at_most_one", f.within_one}, {"mean", f.mean_bound}, {"greatest", f.greatest_bound}};
  Json pixels = Json::array();
  for (std::size_t i = 0; i < std::min(most_shown, f.unexplained.size()); ++i) {
    const UnexplainedPixel& p = f.unexplained[i];
    pixels.push_back(
        {{"pixel", {p.x, p.y}},
         {"ours", p.ours},
         {"expected_of_ours", {p.expected_of_ours.least, p.expected_of_ours.greatest}},
         {"theirs", p.theirs},
         {"expected_of_theirs", {p.expected_of_theirs.least, p.expected_of_theirs.greatest}}});
  }
  json["unexplained"] = pixels;
  return json;
}

RgbImage side_by_side(const validation::GreyPicture& left, const validation::GreyPicture& right) {
  RgbImage image(2 * left.width, left.height);
  for (std::uint32_t y = 0; y < left.height; ++y) {
    for (std::uint32_t x = 0; x < left.width; ++x) {
      const std::uint8_t a = left.codes.at(std::size_t{y} * left.width + x);
      const std::uint8_t b = right.codes.at(std::size_t{y} * left.width + x);
      image.at(x, y) = {a, a, a};
      image.at(left.width + x, y) = {b, b, b};
    }
  }
  return image;
}

void write_files(const std::vector<ColourCase>& cases, const std::filesystem::path& folder) {
  std::deque<OutputFile> files;
  Json results = Json::array();
  for (const ColourCase& c : cases) {
    results.push_back(to_json(c));
    if (!c.theirs) continue;
    files.emplace_back(folder / (c.scene + "-" + c.pair->file + ".png"));
    files.back().write([&](const std::filesystem::path& path) {
      write_png(side_by_side(*c.ours, *c.theirs), path);
    });
  }
  files.emplace_back(folder / "colours.json");
  files.back().write(json_answer({{"results", results}}));
  std::vector<OutputFile*> all;
  all.reserve(files.size());
  for (OutputFile& file : files) all.push_back(&file);
  OutputFile::commit_together(all);
}

}  // namespace

using pipeline::Material;
using pipeline::SpecularModel;
using validation::GreyPicture;

Material material_of(const ColourPair& pair) {
  if (pair.glossy)
    return {.ambient = 0.15,
            .diffuse = 0.6,
            .specular = 0.25,
            .shininess = 40,
            .highlight = SpecularModel::phong};
  return {.ambient = 0.15,
          .diffuse = 0.75,
          .specular = 0,
          .shininess = 1,
          .highlight = SpecularModel::phong};
}

GreyPicture drawn_by_pipeline(const validation::LitScene& scene, pipeline::Shading shading) {
  pipeline::PipelineOptions options;
  options.precision = pipeline::Precision::binary64;
  options.shading = shading;
  options.material = scene.material;
  options.light = {.towards = scene.towards_light, .in_world = true};
  const auto frame = render_frame(as_scene(scene), scene.camera, options, true);
  GreyPicture picture{scene.camera.width, scene.camera.height, {}, "pipeline"};
  for (const Rgb& c : to_rgb(frame.picture).pixels) picture.codes.push_back(c[0]);
  return picture;
}

int report_colours(const std::vector<ColourCase>& cases, const std::string& out) {
  std::string text;
  for (const ColourCase& c : cases) text += line_of(c);
  print(text);
  if (!out.empty()) write_files(cases, out);
  if (std::any_of(cases.begin(), cases.end(),
                  [](const ColourCase& c) { return !c.found.unexplained.empty(); }))
    return answer_is_no;
  const bool all_drawn =
      std::all_of(cases.begin(), cases.end(), [](const ColourCase& c) { return c.theirs; });
  return all_drawn ? done : unusable_input;
}

}  // namespace fathom::app
