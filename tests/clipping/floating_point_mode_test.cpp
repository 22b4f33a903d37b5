// The caller's floating-point mode changes nothing of what is clipped, in binary64 or exactly.
#include <gtest/gtest.h>

#include "fathom/clipping/boolean_by_cgal.h"
#include "fathom/clipping/cohen_sutherland.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/homogeneous.h"
#include "fathom/clipping/liang_barsky.h"
#include "fathom/clipping/plane.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/sutherland_hodgman.h"
#include "fathom/clipping/weiler_atherton.h"
#include "tests/inputs/floating_point_modes.h"

namespace fathom {
namespace {

using namespace clipping;
using Numbers = std::vector<double>;

/// A third is rounded, and the smallest numbers are subnormal.
constexpr double tiny = 0x1p-1070;

void add(Numbers& numbers, const std::optional<Segment2<double>>& segment) {
  numbers.push_back(segment.has_value());
  if (!segment) return;
  for (const Point2<double>& p : {segment->start, segment->end}) {
    numbers.insert(numbers.end(), {p.x, p.y});
  }
}

TEST(FloatingPointMode, ChangesNoClippedLine) {
  const Window<double> window{tiny, 0, 3, 1};
  for (const Segment2<double>& segment :
       {Segment2<double>{{-1, 0.1}, {4, 0.7}}, Segment2<double>{{0, 0}, {3 * tiny, tiny}},
        Segment2<double>{{0.1, -1}, {0.3, 7}}}) {
    checks::expect_same_in_all_modes([&] {
      Numbers numbers;
      add(numbers, cohen_sutherland(segment, window));
      add(numbers, liang_barsky(segment, window));
      return numbers;
    });
  }
}

const Ring<double> square{{0, 0}, {3, 0}, {3, 3}, {0, 3}};
const Ring<double> dart{{-1, 1}, {4, 0.1}, {1.1, 1.3}, {4, 2.7}};
const Ring<double> speck{{0, 0}, {tiny, 0}, {tiny, tiny}};

void add(Numbers& numbers, const Rings<double>& rings) {
  for (const Ring<double>& ring : rings) {
    numbers.push_back(static_cast<double>(ring.size()));
    for (const Point2<double>& p : ring) numbers.insert(numbers.end(), {p.x, p.y});
  }
}

TEST(FloatingPointMode, ChangesNoClippedPolygon) {
  checks::expect_same_in_all_modes([] {
    Numbers numbers;
    for (const auto operation : {SetOperation::intersection, SetOperation::difference}) {
      const auto polygons = weiler_atherton(Rings<double>{dart}, {square}, operation);
      for (const Polygon<double>& polygon : polygons) add(numbers, Rings<double>{polygon.outline});
      numbers.push_back(area_of(polygons));
    }
    return numbers;
  });
}

TEST(FloatingPointMode, ChangesNothingOfRings) {
  for (const Ring<double>& ring : {dart, speck}) {
    checks::expect_same_in_all_modes([&] {
      Numbers numbers;
      add(numbers, checked_rings(Rings<double>{ring}, "subject"));
      numbers.push_back(signed_area(ring));
      add(numbers, convex_pieces(ring));
      return numbers;
    });
  }
}

TEST(FloatingPointMode, ChangesNothingOfExactPolygons) {
  checks::expect_same_in_all_modes([] {
    Numbers numbers;
    const auto add_answer = [&](const std::vector<Polygon<Rational>>& polygons) {
      for (const Polygon<Rational>& polygon : polygons) {
        for (const Point2<Rational>& p : polygon.outline) {
          numbers.insert(numbers.end(), {to_binary64(p.x), to_binary64(p.y)});
        }
      }
      numbers.push_back(to_binary64(area_of(polygons)));
    };
    const Rings<Rational> clip = to_exact(Rings<double>{square});
    for (const Ring<double>& ring : {dart, speck}) {
      const Rings<Rational> subject = to_exact(Rings<double>{ring});
      add_answer(weiler_atherton(subject, clip, SetOperation::intersection));
      add_answer(boolean_by_cgal(subject, clip, SetOperation::intersection));
      const auto difference = first_difference(subject, clip);
      numbers.push_back(to_binary64(difference.value().area));
    }
    return numbers;
  });
}

void add(Numbers& numbers, const std::vector<Corner3<double>>& corners) {
  for (const auto& [p, attributes] : corners) {
    numbers.insert(numbers.end(), {p.x, p.y, p.z});
    numbers.insert(numbers.end(), attributes.begin(), attributes.end());
  }
}

TEST(FloatingPointMode, ChangesNothingInSpace) {
  const std::vector<Corner4<double>> triangle{
      {{-3, 0.1, 0.2, 1}, {0.1}}, {{3, 0.3, tiny, 1.1}, {tiny}}, {{0.7, 5, 0.4, 0.9}, {0.7}}};
  const Plane<double> plane{0.1, 0.7, tiny, -0.3};
  checks::expect_same_in_all_modes([&] {
    Numbers numbers;
    for (const auto& [p, attributes] : clip_homogeneous(triangle, Volume::opengl)) {
      numbers.insert(numbers.end(), {p.x, p.y, p.z, p.w});
      numbers.insert(numbers.end(), attributes.begin(), attributes.end());
    }
    add(numbers, clip_after_division(triangle, Volume::zero_one));
    const Segment4<double> segment{triangle[0].position, triangle[1].position};
    if (const auto part = clip_homogeneous(segment, Volume::zero_one)) {
      numbers.insert(numbers.end(), {part->start.x, part->start.z, part->end.x, part->end.z});
    }
    numbers.push_back(signed_distance(plane, triangle[1].position));
    const Point3<double> R{0.1, 0.2, tiny}, S{3, 7, 0.3};
    if (const auto met = plane_line_intersection(plane, R, S)) {
      numbers.insert(numbers.end(), {met->t, met->point.x, met->point.y, met->point.z});
    }
    return numbers;
  });
}

}  // namespace
}  // namespace fathom
