#include "apps/doctor/preference.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "fathom/attribution/robust_statistics.h"

namespace fathom::doctor {
namespace {

constexpr std::size_t least_pixels = 200;
/// A block with fewer pixels does not count.
constexpr std::size_t least_of_block = 24;
constexpr std::size_t least_blocks = 4;

/// A pixel at which two predictions differ.
struct Vote {
  double place = 0, weight = 0;
};

double weighted_median(std::vector<Vote>& votes) {
  std::ranges::sort(votes, {}, &Vote::place);
  double whole = 0;
  for (const Vote& vote : votes) whole += vote.weight;
  double sum = 0;
  for (const Vote& vote : votes) {
    sum += vote.weight;
    if (2 * sum >= whole) return vote.place;
  }
  return votes.back().place;
}

/// Three times the median difference of the predictions; a greater one, as at silhouettes, has no
/// greater weight.
double cap_of(std::vector<double> differences) {
  return 3 * attribution::median_of(differences);
}

}  // namespace

std::optional<Preference> preference(const std::vector<Pair>& first, double first_scale,
                                     const std::vector<Pair>& second, double second_scale) {
  struct Difference {
    double stored, first, second;
    std::uint32_t block;
  };
  std::vector<Difference> pixels;
  std::vector<double> sizes;
  for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
    const Pair &a = first[i], &b = second[i];
    if (!std::isfinite(a.stored) || !std::isfinite(b.stored) || !std::isfinite(a.exact) ||
        !std::isfinite(b.exact))
      continue;
    // In the unit of the stored depths, of which a correction of the second may be a part.
    const double of_second = b.exact * second_scale - (double(b.stored) - a.stored);
    const double of_first = a.exact * first_scale, size = std::abs(of_second - of_first);
    if (size <= std::max(2e-6 * of_first, 0.02 * double(a.step))) continue;
    pixels.push_back({a.stored, of_first, of_second, a.block});
    sizes.push_back(size);
  }
  if (pixels.size() < least_pixels) return std::nullopt;
  const double cap = cap_of(sizes);
  std::vector<Vote> all;
  std::map<std::uint32_t, std::vector<Vote>> blocks;
  double of_first = 0, of_second = 0;
  for (const Difference& p : pixels) {
    const double difference = p.second - p.first;
    const Vote vote{(p.stored - p.first) / difference, std::min(std::abs(difference), cap)};
    all.push_back(vote);
    blocks[p.block].push_back(vote);
    of_first += std::min(std::abs(p.stored - p.first), 2 * cap);
    of_second += std::min(std::abs(p.stored - p.second), 2 * cap);
  }
  std::size_t counted = 0, agreeing = 0;
  for (auto& [block, votes] : blocks) {
    if (votes.size() < least_of_block) continue;
    ++counted;
    if (weighted_median(votes) > 0.5) ++agreeing;
  }
  if (counted < least_blocks) return std::nullopt;
  return Preference{.place = weighted_median(all),
                    .agreeing_blocks = double(agreeing) / double(counted),
                    .residuals = of_first > 0 ? of_second / of_first : 1};
}

bool is_certain(const Preference& p) {
  return std::abs(p.place - 1) < 0.3 && p.agreeing_blocks >= 0.8 && p.residuals < 1;
}

}  // namespace fathom::doctor
