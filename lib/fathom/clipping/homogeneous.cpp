#include "fathom/clipping/homogeneous.h"

#include <array>

#include "fathom/clipping/exact_kernel.h"
#include "fathom/failures/errors.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::clipping {
namespace {

template <class Number>
bool is_waist(const Point4<Number>& p) {
  return p.x == 0 && p.y == 0 && p.z == 0 && p.w == 0;
}

template <class Number>
void check_point(const Point4<Number>& p) {
  if (is_waist(p)) throw InputError("(0, 0, 0, 0) is no point; expected a coordinate other than 0");
}

/// The box of normalised device coordinates, normals outwards.
template <class Number>
std::vector<Plane<Number>> box_of(Volume volume) {
  const Number near = volume == Volume::opengl ? Number(-1) : Number(0);
  const Number o(0), one(1);
  return {{-one, o, o, -one}, {one, o, o, -one},  {o, -one, o, -one},
          {o, one, o, -one},  {o, o, -one, near}, {o, o, one, -one}};
}

}  // namespace

const char* boundary_name(int k) {
  constexpr std::array names{"left", "right", "bottom", "top", "near", "far"};
  return names[static_cast<std::size_t>(k)];
}

template <class Number>
Number boundary_value(int k, const Point4<Number>& p, Volume volume) {
  switch (k) {
    case 0:
      return p.w + p.x;
    case 1:
      return p.w - p.x;
    case 2:
      return p.w + p.y;
    case 3:
      return p.w - p.y;
    case 4:
      return volume == Volume::opengl ? p.w + p.z : p.z;
    default:
      return p.w - p.z;
  }
}

template <class Number>
std::vector<Corner4<Number>> clip_homogeneous(const std::vector<Corner4<Number>>& subject,
                                              Volume volume, Half half,
                                              ClipStages<Point4, Number>* trace) {
  const StandardArithmetic standard;
  for (const Corner4<Number>& corner : subject) check_point(corner.position);
  std::vector<Corner4<Number>> polygon = subject;
  for (int k = 0; k < boundary_count; ++k) {
    polygon = clip_at_boundary(polygon, [&](const Point4<Number>& p) -> Number {
      const Number value = boundary_value(k, p, volume);
      return half == Half::upper ? -value : value;
    });
    if (trace != nullptr) trace->push_back(polygon);
  }
  std::erase_if(polygon, [](const auto& corner) { return is_waist(corner.position); });
  if (polygon.size() < 3) polygon.clear();
  return polygon;
}

template <class Number>
std::optional<Segment4<Number>> clip_homogeneous(const Segment4<Number>& segment, Volume volume,
                                                 Half half, LiangBarskyTrace<Number>* trace) {
  const StandardArithmetic standard;
  const auto& [start, end] = segment;
  check_point(start);
  check_point(end);
  std::vector<LineParameter<Number>> parameters;
  for (int k = 0; k < boundary_count; ++k) {
    Number s = boundary_value(k, start, volume), e = boundary_value(k, end, volume);
    if (half == Half::lower) s = -s, e = -e;
    parameters.push_back(against_boundary(k + 1, Number(s - e), s));
  }
  const auto [t_entering, t_leaving, visible] = visible_range(parameters);
  if (trace != nullptr) *trace = {parameters, t_entering, t_leaving};
  if (!visible) return std::nullopt;

  Segment4<Number> part{t_entering == 0 ? start : interpolate(start, end, t_entering),
                        t_leaving == 1 ? end : interpolate(start, end, t_leaving)};
  if (is_waist(part.start)) part.start = part.end;
  if (is_waist(part.end)) part.end = part.start;
  if (is_waist(part.start)) return std::nullopt;
  return part;
}

template <class Number>
Point3<Number> divided(const Point4<Number>& p) {
  if (p.w == 0) throw InputError("w is 0: the point lies at infinity and cannot be divided by w");
  return {p.x / p.w, p.y / p.w, p.z / p.w};
}

template <class Number>
std::vector<Corner3<Number>> clip_after_division(const std::vector<Corner4<Number>>& polygon,
                                                 Volume volume, ClipStages<Point3, Number>* trace) {
  const StandardArithmetic standard;
  std::vector<Corner3<Number>> flat;
  flat.reserve(polygon.size());
  for (const Corner4<Number>& corner : polygon)
    flat.push_back({divided(corner.position), corner.attributes});
  return sutherland_hodgman(flat, box_of<Number>(volume), trace);
}

template <class Number>
std::optional<Segment4<Number>> clip_after_division(const Segment4<Number>& segment, Volume volume,
                                                    LiangBarskyTrace<Number>* trace) {
  const StandardArithmetic standard;
  const Point3<Number> start = divided(segment.start), end = divided(segment.end);
  // For w = 1, the boundaries are the sides of the box.
  const Number one(1);
  return clip_homogeneous<Number>({{start.x, start.y, start.z, one}, {end.x, end.y, end.z, one}},
                                  volume, Half::upper, trace);
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Number)                                                                 \
  template Number boundary_value(int, const Point4<Number>&, Volume);                              \
  template std::vector<Corner4<Number>> clip_homogeneous(                                          \
      const std::vector<Corner4<Number>>&, Volume, Half, ClipStages<Point4, Number>*);             \
  template std::optional<Segment4<Number>> clip_homogeneous(const Segment4<Number>&, Volume, Half, \
                                                            LiangBarskyTrace<Number>*);            \
  template Point3<Number> divided(const Point4<Number>&);                                          \
  template std::vector<Corner3<Number>> clip_after_division(const std::vector<Corner4<Number>>&,   \
                                                            Volume, ClipStages<Point3, Number>*);  \
  template std::optional<Segment4<Number>> clip_after_division(const Segment4<Number>&, Volume,    \
                                                               LiangBarskyTrace<Number>*);
FATHOM_INSTANTIATE(double)
FATHOM_INSTANTIATE(Rational)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)
// binary32 is what a graphics pipeline clips polygons in.
template float boundary_value(int, const Point4<float>&, Volume);
template std::vector<Corner4<float>> clip_homogeneous(const std::vector<Corner4<float>>&, Volume,
                                                      Half, ClipStages<Point4, float>*);

}  // namespace fathom::clipping
