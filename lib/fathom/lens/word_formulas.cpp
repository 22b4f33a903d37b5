#include "fathom/lens/word_formulas.h"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "fathom/lens/turn_direction.h"
#include "fathom/numeric/big_interval.h"
#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/exact_words.h"
#include "fathom/numeric/fused_multiply_add.h"

namespace fathom::lens {
namespace {

/// Sizes of a table's numbers of which no square overflows, nor loses bits.
constexpr double least_component = 0x1p-300, greatest_component = 0x1p300;
/// Angles up to π have squares below it; terms of both series then fall from the second one on.
constexpr double end_of_series = 10;
/// A series ends where its terms are below it.
constexpr double negligible = 0x1p-114;
/// The terms of a series: 10²⁷/54! < 2⁻¹⁴⁷.
constexpr std::size_t most_terms = 27;

template <bool fused>
class Formulas {
 public:
  using Word = Certified<DoubleWord<fused>>;

  explicit Formulas(const Preimages& preimages) : lens_(preimages.lens()) {
    const auto rows = preimages.plane_map();
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k) plane_[i][k] = in_words<fused>(words_of(rows[i][k]));
    if (const PolynomialStage* const stage = preimages.stage()) {
      numbers_ = stage->numbers;
      words_ = stage->numbers.in([](double x) { return exactly(x); });
    }
    if (const auto roots = root_formula(lens_))
      roots_ = converted(*roots, [](const Dyadic& x) { return in_words<fused>(words_of(x)); });
    division_ = exactly(division_term(lens_));
    if (lens_.model == LensModel::fov) omega_ = exactly(std::abs(lens_.distortion[0]));
    const auto pi = BigInterval::pi(128).ends();
    two_pi_ = exactly(2) * in_words<fused>(words_within({pi, pi, pi})[0]);
    set_series();
    const Word half = omega_ * exactly(0.5), q = half * half;
    stretch_ = alternating(sine_, q) / alternating(cosine_, q);
  }

  [[nodiscard]] std::optional<DirectionWords> of_pixel(std::uint32_t column, std::uint32_t row,
                                                       const StageStart& start) const {
    if (lens_.directions) return in_table(column, row);
    const HomogeneousPoint<Word> y = point_at(column + 0.5, row + 0.5);
    switch (entry_of(lens_.model).formula) {
      case RayFormula::plane:
      case RayFormula::angle:
        return by_stage(y, start);
      case RayFormula::root:
        if (has_stage_before_root(lens_)) return std::nullopt;
        return as_pairs(
            std::visit([&](const auto& formula) { return formula.at(y).components(); }, *roots_));
      case RayFormula::turn:
        return as_pairs(turned(y));
      case RayFormula::field_of_view:
        return as_pairs(in_field(y));
      case RayFormula::direct:
        return as_pairs(divided(y));
      case RayFormula::angle_of_sample:
        return std::nullopt;
    }
    return std::nullopt;
  }

 private:
  using Direction = std::array<Word, 3>;

  static Word exactly(double x) { return {x, 0}; }
  /// nullopt if nothing is known of a component.
  static std::optional<DirectionWords> as_pairs(const Direction& d) {
    DirectionWords words;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(d[k].error < std::numeric_limits<double>::infinity())) return std::nullopt;
      words[k] = {d[k].value, d[k].error};
    }
    return words;
  }

  void set_series() {
    Word of_cosine = exactly(1), of_sine = exactly(1);
    for (std::size_t k = 0; k < most_terms; ++k) {
      cosine_.push_back(of_cosine);
      sine_.push_back(of_sine);
      const double n = 2 * static_cast<double>(k);
      of_cosine = of_cosine / exactly((n + 1) * (n + 2));
      of_sine = of_sine / exactly((n + 2) * (n + 3));
    }
  }

  [[nodiscard]] std::optional<DirectionWords> in_table(std::uint32_t column,
                                                       std::uint32_t row) const {
    const auto d = lens_.directions->at(column, row);
    if (!d) return std::nullopt;
    DirectionWords words;
    for (std::size_t k = 0; k < 3; ++k) {
      const double size = std::abs((*d)[k]);
      if (size != 0 && !(size > least_component && size < greatest_component)) return std::nullopt;
      words[k] = {{(*d)[k], 0}, 0};
    }
    return words;
  }

  [[nodiscard]] HomogeneousPoint<Word> point_at(double u, double v) const {
    const auto row = [&](const std::array<Word, 3>& g) {
      return g[0] * exactly(u) + g[1] * exactly(v) + g[2];
    };
    return {row(plane_[0]), row(plane_[1]), row(plane_[2])};
  }

  // d = (y, 1 + k·|y|²), times c².
  [[nodiscard]] Direction divided(const HomogeneousPoint<Word>& y) const {
    return {y.a * y.c, y.b * y.c, y.c * y.c + division_ * (y.a * y.a + y.b * y.b)};
  }

  // FOV: d = (y·sin θ/θ, t·cos θ) with θ = ω|y| and t = tan(ω/2)/(ω/2).
  [[nodiscard]] Direction in_field(const HomogeneousPoint<Word>& point) const {
    const Word x = point.a / point.c, y = point.b / point.c;
    const Word q = omega_ * omega_ * (x * x + y * y);
    const Word sine_over_angle = alternating(sine_, q);
    return {x * sine_over_angle, y * sine_over_angle, stretch_ * alternating(cosine_, q)};
  }

  [[nodiscard]] std::optional<DirectionWords> by_stage(const HomogeneousPoint<Word>& y,
                                                       const StageStart& start) const {
    if (numbers_->is_double()) return std::nullopt;
    const auto m = preimage(y, start);
    if (!m) return std::nullopt;
    return as_pairs(is_plane(lens_.model) ? Direction{(*m)[0], (*m)[1], exactly(1)} : lifted(*m));
  }

  /// S(m) − y
  [[nodiscard]] std::array<Word, 2> residual(const Word& x, const Word& y,
                                             const std::array<Word, 2>& image) const {
    const StagePoint<Word> s = stage_value<Word>(*words_, x, y);
    return {s.x - image[0], s.y - image[1]};
  }

  // One step of Newton's method from m, with the Jacobian in binary64, leads to m'. With λ the
  // growth of S and r = |S(m') − y|, (S(a) − y)·(a − m') ≥ |a − m'|·(λ|a − m'| − r) > 0 for every a
  // on a circle around m' whose radius is greater than r/λ, so that S takes the value y in it
  // (Brouwer). The circle of `radius` lies in the convex part of the disc that StageStart names,
  // because m' is within `radius` of m in each coordinate; S is one to one there.
  [[nodiscard]] std::optional<std::array<Word, 2>> preimage(const HomogeneousPoint<Word>& point,
                                                            const StageStart& start) const {
    if (!(start.growth > 0)) return std::nullopt;
    const std::array<Word, 2> image{point.a / point.c, point.b / point.c};
    const auto [fx, fy] = residual(exactly(start.x), exactly(start.y), image);
    const StageJacobian<double> J = stage_jacobian(*numbers_, start.x, start.y);
    const double determinant = J.xx * J.yy - J.xy * J.yx;
    const double step_x = (J.yy * fx.value.hi - J.xy * fy.value.hi) / determinant;
    const double step_y = (J.xx * fy.value.hi - J.yx * fx.value.hi) / determinant;
    if (!(std::abs(step_x) <= start.radius && std::abs(step_y) <= start.radius))
      return std::nullopt;
    const Word x{two_sum(start.x, -step_x), 0}, y{two_sum(start.y, -step_y), 0};
    const auto [rx, ry] = residual(x, y, image);
    const double size = (std::abs(rx.value.hi) + rx.error + std::abs(ry.value.hi) + ry.error);
    const double error = size / start.growth * slack + std::numeric_limits<double>::min();
    if (!(error < start.radius)) return std::nullopt;
    return std::array{Word{x.value, error}, Word{y.value, error}};
  }

  /// Σ (−q)^k·c_k. The terms alternate and fall from the second one on, so that those left out are
  /// less than the first of them.
  /// Needs    q of 0 to end_of_series; otherwise nothing is known.
  [[nodiscard]] static Word alternating(const std::vector<Word>& c, const Word& q) {
    const double most = (q.value.hi + q.error) * slack;
    if (!(most < end_of_series)) return {};
    std::size_t terms = 1;
    double left_out = c[1].value.hi * most, power = most;
    while (left_out > negligible && terms + 1 < c.size())
      left_out = c[++terms].value.hi * (power *= most);
    Word sum = c[terms - 1];
    for (std::size_t k = terms - 1; k-- > 0;) sum = c[k] - q * sum;
    sum.error += left_out * slack;
    sum.error *= slack;
    return sum;
  }

  // (m·sin θ/θ, cos θ) with θ = |m|.
  [[nodiscard]] Direction lifted(const std::array<Word, 2>& m) const {
    const Word q = m[0] * m[0] + m[1] * m[1];
    const Word sine_over_angle = alternating(sine_, q);
    return {m[0] * sine_over_angle, m[1] * sine_over_angle, alternating(cosine_, q)};
  }

  /// Of 2π·turns: of the rest after whole quarters, which are subtracted exactly.
  [[nodiscard]] SineAndCosine<Word> of_turns(const Word& turns) const {
    const double quarters = std::nearbyint(4 * turns.value.hi);
    if (!(std::abs(quarters) < 0x1p40)) return {};
    const Word angle = (turns - exactly(quarters / 4)) * two_pi_;
    const Word q = angle * angle;
    return after_quarters<Word>(static_cast<long>(quarters),
                                {angle * alternating(sine_, q), alternating(cosine_, q)});
  }

  // Equirectangular: y in half turns.
  [[nodiscard]] Direction turned(const HomogeneousPoint<Word>& point) const {
    const Word x = point.a / point.c, y = point.b / point.c;
    const auto [sine, cosine] = of_turns(x);
    if (lens_.model == LensModel::cylindrical) return {sine, y, cosine};
    const auto [down, level] = of_turns(y * exactly(0.5));
    return {level * sine, down, level * cosine};
  }

  Lens lens_;
  /// Preimages::plane_map()
  std::array<std::array<Word, 3>, 3> plane_;
  std::optional<StageNumbers<double>> numbers_;
  std::optional<StageNumbers<Word>> words_;
  std::optional<AnyRootFormula<Word>> roots_;
  Word division_, two_pi_;
  /// |ω| of FOV, and tan(ω/2)/(ω/2).
  Word omega_, stretch_;
  /// 1/(2k)! and 1/(2k + 1)!
  std::vector<Word> cosine_, sine_;
};

FATHOM_WITH_FMA std::optional<DirectionWords> find_with_fma(const Formulas<true>& formulas,
                                                            std::uint32_t column, std::uint32_t row,
                                                            const StageStart& start) {
  return formulas.of_pixel(column, row, start);
}

}  // namespace

WordFormulas::WordFormulas(const Preimages& preimages) {
  if (processor_has_fma()) {
    find_ = [formulas = std::make_shared<const Formulas<true>>(preimages)](
                std::uint32_t column, std::uint32_t row, const StageStart& start) {
      return find_with_fma(*formulas, column, row, start);
    };
  } else {
    find_ = [formulas = std::make_shared<const Formulas<false>>(preimages)](
                std::uint32_t column, std::uint32_t row, const StageStart& start) {
      return formulas->of_pixel(column, row, start);
    };
  }
}

}  // namespace fathom::lens
