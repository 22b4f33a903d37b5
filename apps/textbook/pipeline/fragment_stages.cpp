#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/textbook/cases/case_answers.h"
#include "apps/textbook/pipeline/named_stages.h"
#include "apps/textbook/pipeline/pipeline_report.h"
#include "apps/textbook/pipeline/stage_record.h"
#include "fathom/failures/errors.h"
#include "fathom/pipeline/fragments/fragment.h"
#include "fathom/pipeline/geometry/window_triangle.h"
#include "fathom/pipeline/rasterization/rasterizer.h"

namespace fathom::app::stages {
namespace {

using cases::Json;
using pipeline::PipelineOptions;
using pipeline::attribute::colour;

double fragments_at_most(const pipeline::PixelWindow& box) {
  return std::max(0.0, static_cast<double>(box.x_end - box.x_begin)) *
         std::max(0.0, static_cast<double>(box.y_end - box.y_begin));
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

}  // namespace

std::vector<NamedStage> fragment_stages() {
  return {
      {{"scan-conversion", "window, inverse_w, width, height", "fragments"},
       scan_conversion<float>,
       scan_conversion<double>},
      {{"output-merger", "fragments, width, height, buffer, depth_test, blend", "merged, buffer"},
       output_merger,
       output_merger}};
}

}  // namespace fathom::app::stages
