#pragma once

#include <optional>

#include "fathom/clipping/points.h"

/// Points and lines against a plane, exactly over Rational.
namespace fathom::clipping {

/// The plane A x + B y + C z + D = 0 with the normal N = (A, B, C) ≠ 0 pointing outside.
template <class Number>
struct Plane {
  Number A, B, C, D;
};

/// The plane through Q with the normal N: D = −Q·N.
template <class Number>
Plane<Number> plane_through(const Point3<Number>& Q, const Point3<Number>& N);

/// (Q − P) × (R − P): from where it points to, P, Q, R run counter-clockwise; its length is twice
/// the area of the triangle. The other way round it is the negative.
template <class Number>
Point3<Number> normal_of(const Point3<Number>& P, const Point3<Number>& Q, const Point3<Number>& R);

/// |N|, over Rational rounded once to binary64.
template <class Number>
double length_of(const Point3<Number>& N);

/// Throws InputError if the normal is zero.
template <class Number>
void check_plane(const Plane<Number>& plane);

enum class Side { inside = -1, on = 0, outside = 1 };

/// H·P = A x + B y + C z + D: positive outside. It is the signed distance times |N|.
template <class Number>
Number value_at(const Plane<Number>& plane, const Point3<Number>& point);
/// H·P = A x + B y + C z + D w. Its sign is the side only if w > 0.
template <class Number>
Number value_at(const Plane<Number>& plane, const Point4<Number>& point);

template <class Number>
Side side_of(const Plane<Number>& plane, const Point3<Number>& point);
/// The side of the point (x/w, y/w, z/w), so the sign of H·P is reversed if w < 0; if w = 0, the
/// side on which the direction (x, y, z) ends at infinity. Throws InputError for (0, 0, 0, 0).
template <class Number>
Side side_of(const Plane<Number>& plane, const Point4<Number>& point);

/// The signed distance, positive outside, over Rational rounded once to binary64; ±∞ for points at
/// infinity that are not on the plane. It is ±√((H·P)² / (w² |N|²)).
template <class Number>
double signed_distance(const Plane<Number>& plane, const Point4<Number>& point);

template <class Number>
struct PlaneLineIntersection {
  Number t;
  Point3<Number> point;
};

/// Where the line p(t) = R + t (S − R) meets the plane: t = (Q − R)·N / (S − R)·N with any point Q
/// of the plane, which is −H·R / (S − R)·N. nullopt if the line is parallel to the plane (or lies
/// in it).
template <class Number>
std::optional<PlaneLineIntersection<Number>> plane_line_intersection(const Plane<Number>& plane,
                                                                     const Point3<Number>& R,
                                                                     const Point3<Number>& S);

}  // namespace fathom::clipping
