// fathom clip: points, lines and polygons against planes, and in homogeneous coordinates.

#include <cmath>

#include "apps/textbook/cases/case_effort.h"
#include "apps/textbook/clip/clip_algorithms.h"
#include "fathom/clipping/homogeneous.h"
#include "fathom/clipping/plane.h"
#include "fathom/clipping/sutherland_hodgman.h"

namespace fathom::app::clip {
namespace {

using clipping::Rational;

template <class Number>
clipping::Point3<Number> point3(const std::vector<double>& p) {
  return {Number(p[0]), Number(p[1]), Number(p[2])};
}

/// w is 1 where there are three coordinates.
template <class Number>
clipping::Point4<Number> point4(const std::vector<double>& p) {
  return {Number(p[0]), Number(p[1]), Number(p[2]), Number(p.size() == 4 ? p[3] : 1.0)};
}

template <class Number>
clipping::Plane<Number> plane_of(const std::vector<double>& p) {
  return {Number(p[0]), Number(p[1]), Number(p[2]), Number(p[3])};
}

/// The corners of the member `key`, with the attributes of the case.
template <template <class> class Point, class Number, class ToPoint>
std::vector<clipping::Corner<Point, Number>> corners(const Json& object, const std::string& key,
                                                     std::size_t coordinates,
                                                     const ToPoint& to_point) {
  const auto positions = points(object, key, coordinates, coordinates);
  if (positions.size() < 3)
    throw InputError(key + " has " + std::to_string(positions.size()) +
                     " corners; expected at least 3");
  const auto carried = attributes(object, positions.size());
  std::vector<clipping::Corner<Point, Number>> result;
  for (std::size_t i = 0; i < positions.size(); ++i)
    result.push_back(
        {to_point(positions[i]), std::vector<Number>(carried[i].begin(), carried[i].end())});
  return result;
}

template <template <class> class Point, class Number>
Json positions(const std::vector<clipping::Corner<Point, Number>>& polygon, Form form) {
  Json result = Json::array();
  for (const auto& corner : polygon) result.push_back(to_json(corner.position, form));
  return result;
}

template <template <class> class Point, class Number>
void put_polygon(Json& result, const Json& object, const std::string& key,
                 const std::vector<clipping::Corner<Point, Number>>& polygon, Form form) {
  result[key] = positions(polygon, form);
  if (!object.contains("attributes")) return;
  result["attributes"] = Json::array();
  for (const auto& corner : polygon)
    result["attributes"].push_back(to_json(corner.attributes, form));
}

clipping::Volume volume_of(const Json& object) {
  return word(object, "volume", {"opengl", "zero-one"}) == "opengl" ? clipping::Volume::opengl
                                                                    : clipping::Volume::zero_one;
}

template <class Number>
Json after_division(const Json& object, Form form) {
  const auto polygon = corners<clipping::Point4, Number>(object, "polygon", 4, point4<Number>);
  const auto clipped = clipping::clip_after_division(polygon, volume_of(object));
  std::vector<clipping::Corner4<Number>> with_w;
  with_w.reserve(clipped.size());
  for (const auto& [p, carried] : clipped) with_w.push_back({{p.x, p.y, p.z, Number(1)}, carried});
  Json result;
  put_polygon(result, object, "polygon", with_w, form);
  return result;
}

template <class Number>
void put_half(Json& result, const Json& object, const std::string& key, clipping::Half half,
              Form form) {
  clipping::ClipStages<clipping::Point4, Number> stages;
  const auto polygon = clipping::clip_homogeneous(
      corners<clipping::Point4, Number>(object, "polygon", 4, point4<Number>), volume_of(object),
      half, &stages);
  if (half == clipping::Half::upper)
    put_polygon(result, object, key, polygon, form);
  else
    result[key] = positions(polygon, form);
  if (!form.trace) return;
  for (std::size_t k = 0; k < stages.size(); ++k)
    result["trace"].push_back({{"plane", clipping::boundary_name(static_cast<int>(k))},
                               {"half", half == clipping::Half::upper ? "upper" : "lower"},
                               {"polygon", positions(stages[k], form)}});
}

template <class Number>
void put_segment_half(Json& result, const clipping::Segment4<Number>& segment, const Json& object,
                      const std::string& key, clipping::Half half, Form form) {
  constexpr const char* edges[] = {"left", "right", "bottom", "top", "near", "far"};
  clipping::LiangBarskyTrace<Number> trace;
  const auto part = clipping::clip_homogeneous(segment, volume_of(object), half, &trace);
  result[key] =
      part ? Json::array({to_json(part->start, form), to_json(part->end, form)}) : Json(nullptr);
  if (!form.trace) return;
  Json half_trace{{"half", half == clipping::Half::upper ? "upper" : "lower"}};
  half_trace.update(parameters_to_json(trace, edges, form));
  result["trace"].push_back(half_trace);
}

template <class Number>
Json homogeneous_segment(const Json& object, bool both, Form form) {
  const auto ends = points(object, "segment", 4, 4);
  if (ends.size() != 2) throw InputError("segment: expected two points");
  const clipping::Segment4<Number> segment{point4<Number>(ends[0]), point4<Number>(ends[1])};
  Json result;
  put_segment_half(result, segment, object, "segment", clipping::Half::upper, form);
  if (both) put_segment_half(result, segment, object, "lower", clipping::Half::lower, form);
  return result;
}

/// The plane through three points, front where they run counter-clockwise as seen, with what it says
/// of itself: its normal, the normal's length, which is twice the triangle's area (rounded once), and
/// on which side an eye is: N·V with V from the first corner to the eye.
template <class Number>
clipping::Plane<Number> plane_of_triangle(const Json& object, Json& result, Form form) {
  if (object.contains("plane")) throw InputError("expected \"plane\" or \"triangle\", not both");
  const auto corners = points(object, "triangle", 3, 3);
  if (corners.size() != 3) throw InputError("triangle: expected three points");
  const auto P = point3<Number>(corners[0]), Q = point3<Number>(corners[1]),
             R = point3<Number>(corners[2]);
  const clipping::Point3<Number> N = clipping::normal_of(P, Q, R);
  const clipping::Plane<Number> H = clipping::plane_through(P, N);
  result["plane"] =
      Json::array({to_json(H.A, form), to_json(H.B, form), to_json(H.C, form), to_json(H.D, form)});
  result["normal"] = to_json(N, form);
  result["twice_area"] = clipping::length_of(N);
  if (!object.contains("eye")) return H;
  const auto eye = point3<Number>(numbers(member(object, "eye"), "eye", 3, 3));
  const Number facing = clipping::value_at(H, eye);
  result["facing"] = facing > 0 ? "front" : facing < 0 ? "back" : "edge on";
  result["n_dot_v"] = to_json(facing, form);
  return H;
}

/// null for infinite ones.
Json distance_to_json(double distance) {
  return std::isfinite(distance) ? Json(distance) : Json(nullptr);
}

}  // namespace

template <class Number>
Json clip_in_space(const Json& object, Form form) {
  expect_only(object, {"polygon3", "planes", "attributes"});
  std::vector<clipping::Plane<Number>> planes;
  for (const auto& p : points(object, "planes", 4, 4)) planes.push_back(plane_of<Number>(p));
  clipping::ClipStages<clipping::Point3, Number> stages;
  const auto subject = corners<clipping::Point3, Number>(object, "polygon3", 3, point3<Number>);
  cases::check_effort<Number>(
      static_cast<double>(subject.size()) * static_cast<double>(planes.size()),
      "tests of a corner against a plane", clip_less<Number>);
  const auto polygon =
      clipping::sutherland_hodgman(subject, planes, form.trace ? &stages : nullptr);
  Json result;
  put_polygon(result, object, "polygon3", polygon, form);
  if (form.trace) {
    result["trace"] = Json::array();
    for (std::size_t i = 0; i < stages.size(); ++i)
      result["trace"].push_back({{"plane", i}, {"polygon3", positions(stages[i], form)}});
  }
  return result;
}

template <class Number>
Json homogeneous(const Json& object, Form form) {
  expect_only(object,
              {"polygon", "segment", "volume", "hourglass", "after_division", "attributes"});
  const bool both = word(object, "hourglass", {"upper", "both"}) == "both";
  if (object.contains("segment")) return homogeneous_segment<Number>(object, both, form);
  if (flag(object, "after_division")) return after_division<Number>(object, form);
  Json result;
  put_half<Number>(result, object, "polygon", clipping::Half::upper, form);
  if (both) put_half<Number>(result, object, "lower", clipping::Half::lower, form);
  return result;
}

template <class Number>
Json plane(const Json& object, Form form) {
  if (object.contains("polygon3")) return clip_in_space<Number>(object, form);
  expect_only(object, {"plane", "triangle", "eye", "points", "line"});
  Json result, values = Json::array();
  const clipping::Plane<Number> H =
      object.contains("triangle")
          ? plane_of_triangle<Number>(object, result, form)
          : plane_of<Number>(numbers(member(object, "plane"), "plane", 4, 4));
  clipping::check_plane(H);
  const bool asks_nothing = !object.contains("line") && !object.contains("triangle");
  if (object.contains("points") || asks_nothing) {
    result["sides"] = result["distances"] = Json::array();
    for (const auto& coordinates : points(object, "points", 3, 4)) {
      const auto P = point4<Number>(coordinates);
      result["sides"].push_back(static_cast<int>(clipping::side_of(H, P)));
      result["distances"].push_back(distance_to_json(clipping::signed_distance(H, P)));
      values.push_back(to_json(clipping::value_at(H, P), form));
    }
  }
  if (object.contains("line")) {
    const auto line = points(object, "line", 3, 3);
    if (line.size() != 2) throw InputError("line: expected two points");
    const auto meeting =
        clipping::plane_line_intersection(H, point3<Number>(line[0]), point3<Number>(line[1]));
    result["t"] = meeting ? to_json(meeting->t, form) : Json(nullptr);
    result["point"] = meeting ? to_json(meeting->point, form) : Json(nullptr);
  }
  if (form.trace) result["trace"] = {{"values", values}};
  return result;
}

#define FATHOM_INSTANTIATE(Number)                        \
  template Json clip_in_space<Number>(const Json&, Form); \
  template Json homogeneous<Number>(const Json&, Form);   \
  template Json plane<Number>(const Json&, Form);
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(Rational)
#undef FATHOM_INSTANTIATE

}  // namespace fathom::app::clip
