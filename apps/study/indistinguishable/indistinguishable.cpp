#include <algorithm>

#include "apps/study/indistinguishable/depth_order.h"
#include "apps/study/page.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

const char* name_of(Spacing spacing) {
  return spacing == Spacing::linear ? "linear" : "logarithmic";
}

std::string_view name_of(const std::optional<Storage>& storage) {
  return storage ? fathom::name_of(*storage) : "none";
}

const char* matrices_name(bool premultiplied) {
  return premultiplied ? "premultiplied" : "separate";
}

std::string name_of_matrices(Mapping mapping, bool premultiplied) {
  return std::string(fathom::name_of(mapping)) + ", " + matrices_name(premultiplied);
}

Table order_table(const std::vector<LostOrder>& rows) {
  using Row = LostOrder;
  return {rows,
          {{"spacing", [](const Row& r) { return name_of(r.way.spacing); }},
           {"mapping", [](const Row& r) { return fathom::name_of(r.way.mapping); }},
           {"matrices", [](const Row& r) { return matrices_name(r.way.premultiplied); }},
           {"rounding", [](const Row& r) { return r.way.sources->name; }},
           {"storage", [](const Row& r) { return name_of(r.way.storage); }},
           {"pairs", [](const Row& r) { return r.counts.pairs; }},
           {"equal", [](const Row& r) { return r.counts.equal; }},
           {"swapped", [](const Row& r) { return r.counts.swapped; }},
           {Column("equal_percent", ".4f").csv_only(),
            [](const Row& r) { return percent_equal(r.counts); }},
           {Column("swapped_percent", ".4f").csv_only(),
            [](const Row& r) { return percent_swapped(r.counts); }}}};
}

std::string range_text(double least, double greatest) {
  return text_of(least, ".1f") + " … " + text_of(greatest, ".1f") + " %";
}

Table views_table(const std::vector<OrderSpread>& rows) {
  using Row = OrderSpread;
  return {
      rows,
      {{heading(""), [](const Row& r) { return name_of_matrices(r.mapping, r.premultiplied); }},
       {"mapping", [](const Row& r) { return fathom::name_of(r.mapping); }},
       {"matrices", [](const Row& r) { return matrices_name(r.premultiplied); }},
       {Column("equal_percent_least", ".4f").json("equal_percent[]"), &Row::least_equal},
       {Column("equal_percent_greatest", ".4f").json("equal_percent[]"), &Row::greatest_equal},
       {Column("swapped_percent_least", ".4f").json("swapped_percent[]"), &Row::least_swapped},
       {Column("swapped_percent_greatest", ".4f").json("swapped_percent[]"),
        &Row::greatest_swapped},
       {heading("equal"), [](const Row& r) { return range_text(r.least_equal, r.greatest_equal); }},
       {heading("swapped"),
        [](const Row& r) { return range_text(r.least_swapped, r.greatest_swapped); }}}};
}

/// What the exact depths of the vertices lose: the control.
struct Control {
  Spacing spacing;
  OrderCount counts;
};

Table control_table(const std::vector<Control>& rows) {
  return {rows,
          {{"spacing", [](const Control& c) { return name_of(c.spacing); }},
           {"equal", [](const Control& c) { return c.counts.equal; }},
           {"swapped", [](const Control& c) { return c.counts.swapped; }}}};
}

const OrderCount& counts_of(const std::vector<LostOrder>& rows, Spacing spacing, Mapping mapping,
                            bool premultiplied, const std::string& sources, Storage storage) {
  return std::find_if(rows.begin(), rows.end(),
                      [&](const LostOrder& r) {
                        return r.way.spacing == spacing && r.way.mapping == mapping &&
                               r.way.premultiplied == premultiplied &&
                               r.way.sources->name == sources && r.way.storage == storage;
                      })
      ->counts;
}

/// For the page: vertices in linear spacing.
Table vertices_table(const std::vector<LostOrder>& rows) {
  std::vector<ColumnOf<Mapping>> columns{
      {heading("linear spacing"), [](Mapping m) { return fathom::name_of(m); }}};
  for (const bool premultiplied : {true, false}) {
    for (const Storage storage : {Storage::float32, Storage::unorm24}) {
      const std::string name =
          std::string(matrices_name(premultiplied)) + ", " + std::string(fathom::name_of(storage));
      columns.push_back({heading(name), [&rows, premultiplied, storage](Mapping mapping) {
                           const OrderCount& c = counts_of(rows, Spacing::linear, mapping,
                                                           premultiplied, "vertices", storage);
                           return text_of(percent_equal(c), ".1f") + " % equal, " +
                                  text_of(percent_swapped(c), ".1f") + " % swapped";
                         }});
    }
  }
  return {std::vector<Mapping>(std::begin(projections), std::end(projections)), columns};
}

BarChart order_chart(const std::vector<LostOrder>& rows, Spacing spacing, Storage storage) {
  const std::string space = name_of(spacing), stored(fathom::name_of(storage));
  BarChart chart{.name = "order-" + space + "-" + stored,
                 .title = "Neighbouring depths lost, " + space + " spacing, " + stored,
                 .y_label = "share of neighbours (%)",
                 .series = {{"equal", {}}, {"swapped", {}}}};
  for (const Mapping mapping : projections) {
    for (const bool premultiplied : {false, true}) {
      const OrderCount& c = counts_of(rows, spacing, mapping, premultiplied, "vertices", storage);
      chart.categories.push_back(name_of_matrices(mapping, premultiplied));
      chart.series[0].heights.push_back(percent_equal(c));
      chart.series[1].heights.push_back(percent_swapped(c));
    }
  }
  return chart;
}

/// By what rounds; `percent` is the share that is shown, and `lost` its name.
BarChart sources_chart(const std::vector<LostOrder>& rows, const std::string& lost,
                       double (*percent)(const OrderCount&)) {
  BarChart chart{.name = "sources-" + lost,
                 .title = "Neighbours " + lost +
                          ", by what rounds to binary32: linear spacing, premultiplied, float32",
                 .y_label = "share of neighbours (%)"};
  for (const Mapping mapping : projections) chart.categories.emplace_back(fathom::name_of(mapping));
  for (const Sources& sources : all_sources()) {
    BarChart::Bars bars{sources.name, {}};
    for (const Mapping mapping : projections) {
      bars.heights.push_back(
          percent(counts_of(rows, Spacing::linear, mapping, true, sources.name, Storage::float32)));
    }
    chart.series.push_back(bars);
  }
  return chart;
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
  const std::vector<double> linear = depths_of(Spacing::linear, near, far, samples);
  require_gnuplot(options);
  const View view = default_view(near);
  const std::vector<LostOrder> rows =
      lose_order(near, far, samples, view, [&](double share) { tick(0.9 * share); });
  std::vector<Control> controls;
  for (const Spacing spacing : {Spacing::linear, Spacing::logarithmic}) {
    controls.push_back({spacing, count_vertex_order(view, depths_of(spacing, near, far, samples))});
  }

  Results results("indistinguishable", page_texts::indistinguishable, options);
  results.figure("near", near);
  results.figure("far", far);
  results.figure("samples", samples);
  results.figure("eye", std::vector<double>(view.eye.begin(), view.eye.end()));
  results.figure("direction", std::vector<double>(view.direction.begin(), view.direction.end()));
  results.quote("views", random_views);
  results.table(control_table(controls), {.json = "control"});
  results.table(order_table(rows), {.csv = "order", .json = "order"});
  results.table(vertices_table(rows), {.page = "vertices"});
  results.table(views_table(spread_over_views(near, far, linear)),
                {.csv = "views", .json = "random_views", .page = "views"});
  for (const Spacing spacing : {Spacing::linear, Spacing::logarithmic}) {
    for (const Storage storage : {Storage::float32, Storage::unorm24}) {
      results.plot(order_chart(rows, spacing, storage));
    }
  }
  results.plot(sources_chart(rows, "equal", percent_equal));
  results.plot(sources_chart(rows, "swapped", percent_swapped));
  tick(1);
  return results.files();
}

}  // namespace fathom::studies
