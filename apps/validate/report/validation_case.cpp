#include "apps/validate/report/validation_case.h"

#include <fmt/format.h>

#include <variant>

#include "apps/validate/report/reported_result.h"
#include "fathom/depth_buffer/depth_buffer.h"

namespace fathom::validation {

std::string pixel_text(const ValidationCase& c, std::size_t pixel) {
  return attribution::pixel_text(*c.truth, c.other, c.attribution, pixel);
}

std::string cause_of(const ValidationCase& c) {
  return c.is_done() ? attribution::cause_of(*c.truth, c.other, c.attribution) : c.failure;
}

std::string verdict_of(const ValidationCase& c) {
  return c.is_done() ? attribution::verdict_text(*c.truth, c.other, c.attribution)
                     : "not drawn: " + c.failure;
}

std::string verdict_of(const std::vector<ValidationCase>& cases) {
  if (cases.size() == 1) return verdict_of(cases.front());
  const ValidationCase* first = nullptr;
  std::size_t drawn = 0, failed = 0;
  for (const ValidationCase& c : cases) {
    if (!c.is_done()) continue;
    ++drawn;
    if (c.is_good()) continue;
    if (failed++ == 0) first = &c;
  }
  const std::string undrawn =
      drawn == cases.size() ? "" : fmt::format("; {} not drawn", cases.size() - drawn);
  if (drawn == 0) return "no map was drawn";
  if (first == nullptr) return fmt::format("every pixel of {} maps is explained{}", drawn, undrawn);
  return fmt::format("failed: {} of {} maps{}; the first is {}: {}", failed, drawn, undrawn,
                     title_of(*first), cause_of(*first));
}

namespace {

using attribution::PixelClass;
using attribution::RasterModel;
using attribution::RendererModel;
using attribution::SamplePosition;
using attribution::Truth;

bool is_at_centres(const SamplePosition& s) {
  return s.x == 0.5 && s.y == 0.5 && s.error == 0 && s.k1 == 0 && s.k2 == 0;
}

/// Formats are of perspective depths; an orthographic window depth is linear in the depth.
std::optional<Mapping> mapping_of(const RasterModel& model, ProjectionModel projection) {
  const Mapping mapping = model.stored_mapping();
  if (projection == ProjectionModel::perspective || is_logarithmic(mapping)) return mapping;
  if (is_reversed(mapping)) return std::nullopt;
  return Mapping::linear;
}

}  // namespace

std::string z_fight_count_text(const ValidationCase& c) {
  const std::uint64_t count = c.attribution.count(PixelClass::z_fight);
  if (c.has_triangle_numbers()) return std::to_string(count);
  constexpr const char* why = "no triangle numbers were read";
  return count == 0 ? fmt::format("unknown: {}", why) : fmt::format("at least {}: {}", count, why);
}

std::string z_fight_clause(const ValidationCase& c) {
  const std::uint64_t count = c.attribution.count(PixelClass::z_fight);
  const std::string name = name_of(PixelClass::z_fight);
  if (!c.has_triangle_numbers()) {
    return count == 0 ? fmt::format("{} unknown (no triangle numbers)", name)
                      : fmt::format("at least {} {} (no triangle numbers)", count, name);
  }
  if (count == 0 && c.predicted_fights.value_or(0) == 0) return "";
  return fmt::format("{} {}", count, name) +
         (c.predicted_fights ? fmt::format(" ({} by the format alone)", *c.predicted_fights) : "");
}

std::optional<std::uint64_t> predicted_fights(const Scene& scene, const Truth& truth,
                                              const RendererModel& model) {
  const auto* const raster = std::get_if<RasterModel>(&model.kind);
  if (raster == nullptr || !model.equal_depths || !is_at_centres(model.sample)) return std::nullopt;
  if (raster->bias != 0 || raster->affine) return std::nullopt;
  const auto mapping = mapping_of(*raster, truth.camera.projection.model);
  if (!mapping) return std::nullopt;
  DepthMap map{.width = truth.camera.width, .height = truth.camera.height};
  map.channels.push_back(
      {"id", Samples<std::uint32_t>(truth.triangles.begin(), truth.triangles.end())});
  const DepthBufferOptions options{
      .format = depth_format_of(truth.camera, *mapping, raster->storage),
      .against_exact = true,
      .render = {},
      .equal_depths = *model.equal_depths};
  return add_depth_buffer(map, scene, truth.camera, options).fighting;
}

}  // namespace fathom::validation
