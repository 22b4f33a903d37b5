#include "validation/studies/depth_resolution/depth_resolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "fathom/depth_format/resolution.h"
#include "fathom/numeric/errors.h"
#include "validation/studies/page.h"
#include "validation/studies/plot.h"
#include "validation/studies/sampling.h"

namespace fathom::studies {
namespace {

using Json = nlohmann::ordered_json;

/// One format at one depth.
struct Step {
  double depth;
  double step;       ///< the larger distance to a neighbouring code's depth
  double bin_width;  ///< of the depths that are stored alike
};

struct Measured {
  DepthFormat format;
  std::vector<Step> steps;
};

double step_at(const DepthFormat& format, double depth) {
  const Resolution r = resolution(format, Dyadic(depth));
  return std::max(r.to_nearer.value_or(0), r.to_farther.value_or(0));
}

Measured measure(const DepthFormat& format, const std::vector<double>& depths) {
  Measured measured{format, {}};
  for (const double depth : depths) {
    measured.steps.push_back({depth, step_at(format, depth), bin_width(format, Dyadic(depth))});
  }
  return measured;
}

std::string label_of(const DepthFormat& format) {
  return std::string(name_of(format.mapping)) + " " + std::string(name_of(format.storage));
}

StudyFile steps_csv(const std::vector<Measured>& all) {
  std::string text = "mapping,storage,near,far,depth,step,relative_step,bin_width\n";
  for (const Measured& m : all) {
    for (const Step& s : m.steps) {
      text += fmt::format("{},{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n",
                          name_of(m.format.mapping), name_of(m.format.storage), m.format.near,
                          m.format.far, s.depth, s.step, s.step / s.depth, s.bin_width);
    }
  }
  return {"steps.csv", text};
}

/// opengl is standard in the ideal model, and is left out where formats compete.
bool competes(const Measured& m) {
  return m.format.mapping != Mapping::opengl;
}

/// For each storage and depth the mapping of the least step.
struct Best {
  Storage storage;
  double depth;
  Mapping mapping;
  double step;
};

std::vector<Best> best_mappings(const std::vector<Measured>& all) {
  std::vector<Best> best;
  for (const Storage storage : all_storages) {
    for (std::size_t i = 0; i < all.front().steps.size(); ++i) {
      Best least{storage, all.front().steps[i].depth, Mapping::standard, INFINITY};
      for (const Measured& m : all) {
        if (m.format.storage != storage || !competes(m)) continue;
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

StudyFile best_csv(const std::vector<Best>& best) {
  std::string text = "storage,depth,best_mapping,step\n";
  for (const Best& b : best) {
    text += fmt::format("{},{:.17g},{},{:.17g}\n", name_of(b.storage), b.depth, name_of(b.mapping),
                        b.step);
  }
  return {"best.csv", text};
}

/// The runs of depths over which one mapping is the best of a storage.
Json best_ranges(const std::vector<Best>& best) {
  Json ranges = Json::array();
  for (const Best& b : best) {
    const std::string storage(name_of(b.storage)), mapping(name_of(b.mapping));
    if (!ranges.empty() && ranges.back()["storage"] == storage &&
        ranges.back()["mapping"] == mapping) {
      ranges.back()["to_depth"] = b.depth;
    } else {
      ranges.push_back({{"storage", storage},
                        {"mapping", mapping},
                        {"from_depth", b.depth},
                        {"to_depth", b.depth}});
    }
  }
  return ranges;
}

/// The share of all codes between near and far that depths up to `times` near get.
double share_of_codes(const DepthFormat& format, double times) {
  const Ratio near = Dyadic(format.near), far = Dyadic(format.far);
  const double limit = std::min(times * format.near, format.far);
  return static_cast<double>(codes_between(format, near, Dyadic(limit))) /
         static_cast<double>(codes_between(format, near, far));
}

Json summary_of(const Measured& m) {
  const auto worst = std::max_element(
      m.steps.begin(), m.steps.end(),
      [](const Step& a, const Step& b) { return a.step / a.depth < b.step / b.depth; });
  return {{"mapping", name_of(m.format.mapping)},
          {"storage", name_of(m.format.storage)},
          {"codes", codes_between(m.format, Dyadic(m.format.near), Dyadic(m.format.far))},
          {"share_of_codes_nearer_than_2_near", share_of_codes(m.format, 2)},
          {"share_of_codes_nearer_than_10_near", share_of_codes(m.format, 10)},
          {"step_at_near", m.steps.front().step},
          {"step_at_far", m.steps.back().step},
          {"greatest_relative_step", worst->step / worst->depth},
          {"greatest_relative_step_at", worst->depth}};
}

/// How the step at fixed depths moves when near or far does.
struct Sweep {
  const char* moved;  ///< "near" or "far"
  DepthFormat format;
  double depth;
  double step;
};

constexpr double sweep_factors[] = {0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100};

std::vector<Sweep> sweep(double near, double far) {
  std::vector<Sweep> rows;
  const double depth = std::sqrt(near) * std::sqrt(far);
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : {Storage::unorm16, Storage::unorm24, Storage::float32}) {
      for (const double factor : sweep_factors) {
        const DepthFormat by_near{mapping, storage, near * factor, far};
        if (by_near.near <= depth) {
          rows.push_back({"near", by_near, depth, step_at(by_near, depth)});
        }
        const DepthFormat by_far{mapping, storage, near, far * factor};
        if (by_far.far >= depth) rows.push_back({"far", by_far, depth, step_at(by_far, depth)});
      }
    }
  }
  return rows;
}

StudyFile sweep_csv(const std::vector<Sweep>& rows) {
  std::string text = "moved,mapping,storage,near,far,depth,step\n";
  for (const Sweep& r : rows) {
    text += fmt::format("{},{},{},{:.17g},{:.17g},{:.17g},{:.17g}\n", r.moved,
                        name_of(r.format.mapping), name_of(r.format.storage), r.format.near,
                        r.format.far, r.depth, r.step);
  }
  return {"near-far.csv", text};
}

/// Near a stored 0 the steps of float formats are subnormal numbers, which would squeeze the rest
/// of a plot: what is finer than 10⁻¹⁷ of the depth is left out there, not in the figures.
bool is_drawn(double depth, double step) {
  return std::isfinite(step) && step > 1e-17 * depth;
}

Plot steps_plot(const std::vector<Measured>& all, Storage storage) {
  Plot plot{"steps-" + std::string(name_of(storage)),
            fmt::format("Distance between neighbouring codes, {}", name_of(storage)),
            "depth (scene units)",
            "step (scene units)",
            true,
            true,
            {}};
  for (const Measured& m : all) {
    if (m.format.storage != storage || !competes(m)) continue;
    Series series{std::string(name_of(m.format.mapping)), {}};
    for (const Step& s : m.steps) {
      if (is_drawn(s.depth, s.step)) series.points.emplace_back(s.depth, s.step);
    }
    plot.series.push_back(series);
  }
  return plot;
}

Plot sweep_plot(const std::vector<Sweep>& rows, const std::string& moved) {
  Plot plot{"step-by-" + moved,
            fmt::format("Step at depth {:.4g} when {} moves", rows.front().depth, moved),
            moved + " (scene units)",
            "step (scene units)",
            true,
            true,
            {}};
  std::map<std::string, Series> series;
  for (const Sweep& r : rows) {
    const bool shown = r.format.storage != Storage::unorm16 &&
                       r.format.mapping != Mapping::opengl && !takes_infinite_far(r.format.mapping);
    if (moved != r.moved || !shown || !is_drawn(r.depth, r.step)) continue;
    Series& line = series[label_of(r.format)];
    line.label = label_of(r.format);
    line.points.emplace_back(moved == "near" ? r.format.near : r.format.far, r.step);
  }
  for (auto& [label, line] : series) {
    std::sort(line.points.begin(), line.points.end());
    plot.series.push_back(line);
  }
  return plot;
}

void append(std::vector<StudyFile>& files, std::vector<StudyFile> more) {
  std::move(more.begin(), more.end(), std::back_inserter(files));
}

StudyFile page_of(double near, double far, const Json& summary) {
  Page page(fmt::format("Resolution of depth formats, near {:g}, far {:g}", near, far));
  page.paragraph(
      "A depth buffer tells two surfaces apart where their depths are stored as different codes. "
      "The step is the distance, in scene units, between the depths that neighbouring codes stand "
      "for: the larger of the two around a depth. Every figure is computed exactly and rounded "
      "once; no sampling and no formula of thumb enters.");
  page.heading("What is seen");
  page.paragraph(
      "Mappings with 1/D in unorm storage have steps that grow with the square of the depth, so "
      "that most codes lie just behind near. In standard float32 they do too: the exponents lie "
      "near 0, where near is, and do not help. Reversed, the exponents lie at far, and the step of "
      "float32 is nearly proportional to the depth, like that of a logarithmic format. Linear and "
      "w "
      "in unorm storage have the same step everywhere. log-ulrich has the same relative step "
      "everywhere; log gives up resolution below 1/C, where its step stops shrinking.");
  for (const Storage storage : all_storages) {
    page.plot("steps-" + std::string(name_of(storage)),
              fmt::format("Step against depth in {}; opengl is standard in the ideal model. Steps "
                          "below 1e-17 of the depth are left out.",
                          name_of(storage)));
  }
  page.heading("Codes");
  page.paragraph(
      "The share of the codes that depths up to twice and up to ten times near take, the greatest "
      "relative step and where it is.");
  std::vector<std::vector<std::string>> rows;
  for (const Json& f : summary["formats"]) {
    rows.push_back(
        {f["mapping"].get<std::string>() + " " + f["storage"].get<std::string>(),
         std::to_string(f["codes"].get<std::uint64_t>()),
         fmt::format("{:.2f} %", 100 * f["share_of_codes_nearer_than_2_near"].get<double>()),
         fmt::format("{:.2f} %", 100 * f["share_of_codes_nearer_than_10_near"].get<double>()),
         fmt::format("{:.3g}", f["greatest_relative_step"].get<double>()),
         fmt::format("{:.4g}", f["greatest_relative_step_at"].get<double>())});
  }
  page.table(
      {"format", "codes", "up to 2·near", "up to 10·near", "greatest relative step", "at depth"},
      rows);
  page.heading("Moving near and far");
  page.paragraph(
      "At a fixed depth, the step of standard is inversely proportional to near and hardly depends "
      "on far: moving near out by ten gains more than three bits, moving far in gains nothing. "
      "Reversed float32 moves by less than a factor of two with either; logarithms depend on both, "
      "weakly; linear and w are "
      "proportional to far.");
  page.plot("step-by-near", "Step at one depth against near.");
  page.plot("step-by-far", "Step at one depth against far.");
  page.heading("Files");
  page.paragraph(
      "steps.csv: every format at every depth. best.csv: the mapping of the least step for each "
      "storage and depth. near-far.csv: the sweeps. summary.json: the table above, and the ranges "
      "of depth over which each mapping is the best of its storage. *.gp: the scripts of the "
      "plots, for gnuplot.");
  return page.file();
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
  require_gnuplot();

  std::vector<Measured> all;
  for (const Mapping mapping : all_mappings) {
    for (const Storage storage : all_storages) {
      all.push_back(measure({mapping, storage, near, far}, depths));
      tick(0.8 * static_cast<double>(all.size()) / 54);
    }
  }
  const std::vector<Best> best = best_mappings(all);
  const std::vector<Sweep> sweeps = sweep(near, far);

  Json summary{{"study", "depth-resolution"},
               {"near", near},
               {"far", far},
               {"samples", depths.size()},
               {"formats", Json::array()}};
  for (const Measured& m : all) summary["formats"].push_back(summary_of(m));
  summary["best"] = best_ranges(best);

  std::vector<StudyFile> files{
      steps_csv(all), best_csv(best), sweep_csv(sweeps), {"summary.json", summary.dump(2) + "\n"}};
  for (const Storage storage : all_storages) append(files, draw(steps_plot(all, storage)));
  for (const char* moved : {"near", "far"}) append(files, draw(sweep_plot(sweeps, moved)));
  files.push_back(page_of(near, far, summary));
  tick(1);
  return files;
}

}  // namespace fathom::studies
