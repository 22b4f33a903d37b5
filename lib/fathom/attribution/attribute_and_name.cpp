#include "fathom/attribution/attribute_and_name.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "fathom/attribution/faults/depth_relation.h"
#include "fathom/attribution/faults/hypotheses.h"
#include "fathom/numeric/standard_arithmetic.h"

// How to read this file: attribute_and_name() at the end. What names single triangles comes first;
// where that does not explain nine tenths, what names faults of the whole image.
namespace fathom::attribution {
namespace {

void name_bias(Attribution& found) {
  if (!found.is_biased()) return;
  found.findings.push_back(
      {"bias",
       fmt::format("window depths are biased by {:+.3g} steps of the storage on average",
                   found.bias_steps),
       found.bias_pixels});
}

void name_ties(Attribution& found) {
  if (found.wrong_ties == 0) return;
  found.findings.push_back({"ties",
                            "of triangles with the same corners a later one is seen, where the "
                            "first should be",
                            found.wrong_ties});
}

/// Triangles that are absent wherever they are certain to be visible.
void name_missing_triangles(const Truth& truth, Attribution& found) {
  std::map<std::uint32_t, std::uint64_t> absent;
  std::map<std::uint32_t, std::uint64_t> present;
  for (std::size_t i = 0; i < found.absent.size(); ++i) {
    const std::uint32_t visible = truth.triangles[i];
    if (visible == no_surface) continue;
    if (found.absent[i] != no_surface) {
      ++absent[visible];
    } else if (found.classes[i] <= PixelClass::arithmetic) {
      ++present[visible];
    }
  }
  for (const auto& [triangle, pixels] : absent) {
    if (present[triangle] > pixels / 10) continue;
    found.findings.push_back(
        {"missing-triangle", fmt::format("triangle {} is missing", triangle), pixels});
  }
}

/// Unexplained pixels for which `is_explained(pixel)` become a convention, and `finding` is its
/// name.
template <class IsExplained>
void name_convention(Attribution& found, const Finding& finding, const IsExplained& is_explained) {
  for (std::size_t i = 0; i < found.classes.size(); ++i) {
    PixelClass& c = found.classes[i];
    if (c == PixelClass::unexplained && is_explained(i)) c = PixelClass::convention;
  }
  found.counts = {};
  for (const PixelClass c : found.classes) ++found.counts[static_cast<std::size_t>(c)];
  found.findings.push_back(finding);
}

/// The hypothesis that leaves the fewest pixels unexplained becomes a finding, if it leaves few.
bool name_by_hypothesis(const Truth& truth, const OtherMap& other, const RendererModel& model,
                        Attribution& found) {
  const std::uint64_t before = found.count(PixelClass::unexplained);
  std::uint64_t fewest = before / 10 + 1;
  std::optional<Finding> best;
  std::vector<PixelClass> classes;
  for (const MakeHypothesis& make : hypotheses(truth, other, model, found)) {
    const std::optional<Hypothesis> h = make();
    if (!h) continue;
    Attribution trial = attribute(truth, h->map, h->model);
    const std::uint64_t left = trial.count(PixelClass::unexplained);
    if (left >= fewest) continue;
    fewest = left;
    best = Finding{h->kind, h->text, before - left};
    classes = std::move(trial.classes);
    if (left == 0) break;
  }
  if (!best) return false;
  name_convention(found, *best,
                  [&](std::size_t i) { return classes[i] != PixelClass::unexplained; });
  return true;
}

/// A formula of depths becomes a finding, if it holds at half as many pixels as are unexplained.
bool name_by_relation(const Truth& truth, const OtherMap& other, Attribution& found) {
  const std::optional<Finding> finding = related_depths(truth, other);
  if (!finding || finding->pixels * 2 < found.count(PixelClass::unexplained)) return false;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  name_convention(found, *finding, [&](std::size_t i) {
    return truth.depths[i] < infinity && other.depths[i] < infinity;
  });
  return true;
}

}  // namespace

Attribution attribute_and_name(const Truth& truth, const OtherMap& other,
                               const RendererModel& model) {
  const StandardArithmetic standard;
  Attribution found = attribute(truth, other, model);
  const std::uint64_t unexplained = found.count(PixelClass::unexplained);
  if (unexplained == 0) {
    name_bias(found);
    return found;
  }
  name_ties(found);
  name_missing_triangles(truth, found);
  std::uint64_t named = 0;
  for (const Finding& finding : found.findings) named += finding.pixels;
  if (named * 10 >= unexplained * 9) return found;

  std::vector<Finding> few = std::exchange(found.findings, {});
  const bool is_named =
      name_by_hypothesis(truth, other, model, found) || name_by_relation(truth, other, found);
  if (!is_named) found.findings = std::move(few);
  return found;
}

}  // namespace fathom::attribution
