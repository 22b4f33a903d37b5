// Intervals of MPFR's numbers: they contain the exact results, and are as narrow as they can be.
#include "fathom/numeric/big_interval.h"

#include <gtest/gtest.h>

#include <random>

#include "fathom/numeric/certified_value.h"
#include "fathom/numeric/transcendental.h"

namespace fathom {
namespace {

constexpr long bits = 60;

bool contains(const BigInterval& x, const Dyadic& value) {
  const auto [low, high] = x.ends();
  return low <= value && value <= high;
}

/// Ends of every sign, zeroes among them.
std::vector<std::pair<Dyadic, Dyadic>> intervals() {
  std::vector<std::pair<Dyadic, Dyadic>> all;
  for (const double low : {-5.0, -3.0, -0.5, 0.0, 0.25, 2.0})
    for (const double high : {-5.0, -0.5, 0.0, 0.25, 2.0, 7.0})
      if (low <= high) all.emplace_back(low, high);
  return all;
}

TEST(BigInterval, MultipliesTightlyWhateverTheSigns) {
  for (const auto& [a, b] : intervals())
    for (const auto& [c, d] : intervals()) {
      const auto [low, high] = (BigInterval(a, b, bits) * BigInterval(c, d, bits)).ends();
      EXPECT_TRUE(low == std::min({a * c, a * d, b * c, b * d}));
      EXPECT_TRUE(high == std::max({a * c, a * d, b * c, b * d}));
    }
}

TEST(BigInterval, SquaresTightly) {
  for (const auto& [a, b] : intervals()) {
    const auto [low, high] = square(BigInterval(a, b, bits)).ends();
    const bool is_mixed = a < Dyadic() && b > Dyadic();
    EXPECT_TRUE(low == (is_mixed ? Dyadic() : std::min(a * a, b * b)));
    EXPECT_TRUE(high == std::max(a * a, b * b));
  }
}

TEST(BigInterval, ContainsTheExactResults) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    const auto number = [&random] {
      const Dyadic part = static_cast<double>(random()) - 0x1p63;
      return part * part * part + Dyadic(static_cast<double>(random() % 1000));
    };
    const Dyadic a = number(), b = number(), c = a + abs(number()), d = b + abs(number());
    const BigInterval x(a, c, bits), y(b, d, bits);
    EXPECT_TRUE(contains(x + y, a + b) && contains(x + y, c + d));
    EXPECT_TRUE(contains(x - y, a - d) && contains(x - y, c - b));
    EXPECT_TRUE(contains(x * y, a * b) && contains(x * y, c * d) && contains(x * y, a * d));
    EXPECT_TRUE(contains(-x, -a));
    EXPECT_TRUE(contains(square(x), a * a));
    EXPECT_TRUE(contains(sqrt(square(BigInterval(a, bits))), abs(a)));
    if (y.sign() != Sign::zero) {
      EXPECT_TRUE(contains(x / y * y, a));
    }
  }
}

TEST(BigInterval, HasTheSignOfAllItsNumbers) {
  EXPECT_EQ(BigInterval(1.0, 2.0, bits).sign(), Sign::positive);
  EXPECT_EQ(BigInterval(-2.0, -1.0, bits).sign(), Sign::negative);
  EXPECT_EQ(BigInterval(-2.0, 1.0, bits).sign(), Sign::zero);
  EXPECT_EQ(BigInterval(0.0, 1.0, bits).sign(), Sign::zero);
}

TEST(BigInterval, EnclosesCosines) {
  const auto [low, high] = cos(BigInterval(1.0, 200)).ends();
  EXPECT_LT(enclose(low).lower, 0.5403023058681398);
  EXPECT_GT(enclose(high).upper, 0.5403023058681397);
  EXPECT_TRUE(high - low < Dyadic(1.0).scaled(-190));
}

TEST(GridTrigonometry, IsNearest) {
  for (const double angle : {0.1, -0.7, 1.5, 1e-20, 3.0})
    for (const long grid : {10L, 53L, 128L}) {
      const Dyadic sine = sine_on_grid(angle, grid), cosine = cosine_on_grid(angle, grid);
      const Dyadic step = Dyadic(1.0).scaled(-grid);
      const Dyadic sum = sine * sine + cosine * cosine - Dyadic(1.0);
      EXPECT_TRUE(abs(sum) < step + step);
      EXPECT_TRUE(abs(cosine - enclose(cos(BigInterval(abs(Dyadic(angle)), 300)).centre()).lower) <=
                  step + Dyadic(0x1p-52));
      const Dyadic exact = cos(BigInterval(abs(Dyadic(angle)), 300)).centre();
      EXPECT_TRUE(abs(cosine - exact).scaled(1) <= step);
    }
  EXPECT_TRUE(sine_on_grid(0, 128) == Dyadic());
  EXPECT_TRUE(cosine_on_grid(0, 128) == Dyadic(1.0));
}

TEST(CertifiedInterval, ContainsItsEnds) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 1000; ++i) {
    const double low = static_cast<double>(random()) - 0x1p63;
    const double high = low + static_cast<double>(random() >> (random() % 64));
    const Certified<double> x = to_certified({low, high});
    const Dyadic middle = x.value;
    EXPECT_TRUE(abs(middle - low) <= Dyadic(x.error) && abs(middle - high) <= Dyadic(x.error));
  }
  EXPECT_EQ(to_certified({3, 3}).error, 0);
  EXPECT_EQ(to_certified({0x1p-1074, 0x1p-1074}).value, 0x1p-1074);
  EXPECT_EQ(certain_sign(to_certified({0, 1})), Sign::zero);
  EXPECT_EQ(certain_sign(to_certified({0.5, 1})), Sign::positive);
  EXPECT_EQ(certain_sign(to_certified({-1, -0.5})), Sign::negative);
  EXPECT_EQ(certain_sign(to_certified({-INFINITY, INFINITY})), Sign::zero);
}

}  // namespace
}  // namespace fathom
