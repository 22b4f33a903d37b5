#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fathom/mesh_files/ply/ply_rows.h"

/// Where triangles are in a binary PLY file, so that any of them is found without reading all that
/// comes before it.
namespace fathom::mesh_files {

/// A face, and the first triangle that comes from it or a later one.
struct FacePlace {
  std::uint64_t triangle = 0, face = 0, offset = 0;
};

inline std::uint64_t triangles_of(std::size_t corners) {
  return corners < 3 ? 0 : corners - 2;
}

/// The places of the faces.
class FaceIndex {
  static constexpr std::uint64_t faces_per_entry = 256;

 public:
  void begin(std::uint64_t offset) { end_.offset = start_ = offset; }

  /// So many triangles, of rows of one size, instead of adding each.
  void add_triangles(std::uint64_t count, std::size_t row_size) {
    row_size_ = row_size;
    end_ = {count, count, start_ + count * row_size};
  }

  /// The next face has `corners` corners, and its row ends before `offset`.
  void add(std::size_t corners, std::uint64_t offset) {
    const std::uint64_t size = offset - end_.offset;
    if (end_.face == 0) row_size_ = size;
    if (even_ && (corners != 3 || size != row_size_)) note_uneven();
    if (!even_ && end_.face % faces_per_entry == 0) entries_.push_back(end_);
    triangles_only_ = triangles_only_ && corners == 3;
    has_polygons_ = has_polygons_ || corners > 3;
    end_.triangle += triangles_of(corners);
    ++end_.face;
    end_.offset = offset;
  }

  /// A face at or before the face of triangle `number`: less than 256 faces before it, or with no
  /// triangle in between.
  [[nodiscard]] FacePlace before(std::uint64_t number) const {
    if (even_) return {number, number, start_ + number * row_size_};
    const auto after = std::upper_bound(
        entries_.begin(), entries_.end(), number,
        [](std::uint64_t n, const FacePlace& place) { return n < place.triangle; });
    return *(after - 1);
  }

  /// The place after the last face.
  [[nodiscard]] const FacePlace& end() const { return end_; }
  [[nodiscard]] bool triangles_only() const { return triangles_only_; }
  [[nodiscard]] bool has_polygons() const { return has_polygons_; }
  /// Bytes to read for one triangle.
  [[nodiscard]] std::size_t reach() const {
    return even_ ? std::max<std::size_t>(row_size_, 8) : std::size_t{1} << 12;
  }

 private:
  /// Until now every face had three corners and a row of the same size.
  void note_uneven() {
    even_ = false;
    for (std::uint64_t face = 0; face < end_.face; face += faces_per_entry) {
      entries_.push_back({face, face, start_ + face * row_size_});
    }
  }

  std::uint64_t start_ = 0, row_size_ = 0;
  FacePlace end_;
  bool even_ = true, triangles_only_ = true, has_polygons_ = false;
  std::vector<FacePlace> entries_;
};

/// A corner of a triangle strip that is to be read next, and the first triangle that comes with it
/// or a later one.
struct StripPlace {
  std::uint64_t triangle = 0, row = 0, offset = 0;
  PlyStrip strip;
};

/// The places of the corners of strips.
class StripIndex {
  static constexpr std::uint64_t steps_per_entry = 1024;

 public:
  /// The next corner or −1, before it is read.
  void add_corner(const PlyStrip& strip, std::uint64_t row, std::uint64_t offset) {
    // Empty rows count too, so that an entry follows a long run of them.
    steps_ += 1 + row - row_;
    row_ = row;
    if (!entries_.empty() && steps_ < steps_per_entry) return;
    steps_ = 0;
    entries_.push_back({triangles_, row, offset, strip});
  }
  void add_triangle() { ++triangles_; }

  /// A place from which triangle `number` is found within about a thousand corners and rows.
  [[nodiscard]] const StripPlace& before(std::uint64_t number) const {
    const auto after = std::upper_bound(
        entries_.begin(), entries_.end(), number,
        [](std::uint64_t n, const StripPlace& place) { return n < place.triangle; });
    return *(after - 1);
  }
  [[nodiscard]] std::uint64_t triangles() const { return triangles_; }

 private:
  std::uint64_t triangles_ = 0, steps_ = 0, row_ = 0;
  std::vector<StripPlace> entries_;
};

}  // namespace fathom::mesh_files
