// fathom clip: polygons in the plane, by Weiler–Atherton, Sutherland–Hodgman and CGAL.

#include <algorithm>

#include "apps/textbook/cases/case_answers.h"
#include "apps/textbook/clip/clip_algorithms.h"
#include "fathom/clipping/boolean_by_cgal.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/sutherland_hodgman.h"
#include "fathom/clipping/weiler_atherton.h"

namespace fathom::app::clip {
namespace {

using clipping::Rational;
using clipping::Ring;
using clipping::Rings;

/// Above this "area_exact" is left out.
constexpr std::size_t most_digits = 4000;

template <class Number>
Rings<Number> over_kernel(const Rings<double>& rings) {
  if constexpr (std::is_same_v<Number, double>)
    return rings;
  else
    return clipping::to_exact(rings);
}

void put_area(Json& result, double area, Form form) {
  cases::to_json(area, form);  // refuses infinite numbers and NaN
  result["area"] = to_decimal(Ratio(Dyadic(area)), 17);
}

void put_area(Json& result, const Rational& area, Form) {
  result["area"] = to_decimal(clipping::to_ratio(area), 17);
  const std::string fraction = clipping::to_fraction(area);
  const auto digits =
      std::count_if(fraction.begin(), fraction.end(), [](char c) { return '0' <= c && c <= '9'; });
  if (static_cast<std::size_t>(digits) <= most_digits) result["area_exact"] = fraction;
}

const char* name_of(clipping::ContactKind kind) {
  constexpr const char* names[] = {"entering", "leaving", "touching", "along"};
  return names[static_cast<std::size_t>(kind)];
}

const char* name_of(clipping::Border border) {
  return border == clipping::Border::subject ? "subject" : "clip";
}

template <class Number>
Json to_json(const clipping::ContactList<Number>& list, Form form) {
  Json rings = Json::array();
  for (const auto& ring : list) {
    Json& places = rings.emplace_back(Json::array());
    for (const auto& [point, kind, crossing] : ring) {
      Json& place = places.emplace_back(Json{{"point", cases::to_json(point, form)}});
      if (kind) place["kind"] = name_of(*kind);
      if (crossing) place["crossing"] = *crossing;
    }
  }
  return rings;
}

template <class Number>
Json to_json(const clipping::WeilerAthertonTrace<Number>& trace, Form form) {
  Json walks = Json::array();
  for (const auto& walk : trace.walks) {
    Json& steps = walks.emplace_back(Json::array());
    for (const auto& [from, along, crossing] : walk) {
      Json& step =
          steps.emplace_back(Json{{"from", cases::to_json(from, form)}, {"along", name_of(along)}});
      if (crossing) step["crossing"] = *crossing;
    }
  }
  return {{"subject", to_json(trace.subject, form)},
          {"clip", to_json(trace.clip, form)},
          {"walks", walks}};
}

clipping::SetOperation operation_of(const Json& object) {
  const std::string op = word(object, "op", {"intersection", "difference", "union"});
  if (op == "union") return clipping::SetOperation::join;
  return op == "difference" ? clipping::SetOperation::difference
                            : clipping::SetOperation::intersection;
}

/// A case of two polygons.
template <class Number>
struct PolygonCase {
  Rings<Number> subject, clip;
  clipping::SetOperation operation;
};

template <class Number>
PolygonCase<Number> polygon_case(const Json& object, std::string_view algorithm) {
  expect_only(object, {"subject", "clip", "op"}, algorithm);
  return {over_kernel<Number>(rings(object, "subject")), over_kernel<Number>(rings(object, "clip")),
          operation_of(object)};
}

template <class Number>
Json answer(const std::vector<clipping::Polygon<Number>>& polygons, Form form) {
  Json result{{"polygons", Json::array()}};
  for (const clipping::Polygon<Number>& polygon : polygons) {
    Json all = Json::array({cases::to_json(polygon.outline, form)});
    for (const Ring<Number>& hole : polygon.holes) all.push_back(cases::to_json(hole, form));
    result["polygons"].push_back(all);
  }
  put_area(result, clipping::area_of(polygons), form);
  return result;
}

/// Convex pieces of rings, which must be no holes.
template <class Number>
Rings<Number> pieces_of(const Rings<Number>& subject) {
  Rings<Number> pieces;
  for (std::size_t r = 0; r < subject.size(); ++r) {
    if (clipping::signed_area(subject[r]) < 0)
      throw InputError("subject ring " + std::to_string(r) +
                       " is a hole; \"decompose\" takes outlines only");
    for (Ring<Number>& piece : clipping::convex_pieces(subject[r])) pieces.push_back(piece);
  }
  return pieces;
}

template <class Number>
Json sutherland_hodgman_2(const Json& object, Form form) {
  expect_only(object, {"subject", "clip", "op", "decompose"}, "sutherland-hodgman");
  if (operation_of(object) != clipping::SetOperation::intersection)
    throw InputError(
        "sutherland-hodgman does intersections only; weiler-atherton does differences and unions");
  const bool decompose = flag(object, "decompose");
  Rings<Number> subject =
      clipping::checked_rings(over_kernel<Number>(rings(object, "subject")), "subject");
  const auto clip = clipping::checked_rings(over_kernel<Number>(rings(object, "clip")), "clip");
  if (clip.size() != 1)
    throw InputError("sutherland-hodgman clips against one convex ring; clip has " +
                     std::to_string(clip.size()));
  clipping::check_convex(clip[0], "clip ring 0");
  if (decompose) subject = pieces_of(subject);

  std::size_t corners_of_all = 0;
  for (const Ring<Number>& ring : subject) corners_of_all += ring.size();
  cases::check_effort<Number>(
      static_cast<double>(corners_of_all) * static_cast<double>(clip[0].size()),
      "tests of a corner against an edge", clip_less<Number>);

  Rings<Number> clipped;
  Json trace = Json::array();
  for (std::size_t r = 0; r < subject.size(); ++r) {
    clipping::ClipStages<clipping::Point2, Number> stages;
    const auto corners = clipping::sutherland_hodgman(clipping::corners_of(subject[r]), clip[0],
                                                      form.trace ? &stages : nullptr);
    if (!corners.empty()) clipped.push_back(clipping::ring_of(corners));
    for (std::size_t i = 0; i < stages.size(); ++i)
      trace.push_back(
          {{decompose ? "piece" : "ring", r},
           {"edge",
            cases::to_json(Ring<Number>{clip[0][i], clip[0][(i + 1) % clip[0].size()]}, form)},
           {"polygon", cases::to_json(clipping::ring_of(stages[i]), form)}});
  }
  Json result{{"polygons", Json::array()}};
  if (decompose)
    for (const Ring<Number>& ring : clipped)
      result["polygons"].push_back(Json::array({cases::to_json(ring, form)}));
  else if (!clipped.empty())
    result["polygons"].push_back(cases::to_json(clipped, form));
  put_area(result, clipping::signed_area(clipped), form);
  if (form.trace) result["trace"] = trace;
  return result;
}

}  // namespace

template <class Number>
Json weiler_atherton(const Json& object, Form form) {
  const auto [subject, clip, operation] = polygon_case<Number>(object, "weiler-atherton");
  clipping::WeilerAthertonTrace<Number> trace;
  Json result = answer(
      clipping::weiler_atherton(subject, clip, operation, form.trace ? &trace : nullptr), form);
  if (form.trace) result["trace"] = to_json(trace, form);
  return result;
}

Json cgal(const Json& object, Form form) {
  const auto [subject, clip, operation] = polygon_case<Rational>(object, "cgal");
  return answer(clipping::boolean_by_cgal(subject, clip, operation), form);
}

template <class Number>
Json sutherland_hodgman(const Json& object, Form form) {
  return object.contains("polygon3") ? clip_in_space<Number>(object, "sutherland-hodgman", form)
                                     : sutherland_hodgman_2<Number>(object, form);
}

template Json weiler_atherton<double>(const Json&, Form);
template Json weiler_atherton<Rational>(const Json&, Form);
template Json sutherland_hodgman<double>(const Json&, Form);
template Json sutherland_hodgman<Rational>(const Json&, Form);

}  // namespace fathom::app::clip
