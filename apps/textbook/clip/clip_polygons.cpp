// fathom clip: polygons in the plane, Weiler–Atherton and Sutherland–Hodgman.

#include <algorithm>

#include "apps/textbook/cases/case_effort.h"
#include "apps/textbook/clip/clip_algorithms.h"
#include "fathom/clipping/convex_pieces.h"
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
  cases::to_json(area, form);  // refuses what is not finite
  result["area"] = to_decimal(Ratio(Dyadic(area)), 17);
}

void put_area(Json& result, const Rational& area, Form) {
  result["area"] = to_decimal(clipping::to_ratio(area), 17);
  const std::string fraction = clipping::to_fraction(area);
  const auto digits =
      std::count_if(fraction.begin(), fraction.end(), [](char c) { return '0' <= c && c <= '9'; });
  if (static_cast<std::size_t>(digits) <= most_digits) result["area_exact"] = fraction;
}

const char* name_of(clipping::Relation relation) {
  constexpr const char* names[] = {"inside", "outside", "along"};
  return names[static_cast<std::size_t>(relation)];
}

const char* name_of(clipping::ContactKind kind) {
  constexpr const char* names[] = {"entering", "leaving", "touching", "along"};
  return names[static_cast<std::size_t>(kind)];
}

const char* name_of(clipping::Border border) {
  constexpr const char* names[] = {"subject", "clip", "both"};
  return names[static_cast<std::size_t>(border)];
}

template <class Number>
Json to_json(const clipping::WeilerAthertonTrace<Number>& trace, Form form) {
  Json contacts = Json::array(), walks = Json::array();
  for (const auto& contact : trace.contacts)
    contacts.push_back({{"ring", contact.ring},
                        {"point", cases::to_json(contact.point, form)},
                        {"before", name_of(contact.before)},
                        {"after", name_of(contact.after)},
                        {"kind", name_of(contact.kind)}});
  for (const auto& walk : trace.walks) {
    Json steps = Json::array();
    for (const auto& step : walk)
      steps.push_back({{"from", cases::to_json(step.from, form)}, {"along", name_of(step.along)}});
    walks.push_back(steps);
  }
  return {{"contacts", contacts}, {"walks", walks}};
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
  expect_only(object, {"subject", "clip", "op", "decompose"});
  if (word(object, "op", {"intersection", "difference"}) == "difference")
    throw InputError("sutherland-hodgman does intersections only; weiler-atherton does both");
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
      trace.push_back({{decompose ? "piece" : "ring", r},
                       {"edge",
                        {cases::to_json(clip[0][i], form),
                         cases::to_json(clip[0][(i + 1) % clip[0].size()], form)}},
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
  expect_only(object, {"subject", "clip", "op"});
  const auto operation = word(object, "op", {"intersection", "difference"}) == "intersection"
                             ? clipping::SetOperation::intersection
                             : clipping::SetOperation::difference;
  clipping::WeilerAthertonTrace<Number> trace;
  const Rings<Number> subject = over_kernel<Number>(rings(object, "subject"));
  const Rings<Number> clip = over_kernel<Number>(rings(object, "clip"));
  const auto polygons = clipping::weiler_atherton(subject, clip, operation, &trace);
  Json result{{"polygons", Json::array()}};
  for (const clipping::Polygon<Number>& polygon : polygons) {
    Json all = Json::array({cases::to_json(polygon.outline, form)});
    for (const Ring<Number>& hole : polygon.holes) all.push_back(cases::to_json(hole, form));
    result["polygons"].push_back(all);
  }
  put_area(result, clipping::area_of(polygons), form);
  if (form.trace) result["trace"] = to_json(trace, form);
  return result;
}

template <class Number>
Json sutherland_hodgman(const Json& object, Form form) {
  return object.contains("polygon3") ? clip_in_space<Number>(object, form)
                                     : sutherland_hodgman_2<Number>(object, form);
}

template Json weiler_atherton<double>(const Json&, Form);
template Json weiler_atherton<Rational>(const Json&, Form);
template Json sutherland_hodgman<double>(const Json&, Form);
template Json sutherland_hodgman<Rational>(const Json&, Form);

}  // namespace fathom::app::clip
