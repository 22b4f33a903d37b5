#pragma once

namespace fathom::fast {

/// Points (x, y) with left ≤ x ≤ right, top ≤ y ≤ bottom, where a function is looked at.
struct Rectangle {
  double left, right, top, bottom;
};

/// Whether c + a·x + b·y is certainly negative all over a rectangle: at the corner where it is
/// greatest it is below −error. boxes.cpp does the same for several functions at once.
/// Needs    an error that bounds that of the value as it is computed here.
inline bool is_certainly_negative(double a, double b, double c, double error,
                                  const Rectangle& over) {
  const double x = a > 0 ? over.right : over.left, y = b > 0 ? over.bottom : over.top;
  return c + a * x + b * y < -error;
}

}  // namespace fathom::fast
