#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/fast/bins/bins.h"
#include "fathom/fast/bins/tile_shape.h"
#include "fathom/lens/preimages.h"

namespace fathom::fast {

/// A rectangle of the plane z = 1 of the camera frame; empty at first.
struct PlaneBox {
  double left = 1, right = -1, top = 1, bottom = -1;

  [[nodiscard]] bool is_empty() const { return !(left <= right); }
  void add(const PlaneBox& other);
};

/// Where the rays of a lens of the plane meet the plane z = 1, for all samples of an image: in
/// binary64, each with a proved bound. Found once for a projection; frames with other poses use it
/// again.
///
/// Memory   16 bytes for each sample of the tiles.
class Places {
 public:
  /// Needs    a projection whose rays are (m, 1).
  Places(const Projection& projection, std::uint32_t width, std::uint32_t height);

  /// The samples of a tile, by Tile::index(); both NaN where there is no ray.
  struct OfTile {
    std::span<const double> x, y;
    /// |x − exact x| and |y − exact y| are at most that.
    double error;
    /// Around the samples that have a ray.
    PlaneBox box;
  };
  [[nodiscard]] OfTile of_tile(std::uint32_t tile) const {
    const std::size_t first = std::size_t{tile} * TileShape::samples;
    return {{x_.get() + first, TileShape::samples},
            {y_.get() + first, TileShape::samples},
            errors_[tile],
            boxes_[tile]};
  }
  /// Whether all of them are numbers below 2⁵⁰⁰; otherwise no image of the plane holds them.
  [[nodiscard]] bool are_usable() const { return are_usable_; }
  /// Around all samples that have a ray; the point 0 if there is none.
  [[nodiscard]] const PlaneBox& box() const { return box_; }
  [[nodiscard]] const lens::Preimages& preimages() const { return preimages_; }
  /// Whether they are those of this image.
  [[nodiscard]] bool are_of(const Projection& projection, std::uint32_t width,
                            std::uint32_t height) const {
    return projection == projection_ && width == grid_.width && height == grid_.height;
  }

 private:
  [[nodiscard]] std::size_t samples() const {
    return std::size_t{grid_.count()} * TileShape::samples;
  }

  Projection projection_;
  TileGrid grid_;
  lens::Preimages preimages_;
  std::unique_ptr<double[]> x_, y_;
  std::vector<double> errors_;
  std::vector<PlaneBox> boxes_;
  PlaneBox box_;
  bool are_usable_ = true;
};

}  // namespace fathom::fast
