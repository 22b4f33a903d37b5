#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "fathom/evaluation/bounds.h"
#include "fathom/evaluation/nearest_surface.h"
#include "fathom/evaluation/placed_cloud.h"
#include "fathom/threads/interruption.h"

namespace fathom::evaluation {
namespace {

/// The points that remain, by the cells of a grid, found by a hash of the cell: a list for each
/// value of the hash. Two cells may have the same value, which costs time only.
class RemainingPoints {
 public:
  RemainingPoints(const PlacedCloud& cloud, double density)
      : cloud_(cloud),
        density_(std::ldexp(density, static_cast<int>(-cloud.power()))),
        squared_density_(Dyadic(density) * Dyadic(density)),
        reach_(density_ + bounds::distance_error),
        cell_(2 * std::max(reach_, least_reach)),
        newest_(std::bit_ceil(std::size_t{cloud.count()}), none) {}

  /// Whether a point that remains is nearer to this one than the density.
  [[nodiscard]] bool are_near(std::uint32_t number) const {
    const Vector& p = cloud_[number];
    // Mostly one in the same cell is.
    if (are_near(number, place_of(cell_of(p)))) return true;
    Cell least = cell_of({p[0] - reach_, p[1] - reach_, p[2] - reach_});
    const Cell greatest = cell_of({p[0] + reach_, p[1] + reach_, p[2] + reach_});
    for (Cell c = least; c[0] <= greatest[0]; ++c[0])
      for (c[1] = least[1]; c[1] <= greatest[1]; ++c[1])
        for (c[2] = least[2]; c[2] <= greatest[2]; ++c[2])
          if (are_near(number, place_of(c))) return true;
    return false;
  }

  void add(std::uint32_t number) {
    std::uint32_t& newest = newest_[place_of(cell_of(cloud_[number]))];
    points_.push_back({cloud_[number], number, newest});
    newest = static_cast<std::uint32_t>(points_.size()) - 1;
  }

  [[nodiscard]] std::vector<std::uint32_t> numbers() const {
    std::vector<std::uint32_t> numbers;
    numbers.reserve(points_.size());
    for (const Remaining& point : points_) numbers.push_back(point.number);
    return numbers;
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  /// Keeps numbers of cells far below 2⁶³: coordinates are below 1.
  static constexpr double least_reach = 0x1p-40;

  using Cell = std::array<std::int64_t, 3>;

  struct Remaining {
    Vector at;
    std::uint32_t number;
    /// The one before it of the same list, or none.
    std::uint32_t before;
  };

  [[nodiscard]] Cell cell_of(const Vector& p) const {
    Cell cell;
    for (std::size_t k = 0; k < 3; ++k)
      cell[k] = static_cast<std::int64_t>(std::floor(p[k] / cell_));
    return cell;
  }

  /// Source   [SLF14] for the multipliers and shifts
  [[nodiscard]] std::size_t place_of(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t k : cell) {
      hash = (hash ^ static_cast<std::uint64_t>(k)) * 0xBF58476D1CE4E5B9U;
      hash = (hash ^ (hash >> 27U)) * 0x94D049BB133111EBU;
      hash ^= hash >> 31U;
    }
    return hash & (newest_.size() - 1);
  }

  [[nodiscard]] bool are_near(std::uint32_t number, std::size_t place) const {
    for (std::uint32_t i = newest_[place]; i != none; i = points_[i].before)
      if (are_near(number, points_[i])) return true;
    return false;
  }

  [[nodiscard]] bool are_near(std::uint32_t number, const Remaining& other) const {
    const double distance = length(minus(cloud_[number], other.at));
    if (distance + bounds::distance_error < density_) return true;
    if (distance - bounds::distance_error > density_) return false;
    return squared_distance(cloud_.world(number), cloud_.world(other.number)) < squared_density_;
  }

  const PlacedCloud& cloud_;
  double density_;
  Dyadic squared_density_;
  /// No point that is nearer than the density has a coordinate that differs by more.
  double reach_;
  double cell_;
  /// Of each list the last point.
  std::vector<std::uint32_t> newest_;
  std::vector<Remaining> points_;
};

}  // namespace

std::vector<std::uint32_t> thinned(const PlacedCloud& cloud, double density) {
  RemainingPoints remaining(cloud, density);
  OccasionalInterruption interruption;
  for (std::uint32_t number = 0; number < cloud.count(); ++number) {
    interruption();
    if (!remaining.are_near(number)) remaining.add(number);
  }
  return remaining.numbers();
}

}  // namespace fathom::evaluation
