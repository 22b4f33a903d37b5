#include "fathom/clipping/nesting.h"

#include <algorithm>
#include <optional>

#include "fathom/clipping/contacts.h"
#include "fathom/clipping/even_odd.h"
#include "fathom/numeric/errors.h"

namespace fathom::clipping {
namespace {

enum class Place { along, inside, outside };

/// Where a ring lies with respect to another, and where it crosses it if it does.
struct Placement {
  Place place = Place::along;
  std::optional<Point2<Rational>> crossing;
};

/// Both rings have their contacts entered.
Placement place_of(const Ring<Rational>& ring, const EvenOdd<Rational>& other) {
  Placement placement;
  for (std::size_t i = 0; i < ring.size() && !placement.crossing; ++i) {
    const Beside beside = other.beside(ring[i], ring[(i + 1) % ring.size()]);
    if (beside.left != beside.right) continue;
    const Place here = beside.left ? Place::inside : Place::outside;
    if (placement.place != Place::along && placement.place != here) placement.crossing = ring[i];
    placement.place = here;
  }
  return placement;
}

}  // namespace

std::vector<int> nesting_depths(const Rings<Rational>& rings, const std::string& side) {
  std::vector<int> depths(rings.size(), 0);
  if (rings.size() < 2) return depths;
  const Rings<Rational> split = enter_contacts(rings);
  for (std::size_t j = 0; j < rings.size(); ++j) {
    const Rings<Rational> ring_j{split[j]};
    const EvenOdd<Rational> other(ring_j);
    for (std::size_t i = 0; i < rings.size(); ++i) {
      if (i == j) continue;
      const Placement placement = place_of(split[i], other);
      if (placement.crossing)
        throw InputError(side + " rings " + std::to_string(std::min(i, j)) + " and " +
                         std::to_string(std::max(i, j)) + " cross at " +
                         to_text(*placement.crossing) + "; expected rings that at most touch");
      if (placement.place == Place::inside || (placement.place == Place::along && j < i))
        ++depths[i];
    }
  }
  return depths;
}

}  // namespace fathom::clipping
