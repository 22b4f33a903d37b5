#include "fathom/lens/direction_words.h"

#include <cmath>
#include <limits>

#include "fathom/lens/elimination.h"
#include "fathom/numeric/certified_rounding.h"
#include "fathom/numeric/exact_words.h"
#include "fathom/numeric/fused_multiply_add.h"

namespace fathom::lens {
namespace {

using PointWords = HomogeneousPoint<Certified<WordPair>>;

/// Finds the root of F in double-words.
template <bool fused>
class WordSearch {
 public:
  using Word = DoubleWord<fused>;

  WordSearch(const PolynomialStage& stage, const PointWords& y)
      : numbers_(stage.numbers.in([](double x) {
          return Certified<Word>{x, 0};
        })),
        y_{quotient(in_words<fused>(y.a), in_words<fused>(y.c)),
           quotient(in_words<fused>(y.b), in_words<fused>(y.c)),
           {1.0, 0}} {}

  [[nodiscard]] std::optional<DirectionWords> find(const Interval& q) const {
    const Word root = root_in(q);
    for (const double width : {0x1p-86, 0x1p-76, 0x1p-66}) {
      const double radius = width * root.hi;
      if (!is_root_within(root, radius, q)) continue;
      const auto [x, y, z] = eliminate(numbers_, y_, {root, radius * slack}).direction;
      if (certain_sign(z.value, z.error) != 1) continue;
      return DirectionWords{{{x.value, x.error}, {y.value, y.error}, {z.value, z.error}}};
    }
    return std::nullopt;
  }

 private:
  [[nodiscard]] Certified<Word> value_of_f(const Word& q) const {
    return eliminate(numbers_, y_, {q, 0}).f;
  }

  /// Newton's steps with the slope of the secant, from the middle: q is so narrow that two of them
  /// lose what double-words have.
  [[nodiscard]] Word root_in(const Interval& q) const {
    const Word low = q.lower, high = q.upper;
    const Word slope = (value_of_f(high).value - value_of_f(low).value) / (high - low);
    Word root = q.lower / 2 + q.upper / 2;
    for (int step = 0; step < 2; ++step) root = root - value_of_f(root).value / slope;
    return root;
  }

  /// Whether F has its root between root − radius and root + radius, as rounded to double-words,
  /// which both lie in q.
  [[nodiscard]] bool is_root_within(const Word& root, double radius, const Interval& q) const {
    const Word low = root - radius, high = root + radius;
    if (!(low.hi > q.lower && high.hi < q.upper)) return false;
    const Certified<Word> at_low = value_of_f(low), at_high = value_of_f(high);
    return certain_sign(at_low.value, at_low.error) == -1 &&
           certain_sign(at_high.value, at_high.error) == 1;
  }

  StageNumbers<Certified<Word>> numbers_;
  HomogeneousPoint<Certified<Word>> y_;
};

std::optional<DirectionWords> find_words(const PolynomialStage& stage, const PointWords& y,
                                         const Interval& q) {
  return WordSearch<false>(stage, y).find(q);
}

FATHOM_WITH_FMA std::optional<DirectionWords> find_words_by_fma(const PolynomialStage& stage,
                                                                const PointWords& y,
                                                                const Interval& q) {
  return WordSearch<true>(stage, y).find(q);
}

}  // namespace

DirectionWords words_of(const ExactVector3& direction) {
  return {words_of(direction[0]), words_of(direction[1]), words_of(direction[2])};
}

DirectionWords words_within(const std::array<DyadicInterval, 3>& direction) {
  DirectionWords result;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [low, high] = direction[k];
    result[k] = words_of(low);
    constexpr double infinity = std::numeric_limits<double>::infinity();
    result[k].error = std::nextafter(result[k].error + enclose(high - low).upper, infinity);
  }
  return result;
}

std::optional<DirectionWords> words_of_preimage(const PolynomialStage& stage,
                                                const DistortedPoint& y, const Interval& q) {
  static const bool fused = processor_has_fma();
  const PointWords point = y.in([](const Dyadic& x) { return words_of(x); });
  return fused ? find_words_by_fma(stage, point, q) : find_words(stage, point, q);
}

}  // namespace fathom::lens
