#include "fathom/area/plane/resolve.h"

#include <algorithm>
#include <mutex>
#include <numeric>

#include "fathom/numeric/double_word.h"
#include "fathom/threads/interruption.h"
#include "fathom/threads/per_thread.h"
#include "fathom/threads/threads.h"

namespace fathom::area {
namespace {

/// So few triangles are not divided any further.
constexpr std::size_t few = 32;
/// The greatest number of cuts from the whole to a part.
constexpr int most_cuts = 48;
/// A cut is in vain if the halves have many more triangles together than the part.
constexpr int cuts_in_vain = 4;
/// Cuts of parts with more triangles are in the middle: to compare cuts takes longer than it saves.
constexpr std::size_t most_to_compare = 256;
/// Cuts to compare lie at these 32nds of a side.
constexpr int least_place = 12, greatest_place = 20;
/// Parts of so few triangles are one task of a thread.
constexpr std::size_t triangles_of_task = 4096;

struct Work {
  PlanePart part;
  std::vector<std::uint32_t> triangles;
  int cuts = most_cuts;
  int in_vain = cuts_in_vain;
};

/// The middle, if binary64 has it and it lies between the ends.
std::optional<double> exact_middle(double from, double to) {
  const WordPair sum = two_sum(from, to);
  const double middle = sum.hi / 2;
  if (sum.lo != 0 || !(from < middle && middle < to)) return std::nullopt;
  return middle;
}

using TwoParts = std::optional<std::pair<PlanePart, PlanePart>>;

/// The parts on the two sides of a cut, across or upright, if it lies inside.
TwoParts parts_at(const PlanePart& part, bool across, double at) {
  PlanePart first = part, second = part;
  (across ? first.right : first.bottom) = at;
  (across ? second.left : second.top) = at;
  const bool is_inside =
      across ? part.left < at && at < part.right : part.top < at && at < part.bottom;
  return is_inside ? TwoParts(std::pair(first, second)) : std::nullopt;
}

class Resolver {
 public:
  Resolver(const PlaneMesh& mesh, PartCuts cuts) : mesh_(mesh), cuts_(cuts), finder_(mesh) {
    result_.flags.resize(mesh.size());
  }

  /// Ends the part, or adds its halves to `rest`.
  void resolve(Work work, std::vector<Work>& rest) {
    check_interruption();
    ++result_.parts;
    result_.triangles_in_parts += work.triangles.size();
    if (drop_hidden(work)) return;
    if (work.triangles.size() <= few || !cut(work, rest)) {
      for (const std::uint32_t i : work.triangles) result_.flags[i] |= is_crowded_somewhere;
      result_.crowded.push_back({work.part, std::move(work.triangles)});
    }
  }
  [[nodiscard]] const ResolvedParts& result() const { return result_; }

 private:
  /// Returns whether the part is simple or empty.
  bool drop_hidden(Work& work) {
    if (work.triangles.empty()) return true;
    const std::vector<Sheet> sheets = finder_.sheets(work.part, work.triangles);
    const Sheet* cover = nullptr;
    double farthest = std::numeric_limits<double>::infinity();
    for (const Sheet& sheet : sheets) {
      if (sheet.count == 0) continue;
      const double its = farthest_of(sheet, work);
      if (its >= farthest) continue;
      cover = &sheet;
      farthest = its;
    }
    if (!cover) return false;
    std::vector<std::uint32_t> left;
    for (const std::uint32_t i : work.triangles) {
      const bool is_behind =
          depth_of(mesh_, i).lower > farthest || depth_in(mesh_, i, work.part).lower > farthest;
      if (is_behind) {
        result_.flags[i] |= is_hidden_somewhere;
      } else {
        left.push_back(i);
      }
    }
    work.triangles = std::move(left);
    if (cover->count != 1 || work.triangles.size() != cover->members.size()) return false;
    for (const std::uint32_t i : work.triangles) add_visible(i, work.part);
    return true;
  }

  [[nodiscard]] double farthest_of(const Sheet& sheet, const Work& work) const {
    double farthest = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t member : sheet.members) {
      farthest = std::max(farthest, depth_in(mesh_, work.triangles[member], work.part).upper);
    }
    return farthest;
  }

  void add_visible(std::uint32_t i, const PlanePart& part) {
    result_.flags[i] |= is_seen_somewhere;
    if (mesh_.is_regular(i) && mesh_.box(i).is_inside(part)) return;
    result_.clips.push_back({i, part});
  }

  /// Of the cuts near the middle, the cheapest for sweeps, whose time grows with the square of the
  /// number of triangles in a part.
  [[nodiscard]] TwoParts best_cut(const Work& work) const {
    std::vector<PlaneBox> boxes;
    boxes.reserve(work.triangles.size());
    for (const std::uint32_t i : work.triangles) boxes.push_back(mesh_.box(i));
    const auto triangles_in = [&](const PlanePart& part) {
      return std::ranges::count_if(boxes, [&](const PlaneBox& box) { return !box.misses(part); });
    };
    TwoParts best = halves(work.part);
    std::ptrdiff_t least = std::numeric_limits<std::ptrdiff_t>::max();
    const auto& [left, top, right, bottom] = work.part;
    for (const bool across : {right - left >= bottom - top, right - left < bottom - top}) {
      for (int place = least_place; place <= greatest_place; ++place) {
        const double from = across ? left : top, to = across ? right : bottom;
        const TwoParts parts = parts_at(work.part, across, from + (to - from) * (place / 32.0));
        if (!parts) continue;
        const auto first = triangles_in(parts->first), second = triangles_in(parts->second);
        if (first * first + second * second >= least) continue;
        least = first * first + second * second;
        best = parts;
      }
    }
    return best;
  }

  bool cut(const Work& work, std::vector<Work>& rest) {
    if (work.cuts == 0) return false;
    const bool compares =
        cuts_ == PartCuts::through_few && work.triangles.size() <= most_to_compare;
    const TwoParts parts = compares ? best_cut(work) : halves(work.part);
    if (!parts) return false;
    Work first{parts->first, {}, work.cuts - 1, work.in_vain};
    Work second{parts->second, {}, work.cuts - 1, work.in_vain};
    for (const std::uint32_t i : work.triangles) {
      if (!misses(mesh_, i, first.part)) first.triangles.push_back(i);
      if (!misses(mesh_, i, second.part)) second.triangles.push_back(i);
    }
    if (2 * (first.triangles.size() + second.triangles.size()) > 3 * work.triangles.size()) {
      if (work.in_vain == 0) return false;
      --first.in_vain;
      --second.in_vain;
    }
    rest.push_back(std::move(first));
    rest.push_back(std::move(second));
    return true;
  }

  const PlaneMesh& mesh_;
  PartCuts cuts_;
  SheetFinder finder_;
  ResolvedParts result_;
};

void add(ResolvedParts& all, const ResolvedParts& some) {
  for (std::size_t i = 0; i < some.flags.size(); ++i) all.flags[i] |= some.flags[i];
  all.clips.insert(all.clips.end(), some.clips.begin(), some.clips.end());
  all.crowded.insert(all.crowded.end(), some.crowded.begin(), some.crowded.end());
  all.parts += some.parts;
  all.triangles_in_parts += some.triangles_in_parts;
}

}  // namespace

std::optional<std::pair<PlanePart, PlanePart>> halves(const PlanePart& part) {
  const bool across = part.right - part.left >= part.bottom - part.top;
  const auto middle =
      across ? exact_middle(part.left, part.right) : exact_middle(part.top, part.bottom);
  return middle ? parts_at(part, across, *middle) : std::nullopt;
}

ResolvedParts resolve(const PlaneMesh& mesh, const PlanePart& whole, PartCuts cuts) {
  Work all{whole, {}};
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    if (!misses(mesh, i, whole)) all.triangles.push_back(i);
  }
  // Large parts first, one after another; then small parts at the same time.
  Resolver of_large(mesh, cuts);
  std::vector<Work> large, small;
  large.push_back(std::move(all));
  while (!large.empty()) {
    Work work = std::move(large.back());
    large.pop_back();
    if (work.triangles.size() <= triangles_of_task) {
      small.push_back(std::move(work));
    } else {
      of_large.resolve(std::move(work), large);
    }
  }
  PerThread<Resolver> of_small([&] { return Resolver(mesh, cuts); });
  in_parallel(small.size(), [&](std::size_t k) {
    Resolver& resolver = of_small.local();
    std::vector<Work> rest;
    rest.push_back(std::move(small[k]));
    while (!rest.empty()) {
      Work work = std::move(rest.back());
      rest.pop_back();
      resolver.resolve(std::move(work), rest);
    }
  });
  ResolvedParts result = of_large.result();
  of_small.for_each([&](const Resolver& resolver) { add(result, resolver.result()); });
  return result;
}

}  // namespace fathom::area
