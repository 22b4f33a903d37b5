#include "apps/study/clipping/beside_cgal.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <random>
#include <stdexcept>
#include <utility>

#include "apps/study/clipping/clipped_shapes.h"
#include "fathom/clipping/boolean_by_cgal.h"
#include "fathom/clipping/exact_kernel.h"
#include "fathom/clipping/rings.h"
#include "fathom/clipping/weiler_atherton.h"
#include "fathom/failures/errors.h"

namespace fathom::studies {
namespace {

using clipping::Rational;
using clipping::SetOperation;
using Ring = clipping::Ring<double>;
using Rings = clipping::Rings<double>;

struct Pair {
  Rings subject, clip;
};

Ring square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

Ring star(std::mt19937_64& random, std::size_t corners) {
  Ring ring;
  for (const auto& [x, y] : random_star(random, corners)) ring.push_back({x, y});
  return ring;
}

std::vector<Pair> stars(std::size_t corners) {
  std::mt19937_64 random(corners);
  Pair pair{{star(random, corners / 2)}, {}};
  pair.clip.push_back(star(random, corners / 2));
  return {pair};
}

/// A random ring of eight corners on the grid; drawn again until it is one.
Ring grid_ring(std::mt19937_64& random) {
  for (;;) {
    Ring ring;
    for (int i = 0; i < 8; ++i)
      ring.push_back({static_cast<double>(random() % 7), static_cast<double>(random() % 7)});
    try {
      return clipping::checked_rings(Rings{ring}, "random")[0];
    } catch (const InputError&) {
      continue;  // it meets itself
    }
  }
}

std::vector<Pair> grid(std::size_t corners) {
  std::mt19937_64 random(corners);
  std::vector<Pair> pairs;
  for (std::size_t drawn = 0; drawn < corners;) {
    Pair pair{{grid_ring(random)}, {grid_ring(random)}};
    drawn += pair.subject[0].size() + pair.clip[0].size();
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

std::vector<Pair> squares(std::size_t corners) {
  const auto a_side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(corners) / 8)));
  Pair pair;
  for (int i = 0; i < a_side * a_side; ++i) {
    const int column = i % a_side, row = i / a_side;
    const double x = 3 * column, y = 3 * row;
    pair.subject.push_back(square(x, y, 2));
    pair.clip.push_back(square(x + 1, y + 1, 2));
  }
  return {pair};
}

std::vector<Pair> nested(std::size_t corners) {
  const double n = std::floor(static_cast<double>(corners) / 4);
  Pair pair{{}, {{{1.5, 1.5}, {8 * n, 0}, {0, 8 * n}}}};
  for (double i = 0; i < n; ++i) pair.subject.push_back(square(i, i, 4 * n - 2 * i));
  return {pair};
}

std::vector<Pair> fan(std::size_t corners) {
  const double n = std::floor(static_cast<double>(corners) / 3);
  Pair pair{{}, {square(-1, -1, n / 2 + 1.5)}};
  for (double k = 0; k < n; ++k) pair.subject.push_back({{0, 0}, {n, 2 * k}, {n, 2 * k + 1}});
  return {pair};
}

std::vector<Pair> pairs_of(const std::string& kind, std::size_t corners) {
  constexpr std::pair<const char*, std::vector<Pair> (*)(std::size_t)> makers[] = {
      {"stars", stars}, {"grid", grid}, {"squares", squares}, {"nested", nested}, {"fan", fan}};
  for (const auto& [name, make] : makers)
    if (kind == name) return make(corners);
  throw std::logic_error("no kind of polygons: " + kind);
}

using Answer = std::vector<clipping::Polygon<Rational>>;
struct ExactPair {
  clipping::Rings<Rational> subject, clip;
};

/// The answers to intersection and difference on all pairs, and how long they took.
template <class Clip>
std::pair<std::vector<Answer>, double> timed(const std::vector<ExactPair>& pairs,
                                             const Clip& clip) {
  std::vector<Answer> answers;
  const auto start = std::chrono::steady_clock::now();
  for (const auto& [subject, other] : pairs)
    for (const SetOperation operation : {SetOperation::intersection, SetOperation::difference})
      answers.push_back(clip(subject, other, operation));
  const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
  return {std::move(answers), time.count()};
}

bool is_same(const Answer& a, const Answer& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
    return p.outline == q.outline && p.holes == q.holes;
  });
}

std::size_t corners_of(const clipping::Rings<Rational>& rings) {
  std::size_t corners = 0;
  for (const auto& ring : rings) corners += ring.size();
  return corners;
}

}  // namespace

const std::vector<std::string>& kinds_beside_cgal() {
  static const std::vector<std::string> kinds{"stars", "grid", "squares", "nested", "fan"};
  return kinds;
}

BesideCgal measure_beside_cgal(const std::string& kind, std::size_t corners) {
  constexpr int rounds = 3;
  constexpr double long_enough_ms = 300;
  BesideCgal row{kind};
  std::vector<ExactPair> pairs;
  for (const Pair& pair : pairs_of(kind, corners)) {
    pairs.push_back({clipping::to_exact(pair.subject), clipping::to_exact(pair.clip)});
    row.corners += corners_of(pairs.back().subject) + corners_of(pairs.back().clip);
  }
  row.pairs = pairs.size();
  for (int round = 0; round < rounds; ++round) {
    const auto [ours, ours_ms] =
        timed(pairs, [](const auto& subject, const auto& clip, SetOperation operation) {
          return clipping::weiler_atherton(subject, clip, operation);
        });
    const auto [cgal, cgal_ms] = timed(pairs, clipping::boolean_by_cgal);
    row.ours_ms = round == 0 ? ours_ms : std::min(row.ours_ms, ours_ms);
    row.cgal_ms = round == 0 ? cgal_ms : std::min(row.cgal_ms, cgal_ms);
    if (round > 0) continue;
    if (ours_ms + cgal_ms > long_enough_ms) round = rounds;
    for (std::size_t i = 0; i < ours.size(); ++i) {
      row.polygons += ours[i].size();
      row.different += is_same(ours[i], cgal[i]) ? 0 : 1;
    }
  }
  return row;
}

}  // namespace fathom::studies
