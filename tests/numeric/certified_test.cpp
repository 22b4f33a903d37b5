#include "fathom/numeric/certified.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/numeric/random_numbers.h"

namespace fathom {
namespace {

using checks::any_double;
using checks::few_bits;

/// det by Leibniz in GMP rationals, sharing nothing with the code under test.
int sign_of_leibniz(const double (&m)[3][3]) {
  constexpr int permutations[6][4] = {{0, 1, 2, 1},  {1, 2, 0, 1},  {2, 0, 1, 1},
                                      {0, 2, 1, -1}, {1, 0, 2, -1}, {2, 1, 0, -1}};
  mpq_t sum, term, factor;
  mpq_inits(sum, term, factor, nullptr);
  for (const auto& p : permutations) {
    mpq_set_si(term, p[3], 1);
    for (int i = 0; i < 3; ++i) {
      mpq_set_d(factor, m[i][p[i]]);
      mpq_mul(term, term, factor);
    }
    mpq_add(sum, sum, term);
  }
  const int sign = mpq_sgn(sum);
  mpq_clears(sum, term, factor, nullptr);
  return sign;
}

Sign sign_of(const double (&m)[3][3], TierCounts& counts) {
  const auto row = [&](int i) { return ExactVector3{m[i][0], m[i][1], m[i][2]}; };
  return sign_of_determinant(row(0), row(1), row(2), counts);
}

TEST(SignOfDeterminant, AgreesWithLeibnizAndReachesBothTiers) {
  std::mt19937_64 random(21);
  TierCounts counts;
  int zeros = 0;
  for (int i = 0; i < 30000; ++i) {
    double m[3][3];
    for (auto& row : m) {
      for (double& x : row) x = i % 2 ? few_bits(random) : any_double(random);
    }
    if (i % 10 == 1) {  // a dependent row, then one ulp beside it
      for (int k = 0; k < 3; ++k) m[2][k] = m[0][k] + m[1][k];
      if (i % 20 == 1) m[2][0] = std::nextafter(m[2][0], 1e9);
    }
    const int expected = sign_of_leibniz(m);
    zeros += expected == 0;
    ASSERT_EQ(static_cast<int>(sign_of(m, counts)), expected);
  }
  EXPECT_GT(zeros, 1000);
  EXPECT_GT(counts.interval, 5000U);
  EXPECT_GT(counts.exact, 1000U);
  EXPECT_EQ(counts.interval + counts.exact, 30000U);
}

TEST(SignOfDeterminant, AClearCaseNeedsNoExactArithmetic) {
  TierCounts counts;
  const double identity[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_EQ(sign_of(identity, counts), Sign::positive);
  EXPECT_EQ(counts.interval, 1U);
  EXPECT_EQ(counts.exact, 0U);
}

TEST(Orientation, IsExactForCollinearPointsAndTheirNeighbours) {
  EXPECT_EQ(orientation({0, 0}, {1, 0}, {0, 1}), Sign::positive);
  EXPECT_EQ(orientation({0, 0}, {3, 3}, {1e-300, 1e-300}), Sign::zero);
  EXPECT_EQ(orientation({0, 0}, {12, 12}, {0.5, std::nextafter(0.5, 1)}), Sign::positive);
  EXPECT_EQ(orientation({0, 0}, {12, 12}, {0.5, std::nextafter(0.5, 0)}), Sign::negative);
}

TEST(LinearForm, SignsAreExactAndEnclosuresContain) {
  std::mt19937_64 random(22);
  TierCounts counts;
  for (int i = 0; i < 30000; ++i) {
    const auto number = [&] { return i % 2 ? few_bits(random) : any_double(random); };
    const double u = static_cast<double>(random() % 2048) + 0.5;
    const double v = static_cast<double>(random() % 2048) + 0.5;
    Dyadic l_u = number(), l_v = number(), l_w = number();
    if (i % 3 == 0) l_w = -(l_u * Dyadic(u) + l_v * Dyadic(v));  // exactly on the line
    if (i % 9 == 0) l_w += Dyadic(5e-324);                       // and just off it
    const LinearForm form({l_u, l_v, l_w});
    const Dyadic exact = l_u * Dyadic(u) + l_v * Dyadic(v) + l_w;
    ASSERT_EQ(form.at(u, v), exact);
    ASSERT_EQ(form.sign_at(u, v, counts), exact.sign());
    const Interval hull = form.enclose_at(u, v);
    if (std::isfinite(hull.lower)) {
      ASSERT_LE(Dyadic(hull.lower), exact);
    }
    if (std::isfinite(hull.upper)) {
      ASSERT_GE(Dyadic(hull.upper), exact);
    }
  }
  EXPECT_GT(counts.interval, 1000U);
  EXPECT_GT(counts.exact, 1000U);
}

TEST(Quotient, ContainsEveryQuotient) {
  std::mt19937_64 random(23);
  for (int i = 0; i < 20000; ++i) {
    const double n = any_double(random), d = any_double(random);
    if (d == 0) continue;
    const Interval q = quotient(Interval{n, n}, Interval{d, d});
    if (std::isfinite(q.lower)) {
      ASSERT_FALSE(Ratio(Dyadic(n), Dyadic(d)) < Ratio(Dyadic(q.lower)));
    }
    if (std::isfinite(q.upper)) {
      ASSERT_FALSE(Ratio(Dyadic(q.upper)) < Ratio(Dyadic(n), Dyadic(d)));
    }
  }
  const Interval unknown = quotient(Interval{1, 2}, Interval{-1, 1});
  EXPECT_EQ(unknown.lower, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(unknown.upper, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace fathom
