#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "fathom/camera/direction_table.h"
#include "fathom/camera/lens_model.h"

namespace fathom {

/// What a camera has beside fx, fy, cx, cy and skew (specification, section 2): how its lens bends
/// rays. Every number is the real number that it denotes. Valid if find_fault() finds nothing.
struct Lens {
  LensModel model = LensModel::pinhole;
  /// The numbers of entry_of(model).distortion, in this order; those that a model lacks are 0.
  std::array<double, 14> distortion{};
  /// Rays end there: |m| of a model of the plane, else the angle to the z axis in radians.
  double max_radius = std::numeric_limits<double>::infinity();
  /// Of the model TABLE: the directions of the pixels. Copies of a lens share them.
  std::shared_ptr<const DirectionTable> directions;

  /// Tables of directions are equal if their numbers are.
  friend bool operator==(const Lens& a, const Lens& b);
};

/// The fault of a lens, in one line, or nothing if all numbers are finite (max_radius may be +∞),
/// those that the model lacks are 0, |tauX| and |tauY| are less than π/2, max_radius > 0, and the
/// model TABLE, and no other, has a table of directions.
std::optional<std::string> find_fault(const Lens& lens);

/// The same lens by a model that has fx and fy, if its own has one focal length for both.
Lens with_two_focal_lengths(Lens lens);

/// Whether the lens bends nothing and ends nowhere: a pinhole.
bool is_pinhole(const Lens& lens);

}  // namespace fathom
