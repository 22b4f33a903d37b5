// fathom clip --against: what two answers differ in.

#include "apps/textbook/clip/clip_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "apps/textbook/cases/case_answers.h"
#include "fathom/clipping/boolean_by_cgal.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"

namespace fathom::app::clip {
namespace {

using clipping::Point2;
using clipping::Rational;
using clipping::Ring;
using clipping::Rings;

constexpr cases::Form exact{.exact = true};

Ring<Rational> ring_of(const Json& json) {
  Ring<Rational> ring;
  for (const Json& p : json)
    ring.push_back({Rational(p[0].get<std::string>()), Rational(p[1].get<std::string>())});
  return ring;
}

/// The rings of all polygons of an answer.
Rings<Rational> rings_of(const Json& answer) {
  Rings<Rational> rings;
  for (const Json& polygon : answer["polygons"])
    for (const Json& ring : polygon) rings.push_back(ring_of(ring));
  return rings;
}

/// Pieces of edges between corners of either answer, each with how often it is a border.
using Border = std::map<std::pair<Point2<Rational>, Point2<Rational>>, int>;

/// `corners`: the corners of both answers, in order.
Border border_of(const Rings<Rational>& rings, const Ring<Rational>& corners) {
  Border border;
  for (const Ring<Rational>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto [first, last] = std::minmax(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]);
      Point2<Rational> from = first;
      for (auto p = std::upper_bound(corners.begin(), corners.end(), first);
           p != corners.end() && !(last < *p); ++p)
        if (cross(first, last, *p) == 0) {
          ++border[{from, *p}];
          from = *p;
        }
    }
  return border;
}

Ring<Rational> corners_of(const Rings<Rational>& first, const Rings<Rational>& second) {
  Ring<Rational> corners;
  for (const Rings<Rational>* rings : {&first, &second})
    for (const Ring<Rational>& ring : *rings)
      corners.insert(corners.end(), ring.begin(), ring.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

std::optional<Json> border_difference(const Rings<Rational>& first, const Rings<Rational>& second,
                                      const Names& names) {
  const Ring<Rational> corners = corners_of(first, second);
  std::size_t edges = 0;
  for (const Rings<Rational>* rings : {&first, &second})
    for (const Ring<Rational>& ring : *rings) edges += ring.size();
  cases::check_effort<Rational>(static_cast<double>(edges) * static_cast<double>(corners.size()),
                                "comparisons of an edge with a corner", "clip it in parts");
  Border surplus = border_of(first, corners);
  for (const auto& [edge, count] : border_of(second, corners)) surplus[edge] -= count;
  for (const auto& [edge, count] : surplus)
    if (count != 0)
      return Json{{"kind", "border"},
                  {"only", count > 0 ? names.first : names.second},
                  {"edge", cases::to_json(Ring<Rational>{edge.first, edge.second}, exact)}};
  return std::nullopt;
}

/// The rings of a polygon in the one order that weiler-atherton writes: other algorithms may begin
/// at other corners and keep straight ones.
Rings<Rational> in_canonical_order(const Json& polygon) {
  Rings<Rational> rings;
  for (const Json& ring : polygon) rings.push_back(clipping::canonical(ring_of(ring)));
  if (!rings.empty()) std::sort(rings.begin() + 1, rings.end());
  return rings;
}

std::optional<Json> polygon_difference(const Json& first, const Json& second, const Names& names) {
  std::map<Rings<Rational>, int> surplus;
  std::map<Rings<Rational>, const Json*> written;
  const auto count = [&](const Json& answer, int weight) {
    for (const Json& polygon : answer["polygons"]) {
      const Rings<Rational> rings = in_canonical_order(polygon);
      surplus[rings] += weight;
      written[rings] = &polygon;
    }
  };
  count(first, 1);
  count(second, -1);
  for (const auto& [polygon, more] : surplus)
    if (more != 0)
      return Json{{"kind", "polygons"},
                  {"only", more > 0 ? names.first : names.second},
                  {"polygon", *written[polygon]}};
  return std::nullopt;
}

std::optional<Json> region_difference(const Json& first, const Json& second, const Names& names) {
  if (first["polygons"] == second["polygons"]) return std::nullopt;
  const Rings<Rational> a = rings_of(first), b = rings_of(second);
  const auto region = clipping::first_difference(a, b);
  if (!region) {
    if (auto border = border_difference(a, b, names)) return border;
    return polygon_difference(first, second, names);
  }
  Json piece = Json::array({cases::to_json(region->piece.outline, exact)});
  for (const Ring<Rational>& hole : region->piece.holes)
    piece.push_back(cases::to_json(hole, exact));
  return Json{{"kind", "region"},
              {"only", region->in_first ? names.first : names.second},
              {"inside", cases::to_json(region->inside, exact)},
              {"area", clipping::to_fraction(region->area)},
              {"piece", std::move(piece)}};
}

/// The first place at which two values differ, as a pointer; nullopt if they are equal.
std::optional<std::string> first_place(const Json& a, const Json& b, const std::string& at) {
  if (a == b) return std::nullopt;
  if (a.is_array() && b.is_array() && a.size() == b.size()) {
    for (std::size_t i = 0; i < a.size(); ++i)
      if (auto place = first_place(a[i], b[i], at + "/" + std::to_string(i))) return place;
  }
  if (a.is_object() && b.is_object()) {
    for (const auto& [key, value] : a.items())
      if (b.contains(key)) {
        if (auto place = first_place(value, b[key], at + "/" + key)) return place;
      }
  }
  return at;
}

std::string shortened(const std::string& text) {
  constexpr std::size_t longest = 120;
  return text.size() <= longest ? text : text.substr(0, longest) + "…";
}

/// "(1/3, 2)"
std::string point_text(const Json& point) {
  return "(" + shortened(point[0]) + ", " + shortened(point[1]) + ")";
}

}  // namespace

std::optional<Json> first_difference(const Json& first, const Json& second, const Names& names) {
  if (first.contains("polygons") && second.contains("polygons"))
    return region_difference(first, second, names);
  const auto at = first_place(first, second, "");
  if (!at) return std::nullopt;
  const Json::json_pointer place(*at);
  return Json{
      {"kind", "value"}, {"at", *at}, {names.first, first[place]}, {names.second, second[place]}};
}

std::string to_text(const Json& difference, const Names& names) {
  const std::string kind = difference["kind"];
  if (kind == "value")
    return fmt::format("{} is {} by {} and {} by {}", difference["at"].get<std::string>(),
                       shortened(difference[names.first].dump()), names.first,
                       shortened(difference[names.second].dump()), names.second);
  const std::string only = difference["only"];
  if (kind == "region")
    return fmt::format("only {} has a piece of area {} around {}", only,
                       shortened(difference["area"]), point_text(difference["inside"]));
  if (kind == "border")
    return fmt::format("the regions are the same, but only {} has a border from {} to {}", only,
                       point_text(difference["edge"][0]), point_text(difference["edge"][1]));
  return fmt::format("the borders are the same, but only {} has the polygon {}", only,
                     shortened(difference["polygon"].dump()));
}

}  // namespace fathom::app::clip
