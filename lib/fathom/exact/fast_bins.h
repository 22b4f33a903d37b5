#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "fathom/exact/fast_range.h"
#include "fathom/exact/fast_referee.h"
#include "fathom/exact/fast_vertex.h"

namespace fathom {

/// One object with its vertices in the image.
struct ImageObject {
  ImageObject(const Scene& scene, const Camera& camera, std::size_t object,
              std::uint32_t first_triangle);

  const Mesh& mesh;
  /// Number of its first triangle in the scene.
  std::uint32_t first_number;
  VertexTransform transform;
  /// One for each vertex of the mesh.
  std::unique_ptr<ImageVertex[]> vertices;
};

/// The image cut into tiles, numbered row by row.
struct TileGrid {
  TileGrid(std::uint32_t image_width, std::uint32_t image_height);
  [[nodiscard]] std::uint32_t count() const { return columns * rows; }
  [[nodiscard]] PixelBox area(std::uint32_t tile) const;

  std::uint32_t width, height;  // of the image
  std::uint32_t columns, rows;
};

/// Consecutive triangles of an object, and for each tile those that can be visible in it.
class Bins {
 public:
  Bins(const ImageObject& object, std::uint32_t first, std::uint32_t end)
      : object_(&object), first_(first), end_(end) {}

  struct Context {
    const Camera& camera;
    Cull cull;
    const DepthRange& range;
    const TileGrid& grid;
    Referee& referee;
    RenderStatistics& statistics;
  };
  void fill(const Context& context);

  [[nodiscard]] const ImageObject& object() const { return *object_; }
  /// Numbers within the object's mesh, in ascending order.
  [[nodiscard]] std::span<const std::uint32_t> in_tile(std::uint32_t tile) const {
    return std::span(sorted_).subspan(starts_[tile], starts_[tile + 1] - starts_[tile]);
  }

 private:
  [[nodiscard]] PixelBox visible_box(std::uint32_t triangle, const Context& context) const;
  [[nodiscard]] PixelBox visible_box_exactly(std::uint32_t triangle, const Context& context) const;

  const ImageObject* object_;
  std::uint32_t first_, end_;
  std::vector<std::uint32_t> sorted_;
  std::vector<std::size_t> starts_;
};

}  // namespace fathom
