#include "validation/studies/indistinguishable/indistinguishable.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>

#include "fathom/numeric/errors.h"
#include "validation/studies/indistinguishable/depth_order.h"
#include "validation/studies/page.h"
#include "validation/studies/plot.h"
#include "validation/studies/sampling.h"

namespace fathom::studies {
namespace {

using Json = nlohmann::ordered_json;

constexpr Mapping projections[] = {Mapping::standard, Mapping::infinite, Mapping::reversed,
                                   Mapping::reversed_infinite, Mapping::opengl};
constexpr int random_views = 20;

struct Spacing {
  const char* name;
  std::vector<double> depths;
};

/// One line of the results.
struct Row {
  const char* spacing;
  Mapping mapping;
  bool premultiplied;
  const char* sources;
  std::optional<Storage> storage;
  OrderCount counts;
};

double percent(std::size_t part, std::size_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

std::string storage_name(const std::optional<Storage>& storage) {
  return storage ? std::string(name_of(*storage)) : "none";
}

const char* matrices_name(bool premultiplied) {
  return premultiplied ? "premultiplied" : "separate";
}

PipelineModel model_of(Mapping mapping, double near, double far, const View& view,
                       bool premultiplied, const PipelineRounding& rounding) {
  const double model_far =
      takes_infinite_far(mapping) ? std::numeric_limits<double>::infinity() : far;
  return {{mapping, Storage::float32, near, model_far}, view.row, premultiplied, rounding};
}

/// What is computed once and then stored in every storage.
struct Experiment {
  const Spacing* spacing;
  Mapping mapping;
  bool premultiplied;
  const Sources* sources;
};

std::vector<Experiment> experiments_of(const std::vector<Spacing>& spacings) {
  std::vector<Experiment> experiments;
  for (const Spacing& spacing : spacings) {
    for (const Mapping mapping : projections) {
      for (const bool premultiplied : {false, true}) {
        for (const Sources& sources : all_sources()) {
          experiments.push_back({&spacing, mapping, premultiplied, &sources});
        }
      }
    }
  }
  return experiments;
}

std::vector<Row> rows_of(const Experiment& e, double near, double far, const View& view) {
  const PipelineModel model =
      model_of(e.mapping, near, far, view, e.premultiplied, e.sources->rounding);
  const std::vector<Ratio> window = window_depths(model, view, *e.sources, e.spacing->depths);
  std::vector<std::optional<Storage>> storages{std::nullopt};
  storages.insert(storages.end(), std::begin(all_storages), std::end(all_storages));
  std::vector<Row> rows;
  rows.reserve(storages.size());
  for (const auto& storage : storages) {
    rows.push_back({e.spacing->name, e.mapping, e.premultiplied, e.sources->name, storage,
                    count_order(model, storage, window)});
  }
  return rows;
}

StudyFile csv_of(const std::vector<Row>& rows) {
  std::string text =
      "spacing,mapping,matrices,rounding,storage,pairs,equal,swapped,equal_percent,"
      "swapped_percent\n";
  for (const Row& r : rows) {
    text += fmt::format("{},{},{},{},{},{},{},{},{:.4f},{:.4f}\n", r.spacing, name_of(r.mapping),
                        matrices_name(r.premultiplied), r.sources, storage_name(r.storage),
                        r.counts.pairs, r.counts.equal, r.counts.swapped,
                        percent(r.counts.equal, r.counts.pairs),
                        percent(r.counts.swapped, r.counts.pairs));
  }
  return {"order.csv", text};
}

const Row& row_of(const std::vector<Row>& rows, const std::string& spacing, Mapping mapping,
                  bool premultiplied, const std::string& sources, Storage storage) {
  return *std::find_if(rows.begin(), rows.end(), [&](const Row& r) {
    return r.spacing == spacing && r.mapping == mapping && r.premultiplied == premultiplied &&
           r.sources == sources && r.storage == storage;
  });
}

/// The least and the greatest share over random views.
struct Spread {
  Mapping mapping;
  bool premultiplied;
  double equal[2], swapped[2];
};

Spread spread_of(Mapping mapping, bool premultiplied, double near, double far,
                 const std::vector<double>& depths) {
  Spread spread{mapping, premultiplied, {100, 0}, {100, 0}};
  const auto widen = [](double(&range)[2], double value) {
    range[0] = std::min(range[0], value);
    range[1] = std::max(range[1], value);
  };
  const Sources& vertices = all_sources()[5];
  for (int seed = 1; seed <= random_views; ++seed) {
    const View view = random_view(static_cast<std::uint64_t>(seed), near);
    const PipelineModel model =
        model_of(mapping, near, far, view, premultiplied, vertices.rounding);
    const OrderCount counts =
        count_order(model, Storage::float32, window_depths(model, view, vertices, depths));
    widen(spread.equal, percent(counts.equal, counts.pairs));
    widen(spread.swapped, percent(counts.swapped, counts.pairs));
  }
  return spread;
}

StudyFile csv_of(const std::vector<Spread>& spreads) {
  std::string text =
      "mapping,matrices,equal_percent_least,equal_percent_greatest,swapped_percent_least,"
      "swapped_percent_greatest\n";
  for (const Spread& s : spreads) {
    text += fmt::format("{},{},{:.4f},{:.4f},{:.4f},{:.4f}\n", name_of(s.mapping),
                        matrices_name(s.premultiplied), s.equal[0], s.equal[1], s.swapped[0],
                        s.swapped[1]);
  }
  return {"views.csv", text};
}

BarChart order_chart(const std::vector<Row>& rows, const std::string& spacing, Storage storage) {
  BarChart chart{"order-" + spacing + "-" + std::string(name_of(storage)),
                 fmt::format("Neighbouring depths lost, {} spacing, {}", spacing, name_of(storage)),
                 "share of neighbours (%)",
                 {},
                 {{"equal", {}}, {"swapped", {}}}};
  for (const Mapping mapping : projections) {
    for (const bool premultiplied : {false, true}) {
      const Row& r = row_of(rows, spacing, mapping, premultiplied, "vertices", storage);
      chart.categories.push_back(std::string(name_of(mapping)) + ", " +
                                 matrices_name(premultiplied));
      chart.series[0].heights.push_back(percent(r.counts.equal, r.counts.pairs));
      chart.series[1].heights.push_back(percent(r.counts.swapped, r.counts.pairs));
    }
  }
  return chart;
}

BarChart sources_chart(const std::vector<Row>& rows, bool swapped) {
  BarChart chart{swapped ? "sources-swapped" : "sources-equal",
                 fmt::format("Neighbours {}, by what rounds to binary32: linear spacing, "
                             "premultiplied, float32",
                             swapped ? "swapped" : "equal"),
                 "share of neighbours (%)",
                 {},
                 {}};
  for (const Mapping mapping : projections) chart.categories.emplace_back(name_of(mapping));
  for (const Sources& sources : all_sources()) {
    BarChart::Bars bars{sources.name, {}};
    for (const Mapping mapping : projections) {
      const OrderCount& c =
          row_of(rows, "linear", mapping, true, sources.name, Storage::float32).counts;
      bars.heights.push_back(percent(swapped ? c.swapped : c.equal, c.pairs));
    }
    chart.series.push_back(bars);
  }
  return chart;
}

std::string shares(const OrderCount& c) {
  return fmt::format("{:.1f} % equal, {:.1f} % swapped", percent(c.equal, c.pairs),
                     percent(c.swapped, c.pairs));
}

StudyFile page_of(double near, double far, const std::vector<Row>& rows,
                  const std::vector<Spread>& spreads, const Spacing& first) {
  Page page(fmt::format("Depths that a pipeline confuses, near {:g}, far {:g}", near, far));
  page.paragraph(fmt::format(
      "{} vertices lie in order on the axis of a camera that is turned and moved. Each goes "
      "through a pipeline's matrices and division and is stored; neighbours come out in order, "
      "equal or swapped. This is the experiment of Nathan Reed's 'Depth Precision Visualized' "
      "(2015), after Upchurch and Desbrun (2012). In exact arithmetic no neighbours are equal or "
      "swapped before storage.",
      first.depths.size()));
  page.heading("What is seen");
  page.paragraph(
      "Premultiplied, the standard and OpenGL matrices swap neighbours: z_clip and w_clip are then "
      "two sums of rounded products that err independently of each other, and their quotient lies "
      "where 1/D hardly changes. Applied one by one, w_clip enters z_clip as it is, the errors "
      "agree, and hardly anything is swapped; what is equal is equal because float32 and unorm24 "
      "have as good as the same codes near 1. With an infinite far, z_clip is w_clip minus near, "
      "so that premultiplying does little harm. Reversed with float32 keeps every pair apart, "
      "however the matrices are applied and wherever far is. With an integer buffer reversed is no "
      "better than the others, but it loses nothing to premultiplied matrices either.");
  std::vector<std::vector<std::string>> cells;
  for (const Mapping mapping : projections) {
    std::vector<std::string> row{std::string(name_of(mapping))};
    for (const bool premultiplied : {true, false}) {
      for (const Storage storage : {Storage::float32, Storage::unorm24}) {
        row.push_back(
            shares(row_of(rows, "linear", mapping, premultiplied, "vertices", storage).counts));
      }
    }
    cells.push_back(row);
  }
  page.table({"linear spacing", "premultiplied, float32", "premultiplied, unorm24",
              "separate, float32", "separate, unorm24"},
             cells);
  for (const char* spacing : {"linear", "logarithmic"}) {
    for (const char* storage : {"float32", "unorm24"}) {
      page.plot(fmt::format("order-{}-{}", spacing, storage),
                fmt::format("{} spacing, {}", spacing, storage));
    }
  }
  page.heading("Where it is lost");
  page.paragraph(
      "Each source alone, the rest exact: 'matrix' rounds the entries of the matrices and of their "
      "product, 'transform' the products and sums with a vertex, 'division' z/w, 'interpolation' "
      "the window depth between vertices at half and at twice the depth; 'storage' is what the "
      "buffer loses by itself, in all of them; 'vertices' is matrix, transform and division "
      "together, as in Reed's experiment; 'all' adds interpolation.");
  page.plot("sources-equal", "Neighbours that become equal");
  page.plot("sources-swapped", "Neighbours that are swapped");
  page.heading("Other views");
  page.paragraph(fmt::format(
      "The figures depend on the camera. The least and greatest over {} random views, float32, "
      "linear spacing:",
      random_views));
  cells.clear();
  for (const Spread& s : spreads) {
    cells.push_back({std::string(name_of(s.mapping)) + ", " + matrices_name(s.premultiplied),
                     fmt::format("{:.1f} … {:.1f} %", s.equal[0], s.equal[1]),
                     fmt::format("{:.1f} … {:.1f} %", s.swapped[0], s.swapped[1])});
  }
  page.table({"", "equal", "swapped"}, cells);
  page.heading("Files");
  page.paragraph(
      "order.csv: every combination. views.csv: the random views. summary.json: all of it, with "
      "the view and the control. *.gp: the scripts of the plots, for gnuplot.");
  return page.file();
}

Json json_of(const std::vector<Row>& rows) {
  Json list = Json::array();
  for (const Row& r : rows) {
    list.push_back({{"spacing", r.spacing},
                    {"mapping", name_of(r.mapping)},
                    {"matrices", matrices_name(r.premultiplied)},
                    {"rounding", r.sources},
                    {"storage", storage_name(r.storage)},
                    {"pairs", r.counts.pairs},
                    {"equal", r.counts.equal},
                    {"swapped", r.counts.swapped}});
  }
  return list;
}

Json json_of(const std::vector<Spread>& spreads) {
  Json list = Json::array();
  for (const Spread& s : spreads) {
    list.push_back({{"mapping", name_of(s.mapping)},
                    {"matrices", matrices_name(s.premultiplied)},
                    {"equal_percent", {s.equal[0], s.equal[1]}},
                    {"swapped_percent", {s.swapped[0], s.swapped[1]}}});
  }
  return list;
}

void require_binary32_range(double near, double far) {
  require_meaningful({Mapping::standard, Storage::float32, near, far});
  if (near < 1e-15 || far > 1e15) {
    throw UsageError("near and far of this study lie between 1e-15 and 1e15: it runs in binary32");
  }
}

}  // namespace

std::vector<StudyFile> study_indistinguishable(const StudyOptions& options,
                                               const std::function<void(double)>& tick) {
  const double near = options.near.value_or(0.1), far = options.far.value_or(10000);
  const std::uint32_t samples = options.samples.value_or(10001);
  require_binary32_range(near, far);
  const std::vector<Spacing> spacings{{"linear", linear_samples(near, far, samples)},
                                      {"logarithmic", logarithmic_samples(near, far, samples)}};
  require_gnuplot();

  const View view = default_view(near);
  const std::vector<Experiment> experiments = experiments_of(spacings);
  std::vector<std::vector<Row>> parts(experiments.size());
  std::mutex ticking;
  std::size_t finished = 0;
  tbb::parallel_for(std::size_t{0}, experiments.size(), [&](std::size_t i) {
    parts[i] = rows_of(experiments[i], near, far, view);
    const std::lock_guard<std::mutex> lock(ticking);
    tick(0.9 * static_cast<double>(++finished) / static_cast<double>(experiments.size()));
  });
  std::vector<Row> rows;
  for (const auto& part : parts) rows.insert(rows.end(), part.begin(), part.end());

  std::vector<Spread> spreads;
  for (const Mapping mapping : projections) {
    for (const bool premultiplied : {false, true}) {
      spreads.push_back(spread_of(mapping, premultiplied, near, far, spacings[0].depths));
    }
  }

  Json summary{{"study", "indistinguishable"}, {"near", near},    {"far", far},
               {"samples", samples},           {"eye", view.eye}, {"direction", view.direction},
               {"control", Json::array()}};
  for (const Spacing& spacing : spacings) {
    const OrderCount control = count_vertex_order(view, spacing.depths);
    summary["control"].push_back(
        {{"spacing", spacing.name}, {"equal", control.equal}, {"swapped", control.swapped}});
  }
  summary["order"] = json_of(rows);
  summary["random_views"] = json_of(spreads);

  std::vector<StudyFile> files{
      csv_of(rows), csv_of(spreads), {"summary.json", summary.dump(2) + "\n"}};
  const auto append = [&](std::vector<StudyFile> more) {
    std::move(more.begin(), more.end(), std::back_inserter(files));
  };
  for (const char* spacing : {"linear", "logarithmic"}) {
    for (const Storage storage : {Storage::float32, Storage::unorm24}) {
      append(draw(order_chart(rows, spacing, storage)));
    }
  }
  for (const bool swapped : {false, true}) append(draw(sources_chart(rows, swapped)));
  files.push_back(page_of(near, far, rows, spreads, spacings[0]));
  tick(1);
  return files;
}

}  // namespace fathom::studies
