#pragma once

#include <optional>
#include <vector>

#include "fathom/clipping/liang_barsky.h"
#include "fathom/clipping/points.h"
#include "fathom/clipping/sutherland_hodgman.h"

/// Clipping in homogeneous coordinates, before the division by w. The polygon goes through the six
/// boundaries as in sutherland_hodgman.h.
/// Source   [BN78]
///
/// The six boundaries bound an hourglass in (x, y, z, w) with its waist at the origin. A projection
/// shows the upper half, w > 0. A point of the lower half, w < 0, means the same (x/w, y/w, z/w) as
/// its negative in the upper half; a perspective projection never maps a point in front of the eye
/// there, but rational curves do.
namespace fathom::clipping {

enum class Volume {
  /// −w ≤ x, y, z ≤ w
  opengl,
  /// −w ≤ x, y ≤ w and 0 ≤ z ≤ w
  zero_one,
};

enum class Half { upper, lower };

/// The boundaries in the order in which they clip: left, right, bottom, top, near, far.
constexpr int boundary_count = 6;
const char* boundary_name(int k);

/// Not negative on the inner side of boundary k in the upper half: w + x, w − x, … A sum or a
/// difference, rounded as the thread rounds.
template <class Number>
Number boundary_value(int k, const Point4<Number>& point, Volume volume);

template <class Number>
struct Segment4 {
  Point4<Number> start, end;
};

/// The part of the polygon in one half of the hourglass, with w > 0 (upper) or w < 0 (lower)
/// throughout. A corner at the waist (0, 0, 0, 0) is dropped: both its edges project to points.
/// Exact    over Rational.
/// Fails    InputError if a corner is (0, 0, 0, 0).
template <class Number>
std::vector<Corner4<Number>> clip_homogeneous(const std::vector<Corner4<Number>>& polygon,
                                              Volume volume, Half half = Half::upper,
                                              ClipStages<Point4, Number>* trace = nullptr);

/// The part of the segment in one half of the hourglass, by the order of parameters. A segment from
/// one half to the other has a part in each, and runs through infinity between them. If an end of
/// the part is the waist, the part projects to one point, and both ends are that point.
/// Exact    over Rational.
/// Fails    InputError if an end is (0, 0, 0, 0).
template <class Number>
std::optional<Segment4<Number>> clip_homogeneous(const Segment4<Number>& segment, Volume volume,
                                                 Half half = Half::upper,
                                                 LiangBarskyTrace<Number>* trace = nullptr);

/// (x/w, y/w, z/w). Fails with InputError if w = 0.
template <class Number>
Point3<Number> divided(const Point4<Number>& point);

/// The wrong order, for demonstration: divides first and clips the result against the volume's box.
/// An edge from a point in front of the eye to a point behind it runs through infinity after the
/// projection. This function joins its ends by a straight line, so the polygon is wrong.
/// Fails    InputError if w = 0.
template <class Number>
std::vector<Corner3<Number>> clip_after_division(const std::vector<Corner4<Number>>& polygon,
                                                 Volume volume,
                                                 ClipStages<Point3, Number>* trace = nullptr);

/// The same wrong order for a segment; the result has w = 1.
/// Fails    InputError if w = 0.
template <class Number>
std::optional<Segment4<Number>> clip_after_division(const Segment4<Number>& segment, Volume volume,
                                                    LiangBarskyTrace<Number>* trace = nullptr);

}  // namespace fathom::clipping
