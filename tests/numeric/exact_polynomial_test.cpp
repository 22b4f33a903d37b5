// Polynomials made of known roots: counted, isolated, and the bound on values that are not 0.
#include "fathom/numeric/exact_polynomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "fathom/numeric/big_interval.h"

namespace fathom {
namespace {

/// x − root
ExactPolynomial factor(double root) {
  return ExactPolynomial::variable() - ExactPolynomial(root);
}

/// x² + 2bx + b² + c², without real roots.
ExactPolynomial without_roots(double b, double c) {
  const ExactPolynomial x = ExactPolynomial::variable() + ExactPolynomial(b);
  return x * x + ExactPolynomial(c * c);
}

TEST(ExactPolynomial, IsARing) {
  const ExactPolynomial x = ExactPolynomial::variable(), p = factor(2) * factor(-3);
  EXPECT_TRUE((p - p).is_zero());
  EXPECT_EQ((p - x * x).degree(), 1);
  EXPECT_EQ(ExactPolynomial(0.0).degree(), -1);
  EXPECT_TRUE(p.at(5.0) == Dyadic(24.0));
  EXPECT_TRUE(p.derivative().at(5.0) == Dyadic(11.0));
  EXPECT_EQ((-p).sign_at_infinity(), Sign::negative);
}

TEST(ExactPolynomial, IsMadePrimitive) {
  const ExactPolynomial p = primitive(ExactPolynomial({Dyadic(-1.5), Dyadic(), Dyadic(0.375)}));
  ASSERT_EQ(p.degree(), 2);
  EXPECT_TRUE(p.coefficients()[0] == Dyadic(-4.0));
  EXPECT_TRUE(p.coefficients()[1].is_zero());
  EXPECT_TRUE(p.coefficients()[2] == Dyadic(1.0));
}

TEST(SturmChain, CountsRootsOnceEach) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 200; ++i) {
    ExactPolynomial p(random() % 2 == 0 ? 3.0 : -0.25);
    std::vector<double> roots;
    for (int k = static_cast<int>(random() % 6); k > 0; --k) {
      const double root = (static_cast<int>(random() % 41) - 20) / 8.0;
      for (int power = 1 + static_cast<int>(random() % 3); power > 0; --power) p = p * factor(root);
      roots.push_back(root);
    }
    if (random() % 2 == 0) p = p * without_roots(0.5, 0.25) * without_roots(0.5, 0.25);
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    const SturmChain chain(p);
    const auto count = [&roots](double low, double high) {
      return std::count_if(roots.begin(), roots.end(),
                           [&](double root) { return root > low && root <= high; });
    };
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(chain.real_roots(), count(-infinity, infinity));
    EXPECT_EQ(chain.positive_roots(), count(0, infinity));
    for (const double x : {0.125, 0.5, 0.51, 1.0, 2.5}) {
      EXPECT_EQ(chain.positive_roots_up_to(x), count(0, x)) << x;
    }
  }
}

TEST(ExactPolynomial, IsolatesItsLeastPositiveRoot) {
  const ExactPolynomial x = ExactPolynomial::variable();
  EXPECT_EQ(greatest_before_positive_root(factor(1) * factor(3)), std::nextafter(1.0, 0));
  EXPECT_EQ(greatest_before_positive_root(factor(3) * factor(3) * factor(-1)),
            std::nextafter(3.0, 0));
  EXPECT_EQ(greatest_before_positive_root(factor(-1) * without_roots(-2, 1)), std::nullopt);
  EXPECT_EQ(greatest_before_positive_root(x * x - ExactPolynomial(2.0)),
            std::nextafter(std::sqrt(2.0), 0));
  EXPECT_EQ(greatest_before_positive_root(x * x - ExactPolynomial(3.0)), std::sqrt(3.0));
  EXPECT_EQ(greatest_before_positive_root(factor(5e-324)), 0);
  EXPECT_EQ(greatest_before_positive_root(ExactPolynomial(1e-300) * x - ExactPolynomial(1e300)),
            std::numeric_limits<double>::max());
}

// At √2 = q, h = a·q − b has the least values at the best quotients b/a, Pell's: |h| is about
// 1/(2√2·a). The bound has to be below it, and not by more than some factor.
TEST(ExactPolynomial, BoundsItsValuesAtRoots) {
  const ExactPolynomial x = ExactPolynomial::variable();
  const ExactPolynomial f = x * x - ExactPolynomial(2.0);
  Dyadic a = 1.0, b = 1.0;
  for (int i = 0; i < 200; ++i) {
    const ExactPolynomial h = ExactPolynomial(a) * x - ExactPolynomial(b);
    const long bound = zero_bound_bits(f, h);
    const BigInterval q = sqrt(BigInterval(2.0, 2000));
    const BigInterval value =
        horner(std::vector<BigInterval>{BigInterval(-b, 2000), BigInterval(a, 2000)}, q);
    const auto [low, high] = square(value).ends();
    EXPECT_TRUE(low > Dyadic(1.0).scaled(-2 * bound)) << i;
    EXPECT_LT(bound, 8 + a.top() + 4) << i;
    const Dyadic next = a + b;
    b = a + a + b;
    a = next;
  }
}

}  // namespace
}  // namespace fathom
