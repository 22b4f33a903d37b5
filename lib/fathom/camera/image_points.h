#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "fathom/camera/camera.h"
#include "fathom/camera/pose.h"
#include "fathom/numeric/double_word.h"

/// Between the world and the image, point by point. Each number that is returned is the exact one,
/// rounded once to binary64. Image coordinates (u, v) count as the camera's cx and cy do: the
/// centre of the pixel in column x and row y is at (x + pixel_centre, y + pixel_centre).
namespace fathom {

/// The image of a point.
struct ImageOfPoint {
  /// Pixels, u right, v down; NaN if a perspective camera has no image of the point: at or
  /// behind its eye's plane, depth ≤ 0.
  double u = 0, v = 0;
  /// Planar depth in scene units.
  double depth = 0;
};

/// Source   docs/specification.md, section 2.
/// Needs    a valid camera and finite numbers.
/// Fails    UsageError for a lens that bends rays.
ImageOfPoint project(const Camera& camera, const std::array<double, 3>& world);

/// The rays of a camera's image and their points: what does not depend on the point is computed
/// once.
class ImageRays {
 public:
  /// Needs    a valid camera.
  /// Fails    UsageError for a lens that bends rays.
  ImageRays(const Camera& camera, PointFrame frame);

  /// The point at (u, v) with this planar depth, in scene units.
  /// Needs    finite numbers.
  [[nodiscard]] std::array<double, 3> point(double u, double v, double depth) const;

  /// The vector of the pixel in column x and row y. Perspective: the direction of its ray, along
  /// which planar depth grows by 1. Orthographic: the origin of its ray, at depth 0.
  [[nodiscard]] std::array<double, 3> of_pixel(std::uint32_t x, std::uint32_t y) const;

 private:
  [[nodiscard]] double exactly_of_pixel(std::size_t k, double x, double y) const;

  /// Coordinates of the world or camera frame as numerators over `denominator`:
  ///   point(u, v, d) = (U·(u − cx)·w + V·(v − cy)·w + D·d + O) / denominator
  /// with w = d (perspective) or 1 (orthographic).
  std::array<Dyadic, 3> U_, V_, D_, O_;
  Dyadic denominator_;
  /// u − cx and v − cy of the top left pixel's centre.
  Dyadic first_x_, first_y_;
  double cx_, cy_;
  bool perspective_;
  /// of_pixel() as x·across + y·down + start, in double-words.
  struct Line {
    WordPair across, down, start;
  };
  std::array<Line, 3> lines_;
};

/// The camera with another size of its image that shows the same view up to the edges: the image is
/// scaled by width / camera.width and height / camera.height, about its top left corner rather than
/// the centre of a pixel.
/// Exact    focal lengths, skew and principal point are each rounded once; all else stays.
/// Fails    InputError for a size of 0.
Camera resized(const Camera& camera, std::uint32_t width, std::uint32_t height);

/// resized() to factor·width and factor·height, products of binary64, each rounded to a whole
/// number, ties to even, at least 1.
/// Fails    UsageError unless the factor is a positive number and the sides have at most 2³² − 1
///          pixels.
Camera scaled(const Camera& camera, double factor);

}  // namespace fathom
