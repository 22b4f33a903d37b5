#pragma once

#include <cmath>
#include <cstdint>

#include "fathom/clipping/exact_kernel.h"

/// The arithmetics in which scan conversion runs. Number is one of
///   Exact    rational numbers, nothing rounded;
///   double   every operation rounded to binary64;
///   float    every operation rounded to binary32.
namespace fathom::pipeline {

using Exact = clipping::Rational;

/// The greatest integer not above x; |x| < 2⁶³.
inline std::int64_t floor_of(double x) {
  return static_cast<std::int64_t>(std::floor(x));
}
inline std::int64_t floor_of(float x) {
  return static_cast<std::int64_t>(std::floor(x));
}
std::int64_t floor_of(const Exact& x);

/// The least integer not below x; |x| < 2⁶³.
template <class Number>
std::int64_t ceiling_of(const Number& x) {
  return -floor_of(Number(-x));
}

/// The integer nearest to x; at a tie the greater one. Correct in every arithmetic: x − ⌊x⌋ may be
/// rounded, but ½ is a number of each, and rounding is monotone.
template <class Number>
std::int64_t nearest_integer(const Number& x) {
  const std::int64_t below = floor_of(x);
  return Number(x - Number(below)) * Number(2) >= Number(1) ? below + 1 : below;
}

/// An integer in an arithmetic; floating point rounds it once.
template <class Number>
Number number_of(std::int64_t i) {
  return Number(i);
}

/// The centre i + ½ of column or row i.
template <class Number>
Number centre_of(std::int64_t i) {
  return Number(Number(i) + Number(1) / Number(2));
}

/// A number that was read, in an arithmetic; binary32 rounds it once.
template <class Number>
Number number_from(double x) {
  return static_cast<Number>(x);
}

inline double to_binary64(double x) {
  return x;
}
inline double to_binary64(float x) {
  return static_cast<double>(x);
}
inline double to_binary64(const Exact& x) {
  return clipping::to_binary64(x);
}

/// 128-bit integers: products of differences of coordinates below 2⁶² are exact in them.
__extension__ using Int128 = __int128;

/// ⌊a / b⌋ for b > 0.
constexpr Int128 floor_quotient(Int128 a, Int128 b) {
  const Int128 q = a / b;
  return a % b < 0 ? q - 1 : q;
}

}  // namespace fathom::pipeline
