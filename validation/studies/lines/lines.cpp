#include "validation/studies/lines/lines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "fathom/numeric/errors.h"
#include "fathom/pipeline/scan/diamond_exit.h"
#include "fathom/pipeline/scan/line.h"
#include "validation/studies/page.h"
#include "validation/studies/plot.h"

namespace fathom::studies {
namespace {

using Json = nlohmann::ordered_json;
using pipeline::LineEnds;
using pipeline::Pixel;

/// What one algorithm did to lines of one length.
struct Drift {
  std::string algorithm;
  std::int64_t length = 0;
  std::uint64_t pixels = 0, wrong = 0, wrong_at_ties = 0;
  double greatest = 0;  ///< of the minor coordinate before rounding, in pixels
};

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
void measure(const Draw& draw, const LineEnds& line, Drift& drift) {
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

std::vector<Drift> drifts_of(std::int64_t length, std::uint32_t slopes) {
  std::vector<Drift> drifts{{"dda, binary32", length},
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

struct Cost {
  std::string algorithm, arithmetic;
  double nanoseconds;
};

std::vector<Cost> costs() {
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

/// (0,0)-(8,3) by every algorithm: the row of the pixel in each column, and what it decided by.
std::vector<std::vector<std::string>> known_line() {
  const LineEnds ends{0, 0, 8, 3};
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const char* algorithm, const char* variable, const auto& draw) {
    std::vector<std::int64_t> minor;
    std::vector<std::string> states;
    draw([&](const Pixel& p, const auto& state) {
      minor.push_back(p.y);
      states.push_back(fmt::format("{:.4g}", static_cast<double>(state)));
    });
    rows.push_back({algorithm, fmt::format("{}", fmt::join(minor, " ")),
                    fmt::format("{}: {}", variable, fmt::join(states, " "))});
  };
  add("explicit equation", "y",
      [&](const auto& visit) { pipeline::explicit_line<double>(ends, {}, visit); });
  add("DDA", "y", [&](const auto& visit) { pipeline::dda_line<double>(ends, {}, visit); });
  add("Bresenham", "error", [&](const auto& visit) { pipeline::bresenham_line(ends, {}, visit); });
  add("midpoint", "d", [&](const auto& visit) { pipeline::midpoint_line(ends, {}, visit); });
  std::vector<std::int64_t> minor;
  pipeline::diamond_exit_line<double>({0.5, 0.5, 8.5, 3.5}, {},
                                      [&](const Pixel& p) { minor.push_back(p.y); });
  rows.push_back({"diamond exit, centre to centre", fmt::format("{}", fmt::join(minor, " ")),
                  "the pixel of the end, whose diamond is not left, is not drawn"});
  return rows;
}

StudyFile csv_of(const std::vector<Drift>& drifts) {
  std::string text = "algorithm,length,pixels,wrong,wrong_at_ties,greatest_drift\n";
  for (const Drift& d : drifts)
    text += fmt::format("\"{}\",{},{},{},{},{:.17g}\n", d.algorithm, d.length, d.pixels, d.wrong,
                        d.wrong_at_ties, d.greatest);
  return {"drift.csv", text};
}

StudyFile page_of(const std::vector<Drift>& drifts, const std::vector<Cost>& costs) {
  Page page("Lines");
  page.paragraph(
      "A digital differential analyser adds the slope in every step, and with it the rounding of "
      "the sum. The explicit equation multiplies, so its error does not add up, but grows with the "
      "coordinate all the same. Bresenham's and the midpoint algorithm are integers: they have no "
      "error at any length. A pixel is wrong where it is not the one nearest to the exact line.");
  page.plot("drift", "The farthest that the unrounded coordinate gets from the exact line");
  page.plot("wrong", "Pixels that are not the nearest");
  std::vector<std::vector<std::string>> rows;
  rows.reserve(drifts.size());
  for (const Drift& d : drifts)
    rows.push_back({d.algorithm, fmt::format("{}", d.length), fmt::format("{}", d.pixels),
                    fmt::format("{}", d.wrong), fmt::format("{}", d.wrong_at_ties),
                    fmt::format("{:.3g}", d.greatest)});
  page.table({"algorithm", "length", "pixels", "wrong", "of these at ties", "greatest drift"},
             rows);
  page.heading("(0,0) to (8,3), by every algorithm");
  page.table({"algorithm", "row in each column", "decided by"}, known_line());
  page.heading("What a step costs");
  rows.clear();
  for (const Cost& c : costs)
    rows.push_back({c.algorithm, c.arithmetic, fmt::format("{:.2f}", c.nanoseconds)});
  page.table({"algorithm", "in each step", "ns a pixel, here"}, rows);
  page.paragraph(
      "The division of the slope is done once a line, not once a pixel. Times are of this machine "
      "and include the call that takes the pixel.");
  return page.file();
}

}  // namespace

std::vector<StudyFile> study_lines(const StudyOptions& options,
                                   const std::function<void(double)>& tick) {
  if (options.near || options.far || options.separation)
    throw UsageError("the study lines has no depths: --near, --far and --separation mean nothing");
  const std::uint32_t slopes = options.samples.value_or(40);
  if (slopes == 0) throw UsageError("--samples: expected at least one slope");
  require_gnuplot();
  std::vector<Drift> drifts;
  Plot drift{"drift", "Drift from the exact line", "length of the line in pixels", "pixels"};
  drift.logarithmic_x = drift.logarithmic_y = true;
  Plot wrong{"wrong", "Wrong pixels", "length of the line in pixels", "percent"};
  wrong.logarithmic_x = true;
  for (std::int64_t length = 100; length <= 1000000; length *= 10) {
    for (Drift& d : drifts_of(length, slopes)) {
      const auto series = [&](Plot& plot) -> Series& {
        for (Series& s : plot.series)
          if (s.label == d.algorithm) return s;
        return plot.series.emplace_back(Series{d.algorithm, {}});
      };
      series(drift).points.emplace_back(length, d.greatest);
      series(wrong).points.emplace_back(
          length, 100.0 * static_cast<double>(d.wrong) / static_cast<double>(d.pixels));
      drifts.push_back(std::move(d));
    }
    tick(std::log10(static_cast<double>(length)) / 6);
  }
  const std::vector<Cost> cost = costs();
  std::vector<StudyFile> files = draw(drift);
  for (StudyFile& file : draw(wrong)) files.push_back(std::move(file));
  Json summary{{"study", "lines"}, {"slopes", slopes}};
  for (const Drift& d : drifts)
    summary["drift"].push_back({{"algorithm", d.algorithm},
                                {"length", d.length},
                                {"pixels", d.pixels},
                                {"wrong", d.wrong},
                                {"wrong_at_ties", d.wrong_at_ties},
                                {"greatest", d.greatest}});
  for (const Cost& c : cost)
    summary["cost"].push_back({{"algorithm", c.algorithm}, {"nanoseconds", c.nanoseconds}});
  files.push_back(csv_of(drifts));
  files.push_back({"summary.json", summary.dump(2) + "\n"});
  files.push_back(page_of(drifts, cost));
  return files;
}

}  // namespace fathom::studies
