#include "fathom/lens/polynomial_stage.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "fathom/lens/definiteness.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom::lens {
namespace {

using Verdict = Definiteness::Verdict;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double greatest_number = std::numeric_limits<double>::max();

// With f(r) = r·L(r²) the eigenvalues of the Jacobian are f' and f/r, and f/r is positive as long
// as f' is. D²·f' is a polynomial in q.
double radial_disc(const Definiteness& stage) {
  return greatest_before_positive_root(stage.radial_slope() * stage.denominator())
      .value_or(infinity);
}

/// Finds the disc of a stage with tangential or prism terms.
class DiscSearch {
 public:
  explicit DiscSearch(const Definiteness& stage)
      : stage_(stage),
        inner_(stage.inner_bound().value_or(0)),
        outer_(stage.outer_bound().value_or(infinity)),
        pole_(greatest_before_positive_root(stage.denominator()).value_or(infinity)) {}

  /// A candidate is the last circle before the first one that is not regular; then the ring inside
  /// it is looked at as a whole.
  [[nodiscard]] double run() const {
    if (inner_ == 0) return 0;
    if (inner_ >= pole_) return pole_;
    double candidate = first_candidate();
    while (candidate > inner_) {
      const Definiteness::RingVerdict ring = verdict_on(candidate);
      if (ring.verdict == Verdict::holds) return candidate;
      const double singular = ring.verdict == Verdict::fails ? enclose(ring.q).upper : infinity;
      if (ring.verdict == Verdict::unknown || stage_.holds_on_circle(singular))
        return greatest_proved_below(candidate);
      candidate = last_regular(inner_, singular);
    }
    return inner_;
  }

 private:
  [[nodiscard]] Definiteness::RingVerdict verdict_on(double candidate) const {
    const double end = std::min(candidate, outer_);
    if (end <= inner_) return {Verdict::holds, {}};
    return stage_.holds_on_ring(inner_, std::min(end, greatest_number));
  }

  /// Circles are tried at steps of the factor 2.
  [[nodiscard]] double first_candidate() const {
    const double end = std::min({pole_, outer_, greatest_number});
    double regular = inner_;
    while (regular < end) {
      const double q = std::min(2 * regular, end);
      if (!stage_.holds_on_circle(q)) return last_regular(regular, q);
      regular = q;
    }
    if (pole_ < infinity) return pole_;
    return outer_ < infinity ? infinity : greatest_number;
  }

  /// The regular one of two neighbours in binary64. Between the ends, circles need not be regular
  /// up to one and singular from then on: the ring shows that.
  [[nodiscard]] double last_regular(double regular_end, double singular_end) const {
    auto regular = std::bit_cast<std::uint64_t>(regular_end);
    auto singular = std::bit_cast<std::uint64_t>(singular_end);
    while (singular - regular > 1) {
      const std::uint64_t between = regular + (singular - regular) / 2;
      const bool holds = stage_.holds_on_circle(std::bit_cast<double>(between));
      (holds ? regular : singular) = between;
    }
    return std::bit_cast<double>(regular);
  }

  /// Discs that are smaller by 2⁻⁴⁸, 2⁻²⁴, …, ½ of the candidate.
  [[nodiscard]] double greatest_proved_below(double candidate) const {
    for (int power = -48; power < 0; power /= 2) {
      const double q = std::min(candidate, greatest_number) * (1 - std::ldexp(1.0, power));
      if (stage_.holds_on_circle(q) && verdict_on(q).verdict == Verdict::holds) return q;
    }
    return inner_;
  }

  const Definiteness& stage_;
  double inner_, outer_, pole_;
};

double disc_of_single(const StageNumbers<double>& numbers) {
  const Definiteness stage(as_polynomials(numbers));
  return is_radial(numbers) ? radial_disc(stage) : DiscSearch(stage).run();
}

/// In the disc of the first stage q·N₁² grows with q.
double disc_of_double(const StageNumbers<double>& numbers) {
  const double first = disc_of_single(first_stage(numbers));
  const double second = disc_of_single(second_stage(numbers));
  if (second == infinity) return first;
  const StageNumbers<Dyadic> exact = numbers.in([](double x) { return Dyadic(x); });
  const auto is_within = [&](double q) {
    return image_of_circle(exact, Dyadic(q)) <= Dyadic(second);
  };
  const double last = std::min(first, greatest_number);
  if (is_within(last)) return first;
  auto inside = std::bit_cast<std::uint64_t>(0.0), outside = std::bit_cast<std::uint64_t>(last);
  while (outside - inside > 1) {
    const std::uint64_t between = inside + (outside - inside) / 2;
    (is_within(std::bit_cast<double>(between)) ? inside : outside) = between;
  }
  return std::bit_cast<double>(inside);
}

}  // namespace

double greatest_disc(const StageNumbers<double>& numbers) {
  const StandardArithmetic standard;
  return numbers.is_double() ? disc_of_double(numbers) : disc_of_single(numbers);
}

namespace {

/// Of OMNI: the greatest binary64 number q such that (ξ² − 1)·q < 1; +∞ if there is no bound.
double disc_of_root(double xi) {
  const Dyadic slope = Dyadic(xi) * Dyadic(xi) - Dyadic(1.0);
  if (slope.sign() != Sign::positive) return infinity;
  return greatest_before_positive_root(ExactPolynomial({Dyadic(1.0), -slope})).value_or(infinity);
}

class RecentDiscs {
 public:
  double of(const StageNumbers<double>& numbers) {
    const auto found = std::ranges::find(entries_, numbers, &Entry::numbers);
    if (found != entries_.end()) return found->disc;
    Entry entry{numbers, greatest_disc(numbers)};
    return (entries_[next_++ % entries_.size()] = std::move(entry)).disc;
  }

 private:
  struct Entry {
    StageNumbers<double> numbers;
    double disc;
  };
  std::array<Entry, 16> entries_{};  // no stage is without a numerator
  std::size_t next_ = 0;
};
thread_local RecentDiscs recent_discs;

double disc_of(const Lens& lens, const StageNumbers<double>& stage) {
  const double of_stage = recent_discs.of(stage);
  if (lens.model == LensModel::omni) return std::min(of_stage, disc_of_root(lens.distortion[0]));
  return is_plane(lens.model) ? of_stage : std::min(of_stage, end_of_angles);
}

}  // namespace

PolynomialStage::PolynomialStage(const Lens& lens)
    : numbers(stage_of(lens)),
      certified(numbers.in([](double x) {
        return Certified<double>{x, 0};
      })),
      exact(numbers.in([](double x) { return Dyadic(x); })),
      disc(disc_of(lens, numbers)) {
  if (std::isfinite(disc)) limit = disc;
  if (!std::isfinite(lens.max_radius) || lens.model == LensModel::omni) return;
  const Dyadic square = Dyadic(lens.max_radius) * Dyadic(lens.max_radius);
  if (!limit || square < *limit) limit = square;
}

}  // namespace fathom::lens
