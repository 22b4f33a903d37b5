#include "fathom/rays/split_elements.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "fathom/threads/interruption.h"

namespace fathom::rays {
namespace {

/// How many blocks so many triangles fill.
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

}  // namespace fathom::rays
