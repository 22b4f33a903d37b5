#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fathom/fast/bins/bins.h"
#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/coverage/coverage_classes.h"
#include "fathom/fast/coverage/edge_balance.h"
#include "fathom/fast/coverage/square_edges.h"
#include "fathom/fast/coverage/tile_rows.h"

namespace fathom::fast {

/// For each pixel of a tile, the edges or triangles that meet it; pixels are numbered by rows.
class PixelMeetings {
 public:
  void clear() { unsorted_.clear(); }
  void add(std::uint32_t pixel, std::size_t index) {
    unsorted_.push_back({pixel, static_cast<std::uint32_t>(index)});
  }
  /// To be called after the last add().
  void sort() {
    starts_.fill(0);
    for (const Meeting& meeting : unsorted_) ++starts_[meeting.pixel + 1];
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    sorted_.resize(unsorted_.size());
    auto next = starts_;
    for (const Meeting& meeting : unsorted_) sorted_[next[meeting.pixel]++] = meeting.index;
  }
  /// The indices for a pixel, in the order in which they were added.
  [[nodiscard]] std::span<const std::uint32_t> at(std::uint32_t pixel) const {
    return std::span(sorted_).subspan(starts_[pixel], starts_[pixel + 1] - starts_[pixel]);
  }

 private:
  struct Meeting {
    std::uint32_t pixel, index;
  };
  std::vector<Meeting> unsorted_;
  std::vector<std::uint32_t> sorted_;
  std::array<std::uint32_t, TileShape::samples + std::size_t{1}> starts_{};
};

/// An edge of triangles turned so that their area is positive, with the number of times that it
/// occurs more often than its opposite; in pixels of the tile.
struct OutlineEdge {
  SquarePoint from, to;
  /// Of the ends' coordinates, the roundings of these included.
  double error;
  int times;
  const ImageObject* object;
  std::uint32_t from_vertex, to_vertex;
};

/// The lines along which the number of triangles that cover a point of a tile changes: the edges of
/// triangles that are certainly positive or negative, except edges between two adjacent triangles
/// (EdgeBalance).
class TileOutlines {
 public:
  void start(const PixelBox& area);
  /// Adds triangles of an object, given by their numbers.
  void add(const ImageObject& object, std::span<const std::uint32_t> numbers,
           std::span<const CoverageTriangle> classes);
  /// The number of edges without an opposite that may meet the tile. Opposite edges count if their
  /// ends are at the same place of the mesh but are different vertices.
  [[nodiscard]] std::size_t size() const;

  /// Processes all added edges; sets the bits of all pixels that an edge may meet.
  void find_pixels(TileRows& pixels);
  /// Lists the edges that may meet the pixels.
  /// Needs    find_pixels() after the last add().
  void list_edges(const TileRows& pixels);
  /// For a pixel for which list_edges() was called.
  [[nodiscard]] std::span<const std::uint32_t> edges_at(std::uint32_t pixel) const {
    return edges_at_.at(pixel);
  }
  /// For a row of the tile.
  [[nodiscard]] std::size_t edges_in_row(std::uint32_t row) const {
    return edges_in_row_[row].size();
  }
  [[nodiscard]] const OutlineEdge& edge(std::uint32_t index) const { return edges_[index]; }
  /// By how much the number is greater at a point of a row of pixels than at the same height in the
  /// middle of a column where no edge meets the row's pixel; nothing if that is not certain for all
  /// points within the errors of the edges.
  [[nodiscard]] std::optional<int> difference(std::uint32_t row, const SquarePoint& point,
                                              std::uint32_t column) const;

 private:
  void sieve_edges(const ImageObject& object, std::span<const std::uint32_t> numbers,
                   std::span<const CoverageTriangle> classes);
  std::vector<EdgeBalance::Edge>& left_of(const ImageObject& object);
  void find_edges(const ImageObject& object, const std::vector<EdgeBalance::Edge>& left);
  [[nodiscard]] OutlineEdge edge_of(const ImageObject& object, const EdgeBalance::Edge& edge) const;
  [[nodiscard]] bool misses_tile(const ImageVertex& p, const ImageVertex& q) const;
  [[nodiscard]] TileBox box_of(const OutlineEdge& edge, double margin) const;
  /// visit(row, bits of the columns that the edge may meet there)
  template <class Visit>
  void for_each_row(const OutlineEdge& edge, const Visit& visit) const;

  PixelBox area_{};
  TileBox whole_{};
  EdgeSieve sieve_;
  EdgeBalance balance_;
  /// The edges of each object that remain after opposite edges cancel, in the order of the objects.
  struct EdgesLeft {
    const ImageObject* object;
    std::vector<EdgeBalance::Edge> edges;
  };
  std::vector<EdgesLeft> left_;
  std::vector<EdgeBalance::Edge> met_edges_;
  std::vector<std::uint32_t> vertex_at_;
  std::vector<OutlineEdge> edges_;
  PixelMeetings edges_at_;
  std::array<std::vector<std::uint32_t>, TileShape::size> edges_in_row_;
};

}  // namespace fathom::fast
