#include "fathom/numeric/ratio_sum.h"

#include <array>
#include <memory>
#include <optional>
#include <utility>

namespace fathom {
namespace {

/// So few terms are added exactly at once.
constexpr std::size_t few_terms = 4;
/// The bits for which an enclosure by EnclosedSum is asked; the exact number answers for more.
constexpr long enclosed_bits = 96;

Enclosure enclosure_of(const std::vector<Ratio>& terms) {
  EnclosedSum sum;
  for (const Ratio& term : terms) sum.add(term);
  return sum.get();
}

/// A number within `around` that `exactly` computes.
template <class Exactly>
Real real_within(Enclosure around, const Exactly& exactly) {
  return {[around = std::move(around), exactly](long bits) {
            if (bits <= enclosed_bits) return around;
            const Ratio value = exactly();
            return Enclosure{value, value};
          },
          [exactly]() -> std::optional<Ratio> { return exactly(); }};
}

}  // namespace

Real real_sum(std::vector<Ratio> terms) {
  if (terms.size() <= few_terms) return sum_of(std::move(terms));
  Enclosure around = enclosure_of(terms);
  return real_within(std::move(around), [sum = std::make_shared<const std::vector<Ratio>>(
                                             std::move(terms))] { return sum_of(*sum); });
}

Real real_quotient(std::vector<Ratio> over, std::vector<Ratio> under) {
  const Enclosure above = enclosure_of(over), below = enclosure_of(under);
  const auto exactly = [sums = std::make_shared<const std::array<std::vector<Ratio>, 2>>(
                            std::array{std::move(over), std::move(under)})] {
    return quotient(sum_of((*sums)[0]), sum_of((*sums)[1]));
  };
  // Terms may be too small for the enclosure's resolution.
  if (below.low.sign() != Sign::positive) return exactly();
  return real_within(quotient(above, below), exactly);
}

Enclosure quotient(const Enclosure& over, const Enclosure& under) {
  const bool falls = over.low.sign() == Sign::negative;
  const bool rises = over.high.sign() == Sign::positive;
  return {quotient(over.low, falls ? under.low : under.high),
          quotient(over.high, rises ? under.low : under.high)};
}

}  // namespace fathom
