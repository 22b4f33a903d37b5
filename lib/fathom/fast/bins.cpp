#include "fathom/fast/bins.h"

#include <algorithm>
#include <limits>
#include <new>

#include "fathom/fast/boxes.h"
#include "fathom/fast/certain_sign.h"
#include "fathom/fast/setup.h"
#include "fathom/fast/tile.h"
#include "fathom/numeric/errors.h"
#include "fathom/scene/element_checks.h"
#include "fathom/threads/threads.h"

namespace fathom::fast {
using namespace triangle;

namespace {

/// Throws scene::ElementFault if a number is not finite. That is looked at after the work, while the
/// points are in the innermost cache: before it, a twentieth of a map's time would go into waiting
/// for them.
void transform_finite(const VertexTransform& transform, std::span<const MeshPoint> points,
                      ImageVertex* image) {
  constexpr std::size_t part = 512;
  for (std::size_t first = 0; first < points.size(); first += part) {
    const auto some = points.subspan(first, std::min(part, points.size() - first));
    transform(some, image + first);
    if (!scene::all_finite(some)) throw scene::ElementFault();
  }
}

}  // namespace

ImageObject::ImageObject(const Object& object, const Mesh& its_mesh, const Camera& camera,
                         std::uint32_t first_triangle, VertexMemory* where_kept)
    : mesh(its_mesh),
      first_number(first_triangle),
      transform(object, camera),
      vertices(where_kept ? where_kept->take(mesh.vertices.size())
                          : std::make_unique_for_overwrite<ImageVertex[]>(mesh.vertices.size())),
      kept(where_kept) {
  constexpr std::size_t part = 4096;
  const std::size_t count = mesh.vertices.size();
  in_parallel((count + part - 1) / part, [&](std::size_t i) {
    const std::size_t first = i * part;
    transform_finite(transform,
                     std::span(mesh.vertices).subspan(first, std::min(part, count - first)),
                     vertices.get() + first);
  });
}

ImageObject::~ImageObject() {
  if (kept) kept->give_back(std::move(vertices), mesh.vertices.size());
}

VertexMemory::Vertices VertexMemory::take(std::size_t count) {
  const auto fits = std::find_if(blocks_.begin(), blocks_.end(),
                                 [&](const Block& block) { return block.count == count; });
  if (fits == blocks_.end()) return std::make_unique_for_overwrite<ImageVertex[]>(count);
  Vertices vertices = std::move(fits->vertices);
  blocks_.erase(fits);
  return vertices;
}

void VertexMemory::give_back(Vertices vertices, std::size_t count) noexcept try {
  blocks_.push_back({std::move(vertices), count});
} catch (const std::bad_alloc&) {
}

const ImageObject& object_of(const ImageObjects& objects, std::uint32_t number) {
  const auto next = std::upper_bound(
      objects.begin(), objects.end(), number,
      [](std::uint32_t n, const ImageObject& object) { return n < object.first_number; });
  return *std::prev(next);
}

TileGrid::TileGrid(std::uint32_t image_width, std::uint32_t image_height)
    : width(image_width),
      height(image_height),
      columns((image_width - 1) / Tile::size + 1),
      rows((image_height - 1) / Tile::size + 1) {
  if (std::uint64_t{columns} * rows > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError("an image of more than 2^44 pixels cannot be rendered");
  }
}

std::uint32_t TileGrid::tile_at(std::uint32_t column, std::uint32_t row) const {
  return row / Tile::size * columns + column / Tile::size;
}

PixelBox TileGrid::area(std::uint32_t tile) const {
  const std::uint32_t column = tile % columns * Tile::size, row = tile / columns * Tile::size;
  // Sums with the side of a tile could be beyond the range of a column.
  return {column, column + (std::min(Tile::size, width - column) - 1), row,
          row + (std::min(Tile::size, height - row) - 1)};
}

void Bins::fill(const Context& context) {
  for (Lists& lists : lists_) lists.start(context.grid.count());
  for (const ImageObject& object : context.objects) {
    if (object.end_number() > first_ && object.first_number < end_) add_object(object, context);
  }
  for (Lists& lists : lists_) lists.sort(context.keep_memory);
}

namespace {

PixelBox common_part(const PixelBox& a, const PixelBox& b) {
  return {std::max(a.first_column, b.first_column), std::min(a.last_column, b.last_column),
          std::max(a.first_row, b.first_row), std::min(a.last_row, b.last_row)};
}

/// Whether the triangle certainly covers no sample of the box and meets none of its pixels: the box
/// is taken to be greater by one sample on each side, for which the bounds hold, too.
bool certainly_misses(const TriangleSetup& s, const PixelBox& box) {
  const Rectangle pixels{static_cast<double>(box.first_column) - s.column - 1,
                         static_cast<double>(box.last_column) - s.column + 1,
                         static_cast<double>(box.first_row) - s.row - 1,
                         static_cast<double>(box.last_row) - s.row + 1};
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_certainly_negative(s.edge_a[k], s.edge_b[k], s.edge_c[k], s.edge_error, pixels)) {
      return true;
    }
  }
  return false;
}

/// The pixels where a triangle about which nothing was certain can be visible; empty if none.
PixelBox visible_box_exactly(const ImageObject& object, std::uint32_t number,
                             const Bins::Context& context) {
  const Mesh& mesh = object.mesh;
  const auto& [a, b, c] = mesh.triangles[number - object.first_number];
  const auto& vertices = object.vertices;
  if (vertices[a].is_behind() && vertices[b].is_behind() && vertices[c].is_behind()) return {};
  const bool usable = vertices[a].is_usable() && vertices[b].is_usable() && vertices[c].is_usable();
  if (!usable &&
      object.transform.misses_image({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]})) {
    return {};
  }
  RenderStatistics& statistics = context.statistics;
  ++statistics.facing.exact;
  const bool distinct = a != b && b != c && c != a;
  const ProjectedTriangle* t = distinct ? &context.referee.projected(number) : nullptr;
  if (!t || t->orientation == Sign::zero) {
    ++statistics.degenerate_triangles;
    return {};
  }
  if (!is_kept(*t, context.cull)) {
    ++statistics.culled_triangles;
    return {};
  }
  return bounding_box(*t, context.camera);
}

}  // namespace

// The box of a triangle that reaches behind the camera is the whole image, most of whose tiles it
// misses.
void Bins::add_exactly(const ImageObject& object, std::uint32_t number, const Context& context) {
  const PixelBox box = visible_box_exactly(object, number, context);
  if (box.is_empty()) return;
  Lists& lists = lists_[index(Side::front)];
  const TileGrid& grid = context.grid;
  const std::uint32_t first_tile = grid.tile_at(box.first_column, box.first_row);
  if (first_tile == grid.tile_at(box.last_column, box.last_row)) {
    lists.add(number, never_hidden, first_tile);
    return;
  }
  const bool perspective = context.camera.projection == Projection::perspective;
  ++context.statistics.exact_setups;
  const TriangleSetup& setup = context.exact_setups.of(number, context.referee, perspective);
  for (std::uint32_t row = box.first_row / Tile::size; row <= box.last_row / Tile::size; ++row) {
    for (std::uint32_t column = box.first_column / Tile::size;
         column <= box.last_column / Tile::size; ++column) {
      const std::uint32_t tile = row * grid.columns + column;
      if (!certainly_misses(setup, common_part(grid.area(tile), box))) {
        lists.add(number, never_hidden, tile);
      }
    }
  }
}

void Bins::add_object(const ImageObject& object, const Context& context) {
  const std::uint32_t first = std::max(first_, object.first_number);
  const std::uint32_t end = std::min(end_, object.end_number());
  const auto boxes = std::make_unique_for_overwrite<BoxBatch>();
  RenderStatistics& statistics = context.statistics;
  for (std::uint32_t next = first, count = 0; next < end; next += count) {
    count = std::min<std::uint32_t>(BoxBatch::most, end - next);
    box_triangles({object.vertices.get(), static_cast<std::uint32_t>(object.mesh.vertices.size()),
                   &object.mesh.triangles[next - object.first_number], count, next, context.cull,
                   context.by_area, context.grid.width, context.grid.height, context.grid.columns},
                  *boxes);
    statistics.facing.interval += count - boxes->unsettled;
    statistics.degenerate_triangles += boxes->degenerate;
    statistics.culled_triangles += boxes->culled;
    for (const Side side : {Side::front, Side::back}) {
      lists_[index(side)].add(boxes->in_one_tile[index(side)]);
    }
    for (std::size_t i = 0; i < boxes->in_more_tiles; ++i) {
      lists_[index(boxes->side[i])].add(boxes->number[i], boxes->nearest[i], boxes->box[i],
                                        context.grid);
    }
    for (std::size_t i = 0; i < boxes->unsettled; ++i) {
      add_exactly(object, boxes->unsettled_number[i], context);
    }
  }
}

void Bins::Lists::start(std::uint32_t tiles) {
  starts_.assign(tiles + std::size_t{1}, 0);
}

void Bins::Lists::add(const BoxBatch::Entries& entries) {
  for (const std::uint64_t entry : entries.all()) ++starts_[(entry >> 32) + 1];
  entries_.insert(entries_.end(), entries.all().begin(), entries.all().end());
  const std::size_t before = nearness_.size();
  nearness_.resize(before + entries.count);
  for (std::size_t i = 0; i < entries.count; ++i) {
    nearness_[before + i] = static_cast<Nearness>(entries.nearness[i]);
  }
}

void Bins::Lists::add(std::uint32_t number, std::uint32_t q, const PixelBox& box,
                      const TileGrid& grid) {
  // Blocks of the image; those of a tile begin with tile · blocks_of_row.
  constexpr std::uint32_t blocks = Tile::blocks_of_row;
  const std::uint32_t left = box.first_column / Tile::block, right = box.last_column / Tile::block;
  const std::uint32_t top = box.first_row / Tile::block, bottom = box.last_row / Tile::block;
  const auto first_in = [](std::uint32_t first, std::uint32_t tile) {
    return std::max(first, tile * blocks) - tile * blocks;
  };
  const auto last_in = [](std::uint32_t last, std::uint32_t tile) {
    return std::min(last - tile * blocks, blocks - 1);
  };
  for (std::uint32_t row = top / blocks; row <= bottom / blocks; ++row) {
    const std::uint32_t first_row = first_in(top, row), last_row = last_in(bottom, row);
    for (std::uint32_t column = left / blocks; column <= right / blocks; ++column) {
      add(number,
          nearness_in(q, first_in(left, column), last_in(right, column), first_row, last_row),
          row * grid.columns + column);
    }
  }
}

void Bins::Lists::sort(bool keep_memory) {
  for (std::size_t tile = 0; tile + 1 < starts_.size(); ++tile) starts_[tile + 1] += starts_[tile];
  sorted_.resize(entries_.size());
  next_.assign(starts_.begin(), starts_.end() - 1);
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    sorted_[next_[entries_[i] >> 32]++] = {static_cast<std::uint32_t>(entries_[i]), nearness_[i]};
  }
  if (keep_memory) {
    entries_.clear();
    nearness_.clear();
  } else {
    entries_ = {};
    nearness_ = {};
    next_ = {};
  }
}

}  // namespace fathom::fast
