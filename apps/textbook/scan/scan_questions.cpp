// fathom scan: questions about polygons, and flood fill.

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "apps/textbook/cases/case_answers.h"
#include "apps/textbook/scan/scan_json.h"
#include "fathom/numeric/certified.h"
#include "fathom/pipeline/scan/area_fill.h"
#include "fathom/pipeline/scan/polygon_tests.h"
#include "fathom/pipeline/scan/tessellate.h"
#include "fathom/text/counted.h"

namespace fathom::app::scan {
namespace {

template <class Number>
pipeline::Rings<Number> over(const clipping::Rings<double>& rings) {
  pipeline::Rings<Number> result;
  for (const auto& ring : rings) {
    result.emplace_back();
    for (const auto& p : ring)
      result.back().push_back(
          {pipeline::number_from<Number>(p.x), pipeline::number_from<Number>(p.y)});
  }
  return result;
}

template <class Number>
std::vector<pipeline::Point<Number>> points_of(const Json& object) {
  std::vector<pipeline::Point<Number>> points;
  for (const auto& p : cases::points(object, "points", 2, 2))
    points.push_back({pipeline::number_from<Number>(checked_coordinate(p[0], "points")),
                      pipeline::number_from<Number>(checked_coordinate(p[1], "points"))});
  return points;
}

/// "weights", one for each point, with a sum above 0.
template <class Number>
std::vector<Number> weights_of(const Json& object, std::size_t points) {
  std::vector<Number> weights;
  Number sum(0);
  for (const double w : cases::numbers(object["weights"], "weights", points, points)) {
    weights.push_back(pipeline::number_from<Number>(w));
    sum += weights.back();
  }
  if (!(sum > 0)) throw InputError("weights: they add up to 0 or less; expected a sum above 0");
  return weights;
}

std::size_t edges_of(const clipping::Rings<double>& rings) {
  std::size_t edges = 0;
  for (const auto& ring : rings) edges += ring.size();
  return edges;
}

/// Refuses what takes a step for each of `rows` with each of `columns`.
template <class Number>
void check_pairs(std::size_t rows, std::size_t columns, const char* what) {
  cases::check_effort<Number>(static_cast<double>(rows) * static_cast<double>(columns), what,
                              "fewer corners take fewer");
}

/// In how many points edges cross.
std::size_t crossings_of(const clipping::Rings<double>& rings) {
  std::vector<std::array<std::array<double, 2>, 2>> edges;
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const auto &a = ring[i], &b = ring[(i + 1) % ring.size()];
      edges.push_back({{{a.x, a.y}, {b.x, b.y}}});
    }
  const auto divides = [](const auto& a, const auto& b) {
    return orientation(a[0], a[1], b[0]) * orientation(a[0], a[1], b[1]) != Sign::positive;
  };
  std::size_t count = 0;
  for (std::size_t i = 0; i < edges.size(); ++i)
    for (std::size_t k = i + 1; k < edges.size(); ++k)
      if (divides(edges[i], edges[k]) && divides(edges[k], edges[i])) ++count;
  return count;
}

template <class Number>
Json ring_to_json(const pipeline::Ring<Number>& ring, const Form& form) {
  Json list = Json::array();
  for (const auto& p : ring) list.push_back(point_to_json(p, form));
  return list;
}

pipeline::CharacterGrid grid_of(const Json& object) {
  pipeline::CharacterGrid grid;
  for (const Json& row : cases::list(cases::member(object, "grid"), "grid")) {
    if (!row.is_string()) throw InputError(fmt::format("grid[{}]: expected a string", grid.size()));
    grid.push_back(row.get<std::string>());
    if (grid.back().size() != grid[0].size())
      throw InputError(fmt::format("grid[{}] has {}, the first row {}", grid.size() - 1,
                                   text::counted(grid.back().size(), "character"), grid[0].size()));
  }
  if (grid.empty()) throw InputError("grid: expected at least one row");
  return grid;
}

}  // namespace

Json flood(const Json& object, const Form& form) {
  cases::expect_only(object, {"grid", "seed", "connectivity"});
  const pipeline::CharacterGrid grid = grid_of(object);
  const auto seed = cases::numbers(cases::member(object, "seed"), "seed", 2, 2);
  const Json connectivity = object.value("connectivity", Json(4));
  if (connectivity != 4 && connectivity != 8)
    throw InputError("\"connectivity\" is " + connectivity.dump() + "; expected 4 or 8");
  if (seed[0] != std::floor(seed[0]) || seed[1] != std::floor(seed[1]) || seed[0] < 0 ||
      seed[1] < 0 || seed[1] >= static_cast<double>(grid.size()) ||
      seed[0] >= static_cast<double>(grid[0].size()))
    throw InputError(fmt::format("seed: [{}, {}] is not a pixel of the grid of {} by {}", seed[0],
                                 seed[1], grid[0].size(), grid.size()));
  PixelList pixels(form.runs);
  for (const pipeline::Pixel& p : pipeline::flood_fill(
           grid, {static_cast<std::int64_t>(seed[0]), static_cast<std::int64_t>(seed[1])},
           connectivity == 4 ? pipeline::Connectivity::four : pipeline::Connectivity::eight))
    pixels.add(p);
  return pixels.json(false);
}

template <class Number>
Json inside(const Json& object, const Form& form) {
  cases::expect_only(object, {"polygon", "points", "width", "height"});
  (void)form;
  (void)window_of(object);
  const clipping::Rings<double> polygon = polygon_of(object);
  const auto points = points_of<Number>(object);
  check_pairs<Number>(points.size() + edges_of(polygon), edges_of(polygon),
                      "pairs of points and edges");
  const pipeline::Rings<Number> rings = over<Number>(polygon);
  Json even_odd = Json::array(), non_zero = Json::array(), crossings = Json::array(),
       windings = Json::array(), on_outline = Json::array(), one_side = Json::array();
  for (const auto& p : points) {
    const pipeline::RayCrossings ray = pipeline::ray_crossings(rings, p);
    even_odd.push_back(ray.count % 2 != 0);
    non_zero.push_back(ray.winding != 0);
    crossings.push_back(ray.count);
    windings.push_back(ray.winding);
    on_outline.push_back(ray.on_outline);
    one_side.push_back(rings.size() == 1 && pipeline::is_on_one_side_of_every_edge(rings[0], p));
  }
  Json result{{"inside", even_odd},
              {"non_zero", non_zero},
              {"crossings", crossings},
              {"winding", windings},
              {"on_outline", on_outline}};
  if (rings.size() == 1) {
    result["on_one_side_of_every_edge"] = one_side;
    result["convex"] = pipeline::convexity_of(rings[0]).convex;
  }
  return result;
}

template <class Number>
Json convexity(const Json& object, const Form& form) {
  cases::expect_only(object, {"polygon", "width", "height"});
  (void)form;
  (void)window_of(object);
  const clipping::Rings<double> polygon = polygon_of(object);
  check_pairs<Number>(edges_of(polygon), edges_of(polygon), "pairs of corners and edges");
  const pipeline::Rings<Number> rings = over<Number>(polygon);
  if (rings.size() != 1)
    throw InputError(fmt::format("polygon: {} rings; convexity takes one", rings.size()));
  const pipeline::Convexity c = pipeline::convexity_of(rings[0]);
  Json result{{"convex", c.convex},
              {"corners_on_one_side", c.corners_on_one_side},
              {"turns", c.turns},
              {"turning_number", nullptr}};
  if (c.turning_number) result["turning_number"] = *c.turning_number;
  return result;
}

template <class Number>
Json convex_hull(const Json& object, const Form& form) {
  cases::expect_only(object, {"points", "weights", "width", "height"});
  (void)window_of(object);
  const auto points = points_of<Number>(object);
  if (points.empty()) throw InputError("points: expected at least one");
  const pipeline::Ring<Number> hull = pipeline::convex_hull(points);
  Json result{{"hull", ring_to_json(hull, form)}};
  if (!object.contains("weights")) return result;
  const auto weights = weights_of<Number>(object, points.size());
  const pipeline::Point<Number> combined = pipeline::combination(points, weights);
  result["combination"] = point_to_json(combined, form);
  result["inside"] = pipeline::is_in_hull(hull, combined);
  return result;
}

Json tessellate(const Json& object, const Form& form) {
  cases::expect_only(object, {"polygon", "width", "height"});
  (void)window_of(object);
  const clipping::Rings<double> polygon = polygon_of(object);
  const std::size_t edges = edges_of(polygon);
  check_pairs<pipeline::Exact>(2 * edges, edges, "pairs of triangles and edges");
  check_pairs<pipeline::Exact>(2 * (edges + crossings_of(polygon)), edges,
                               "pairs of triangles and edges");
  Json triangles = Json::array();
  // Counter-clockwise as seen, as all rings in answers.
  for (const auto& t : pipeline::tessellate(over<pipeline::Exact>(polygon)))
    triangles.push_back(ring_to_json<pipeline::Exact>({t[0], t[2], t[1]}, form));
  return {{"triangles", triangles}};
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs none
#define FATHOM_INSTANTIATE(Number)                           \
  template Json inside<Number>(const Json&, const Form&);    \
  template Json convexity<Number>(const Json&, const Form&); \
  template Json convex_hull<Number>(const Json&, const Form&);
FATHOM_INSTANTIATE(pipeline::Exact)
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(float)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::app::scan
