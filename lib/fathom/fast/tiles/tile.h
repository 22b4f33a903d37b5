#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/setup/setup.h"
#include "fathom/fast/tiles/draw_context.h"
#include "fathom/fast/vertices/vertex.h"
#include "fathom/geometry/frames.h"
#include "fathom/image/depth_map.h"

namespace fathom::fast {

/// Tag of a surface: its number in the lower half and, read as a whole as a binary64 number, a
/// bound on the error of its q: upper_half() rounds up, so that the lower half can only add to it.
/// A bound of +∞ becomes NaN, for which no comparison holds: nothing is certain.
inline std::uint64_t surface_tag(std::uint32_t number, double q_error) {
  return upper_half(q_error) << 32 | number;
}
/// No surface: an error of almost nothing.
inline constexpr std::uint64_t no_surface_tag = std::uint64_t{0x00100000} << 32 | no_surface;

/// A surface that may be visible in a tile: q as an affine function of the sample's column and row
/// in the tile, c + a·column + b·row, with its tag.
struct alignas(32) TileSurface {
  double c, a, b;
  std::uint64_t tag;

  [[nodiscard]] double q(double column, double row) const { return c + a * column + b * row; }
  [[nodiscard]] double error() const { return std::bit_cast<double>(tag); }
  [[nodiscard]] std::uint32_t number() const { return static_cast<std::uint32_t>(tag); }
};

/// q at a sample in binary32, a bound on its error, and which of the tile's surfaces it is of: as a
/// surface_tag(), with half as many bits for each. The place of a surface is its index.
using LaneTag = std::uint32_t;
inline LaneTag lane_tag(std::uint32_t place, float q_error) {
  return ((std::bit_cast<std::uint32_t>(q_error) >> 16) + 1) << 16 | place;
}
/// No surface: an error of almost nothing, and place 0.
inline constexpr LaneTag no_surface_lane_tag = 0x00800000;

struct ImageObject;

/// The nearest surface so far at each sample of a small part of the image, whatever the order in
/// which triangles are drawn. Samples hold q in binary32, which settles nearly every decision;
/// surfaces hold q in binary64.
class Tile : public TileShape {
 public:
  static const std::size_t most_packed_bytes;

  /// Empties the tile and moves it to an area of at most size × size pixels, its first row and
  /// column multiples of size.
  void start(const PixelBox& area);
  [[nodiscard]] const PixelBox& area() const { return area_; }
  /// Whether the area is smaller than a tile can be.
  [[nodiscard]] bool is_partial() const {
    return area_.last_column - area_.first_column != size - 1 ||
           area_.last_row - area_.first_row != size - 1;
  }

  /// Draws triangles of one object (their numbers in the scene, one at least) at the samples of the
  /// area.
  void draw(const ImageObject& object, std::span<const std::uint32_t> numbers,
            const DrawContext& context);
  /// Marks all triangles drawn from now on as back faces.
  void begin_back_faces() {
    end_of_front_ = draws_back_faces_ ? 0 : places_;
    draws_back_faces_ = true;
  }

  /// The surface at a sample; its number is no_surface where there is none.
  [[nodiscard]] const TileSurface& surface_at(std::size_t i) const {
    return surfaces_[place_of(tags_[i])];
  }
  [[nodiscard]] bool shows_surface(std::size_t i) const { return place_of(tags_[i]) != 0; }
  /// Samples whose surface has a place below this number certainly show a surface that was drawn
  /// before the first back face. If front faces have been drawn since, no sample is certain to.
  [[nodiscard]] std::uint32_t end_of_front() const { return end_of_front_; }
  [[nodiscard]] bool draws_back_faces() const { return draws_back_faces_; }

  /// Releases all memory except what the finished tile needs, at most most_packed_bytes.
  void pack();
  /// The size of its memory.
  [[nodiscard]] std::size_t bytes() const;
  /// Makes a tile of samples, whose q() and tags() have been written, and of their surfaces by
  /// place.
  void set_surfaces(std::vector<TileSurface> surfaces, std::uint32_t end_of_front,
                    bool draws_back_faces);

  // For the vector code.
  static constexpr std::uint32_t place_of(LaneTag tag) { return tag & 0xFFFF; }
  /// The surface at a sample: its q, −∞ if there is none, and its tag.
  float* q() { return q_.data(); }
  [[nodiscard]] const float* q() const { return q_.data(); }
  LaneTag* tags() { return tags_.data(); }
  [[nodiscard]] const LaneTag* tags() const { return tags_.data(); }
  [[nodiscard]] const TileSurface* surfaces() const { return surfaces_.data(); }
  /// Surfaces have places from 1 up to this number, less one.
  [[nodiscard]] std::uint32_t end_of_places() const { return places_; }
  /// Makes room for the surfaces of a batch and returns the first place; the first `count` of them
  /// are kept.
  std::uint32_t next_place();
  TileSurface* surfaces_at(std::uint32_t place) { return surfaces_.data() + place; }
  void keep_surfaces(std::uint32_t count) { places_ += count; }
  /// For each block a number that is not greater than the exact q at any of its samples.
  std::array<float, blocks>& farthest() { return farthest_; }
  /// How often each block was drawn into since its farthest() was computed.
  std::uint8_t* draws() { return draws_.data(); }
  /// Settles one sample in binary64 or, if its bounds leave it open, exactly. Column and row are
  /// counted in the image; `tag` is the triangle's tag.
  void settle(const TriangleSetup& setup, LaneTag tag, bool test_range, std::uint32_t column,
              std::uint32_t row, const DrawContext& context);

 private:
  /// Forgets the surfaces that are visible at no sample; the others keep their order.
  void forget_hidden();

  /// Place 0 is no surface; the other places are 16-bit numbers. At most a quarter of the places
  /// are visible: with more places, surfaces would be forgotten less often, but would not stay in
  /// the caches.
  static constexpr std::uint32_t most_places = 4 * samples;
  static_assert(most_places <= 0x10000);
  PixelBox area_;
  alignas(64) std::array<float, samples> q_;
  alignas(64) std::array<LaneTag, samples> tags_;
  alignas(64) std::array<float, blocks> farthest_;
  std::array<std::uint8_t, blocks> draws_;
  std::vector<TileSurface> surfaces_;
  std::uint32_t places_;
  /// Places of surfaces that were drawn before back faces are below it.
  std::uint32_t end_of_front_;
  bool draws_back_faces_;
};

/// The tile, and a surface at each sample.
inline constexpr std::size_t Tile::most_packed_bytes =
    sizeof(Tile) + (std::size_t{samples} + 1) * sizeof(TileSurface);

}  // namespace fathom::fast
