#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "apps/study/page.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "apps/study/sweeps.h"
#include "fathom/depth_format/depth_format.h"
#include "fathom/depth_format/resolution.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

/// At one depth.
struct Step {
  double depth;
  double step;       ///< the larger distance to a neighbouring code's depth
  double bin_width;  ///< of the depths that are stored alike
};

struct FormatSteps {
  DepthFormat format;
  std::vector<Step> steps;
  std::uint64_t codes;                    ///< between near and far
  double share_below_2, share_below_10;   ///< of the codes, up to 2 and to 10 times near
  double greatest_relative, greatest_at;  ///< step over depth, and the depth where it is greatest
};

/// The mapping of the least step of a storage at a depth.
struct BestMapping {
  Storage storage;
  double depth;
  Mapping mapping;
  double step;
};

/// Neighbouring depths over which one mapping is the best of a storage.
struct BestRange {
  Storage storage;
  Mapping mapping;
  double from, to;
};

/// The step at a depth when near or far is moved.
enum class Moved { near, far };

struct MovedStep {
  Moved moved;
  DepthFormat format;
  double depth;
  double step;

  [[nodiscard]] double place() const { return moved == Moved::near ? format.near : format.far; }
};

double step_at(const DepthFormat& format, double depth) {
  const Resolution r = resolution(format, Dyadic(depth));
  return std::max(r.to_nearer.value_or(0), r.to_farther.value_or(0));
}

/// The share of all codes between near and far that depths up to `times` near get.
double share_of_codes(const DepthFormat& format, double times) {
  const Ratio near = Dyadic(format.near), far = Dyadic(format.far);
  const double limit = std::min(times * format.near, format.far);
  return static_cast<double>(codes_between(format, near, Dyadic(limit))) /
         static_cast<double>(codes_between(format, near, far));
}

FormatSteps measure(const DepthFormat& format, const std::vector<double>& depths) {
  FormatSteps measured{.format = format,
                       .codes = codes_between(format, Dyadic(format.near), Dyadic(format.far)),
                       .share_below_2 = share_of_codes(format, 2),
                       .share_below_10 = share_of_codes(format, 10)};
  for (const double depth : depths) {
    measured.steps.push_back({depth, step_at(format, depth), bin_width(format, Dyadic(depth))});
  }
  const auto worst = std::max_element(
      measured.steps.begin(), measured.steps.end(),
      [](const Step& a, const Step& b) { return a.step / a.depth < b.step / b.depth; });
  measured.greatest_relative = worst->step / worst->depth;
  measured.greatest_at = worst->depth;
  return measured;
}

/// Of every format, at these depths from near to far.
std::vector<FormatSteps> measure_formats(double near, double far, const std::vector<double>& depths,
                                         const std::function<void(double)>& tick) {
  std::vector<FormatSteps> all;
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : all_storages) {
      all.push_back(measure({mapping, storage, near, far}, depths));
      tick(static_cast<double>(all.size()) /
           static_cast<double>(std::size(all_mappings) * std::size(all_storages)));
    }
  }
  return all;
}

/// opengl is standard in the ideal model, and is left out.
std::vector<BestMapping> best_mappings(const std::vector<FormatSteps>& all) {
  std::vector<BestMapping> best;
  for (const Storage storage : all_storages) {
    for (std::size_t i = 0; i < all.front().steps.size(); ++i) {
      BestMapping least{storage, all.front().steps[i].depth, Mapping::standard, INFINITY};
      for (const FormatSteps& m : all) {
        if (m.format.storage != storage || m.format.mapping == Mapping::opengl) continue;
        if (m.steps[i].step < least.step) {
          least.mapping = m.format.mapping;
          least.step = m.steps[i].step;
        }
      }
      best.push_back(least);
    }
  }
  return best;
}

std::vector<BestRange> best_ranges(const std::vector<BestMapping>& best) {
  std::vector<BestRange> ranges;
  for (const BestMapping& b : best) {
    if (!ranges.empty() && ranges.back().storage == b.storage &&
        ranges.back().mapping == b.mapping) {
      ranges.back().to = b.depth;
    } else {
      ranges.push_back({b.storage, b.mapping, b.depth, b.depth});
    }
  }
  return ranges;
}

/// By factors from 0.01 to 100, at the geometric mean of near and far.
std::vector<MovedStep> move_near_and_far(double near, double far) {
  constexpr double factors[] = {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100};
  std::vector<MovedStep> rows;
  const double depth = std::sqrt(near) * std::sqrt(far);
  const auto add = [&](Moved moved, const DepthFormat& format) {
    if (format.near <= depth && depth <= format.far) {
      rows.push_back({moved, format, depth, step_at(format, depth)});
    }
  };
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::float32}) {
      for (const double factor : factors) {
        add(Moved::near, {mapping, storage, near * factor, far});
        add(Moved::far, {mapping, storage, near, far * factor});
      }
    }
  }
  return rows;
}

/// A step with its format: a row of steps.csv.
struct StepOfFormat {
  DepthFormat format;
  Step at;
};

Table steps_table(const std::vector<FormatSteps>& all) {
  using Row = StepOfFormat;
  std::vector<Row> rows;
  for (const FormatSteps& m : all) {
    for (const Step& step : m.steps) rows.push_back({m.format, step});
  }
  return {rows,
          {{"mapping", mapping_of},
           {"storage", storage_of},
           {"near", [](const Row& r) { return r.format.near; }},
           {"far", [](const Row& r) { return r.format.far; }},
           {"depth", [](const Row& r) { return r.at.depth; }},
           {"step", [](const Row& r) { return r.at.step; }},
           {"relative_step", [](const Row& r) { return r.at.step / r.at.depth; }},
           {"bin_width", [](const Row& r) { return r.at.bin_width; }}}};
}

Table best_table(const std::vector<BestMapping>& rows) {
  using Row = BestMapping;
  return {rows,
          {{"storage", [](const Row& r) { return name_of(r.storage); }},
           {"depth", &Row::depth},
           {"best_mapping", [](const Row& r) { return name_of(r.mapping); }},
           {"step", &Row::step}}};
}

Table ranges_table(const std::vector<BestRange>& rows) {
  using Row = BestRange;
  return {rows,
          {{"storage", [](const Row& r) { return name_of(r.storage); }},
           {"mapping", [](const Row& r) { return name_of(r.mapping); }},
           {"from_depth", &Row::from},
           {"to_depth", &Row::to}}};
}

Table moved_table(const std::vector<MovedStep>& rows) {
  using Row = MovedStep;
  return {rows,
          {{"moved", [](const Row& r) { return r.moved == Moved::near ? "near" : "far"; }},
           {"mapping", mapping_of},
           {"storage", storage_of},
           {"near", [](const Row& r) { return r.format.near; }},
           {"far", [](const Row& r) { return r.format.far; }},
           {"depth", &Row::depth},
           {"step", &Row::step}}};
}

Table formats_table(const std::vector<FormatSteps>& rows) {
  using Row = FormatSteps;
  return {rows,
          {{heading("format"), [](const Row& r) { return label_of(r.format); }},
           {"mapping", mapping_of},
           {"storage", storage_of},
           {Column("codes").page("codes"), &Row::codes},
           {Column("share_of_codes_nearer_than_2_near").percent("up to 2·near", ".2f"),
            &Row::share_below_2},
           {Column("share_of_codes_nearer_than_10_near").percent("up to 10·near", ".2f"),
            &Row::share_below_10},
           {"step_at_near", [](const Row& r) { return r.steps.front().step; }},
           {"step_at_far", [](const Row& r) { return r.steps.back().step; }},
           {Column("greatest_relative_step").page("greatest relative step", ".3g"),
            &Row::greatest_relative},
           {Column("greatest_relative_step_at").page("at depth", ".4g"), &Row::greatest_at}}};
}

/// The finest mappings of a storage, by their greatest relative step.
struct FinestMapping {
  FormatSteps of_projections, of_all, standard;
};

/// opengl is standard in the ideal model.
std::vector<FinestMapping> finest_mappings(const std::vector<FormatSteps>& all) {
  const auto finest = [](const std::vector<FormatSteps>& some) {
    return *std::ranges::min_element(some, {}, &FormatSteps::greatest_relative);
  };
  std::vector<FinestMapping> rows;
  for (const Storage storage : all_storages) {
    const auto of_storage = rows_where(all, [&](const FormatSteps& m) {
      return m.format.storage == storage && m.format.mapping != Mapping::opengl;
    });
    const auto projections = rows_where(
        of_storage, [](const FormatSteps& m) { return is_projection(m.format.mapping); });
    const auto standard = rows_where(
        of_storage, [](const FormatSteps& m) { return m.format.mapping == Mapping::standard; });
    rows.push_back({finest(projections), finest(of_storage), standard.front()});
  }
  return rows;
}

Table answer_table(const std::vector<FinestMapping>& rows) {
  using Row = FinestMapping;
  const auto storage = [](const Row& r) { return name_of(r.standard.format.storage); };
  return {
      rows,
      {{heading("storage"), storage},
       {heading("finest projection"),
        [](const Row& r) { return name_of(r.of_projections.format.mapping); }},
       {heading("step ÷ depth", ".3g"),
        [](const Row& r) { return r.of_projections.greatest_relative; }},
       {heading("finest mapping"), [](const Row& r) { return name_of(r.of_all.format.mapping); }},
       {heading("step ÷ depth", ".3g"), [](const Row& r) { return r.of_all.greatest_relative; }},
       {heading("standard: step ÷ depth", ".3g"),
        [](const Row& r) { return r.standard.greatest_relative; }},
       {heading("at depth", ".4g"), [](const Row& r) { return r.standard.greatest_at; }}}};
}

/// The values of the page's first sentences.
void quote_answer(Results& results, const std::vector<FinestMapping>& rows) {
  for (const auto& [of_projections, of_all, standard] : rows) {
    const std::string name(name_of(standard.format.storage));
    if (name != "float32" && name != "unorm24") continue;
    results.quote("projection_" + name, label_of(of_projections.format));
    results.quote("projection_" + name + "_step", of_projections.greatest_relative, ".3g");
    results.quote("best_" + name, label_of(of_all.format));
    results.quote("best_" + name + "_step", of_all.greatest_relative, ".3g");
    results.quote("standard_" + name + "_step", standard.greatest_relative, ".3g");
  }
}

/// Near a stored 0 the steps of float formats are subnormal numbers, which would squeeze the rest
/// of a plot: what is finer than 10⁻¹⁷ of the depth is left out there, not in the figures.
template <class Row>
bool is_coarse_enough(const Row& row) {
  return row.step > 1e-17 * row.depth;
}

Plot steps_plot(const std::vector<FormatSteps>& all, Storage storage) {
  const std::string name(name_of(storage));
  Plot plot{.name = "steps-" + name,
            .title = "Distance between neighbouring codes, " + name,
            .x_label = "depth (scene units)",
            .y_label = "step (scene units)",
            .logarithmic_x = true,
            .logarithmic_y = true};
  for (const FormatSteps& m : all) {
    // opengl is standard in the ideal model.
    if (m.format.storage != storage || m.format.mapping == Mapping::opengl) continue;
    plot.series.push_back(series_of(std::string(name_of(m.format.mapping)),
                                    rows_where(m.steps, is_coarse_enough<Step>), &Step::depth,
                                    &Step::step));
  }
  return plot;
}

/// A line for each format that is shown, in the order of their names.
Plot moved_plot(const std::vector<MovedStep>& rows, Moved moved) {
  const std::string name = moved == Moved::near ? "near" : "far";
  Plot plot{
      .name = "step-by-" + name,
      .title = "Step at depth " + text_of(rows.front().depth, ".4g") + " when " + name + " moves",
      .x_label = name + " (scene units)",
      .y_label = "step (scene units)",
      .logarithmic_x = true,
      .logarithmic_y = true};
  std::map<std::string, std::vector<MovedStep>> lines;
  for (const MovedStep& r : rows) {
    const bool is_shown = r.format.storage != Storage::unorm16 &&
                          r.format.mapping != Mapping::opengl &&
                          !takes_infinite_far(r.format.mapping);
    if (r.moved == moved && is_shown && is_coarse_enough(r)) {
      lines[label_of(r.format)].push_back(r);
    }
  }
  for (const auto& [label, line] : lines) {
    plot.series.push_back(series_of(label, line, &MovedStep::place, &MovedStep::step));
  }
  return plot;
}

}  // namespace

std::vector<StudyFile> study_depth_resolution(const StudyOptions& options,
                                              const std::function<void(double)>& tick) {
  const double near = options.near.value_or(0.1), far = options.far.value_or(1000);
  require_meaningful({Mapping::standard, Storage::unorm16, near, far});
  if (near < 1e-300 || far > 1e300) {
    throw UsageError("near and far of this study lie between 1e-300 and 1e300");
  }
  const std::vector<double> depths = logarithmic_samples(near, far, options.samples.value_or(121));
  require_gnuplot(options);
  const std::vector<FormatSteps> all =
      measure_formats(near, far, depths, [&](double share) { tick(0.8 * share); });
  const std::vector<BestMapping> best = best_mappings(all);
  const std::vector<MovedStep> moved = move_near_and_far(near, far);

  Results results("depth-resolution", page_texts::depth_resolution, options);
  results.figure("near", near);
  results.figure("far", far);
  results.figure("samples", depths.size());
  const std::vector<FinestMapping> finest = finest_mappings(all);
  quote_answer(results, finest);
  results.table(answer_table(finest), {.page = "answer"});
  results.table(formats_table(all), {.json = "formats", .page = "formats"});
  results.table(ranges_table(best_ranges(best)), {.json = "best"});
  results.table(steps_table(all), {.csv = "steps"});
  results.table(best_table(best), {.csv = "best"});
  results.table(moved_table(moved), {.csv = "near-far"});
  for (const Storage storage : all_storages) results.plot(steps_plot(all, storage));
  results.plot(moved_plot(moved, Moved::near));
  results.plot(moved_plot(moved, Moved::far));
  tick(1);
  return results.files();
}

}  // namespace fathom::studies
