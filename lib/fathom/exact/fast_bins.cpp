#include "fathom/exact/fast_bins.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "fathom/exact/fast_setup.h"
#include "fathom/exact/fast_tile.h"

namespace fathom {
namespace {

struct Entry {
  std::uint32_t tile;
  std::uint32_t triangle;
};

bool keeps(Cull cull, Sign orientation) {
  if (cull == Cull::none) return true;
  return orientation == (cull == Cull::back ? Sign::negative : Sign::positive);
}

}  // namespace

ImageObject::ImageObject(const Scene& scene, const Camera& camera, std::size_t object,
                         std::uint32_t first_triangle)
    : mesh(scene.meshes[scene.objects[object].mesh]),
      first_number(first_triangle),
      transform(scene.objects[object], camera),
      vertices(std::make_unique_for_overwrite<ImageVertex[]>(mesh.vertices.size())) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.vertices.size(), 4096),
                    [&](const auto& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        vertices[i] = transform(mesh.vertices[i]);
                      }
                    });
}

TileGrid::TileGrid(std::uint32_t image_width, std::uint32_t image_height)
    : width(image_width),
      height(image_height),
      columns((image_width - 1) / Tile::size + 1),
      rows((image_height - 1) / Tile::size + 1) {}

PixelBox TileGrid::area(std::uint32_t tile) const {
  const std::uint32_t column = tile % columns * Tile::size, row = tile / columns * Tile::size;
  return {column, std::min(column + Tile::size, width) - 1, row,
          std::min(row + Tile::size, height) - 1};
}

void Bins::fill(const Context& context) {
  const TileGrid& grid = context.grid;
  std::vector<Entry> entries;
  starts_.assign(grid.count() + 1, 0);
  for (std::uint32_t triangle = first_; triangle < end_; ++triangle) {
    const PixelBox box = visible_box(triangle, context);
    if (box.is_empty()) continue;
    for (std::uint32_t row = box.first_row / Tile::size; row <= box.last_row / Tile::size; ++row) {
      for (std::uint32_t column = box.first_column / Tile::size;
           column <= box.last_column / Tile::size; ++column) {
        entries.push_back({row * grid.columns + column, triangle});
        ++starts_[entries.back().tile + 1];
      }
    }
  }
  for (std::size_t tile = 0; tile < grid.count(); ++tile) starts_[tile + 1] += starts_[tile];
  sorted_.resize(entries.size());
  std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
  for (const Entry& entry : entries) sorted_[next[entry.tile]++] = entry.triangle;
}

/// Where the triangle can be visible; empty where it is not.
PixelBox Bins::visible_box(std::uint32_t triangle, const Context& context) const {
  const auto& [a, b, c] = object_->mesh.triangles[triangle];
  const ImageVertex& A = object_->vertices[a];
  const ImageVertex& B = object_->vertices[b];
  const ImageVertex& C = object_->vertices[c];
  if (!A.is_usable() || !B.is_usable() || !C.is_usable()) {
    return visible_box_exactly(triangle, context);
  }
  RenderStatistics& statistics = context.statistics;
  auto orientation = certified_orientation(A, B, C);
  if (orientation) {
    ++statistics.facing.interval;
  } else {
    ++statistics.facing.exact;
    const bool distinct = a != b && b != c && c != a;
    orientation = distinct ? context.referee.projected(object_->first_number + triangle).orientation
                           : Sign::zero;
  }
  if (orientation == Sign::zero) {
    ++statistics.degenerate_triangles;
    return {};
  }
  if (!keeps(context.cull, *orientation)) {
    ++statistics.culled_triangles;
    return {};
  }
  return sample_box(A, B, C, context.grid.width, context.grid.height);
}

PixelBox Bins::visible_box_exactly(std::uint32_t triangle, const Context& context) const {
  const Mesh& mesh = object_->mesh;
  const auto& [a, b, c] = mesh.triangles[triangle];
  const auto& vertices = object_->vertices;
  if (vertices[a].is_behind() && vertices[b].is_behind() && vertices[c].is_behind()) return {};
  if (object_->transform.misses_image({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]})) {
    return {};
  }
  RenderStatistics& statistics = context.statistics;
  ++statistics.facing.exact;
  const ProjectedTriangle& t = context.referee.projected(object_->first_number + triangle);
  if (t.orientation == Sign::zero) {
    ++statistics.degenerate_triangles;
    return {};
  }
  if (!is_kept(t, context.cull)) {
    ++statistics.culled_triangles;
    return {};
  }
  return bounding_box(t, context.camera);
}

}  // namespace fathom
