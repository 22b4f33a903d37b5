// fathom clip: points, lines and polygons against planes, and in homogeneous coordinates.

#include <cmath>
#include <optional>
#include <string>

#include "apps/textbook/cases/case_answers.h"
#include "apps/textbook/clip/clip_algorithms.h"
#include "fathom/clipping/homogeneous.h"
#include "fathom/clipping/plane.h"
#include "fathom/clipping/sutherland_hodgman.h"
#include "fathom/text/counted.h"

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
    throw InputError(key + " has " + text::counted(positions.size(), "corner") +
                     "; expected at least 3");
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
                 const std::string& attributes_key,
                 const std::vector<clipping::Corner<Point, Number>>& polygon, Form form) {
  result[key] = positions(polygon, form);
  if (!object.contains("attributes")) return;
  Json& carried = result[attributes_key] = Json::array();
  for (const auto& corner : polygon) carried.push_back(to_json(corner.attributes, form));
}

clipping::Volume volume_of(const Json& object) {
  return word(object, "volume", {"opengl", "zero-one"}) == "opengl" ? clipping::Volume::opengl
                                                                    : clipping::Volume::zero_one;
}

template <class Number>
std::vector<clipping::Corner4<Number>> with_w(
    const std::vector<clipping::Corner3<Number>>& polygon) {
  std::vector<clipping::Corner4<Number>> result;
  result.reserve(polygon.size());
  for (const auto& [p, carried] : polygon) result.push_back({{p.x, p.y, p.z, Number(1)}, carried});
  return result;
}

template <class Number>
Json after_division(const Json& object, Form form) {
  clipping::ClipStages<clipping::Point3, Number> stages;
  const auto polygon = clipping::clip_after_division(
      corners<clipping::Point4, Number>(object, "polygon", 4, point4<Number>), volume_of(object),
      &stages);
  Json result;
  put_polygon(result, object, "polygon", "attributes", with_w(polygon), form);
  if (!form.trace) return result;
  for (std::size_t k = 0; k < stages.size(); ++k)
    result["trace"].push_back({{"plane", clipping::boundary_name(static_cast<int>(k))},
                               {"polygon", positions(with_w(stages[k]), form)}});
  return result;
}

template <class Number>
void put_half(Json& result, const Json& object, clipping::Half half, Form form) {
  clipping::ClipStages<clipping::Point4, Number> stages;
  const auto polygon = clipping::clip_homogeneous(
      corners<clipping::Point4, Number>(object, "polygon", 4, point4<Number>), volume_of(object),
      half, &stages);
  if (half == clipping::Half::upper)
    put_polygon(result, object, "polygon", "attributes", polygon, form);
  else
    put_polygon(result, object, "lower", "lower_attributes", polygon, form);
  if (!form.trace) return;
  for (std::size_t k = 0; k < stages.size(); ++k)
    result["trace"].push_back({{"plane", clipping::boundary_name(static_cast<int>(k))},
                               {"half", half == clipping::Half::upper ? "upper" : "lower"},
                               {"polygon", positions(stages[k], form)}});
}

template <class Number>
Json segment_to_json(const std::optional<clipping::Segment4<Number>>& part, Form form) {
  return part ? Json::array({to_json(part->start, form), to_json(part->end, form)}) : Json(nullptr);
}

template <class Number>
Json boundaries_to_json(const clipping::LiangBarskyTrace<Number>& trace, Form form) {
  constexpr const char* boundaries[] = {"left", "right", "bottom", "top", "near", "far"};
  return parameters_to_json(trace, boundaries, form);
}

template <class Number>
void put_segment_half(Json& result, const clipping::Segment4<Number>& segment, const Json& object,
                      const std::string& key, clipping::Half half, Form form) {
  clipping::LiangBarskyTrace<Number> trace;
  result[key] =
      segment_to_json(clipping::clip_homogeneous(segment, volume_of(object), half, &trace), form);
  if (!form.trace) return;
  Json half_trace{{"half", half == clipping::Half::upper ? "upper" : "lower"}};
  half_trace.update(boundaries_to_json(trace, form));
  result["trace"].push_back(half_trace);
}

template <class Number>
Json segment_after_division(const clipping::Segment4<Number>& segment, const Json& object,
                            Form form) {
  clipping::LiangBarskyTrace<Number> trace;
  Json result{
      {"segment",
       segment_to_json(clipping::clip_after_division(segment, volume_of(object), &trace), form)}};
  if (form.trace) result["trace"] = Json::array({boundaries_to_json(trace, form)});
  return result;
}

/// Halves of the hourglass to clip in, or clipping after the division, which has no hourglass.
enum class Order { upper_half, both_halves, after_division };

Order order_of(const Json& object) {
  const bool both = word(object, "hourglass", {"upper", "both"}) == "both";
  if (!flag(object, "after_division")) return both ? Order::both_halves : Order::upper_half;
  if (both)
    throw InputError(
        "\"hourglass\": \"both\" has no meaning with \"after_division\", which leaves no lower "
        "half; "
        "leave one of them out");
  return Order::after_division;
}

template <class Number>
Json homogeneous_polygon(const Json& object, Form form) {
  expect_only(object, {"polygon", "volume", "hourglass", "after_division", "attributes"},
              "homogeneous with polygon");
  const Order order = order_of(object);
  if (order == Order::after_division) return after_division<Number>(object, form);
  Json result;
  put_half<Number>(result, object, clipping::Half::upper, form);
  if (order == Order::both_halves) put_half<Number>(result, object, clipping::Half::lower, form);
  return result;
}

template <class Number>
Json homogeneous_segment(const Json& object, Form form) {
  expect_only(object, {"segment", "volume", "hourglass", "after_division"},
              "homogeneous with segment");
  const Order order = order_of(object);
  const auto ends = points(object, "segment", 4, 4);
  if (ends.size() != 2) throw InputError("segment: expected two points");
  const clipping::Segment4<Number> segment{point4<Number>(ends[0]), point4<Number>(ends[1])};
  if (order == Order::after_division) return segment_after_division(segment, object, form);
  Json result;
  put_segment_half(result, segment, object, "segment", clipping::Half::upper, form);
  if (order == Order::both_halves)
    put_segment_half(result, segment, object, "lower", clipping::Half::lower, form);
  return result;
}

/// Fails    InputError if the normal is zero; the message follows from the exact normal.
template <class Number>
void check_normal(const clipping::Point3<Number>& N,
                  const std::vector<std::vector<double>>& corners) {
  const auto is_zero = [](const auto& v) { return v.x == 0 && v.y == 0 && v.z == 0; };
  if (!is_zero(N)) return;
  if (is_zero(clipping::normal_of(point3<Rational>(corners[0]), point3<Rational>(corners[1]),
                                  point3<Rational>(corners[2]))))
    throw InputError("the triangle has no area: its corners lie on one line");
  throw InputError("the triangle's normal is rounded to zero; --kernel exact has it");
}

/// The plane through three points, whose front sees them counter-clockwise, with its normal, the
/// normal's length, which is twice the triangle's area (rounded once), and the side of an eye: N·V
/// with V from the first corner to the eye.
template <class Number>
clipping::Plane<Number> plane_of_triangle(const Json& object, Json& result, Form form) {
  if (object.contains("plane")) throw InputError("expected \"plane\" or \"triangle\", not both");
  const auto corners = points(object, "triangle", 3, 3);
  if (corners.size() != 3) throw InputError("triangle: expected three points");
  const auto P = point3<Number>(corners[0]), Q = point3<Number>(corners[1]),
             R = point3<Number>(corners[2]);
  const clipping::Point3<Number> N = clipping::normal_of(P, Q, R);
  check_normal(N, corners);
  clipping::Plane<Number> H = clipping::plane_through(P, N);
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
Json clip_in_space(const Json& object, const std::string& algorithm, Form form) {
  expect_only(object, {"polygon3", "planes", "attributes"}, algorithm + " with polygon3");
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
  put_polygon(result, object, "polygon3", "attributes", polygon, form);
  if (form.trace) {
    result["trace"] = Json::array();
    for (std::size_t i = 0; i < stages.size(); ++i)
      result["trace"].push_back({{"plane", i}, {"polygon3", positions(stages[i], form)}});
  }
  return result;
}

template <class Number>
Json homogeneous(const Json& object, Form form) {
  const bool is_polygon = object.contains("polygon"), is_segment = object.contains("segment");
  if (is_polygon && is_segment) throw InputError("expected \"polygon\" or \"segment\", not both");
  if (!is_polygon && !is_segment) throw InputError("\"polygon\" or \"segment\" is missing");
  return is_polygon ? homogeneous_polygon<Number>(object, form)
                    : homogeneous_segment<Number>(object, form);
}

template <class Number>
Json plane(const Json& object, Form form) {
  if (object.contains("polygon3")) return clip_in_space<Number>(object, "plane", form);
  expect_only(object, {"plane", "triangle", "eye", "points", "line"}, "plane");
  if (object.contains("eye") && !object.contains("triangle"))
    throw InputError("\"eye\" needs a triangle; add \"triangle\" or leave out \"eye\"");
  if (!object.contains("plane") && !object.contains("triangle"))
    throw InputError("\"plane\" or \"triangle\" is missing");
  Json result, values = Json::array();
  const clipping::Plane<Number> H =
      object.contains("triangle")
          ? plane_of_triangle<Number>(object, result, form)
          : plane_of<Number>(numbers(member(object, "plane"), "plane", 4, 4));
  clipping::check_plane(H);
  if (!object.contains("points") && !object.contains("line") && !object.contains("triangle"))
    throw InputError("\"points\" or \"line\" is missing");
  if (object.contains("points")) {
    result["sides"] = Json::array();
    result["distances"] = Json::array();
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

#define FATHOM_INSTANTIATE(Number)                                            \
  template Json clip_in_space<Number>(const Json&, const std::string&, Form); \
  template Json homogeneous<Number>(const Json&, Form);                       \
  template Json plane<Number>(const Json&, Form);
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(Rational)
#undef FATHOM_INSTANTIATE

}  // namespace fathom::app::clip
