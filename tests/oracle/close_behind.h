#pragma once

#include "tests/oracle/clipped_polygon.h"

/// The slow answer to which triangles lie close behind visible ones: pixel by pixel, whatever hides
/// a triangle is cut out of it, edge by edge, in GMP's own rational numbers.
namespace fathom::oracle {

/// Where one triangle is visible and another is behind it or equally deep.
struct Behind {
  std::uint32_t visible = 0, behind = 0;
  /// In one pixel: convex parts, each with an area.
  struct InPixel {
    int x = 0, y = 0;
    std::vector<Polygon> parts;
  };
  std::vector<InPixel> pixels;

  /// Whether D_behind − D_visible is below a limit, or at most that if `closed`, at a point of the
  /// parts or of their rims.
  [[nodiscard]] bool reaches(const Q& limit, bool closed) const;
  /// Whether D_behind − D_visible is at most the limit over an area of a pixel.
  [[nodiscard]] bool is_close(const InPixel& pixel, const Q& limit) const;

  bool perspective = true;
  std::array<Q, 3> visible_key, behind_key;

 private:
  [[nodiscard]] Q excess(const Point& p, const Q& limit) const;
  [[nodiscard]] bool reaches(const Polygon& part, const Q& limit, bool closed) const;
  [[nodiscard]] bool is_constantly(const Polygon& part, const Q& limit) const;
};

/// All of them, in the order of their numbers, whatever corners they share. Where `way` is not 0,
/// there are only triangles that turn that way in the image.
std::vector<Behind> behind_visible(const Areas& areas, bool perspective, int width, int height,
                                   int way);

}  // namespace fathom::oracle
