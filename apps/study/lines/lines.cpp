#include "apps/study/lines/lines.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "apps/study/cell.h"
#include "apps/study/page.h"
#include "apps/study/results.h"
#include "apps/study/study.h"
#include "fathom/failures/errors.h"
#include "fathom/pipeline/scan/diamond_exit.h"
#include "fathom/pipeline/scan/line.h"

namespace fathom::studies {
namespace {

using pipeline::LineEnds;
using pipeline::Pixel;

/// The nearest pixel's minor coordinate, at a tie the larger, for a line from the origin with
/// 0 ≤ dy ≤ dx; and whether it is a tie.
struct Nearest {
  std::int64_t minor;
  bool tie;
};
Nearest nearest(const LineEnds& line, std::int64_t x) {
  const std::int64_t twice = 2 * x * line.y1 + line.x1;
  return {twice / (2 * line.x1), twice % (2 * line.x1) == 0};
}

template <class Number, class Draw>
void measure(const Draw& draw, const LineEnds& line, LineDrift& drift) {
  draw(line, pipeline::PixelWindow{}, [&](const Pixel& p, const Number& minor) {
    const Nearest exact = nearest(line, p.x);
    ++drift.pixels;
    if (p.y != exact.minor) {
      ++drift.wrong;
      drift.wrong_at_ties += exact.tie;
    }
    // x·dy is below 2^53: one rounding of the quotient, far below the drifts that are shown.
    const double truth = static_cast<double>(p.x * line.y1) / static_cast<double>(line.x1);
    drift.greatest = std::max(drift.greatest, std::abs(static_cast<double>(minor) - truth));
  });
}

/// Nanoseconds for a pixel of a long line, the least of five runs.
template <class State, class Draw>
double cost_of(const Draw& draw) {
  constexpr std::int64_t length = 1000000;
  double least = 1e9;
  std::int64_t sum = 0;
  for (int run = 0; run < 5; ++run) {
    const auto start = std::chrono::steady_clock::now();
    draw({0, 0, length, 333333}, pipeline::PixelWindow{},
         [&](const Pixel& p, const State&) { sum += p.y; });
    const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
    least = std::min(least, time.count() / length);
  }
  return sum == 0 ? 0 : least;
}

}  // namespace

std::vector<LineDrift> measure_drift(std::int64_t length, std::uint32_t slopes) {
  std::vector<LineDrift> drifts{{"dda, binary32", length},
                                {"explicit, binary32", length},
                                {"dda, binary64", length},
                                {"explicit, binary64", length}};
  std::mt19937_64 random(42);
  for (std::uint32_t i = 0; i < slopes; ++i) {
    const LineEnds line{
        0, 0, length, static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(length + 1))};
    measure<float>(pipeline::dda_line<float>, line, drifts[0]);
    measure<float>(pipeline::explicit_line<float>, line, drifts[1]);
    measure<double>(pipeline::dda_line<double>, line, drifts[2]);
    measure<double>(pipeline::explicit_line<double>, line, drifts[3]);
  }
  return drifts;
}

std::vector<LineCost> line_costs() {
  return {{"explicit, binary32", "1 multiplication, 1 addition, 1 rounding",
           cost_of<float>(pipeline::explicit_line<float>)},
          {"explicit, binary64", "the same", cost_of<double>(pipeline::explicit_line<double>)},
          {"dda, binary32", "1 addition, 1 rounding", cost_of<float>(pipeline::dda_line<float>)},
          {"dda, binary64", "the same", cost_of<double>(pipeline::dda_line<double>)},
          {"bresenham", "1 or 2 integer additions, 1 comparison",
           cost_of<std::int64_t>(pipeline::bresenham_line)},
          {"midpoint", "1 integer addition, 1 comparison",
           cost_of<std::int64_t>(pipeline::midpoint_line)}};
}

std::vector<DecidedLine> decided_lines() {
  const LineEnds ends{0, 0, 8, 3};
  std::vector<DecidedLine> lines;
  const auto add = [&](const char* algorithm, const char* variable, const auto& draw) {
    DecidedLine line{algorithm, {}, std::string(variable) + ":"};
    draw([&](const Pixel& p, const auto& state) {
      line.rows.push_back(static_cast<double>(p.y));
      line.decisions += " " + text_of(static_cast<double>(state), ".4g");
    });
    lines.push_back(std::move(line));
  };
  add("explicit equation", "y",
      [&](const auto& visit) { pipeline::explicit_line<double>(ends, {}, visit); });
  add("DDA", "y", [&](const auto& visit) { pipeline::dda_line<double>(ends, {}, visit); });
  add("Bresenham", "error", [&](const auto& visit) { pipeline::bresenham_line(ends, {}, visit); });
  add("midpoint", "d", [&](const auto& visit) { pipeline::midpoint_line(ends, {}, visit); });
  LineEnds staying = ends;
  staying.ties = pipeline::TieRule::stay;
  add("the textbook's Bresenham: --ties stay", "error",
      [&](const auto& visit) { pipeline::bresenham_line(staying, {}, visit); });
  DecidedLine diamonds{"diamond exit, centre to centre",
                       {},
                       "the pixel of the end, whose diamond is not left, is not drawn"};
  pipeline::diamond_exit_line<double>({0.5, 0.5, 8.5, 3.5}, {}, [&](const Pixel& p) {
    diamonds.rows.push_back(static_cast<double>(p.y));
  });
  lines.push_back(std::move(diamonds));
  return lines;
}

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
