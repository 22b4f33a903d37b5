#include "fathom/rays/tree_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "fathom/numeric/certified.h"
#include "fathom/numeric/interval.h"
#include "fathom/rays/exact_ray.h"
#include "fathom/rays/ray_bounds.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/threads.h"

namespace fathom::rays {
namespace {

/// Whether n is not 0, exactly: n is 0 only for a triangle without area.
bool has_area(const PlacedTriangles::Corners& corners, double corner_error,
              const TriangleSource& source, std::uint32_t number) {
  Vector p, r;
  double H = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    p[k] = corners[1][k] - corners[0][k];
    r[k] = corners[2][k] - corners[0][k];
    H = std::max({H, std::abs(p[k]), std::abs(r[k])});
  }
  const double error =
      (bounds::of_normal * H * H + bounds::of_normal_corners * corner_error * H) * bounds::slack +
      bounds::floor;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
    if (std::abs(p[i] * r[j] - p[j] * r[i]) > error) return true;
  }
  const auto [a, b, c] = source.world_corners(number);
  const ExactVector3 n = cross(difference(b, a), difference(c, a));
  return !std::ranges::all_of(n, &Dyadic::is_zero);
}

FloatBox box_of(const PlacedTriangles::Corners& corners, double corner_error) {
  FloatBox box;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [least, greatest] = std::minmax({corners[0][k], corners[1][k], corners[2][k]});
    // The error is 0, or greater than the rounding of the sum.
    box.lower[k] = round_down(least - 2 * corner_error);
    box.upper[k] = round_up(greatest + 2 * corner_error);
  }
  return box;
}

}  // namespace

std::vector<Element> elements_of(const TriangleSource& source, const PlacedTriangles& triangles,
                                 double corner_error) {
  constexpr std::size_t together = 4096;
  std::vector<Element> elements(triangles.count());
  const std::size_t pieces = (elements.size() + together - 1) / together;
  parallel_for(std::size_t{0}, pieces, [&](std::size_t piece) {
    const std::size_t end = std::min(elements.size(), (piece + 1) * together);
    for (std::size_t i = piece * together; i < end; ++i) {
      const auto number = static_cast<std::uint32_t>(i);
      if (!has_area(triangles[number], corner_error, source, number)) continue;
      elements[i] = {box_of(triangles[number], corner_error), number};
    }
  });
  // Elements that were left out have empty boxes.
  std::erase_if(elements, [](const Element& e) { return e.box.lower[0] > e.box.upper[0]; });
  return elements;
}

std::vector<bool> objects_with_exact_corners(const TriangleSource& source, long power) {
  const double least = std::ldexp(1.0, static_cast<int>(power) - 960);
  const auto is_kept = [&](double x) { return x == 0 || std::abs(x) >= least; };
  const std::vector<Object>& objects = source.objects();
  std::vector<bool> are_exact(objects.size(), true);
  source.for_each_part(0, [&](const TriangleSource::Part& part) {
    const bool are_kept = part.object.placed_as_is &&
                          std::ranges::all_of(part.mesh.vertices, [&](const MeshPoint& p) {
                            return is_kept(p.x) && is_kept(p.y) && is_kept(p.z);
                          });
    if (!are_kept) are_exact[static_cast<std::size_t>(&part.object - objects.data())] = false;
  });
  return are_exact;
}

bool are_in_binary32(const PlacedTriangles& triangles) {
  const auto is_binary32 = [](double x) { return static_cast<float>(x) == x; };
  for (std::uint32_t i = 0; i < triangles.count(); ++i)
    for (const Vector& corner : triangles[i])
      if (!std::ranges::all_of(corner, is_binary32)) return false;
  return true;
}

namespace {

/// The number of blocks that so many triangles fill.
float blocks_for(std::size_t triangles) {
  const std::size_t blocks = (triangles + triangles_together - 1) / triangles_together;
  return static_cast<float>(blocks);
}

constexpr std::size_t bins = 16;

/// The bins of an axis; all elements are in the first if their centres do not differ.
struct Binning {
  std::size_t axis;
  float first, scale;

  Binning(const Part& part, std::size_t along) : axis(along), first(part.centres.lower[along]) {
    const float factor = static_cast<float>(bins) / (part.centres.upper[along] - first);
    scale = factor < beyond_all ? factor : 0;
  }
  [[nodiscard]] std::size_t bin_of(const Element& e) const {
    return std::min(bins - 1, static_cast<std::size_t>((e.centre(axis) - first) * scale));
  }
};

struct Plane {
  std::size_t axis = 0;
  /// The first bin beyond it; 0: there is no plane that separates elements.
  std::size_t bin = 0;
  float cost = beyond_all;
};

/// The plane between bins with the least sum of areas times blocks on both sides.
Plane best_plane(const Part& part) {
  Plane best;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Binning binning(part, axis);
    std::array<FloatBox, bins> boxes;
    std::array<std::size_t, bins> counts{};
    for (const Element& e : part.elements) {
      const std::size_t bin = binning.bin_of(e);
      boxes[bin].add(e.box);
      ++counts[bin];
    }
    std::array<float, bins> below{};  // the cost of all bins below one
    FloatBox box;
    std::size_t count = 0;
    for (std::size_t bin = 1; bin < bins; ++bin) {
      box.add(boxes[bin - 1]);
      count += counts[bin - 1];
      below[bin] = box.area() * blocks_for(count);
    }
    box = {};
    count = 0;
    for (std::size_t bin = bins - 1; bin > 0; --bin) {
      box.add(boxes[bin]);
      count += counts[bin];
      const float cost = below[bin] + box.area() * blocks_for(count);
      if (count > 0 && count < part.elements.size() && cost < best.cost) best = {axis, bin, cost};
    }
  }
  return best;
}

/// The number of elements in the first of two parts; they are sorted so.
std::size_t split(const Part& part, bool by_number) {
  check_interruption();
  const Plane plane = by_number ? Plane{} : best_plane(part);
  if (plane.bin == 0) return part.elements.size() / 2;
  const Binning binning(part, plane.axis);
  const auto second =
      std::partition(part.elements.begin(), part.elements.end(),
                     [&](const Element& e) { return binning.bin_of(e) < plane.bin; });
  return static_cast<std::size_t>(second - part.elements.begin());
}

}  // namespace

bool is_crowd(Elements elements) {
  const auto has_centre_of_first = [&](const Element& e) {
    const Element& first = elements.front();
    return e.centre(0) == first.centre(0) && e.centre(1) == first.centre(1) &&
           e.centre(2) == first.centre(2);
  };
  return std::ranges::all_of(elements, has_centre_of_first);
}

std::vector<Part> split_into_children(Elements elements, bool by_number) {
  std::vector<Part> parts{Part(elements)};
  const bool splits_crowds = by_number || is_crowd(elements);
  while (parts.size() < TreeNode::most_children) {
    std::size_t largest = parts.size();
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const bool can_be_split = parts[i].elements.size() > triangles_together &&
                                (splits_crowds || !is_crowd(parts[i].elements));
      if (can_be_split &&
          (largest == parts.size() || parts[i].box.area() > parts[largest].box.area()))
        largest = i;
    }
    if (largest == parts.size()) break;
    const Elements all = parts[largest].elements;
    const std::size_t first = split(parts[largest], by_number);
    parts[largest] = Part(all.first(first));
    parts.emplace_back(all.subspan(first));
  }
  return parts;
}

namespace {

bool same_place(const WorldPoint& a, const WorldPoint& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// Of triangles whose placed corners are equal: these may have been rounded.
bool have_same_corners(const TriangleSource& source, std::uint32_t a, std::uint32_t b) {
  const auto of_a = source.world_corners(a), of_b = source.world_corners(b);
  return std::ranges::equal(of_a, of_b, same_place);
}

}  // namespace

Elements without_repetitions(Elements crowd, const PlacedTriangles& triangles,
                             const TriangleSource& source, std::vector<Repetition>& repeated) {
  std::ranges::sort(crowd, [&](const Element& a, const Element& b) {
    const auto &of_a = triangles[a.number], &of_b = triangles[b.number];
    return of_a == of_b ? a.number < b.number : of_a < of_b;
  });
  std::size_t kept = 0, first = 0;
  for (const Element& element : crowd) {
    const bool is_first = kept == 0 || triangles[crowd[first].number] != triangles[element.number];
    if (is_first) first = kept;
    if (!is_first && have_same_corners(source, crowd[first].number, element.number)) {
      repeated.push_back({crowd[first].number, element.number});
    } else {
      crowd[kept++] = element;
    }
  }
  return crowd.first(kept);
}

}  // namespace fathom::rays
