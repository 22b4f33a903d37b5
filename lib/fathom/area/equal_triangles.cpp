#include "fathom/area/equal_triangles.h"

#include <algorithm>
#include <array>

namespace fathom::area {
namespace {

using Corners = std::array<WorldPoint, 3>;

bool same_place(const WorldPoint& a, const WorldPoint& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

/// The same whichever corner comes first.
std::size_t hash_of(const Corners& corners) {
  std::size_t sum = 0;
  for (const WorldPoint& p : corners) {
    std::size_t hash = 0;
    for (const Dyadic* x : {&p.x, &p.y, &p.z}) hash = hash * 31 + fathom::hash_of(*x);
    sum += hash ^ hash >> 29;
  }
  return sum;
}

bool have_same_corners(const Corners& a, Corners b) {
  for (int turn = 0; turn < 3; ++turn) {
    if (std::equal(a.begin(), a.end(), b.begin(), same_place)) return true;
    std::rotate(b.begin(), b.begin() + 1, b.end());
  }
  return false;
}

}  // namespace

bool EqualTriangles::is_first(std::uint32_t number) {
  const Corners corners = triangles_.world_corners(number);
  const std::size_t hash = hash_of(corners);
  if (2 * count_ >= table_.size()) grow();
  std::size_t place = place_of(hash);
  for (; table_[place].number; place = (place + 1) % table_.size()) {
    const auto& [other_hash, other] = table_[place];
    if (other_hash == hash && have_same_corners(triangles_.world_corners(*other), corners))
      return false;
  }
  table_[place] = {hash, number};
  ++count_;
  return true;
}

/// Where the search for a hash begins: its best mixed bits after a multiplication by 2⁶⁴ over the
/// golden ratio.
std::size_t EqualTriangles::place_of(std::size_t hash) const {
  return (std::uint64_t{hash} * 0x9e3779b97f4a7c15U >> 32U) % table_.size();
}

void EqualTriangles::grow() {
  std::vector<First> before(2 * table_.size());
  before.swap(table_);
  for (const First& first : before) {
    if (!first.number) continue;
    std::size_t place = place_of(first.hash);
    while (table_[place].number) place = (place + 1) % table_.size();
    table_[place] = first;
  }
}

}  // namespace fathom::area
