#include "validation/studies/clipping/clipping.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "fathom/clipping/convex_pieces.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/sutherland_hodgman.h"
#include "fathom/clipping/weiler_atherton.h"
#include "fathom/numeric/errors.h"
#include "validation/studies/gnuplot.h"
#include "validation/studies/page.h"
#include "validation/studies/plot.h"

namespace fathom::studies {
namespace {

using Json = nlohmann::ordered_json;
using Exact = clipping::Rational;
using Ring = clipping::Ring<Exact>;
using Rings = clipping::Rings<Exact>;

/// The three ways to clip one polygon by one convex window.
struct Clipped {
  Rings reentrant;   ///< Sutherland–Hodgman: one ring at most
  Rings pieces;      ///< Weiler–Atherton: outlines (the subject has no holes)
  Rings decomposed;  ///< Sutherland–Hodgman, convex piece by convex piece
};

Clipped clip(const Ring& subject, const Ring& window) {
  const auto by_edges = [&](const Ring& ring) {
    return clipping::ring_of(clipping::sutherland_hodgman(clipping::corners_of(ring), window));
  };
  Clipped result;
  if (Ring ring = by_edges(subject); !ring.empty()) result.reentrant.push_back(ring);
  for (const Ring& convex : clipping::convex_pieces(subject))
    if (Ring ring = by_edges(convex); !ring.empty()) result.decomposed.push_back(ring);
  for (const auto& polygon :
       clipping::weiler_atherton<Exact>({subject}, {window}, clipping::SetOperation::intersection))
    result.pieces.push_back(polygon.outline);
  return result;
}

double length_of(const Rings& rings) {
  double length = 0;
  for (const Ring& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto &p = ring[i], &q = ring[(i + 1) % ring.size()];
      length += std::hypot(clipping::to_binary64(Exact(q.x - p.x)),
                           clipping::to_binary64(Exact(q.y - p.y)));
    }
  return length;
}

struct Row {
  std::string name;
  std::size_t corners = 0, pieces = 0, convex_pieces = 0;
  double border = 0;   ///< of the true pieces
  double bridges = 0;  ///< what Sutherland–Hodgman's ring is longer by
  double cuts = 0;     ///< what the decomposed pieces' rings are longer by
  bool areas_agree = false;
};

Row row_of(const std::string& name, const Ring& subject, const Clipped& clipped) {
  const Exact area = clipping::signed_area(clipped.pieces);
  const double border = length_of(clipped.pieces);
  // With one piece the rings are the same, and the difference is rounding.
  const double bridges = clipped.pieces.size() > 1 ? length_of(clipped.reentrant) - border : 0;
  return {name,
          subject.size(),
          clipped.pieces.size(),
          clipped.decomposed.size(),
          border,
          bridges,
          clipped.decomposed.size() > clipped.pieces.size() ? length_of(clipped.decomposed) - border
                                                            : 0,
          clipping::signed_area(clipped.reentrant) == area &&
              clipping::signed_area(clipped.decomposed) == area};
}

struct Shape {
  std::string name;
  Ring ring, window;
};

Ring rectangle(int x0, int y0, int x1, int y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

std::vector<Shape> named_shapes() {
  return {{"notch", {{0, 0}, {8, 0}, {8, 8}, {6, 2}, {2, 2}, {0, 8}}, rectangle(-1, 4, 9, 6)},
          {"comb",
           {{0, 0},
            {10, 0},
            {10, 6},
            {8, 6},
            {8, 1},
            {6, 1},
            {6, 6},
            {4, 6},
            {4, 1},
            {2, 1},
            {2, 6},
            {0, 6}},
           rectangle(-1, 3, 11, 5)},
          {"spiral",
           {{0, 0},
            {7, 0},
            {7, 7},
            {1, 7},
            {1, 2},
            {5, 2},
            {5, 5},
            {3, 5},
            {3, 4},
            {4, 4},
            {4, 3},
            {2, 3},
            {2, 6},
            {6, 6},
            {6, 1},
            {0, 1}},
           {{-1, 4}, {4, -1}, {8, 3}, {3, 8}}}};
}

/// A ring around the origin with a corner at each of `corners` even angles, as far out as drawn.
Ring random_star(std::mt19937_64& random, std::size_t corners) {
  std::uniform_real_distribution<double> radius(0.2, 1);
  Ring ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const double r = radius(random);
    const double angle =
        2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    ring.push_back({Exact(r * std::cos(angle)), Exact(r * std::sin(angle))});
  }
  return ring;
}

/// A window off the centre, so that it meets the rays of the star.
Ring star_window() {
  return {{Exact(0.4), Exact(-0.9)},
          {Exact(0.9), Exact(-0.9)},
          {Exact(0.9), Exact(0.9)},
          {Exact(0.4), Exact(0.9)}};
}

/// What random polygons of one number of corners come to on average.
struct Average {
  std::size_t corners = 0, polygons = 0, in_pieces = 0;
  double pieces = 0, convex_pieces = 0, bridge_percent = 0, cut_percent = 0;
  bool areas_agree = true;
};

Average average_of(std::size_t corners, std::size_t polygons) {
  std::mt19937_64 random(corners);
  Average a{corners, polygons};
  for (std::size_t i = 0; i < polygons; ++i) {
    const Ring ring = random_star(random, corners);
    const Row row = row_of("", ring, clip(ring, star_window()));
    const double n = static_cast<double>(polygons);
    a.in_pieces += row.pieces > 1 ? 1 : 0;
    a.pieces += static_cast<double>(row.pieces) / n;
    a.convex_pieces += static_cast<double>(row.convex_pieces) / n;
    if (row.border > 0) {
      a.bridge_percent += 100 * row.bridges / row.border / n;
      a.cut_percent += 100 * row.cuts / row.border / n;
    }
    a.areas_agree = a.areas_agree && row.areas_agree;
  }
  return a;
}

std::string block_of(const Rings& rings) {
  std::string text;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i <= ring.size(); ++i) {
      const auto& p = ring[i % ring.size()];
      text += fmt::format("{} {}\n", clipping::to_binary64(p.x), clipping::to_binary64(p.y));
    }
    text += "\n";
  }
  return text;
}

/// Three panels: the same shape clipped in the three ways.
std::vector<StudyFile> picture_of(const Shape& shape, const Clipped& clipped) {
  std::string script = fmt::format("$subject << EOD\n{}EOD\n$window << EOD\n{}EOD\n",
                                   block_of({shape.ring}), block_of({shape.window}));
  script += fmt::format("$a << EOD\n{}EOD\n$b << EOD\n{}EOD\n$c << EOD\n{}EOD\n",
                        block_of(clipped.reentrant), block_of(clipped.pieces),
                        block_of(clipped.decomposed));
  script +=
      "set multiplot layout 1,3\nset size ratio -1\nset offsets 0.5, 0.5, 0.5, 0.5\nunset key\n"
      "unset border\nunset tics\n";
  const std::pair<const char*, std::string> panels[] = {
      {"$a", "Sutherland-Hodgman: one ring"},
      {"$b", fmt::format("Weiler-Atherton: {} pieces", clipped.pieces.size())},
      {"$c", fmt::format("convex pieces first: {}", clipped.decomposed.size())}};
  for (const auto& [data, title] : panels)
    script += fmt::format(
        "set title '{1}'\n"
        "plot $subject with lines lc rgb '#aaaaaa' lw 1, $window with lines lc rgb '#888888' dt 2, "
        "{0} with filledcurves closed fc rgb '#9ecae1' notitle, "
        "{0} with lines lc rgb '#b2182b' lw 3\n",
        data, title);
  script += "unset multiplot\n";
  return run_gnuplot("shape-" + shape.name, script);
}

StudyFile csv_of(const std::vector<Row>& rows) {
  std::string text = "shape,corners,pieces,convex_pieces,border,bridges,cuts,areas_agree\n";
  for (const Row& r : rows)
    text += fmt::format("{},{},{},{},{:.17g},{:.17g},{:.17g},{}\n", r.name, r.corners, r.pieces,
                        r.convex_pieces, r.border, r.bridges, r.cuts, r.areas_agree);
  return {"shapes.csv", text};
}

StudyFile csv_of(const std::vector<Average>& averages) {
  std::string text =
      "corners,polygons,in_pieces,pieces,convex_pieces,bridge_percent,cut_percent,areas_agree\n";
  for (const Average& a : averages)
    text += fmt::format("{},{},{},{:.17g},{:.17g},{:.17g},{:.17g},{}\n", a.corners, a.polygons,
                        a.in_pieces, a.pieces, a.convex_pieces, a.bridge_percent, a.cut_percent,
                        a.areas_agree);
  return {"random.csv", text};
}

Plot plot_of(const std::vector<Average>& averages) {
  Plot plot{"bridges", "Edges that do not belong to the border", "corners of the polygon",
            "percent of the true border"};
  Series bridges{"bridging edges of Sutherland-Hodgman", {}}, cuts{"cuts of the decomposition", {}};
  for (const Average& a : averages) {
    bridges.points.emplace_back(a.corners, a.bridge_percent);
    cuts.points.emplace_back(a.corners, a.cut_percent);
  }
  plot.series = {bridges, cuts};
  return plot;
}

StudyFile page_of(const std::vector<Row>& rows) {
  Page page("Where Sutherland-Hodgman is wrong");
  page.paragraph(
      "Sutherland and Hodgman's algorithm makes one ring of what it is given. A concave polygon "
      "that "
      "falls into pieces keeps them joined by bridging edges along the border of the window, which "
      "run there and back: the area is right, exactly, and the border is not. Weiler and "
      "Atherton's "
      "algorithm gives the pieces; so does clipping a convex decomposition, with cuts between "
      "them.");
  std::vector<std::vector<std::string>> table;
  for (const Row& r : rows) {
    page.plot("shape-" + r.name, r.name + ": the ring of each answer in red");
    table.push_back({r.name, fmt::format("{}", r.pieces), fmt::format("{}", r.convex_pieces),
                     fmt::format("{:.4g}", r.border), fmt::format("{:.4g}", r.bridges),
                     fmt::format("{:.4g}", r.cuts), r.areas_agree ? "equal" : "different"});
  }
  page.table({"shape", "pieces", "convex pieces", "border", "bridging edges", "cuts", "areas"},
             table);
  page.plot("bridges",
            "Random polygons, averages: what the rings are longer by than the true border");
  return page.file();
}

}  // namespace

std::vector<StudyFile> study_clipping(const StudyOptions& options,
                                      const std::function<void(double)>& tick) {
  if (options.near || options.far)
    throw UsageError("the study clipping has no depths: --near and --far mean nothing to it");
  const std::size_t polygons = options.samples.value_or(100);
  if (polygons > 100000) throw UsageError("--samples is not from 2 to 100000");
  require_gnuplot();

  std::vector<Row> rows;
  std::vector<StudyFile> files;
  const auto append = [&](std::vector<StudyFile> more) {
    std::move(more.begin(), more.end(), std::back_inserter(files));
  };
  for (const Shape& shape : named_shapes()) {
    const Clipped clipped = clip(shape.ring, shape.window);
    rows.push_back(row_of(shape.name, shape.ring, clipped));
    append(picture_of(shape, clipped));
  }
  std::vector<Average> averages;
  const std::vector<std::size_t> corner_counts{6, 8, 12, 16, 24, 32, 48, 64};
  for (const std::size_t corners : corner_counts) {
    averages.push_back(average_of(corners, polygons));
    tick(0.9 * static_cast<double>(averages.size()) / static_cast<double>(corner_counts.size()));
  }
  append(draw(plot_of(averages)));

  Json summary{{"study", "clipping"}, {"polygons", polygons}};
  for (const Row& r : rows)
    summary["shapes"].push_back({{"shape", r.name},
                                 {"pieces", r.pieces},
                                 {"convex_pieces", r.convex_pieces},
                                 {"border", r.border},
                                 {"bridges", r.bridges},
                                 {"cuts", r.cuts},
                                 {"areas_agree", r.areas_agree}});
  for (const Average& a : averages)
    summary["random"].push_back({{"corners", a.corners},
                                 {"in_pieces", a.in_pieces},
                                 {"bridge_percent", a.bridge_percent},
                                 {"cut_percent", a.cut_percent},
                                 {"areas_agree", a.areas_agree}});
  append({csv_of(rows), csv_of(averages), {"summary.json", summary.dump(2) + "\n"}, page_of(rows)});
  tick(1);
  return files;
}

}  // namespace fathom::studies
