#include "apps/textbook/pipeline/pipeline_report.h"

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "apps/shell/standard_streams.h"
#include "fathom/numeric/rounding.h"
#include "fathom/pipeline/geometry/window_transform.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<std::string_view, 8> comparisons{"never",   "less",     "equal",  "lequal",
                                                      "greater", "notequal", "gequal", "always"};

/// What a sample holds; `primitive` is null where nothing was drawn.
Json sample_json(const pipeline::StoredSample& sample, Storage storage, bool with_stencil) {
  const bool drawn = sample.id != no_surface;
  Json json{{"primitive", drawn ? Json(sample.id) : Json(nullptr)},
            {"depth", drawn ? Json(sample.depth) : Json(nullptr)},
            {"stored", stored_json(storage, sample.stored)},
            {"depth_written", sample.depth_written},
            {"colour", sample.colour}};
  if (with_stencil) json["stencil"] = sample.stencil;
  return json;
}

bool same_colour(const pipeline::StoredSample& a, const pipeline::StoredSample& b) {
  return a.colour == b.colour;
}

}  // namespace

double stored_number(Storage storage, StoredDepth stored) {
  return round_to_binary64(value_of(storage, stored));
}

Json stored_json(Storage storage, StoredDepth stored) {
  return {{is_unorm(storage) ? "code" : "bits", stored.bits},
          {"value", stored_number(storage, stored)}};
}

const char* comparison_name(Comparison comparison) {
  return comparisons[static_cast<std::size_t>(comparison)].data();
}

std::optional<Comparison> comparison_named(std::string_view name) {
  for (std::size_t i = 0; i < comparisons.size(); ++i)
    if (comparisons[i] == name) return static_cast<Comparison>(i);
  return std::nullopt;
}

const char* outcome_name(pipeline::Outcome outcome) {
  constexpr const char* names[] = {"stencil test failed", "depth test failed", "passed"};
  return names[static_cast<std::size_t>(outcome)];
}

const char* depth_test_name(const pipeline::MergeStep& step) {
  if (!step.depth_tested) return "none";
  return step.rules.depth_test ? comparison_name(*step.rules.depth_test) : "nearer";
}

Json merge_json(const pipeline::MergeStep& step, Storage storage) {
  const bool stencil = step.rules.stencil.has_value();
  const bool wanted = step.outcome == pipeline::Outcome::passed ||
                      (step.outcome == pipeline::Outcome::depth_failed && step.rules.blends_failed);
  Json tests{{"depth", depth_test_name(step)}};
  if (stencil) tests["stencil"] = comparison_name(step.rules.stencil->test);
  tests["outcome"] = outcome_name(step.outcome);
  Json blend = nullptr;
  if (step.rules.alpha && step.rules.colour_write && wanted)
    blend = {{"alpha", *step.rules.alpha}, {"one_minus_alpha", 1 - *step.rules.alpha}};
  Json writes = Json::array();
  if (!same_colour(step.before, step.after)) writes.push_back("colour");
  if (!(step.before.stored == step.after.stored) ||
      step.before.depth_written != step.after.depth_written)
    writes.push_back("depth");
  if (step.before.stencil != step.after.stencil) writes.push_back("stencil");
  return {{"primitive", step.fragment.number},
          {"pixel", {step.pixel.x, step.pixel.y}},
          {"before", sample_json(step.before, storage, stencil)},
          {"fragment",
           {{"window_z", step.fragment.window_z},
            {"depth", step.fragment.depth},
            {"stored", stored_json(storage, step.fragment.stored)},
            {"colour", step.colour}}},
          {"tests", tests},
          {"blend", blend},
          {"changes", writes},
          {"after", sample_json(step.after, storage, stencil)}};
}

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const pipeline::PipelineStatistics& s) {
  return {{"triangles", s.triangles},
          {"not_finite", s.not_finite},
          {"clipped_away", s.clipped_away},
          {"clipped", s.clipped},
          {"degenerate", s.degenerate},
          {"culled", s.culled},
          {"drawn", s.drawn},
          {"lines", s.lines},
          {"points", s.points},
          {"turned_by_snapping", s.turned_by_snapping},
          {"fragments", s.fragments},
          {"depth_passed", s.depth_passed},
          {"shaded", s.shaded},
          {"blocks_skipped", s.blocks_skipped},
          {"blocks_full", s.blocks_full},
          {"near", s.near},
          {"far", s.far},
          {"facings",
           {{"compared", s.facings.compared},
            {"front_in_world", s.facings.front_in_world},
            {"front_in_ndc", s.facings.front_in_ndc},
            {"front_in_window", s.facings.front_in_window},
            {"disagreeing", s.facings.disagreeing}}}};
}

Json to_json(const pipeline::PainterStatistics& s) {
  return {{"z_disjoint", s.z_disjoint},
          {"x_disjoint", s.settled[0]},
          {"y_disjoint", s.settled[1]},
          {"behind_plane", s.settled[2]},
          {"before_plane", s.settled[3]},
          {"projections_disjoint", s.settled[4]},
          {"moved", s.moved},
          {"splits", s.splits},
          {"comparisons", s.comparisons}};
}

Json to_json(const PipelineReport& report) {
  Json json{{"map", report.map},
            {"engine", "pipeline"},
            {"width", report.width},
            {"height", report.height}};
  json.update(to_json(report.statistics));
  if (report.painter) json["painter"] = to_json(*report.painter);
  return json;
}

}  // namespace

std::string as_json(const std::vector<PipelineReport>& maps) {
  Json list = Json::array();
  for (const PipelineReport& map : maps) list.push_back(to_json(map));
  return json_answer(list.size() == 1 ? list[0] : list);
}

void warn_of_windows(const Camera& camera, const pipeline::PipelineOptions& stages,
                     const Console& console) {
  if (pipeline::is_stretched(camera, stages))
    console.warn("the viewport's width : height is not the camera's: the picture is stretched");
  if (pipeline::drawable_window(camera, stages).is_empty())
    console.warn("viewport and scissor box leave no pixel of the image: the map is background");
}

}  // namespace fathom::app
