#include "fathom/pipeline/geometry/painters_algorithm.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <list>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/geometry/eigen_arrays.h"
#include "fathom/numeric/certified.h"
#include "fathom/threads/interruption.h"

namespace fathom::pipeline {
namespace {

Sign exact_side(const Point3d& a, const Point3d& b, const Point3d& c, const Point3d& p) {
  const auto minus = [&](const Point3d& q) {
    return ExactVector3{Dyadic(q[0]) - a[0], Dyadic(q[1]) - a[1], Dyadic(q[2]) - a[2]};
  };
  return determinant(minus(b), minus(c), minus(p)).sign();
}

/// Whether an edge of `p` has all of `q` on its outer side or on it.
bool separates(const std::vector<Point3d>& p, const std::vector<Point3d>& q) {
  Sign inner = Sign::zero;
  for (std::size_t i = 2; i < p.size() && inner == Sign::zero; ++i)
    inner = turn_in_window(p[0], p[i - 1], p[i]);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto &a = p[i], &b = p[(i + 1) % p.size()];
    if (a[0] == b[0] && a[1] == b[1]) continue;
    if (std::none_of(q.begin(), q.end(),
                     [&](const Point3d& c) { return turn_in_window(a, b, c) == inner; }))
      return true;
  }
  return false;
}

}  // namespace

Sign side_of_plane(const Point3d& a, const Point3d& b, const Point3d& c, const Point3d& p) {
  const double ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
  const double vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
  const double wx = p[0] - a[0], wy = p[1] - a[1], wz = p[2] - a[2];
  const double d = ux * (vy * wz - vz * wy) - uy * (vx * wz - vz * wx) + uz * (vx * wy - vy * wx);
  // Differences have one rounding, each term two products and one more difference, then two sums:
  // the relative errors of the six products of three are below (1 + 2⁻⁵³)⁸ − 1 < 2⁻⁴⁹ of their sum.
  const double size = std::abs(ux) * (std::abs(vy * wz) + std::abs(vz * wy)) +
                      std::abs(uy) * (std::abs(vx * wz) + std::abs(vz * wx)) +
                      std::abs(uz) * (std::abs(vx * wy) + std::abs(vy * wx));
  if (size > 0x1p-900 && std::abs(d) > size * 0x1p-49)
    return d > 0 ? Sign::positive : Sign::negative;
  return exact_side(a, b, c, p);
}

Sign turn_in_window(const Point3d& a, const Point3d& b, const Point3d& c) {
  return orientation({a[0], a[1]}, {b[0], b[1]}, {c[0], c[1]});
}

bool projections_overlap(const std::vector<Point3d>& p, const std::vector<Point3d>& q) {
  return !separates(p, q) && !separates(q, p);
}

namespace {

constexpr std::uint64_t most_splits = 1000000;

/// A convex polygon in the window; farness grows away from the eye.
template <class Real>
struct Polygon {
  WindowTriangle<Real> source;  ///< the triangle that this is a part of
  std::size_t plane = 0;        ///< the number of its plane in planes_
  std::vector<WindowVertex<Real>> corners;
  std::vector<Point3d> points;  ///< x, y, farness of `corners`
  Point3d low{}, high{};        ///< its box
  bool moved = false;           ///< since the last polygon was painted
  /// Sides of planes on which it lies, as decided by the splits that made it.
  std::vector<std::pair<std::size_t, Sign>> known_sides;
  /// Edges, 3·plane + i, seen end on, that have already cut it: rounded cuts lie next to their line
  /// and would be repeated.
  std::vector<std::size_t> known_edges;
  std::size_t serial = 0;
  /// Serial numbers of polygons before which it is painted, whatever the tests find.
  std::vector<std::size_t> forced_before;
  std::size_t traced = 0;  ///< its index in the trace
};

/// A point between a and b in the window: x, y, z and 1/w are linear there, attributes over w.
template <class Real>
WindowVertex<Real> between(const WindowVertex<Real>& a, const WindowVertex<Real>& b, Real t) {
  const auto mix = [&](Real p, Real q) { return p + t * (q - p); };
  WindowVertex<Real> v{
      mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z), mix(a.inverse_w, b.inverse_w), {}};
  for (std::size_t i = 0; i < attribute::count; ++i)
    v.attributes[i] =
        mix(a.attributes[i] * a.inverse_w, b.attributes[i] * b.inverse_w) / v.inverse_w;
  return v;
}

template <class Real>
class Painter {
 public:
  Painter(bool greater_is_nearer, PainterStatistics& statistics, PainterTrace* trace)
      : sign_(greater_is_nearer ? -1 : 1), count_(statistics), trace_(trace) {}

  std::vector<WindowTriangle<Real>> run(std::vector<WindowTriangle<Real>> triangles) {
    for (WindowTriangle<Real>& t : triangles) {
      check_interruption();
      Polygon<Real> p;
      p.corners.assign(t.corners.begin(), t.corners.end());
      p.plane = planes_.size();
      p.serial = ++serials_;
      p.source = std::move(t);
      measure(p);
      planes_.push_back(p.points);
      todo_.push_back(std::move(p));
    }
    todo_.sort(is_farther);
    for (Polygon<Real>& p : todo_) note(p, std::nullopt);
    while (!todo_.empty()) {
      if (settle_first()) paint_first();
    }
    return std::move(painted_);
  }

 private:
  using Place = typename std::list<Polygon<Real>>::iterator;

  /// Enters a polygon in the trace.
  void note(Polygon<Real>& p, std::optional<std::size_t> part_of) {
    if (trace_ == nullptr) return;
    p.traced = trace_->polygons.size();
    PaintedPolygon painted{p.source.number, part_of, {}};
    for (const auto& c : p.corners)
      painted.corners.push_back(
          {static_cast<double>(c.x), static_cast<double>(c.y), static_cast<double>(c.z)});
    trace_->polygons.push_back(std::move(painted));
  }

  void note(PainterStep::Kind kind, const Polygon<Real>& P, const Polygon<Real>& Q, int test = 0) {
    note({kind, P.traced, Q.traced, test});
  }

  /// Traces are for human readers, and the steps of a mesh of thousands of triangles would fill the
  /// memory.
  void note(const PainterStep& step) {
    constexpr std::size_t most_steps = 100'000;
    if (trace_ == nullptr) return;
    if (trace_->steps.size() == most_steps) {
      throw InputError(
          "the painter's algorithm takes more than 100000 steps here, too many to list; trace a "
          "scene with fewer triangles");
    }
    trace_->steps.push_back(step);
  }

  static bool is_farther(const Polygon<Real>& a, const Polygon<Real>& b) {
    check_interruption();  // in every comparison of a sort
    return a.high[2] > b.high[2];
  }

  void measure(Polygon<Real>& p) const {
    p.points.clear();
    for (const auto& c : p.corners)
      p.points.push_back(
          {static_cast<double>(c.x), static_cast<double>(c.y), sign_ * static_cast<double>(c.z)});
    p.low = p.high = p.points[0];
    for (const Point3d& point : p.points)
      for (std::size_t k = 0; k < 3; ++k) {
        p.low[k] = std::min(p.low[k], point[k]);
        p.high[k] = std::max(p.high[k], point[k]);
      }
  }

  /// Whether all of p lies behind (positive) or before (negative) the plane of `plane`, or on it.
  [[nodiscard]] bool lies(const Polygon<Real>& p, Sign where, std::size_t plane) const {
    for (const auto& [known, side] : p.known_sides)
      if (known == plane) return side == where;
    if (p.plane == plane) return true;
    const std::vector<Point3d>& q = planes_[plane];
    const Sign away = turn_in_window(q[0], q[1], q[2]);
    return std::all_of(p.points.begin(), p.points.end(), [&](const Point3d& point) {
      const Sign side = side_of_plane(q[0], q[1], q[2], point) * away;
      return side == Sign::zero || side == where;
    });
  }

  /// The first of Newell's tests by which P may be painted before Q; 5 if none holds.
  [[nodiscard]] std::size_t test(const Polygon<Real>& P, const Polygon<Real>& Q) const {
    for (std::size_t k = 0; k < 2; ++k)
      if (P.high[k] <= Q.low[k] || Q.high[k] <= P.low[k]) return k;
    if (std::find(P.forced_before.begin(), P.forced_before.end(), Q.serial) !=
        P.forced_before.end())
      return 4;
    if (lies(P, Sign::positive, Q.plane)) return 2;
    if (lies(Q, Sign::negative, P.plane)) return 3;
    return projections_overlap(P.points, Q.points) ? 5 : 4;
  }

  /// Returns true if the first polygon may be painted; otherwise changes the list.
  bool settle_first() {
    const Place P = todo_.begin();
    for (Place Q = std::next(P); Q != todo_.end(); ++Q) {
      check_interruption();
      // Polygons that were moved are out of order, so the list is searched to its end.
      if (Q->high[2] <= P->low[2]) {
        ++count_.z_disjoint;
        note(PainterStep::Kind::z_disjoint, *P, *Q);
        continue;
      }
      ++count_.comparisons;
      const std::size_t settled = test(*P, *Q);
      if (settled < 5) {
        ++count_.settled[settled];
        note(PainterStep::Kind::settled, *P, *Q, static_cast<int>(settled) + 1);
        continue;
      }
      const bool reversible =
          lies(*Q, Sign::positive, P->plane) || lies(*P, Sign::negative, Q->plane);
      if (!Q->moved && reversible) {
        ++count_.moved;
        note(PainterStep::Kind::moved, *P, *Q);
        Q->moved = true;
        todo_.splice(todo_.begin(), todo_, Q);
      } else {
        split(P, Q);
      }
      return false;
    }
    return true;
  }

  void paint_first() {
    const Polygon<Real>& p = todo_.front();
    note(PainterStep::Kind::painted, p, p);
    for (std::size_t i = 2; i < p.corners.size(); ++i) {
      WindowTriangle<Real> t = p.source;
      t.corners = {p.corners[0], p.corners[i - 1], p.corners[i]};
      painted_.push_back(t);
    }
    todo_.pop_front();
    for (Polygon<Real>& q : todo_) q.moved = false;
  }

  /// Splits a polygon by the plane of the other or, if that cuts nothing, by an edge of the other
  /// seen end on. A cycle in which neither cuts exists only because of rounding: if P covers Q
  /// within one outline, every polygon that must come between them in the order passes through one
  /// of their planes.
  void split(Place P, Place Q) {
    const auto plane_of = [&](const Polygon<Real>& q) {
      const std::vector<Point3d>& corners = planes_[q.plane];
      const Sign away = turn_in_window(corners[0], corners[1], corners[2]);
      return [corners, away](const Point3d& p) {
        return (away == Sign::negative ? -1 : 1) * value(corners, p);
      };
    };
    const auto is_known = [](const Polygon<Real>& p, std::size_t plane) {
      return std::any_of(p.known_sides.begin(), p.known_sides.end(),
                         [&](const auto& known) { return known.first == plane; });
    };
    compared_ = {P->traced, Q->traced};
    if (!is_known(*P, Q->plane) && cut(P, plane_of(*Q), Q->plane)) return;
    if (!is_known(*Q, P->plane) && cut(Q, plane_of(*P), P->plane)) return;
    if (cut_by_edges(P, Q->plane) || cut_by_edges(Q, P->plane)) return;
    // Nothing cuts: they overlap only by rounding. Keep the order of the list.
    note(PainterStep::Kind::forced, *P, *Q);
    P->forced_before.push_back(Q->serial);
  }

  bool cut_by_edges(Place place, std::size_t plane) {
    const std::vector<Point3d>& corners = planes_[plane];
    for (std::size_t i = 0; i < 3; ++i) {
      auto& known = place->known_edges;
      if (std::find(known.begin(), known.end(), 3 * plane + i) != known.end()) continue;
      known.push_back(3 * plane + i);
      const Point3d &a = corners[i], &b = corners[(i + 1) % 3];
      const auto side = [&](const Point3d& p) {
        return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
      };
      if (cut(place, side, no_plane)) return true;
    }
    return false;
  }

  /// Six times the volume of the corners of `q` and p.
  static double value(const std::vector<Point3d>& q, const Point3d& p) {
    using geometry::as_vector;
    const Eigen::Vector3d a = as_vector(q[0]), b = as_vector(q[1]), c = as_vector(q[2]);
    return geometry::dot_from_left((b - a).cross(c - a), as_vector(p) - a);
  }

  /// Replaces a polygon by its parts on the two sides of `value_at` = 0; returns false if it lies
  /// on one side, or if a part would have no area.
  template <class Value>
  bool cut(Place place, const Value& value_at, std::size_t plane) {
    Polygon<Real> behind = *place, before = *place;
    behind.corners.clear(), before.corners.clear();
    const std::size_t n = place->corners.size();
    std::vector<double> values;
    for (const Point3d& p : place->points) values.push_back(value_at(p));
    for (std::size_t i = 0; i < n; ++i) {
      const auto &a = place->corners[i], &b = place->corners[(i + 1) % n];
      const double va = values[i], vb = values[(i + 1) % n];
      if (va >= 0) behind.corners.push_back(a);
      if (va <= 0) before.corners.push_back(a);
      if ((va > 0 && vb < 0) || (va < 0 && vb > 0)) {
        const auto cut_at = between(a, b, static_cast<Real>(va / (va - vb)));
        behind.corners.push_back(cut_at);
        before.corners.push_back(cut_at);
      }
    }
    if (behind.corners.size() < 3 || before.corners.size() < 3) return false;
    measure(behind), measure(before);
    if (!has_area(behind) || !has_area(before)) return false;
    if (++count_.splits > most_splits)
      throw InputError(
          "the painter's algorithm needs more than a million pieces; use the z-buffer");
    if (plane != no_plane) {
      behind.known_sides.emplace_back(plane, Sign::positive);
      before.known_sides.emplace_back(plane, Sign::negative);
    }
    const std::size_t whole = place->traced;
    todo_.erase(place);
    note(behind, whole), note(before, whole);
    note({PainterStep::Kind::split, compared_[0], compared_[1], 0, whole, behind.traced,
          before.traced});
    for (Polygon<Real>* part : {&behind, &before}) {
      part->moved = false;
      part->serial = ++serials_;
      todo_.insert(std::find_if(todo_.begin(), todo_.end(),
                                [&](const auto& q) { return !q.moved && is_farther(*part, q); }),
                   std::move(*part));
    }
    return true;
  }

  static bool has_area(const Polygon<Real>& p) {
    for (std::size_t i = 2; i < p.points.size(); ++i)
      if (turn_in_window(p.points[0], p.points[i - 1], p.points[i]) != Sign::zero) return true;
    return false;
  }

  static constexpr std::size_t no_plane = static_cast<std::size_t>(-1);

  double sign_;
  PainterStatistics& count_;
  PainterTrace* trace_;
  std::array<std::size_t, 2> compared_{};  ///< the polygons between which there is no order
  std::vector<std::vector<Point3d>> planes_;
  std::list<Polygon<Real>> todo_;
  std::size_t serials_ = 0;
  std::vector<WindowTriangle<Real>> painted_;
};

}  // namespace

template <class Real>
std::vector<WindowTriangle<Real>> painters_order(std::vector<WindowTriangle<Real>> triangles,
                                                 bool greater_is_nearer,
                                                 PainterStatistics& statistics,
                                                 PainterTrace* trace) {
  return Painter<Real>(greater_is_nearer, statistics, trace).run(std::move(triangles));
}

// NOLINTBEGIN(bugprone-macro-parentheses): a type needs no parentheses
#define FATHOM_INSTANTIATE(Real)                             \
  template std::vector<WindowTriangle<Real>> painters_order( \
      std::vector<WindowTriangle<Real>>, bool, PainterStatistics&, PainterTrace*);
FATHOM_INSTANTIATE(float)
FATHOM_INSTANTIATE(double)
#undef FATHOM_INSTANTIATE
// NOLINTEND(bugprone-macro-parentheses)

}  // namespace fathom::pipeline
