#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fathom/camera/camera.h"
#include "fathom/fast/bins/bins.h"
#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/lenses/direction_places.h"
#include "fathom/fast/lenses/view_axes.h"
#include "fathom/lens/preimages.h"

namespace fathom::fast {

/// Where the rays of a lens meet planes at distance 1 from the eye, for all samples of an image: in
/// binary64, each with a proved bound. Of a lens of the plane that is the plane z = 1. Other rays
/// go in all directions; each sample has its place in one of six views. Found once for a
/// projection; frames with other poses use them again.
///
/// Memory   16 bytes for each sample of the tiles, and 1 where there are several views.
class Places {
 public:
  Places(const Projection& projection, std::uint32_t width, std::uint32_t height);

  /// The samples of the image that one view holds.
  struct View {
    View(const ViewAxes& axes, std::size_t tiles);

    ViewAxes axes;
    /// By the numbers of tiles: bounds on the errors of places, and boxes around them.
    std::vector<double> errors;
    std::vector<PlaneBox> boxes;
    /// Around all of them; the point 0 if there is none.
    PlaneBox box;
    std::uint64_t count = 0;
  };
  /// Those that hold samples, at least one.
  [[nodiscard]] std::span<const View> views() const { return views_; }

  /// The samples of a tile that a view holds, by Tile::index(); both NaN elsewhere.
  struct OfTile {
    std::span<const double> x, y;
    /// |x − exact x| and |y − exact y| are at most that.
    double error;
    /// Around these samples.
    PlaneBox box;
    /// Whether the view holds all samples of the tile that have a ray.
    bool is_whole;
  };
  /// For the places of a tile that has several views.
  struct Room {
    std::array<double, TileShape::samples> x, y;
  };
  /// Valid as long as the room is not used again.
  [[nodiscard]] OfTile of_tile(const View& view, std::uint32_t tile, Room& room) const;
  /// Whether a sample of a tile has a ray.
  [[nodiscard]] bool has_ray(std::uint32_t tile, std::size_t i) const {
    const double x = x_[std::size_t{tile} * TileShape::samples + i];
    return x == x;
  }
  /// Whether all of them are numbers below 2⁵⁰⁰; otherwise no image of the plane holds them.
  [[nodiscard]] bool are_usable() const { return are_usable_; }
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
  [[nodiscard]] FoundPlaces room_of(std::uint32_t tile);
  void find_in_plane();
  void find_in_views();
  [[nodiscard]] bool is_whole(const View& view, std::uint32_t tile) const;

  Projection projection_;
  TileGrid grid_;
  lens::Preimages preimages_;
  std::unique_ptr<double[]> x_, y_;
  /// Of each sample that has a ray, the number of its view in all_views; only where there may be
  /// several.
  std::unique_ptr<std::uint8_t[]> view_of_sample_;
  std::vector<View> views_;
  bool are_usable_ = true;
};

}  // namespace fathom::fast
