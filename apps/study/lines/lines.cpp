#include <cmath>

#include "apps/study/lines/line_drift.h"
#include "apps/study/lines/step_costs.h"
#include "apps/study/page_texts.h"
#include "apps/study/results.h"
#include "apps/study/studies.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

Table drift_table(const std::vector<LineDrift>& rows) {
  using Row = LineDrift;
  return {
      rows,
      {{Column("algorithm").page("algorithm"), &Row::algorithm},
       {Column("length").page("length"), &Row::length},
       {Column("pixels").page("pixels"), &Row::pixels},
       {Column("wrong").page("wrong"), &Row::wrong},
       {Column("wrong_at_ties").page("of these at ties"), &Row::wrong_at_ties},
       {Column("greatest_drift").json("greatest").page("greatest drift", ".3g"), &Row::greatest}}};
}

Table costs_table(const std::vector<LineCost>& rows) {
  using Row = LineCost;
  return {rows,
          {{Column("algorithm").page("algorithm"), &Row::algorithm},
           {Column("step").page("in each step"), &Row::step},
           {Column("nanoseconds").page("ns a pixel, here", ".2f"), &Row::nanoseconds}}};
}

Table step_costs_table(const std::vector<StepCost>& rows) {
  using Row = StepCost;
  return {rows,
          {{Column("step").page("arithmetic of a step"), &Row::step},
           {Column("binary32_ns").page("ns a pixel, binary32", ".2f"), &Row::binary32_ns},
           {Column("binary64_ns").page("binary64", ".2f"), &Row::binary64_ns}}};
}

Table known_line_table(const std::vector<DecidedLine>& rows) {
  using Row = DecidedLine;
  return {rows,
          {{heading("algorithm"), &Row::algorithm},
           {heading("row in each column"), &Row::rows},
           {heading("decided by"), &Row::decisions}}};
}

/// `y` of every algorithm against the length.
template <class Y>
std::vector<Series> series_by_length(const std::vector<LineDrift>& rows, Y y) {
  std::vector<Series> all;
  for (const LineDrift& first : rows) {
    if (first.length != rows.front().length) break;
    const auto is_same = [&](const LineDrift& d) { return d.algorithm == first.algorithm; };
    all.push_back(series_of(first.algorithm, rows_where(rows, is_same), &LineDrift::length, y));
  }
  return all;
}

std::vector<LineDrift> measure_drifts(std::uint32_t slopes,
                                      const std::function<void(double)>& tick) {
  std::vector<LineDrift> rows;
  for (std::int64_t length = 100; length <= 1000000; length *= 10) {
    for (LineDrift& drift : measure_drift(length, slopes)) rows.push_back(std::move(drift));
    tick(std::log10(static_cast<double>(length)) / 6);
  }
  return rows;
}

}  // namespace

std::vector<StudyFile> study_lines(const StudyOptions& options,
                                   const std::function<void(double)>& tick) {
  if (options.near || options.far || options.separation)
    throw UsageError("the study lines has no depths: --near, --far and --separation mean nothing");
  const std::uint32_t slopes = options.samples.value_or(40);
  if (slopes == 0) throw UsageError("--samples: expected at least one slope");
  require_gnuplot(options);
  const std::vector<LineDrift> drifts = measure_drifts(slopes, tick);

  Results results("lines", page_texts::lines, options);
  results.figure("slopes", slopes);
  results.table(drift_table(drifts), {.csv = "drift", .json = "drift", .page = "drift"});
  for (const LineDrift& d : drifts)
    if (d.length == drifts.back().length)
      results.quote("wrong " + d.algorithm, d.percent_wrong(), ".2g");
  results.quote("longest", drifts.back().length);
  results.table(costs_table(line_costs()), {.csv = "cost", .json = "cost", .page = "costs"});
  results.table(step_costs_table(step_costs()),
                {.csv = "step_cost", .json = "step_cost", .page = "step_costs"});
  results.table(known_line_table(decided_lines()), {.page = "known_line"});
  results.plot(Plot{.name = "drift",
                    .title = "Drift from the exact line",
                    .x_label = "length of the line in pixels",
                    .y_label = "pixels",
                    .logarithmic_x = true,
                    .logarithmic_y = true,
                    .series = series_by_length(drifts, &LineDrift::greatest)});
  results.plot(Plot{.name = "wrong",
                    .title = "Wrong pixels",
                    .x_label = "length of the line in pixels",
                    .y_label = "percent",
                    .logarithmic_x = true,
                    .logarithmic_y = true,
                    .series = series_by_length(drifts, &LineDrift::percent_wrong)});
  return results.files();
}

}  // namespace fathom::studies
