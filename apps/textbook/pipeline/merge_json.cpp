#include "apps/textbook/pipeline/merge_json.h"

#include <array>
#include <string_view>

#include "fathom/numeric/rounding.h"

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

}  // namespace fathom::app
