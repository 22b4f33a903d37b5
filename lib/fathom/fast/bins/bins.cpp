#include "fathom/fast/bins/bins.h"

#include <algorithm>
#include <limits>

#include "fathom/fast/bins/boxes.h"
#include "fathom/fast/bins/tile_shape.h"
#include "fathom/fast/setup/setup.h"
#include "fathom/scene/scene_fault.h"

namespace fathom::fast {
using namespace triangle;

TileGrid::TileGrid(std::uint32_t image_width, std::uint32_t image_height)
    : width(image_width),
      height(image_height),
      columns((image_width - 1) / TileShape::size + 1),
      rows((image_height - 1) / TileShape::size + 1) {
  constexpr std::uint64_t most_tiles =
      most_pixels_of_image / (TileShape::size * TileShape::size) - 1;
  static_assert(most_tiles == std::numeric_limits<std::uint32_t>::max());
  if (std::uint64_t{columns} * rows > most_tiles) throw image_too_large();
}

std::uint32_t TileGrid::tile_at(std::uint32_t column, std::uint32_t row) const {
  return row / TileShape::size * columns + column / TileShape::size;
}

PixelBox TileGrid::area(std::uint32_t tile) const {
  const std::uint32_t column = tile % columns * TileShape::size,
                      row = tile / columns * TileShape::size;
  // Sums with the side of a tile could be beyond the range of a column.
  return {column, column + (std::min(TileShape::size, width - column) - 1), row,
          row + (std::min(TileShape::size, height - row) - 1)};
}

void Bins::fill(const Context& context) {
  for (Lists& lists : lists_) lists.start(context.grid.count());
  for (const ImageObject& object : context.objects) {
    if (object.end_number() > first_ && object.first_number < end_) add_object(object, context);
  }
  for (Lists& lists : lists_) lists.sort(context.keep_memory);
}

namespace {

BoxEdges edges_of(const TriangleSetup& s) {
  return {s.edge_a, s.edge_b, s.edge_c, s.edge_error};
}

bool is_usable(const ImageObject& object, const CornerIndices& corners) {
  return std::all_of(corners.begin(), corners.end(),
                     [&](std::uint32_t vertex) { return object.vertices[vertex].is_usable(); });
}

/// Whether a triangle with a corner that is not usable is certainly at no sample.
bool is_certainly_unseen(const ImageObject& object, const CornerIndices& corners) {
  const auto is_behind = [&](std::uint32_t vertex) { return object.vertices[vertex].is_behind(); };
  if (std::all_of(corners.begin(), corners.end(), is_behind)) return true;
  const auto& vertices = object.mesh.vertices;
  return object.transform.misses_image(
      {vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]});
}

/// The pixels where a triangle can be visible; empty if none.
PixelBox visible_box_exactly(const ImageObject& object, const CornerIndices& corners,
                             std::uint32_t number, const Bins::Context& context) {
  const MeshPoint &a = object.mesh.vertices[corners[0]], &b = object.mesh.vertices[corners[1]],
                  &c = object.mesh.vertices[corners[2]];
  RenderStatistics& statistics = context.statistics;
  ++statistics.facing.exact;
  // Exact numbers would give the same answer for equal points, in a thousand times the time.
  const bool distinct = a != b && b != c && c != a;
  const ProjectedTriangle* t =
      distinct ? &context.referee.projected(object.number_in_scene(number)) : nullptr;
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
// misses. Exact numbers would take a third of the time of a picture of streets with long triangles
// under and beside the camera.
void Bins::add_exactly(const ImageObject& object, std::uint32_t number, const Context& context) {
  const CornerIndices& corners = object.mesh.triangles[number - object.first_number];
  Lists& lists = lists_[index(Side::front)];
  const TileGrid& grid = context.grid;
  const auto add_where_met = [&](const TriangleSetup& setup, const PixelBox& box) {
    ++context.statistics.exact_setups;
    for_parts_met(edges_of(setup), box, TileShape::size,
                  [&](const PixelBox& part) { lists.add(number, never_hidden, part, grid); });
  };
  if (!is_usable(object, corners)) {
    if (is_certainly_unseen(object, corners)) return;
    const PixelBox image{0, grid.width - 1, 0, grid.height - 1};
    const auto setup = context.cull == Cull::none
                           ? wide_setup(context.referee, object.number_in_scene(number), image)
                           : std::nullopt;
    if (setup) {
      ++context.statistics.facing.interval;
      add_where_met(*setup, image);
      return;
    }
  }
  const PixelBox box = visible_box_exactly(object, corners, number, context);
  if (box.is_empty()) return;
  if (grid.tile_at(box.first_column, box.first_row) ==
      grid.tile_at(box.last_column, box.last_row)) {
    lists.add(number, never_hidden, box, grid);
    return;
  }
  const bool perspective = is_perspective(context.camera.projection);
  const ProjectedTriangle& projected = context.referee.projected(object.number_in_scene(number));
  add_where_met(exact_setup(projected, perspective, box), box);
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
    auto edges = boxes->edges.begin();
    for (std::size_t i = 0; i < boxes->in_more_tiles; ++i) {
      const auto add = [&](const PixelBox& part) {
        lists_[index(boxes->side[i])].add(boxes->number[i], boxes->nearest[i], part, context.grid);
      };
      const PixelBox& box = boxes->box[i];
      if (meets_many_tiles(box, TileShape::size)) {
        for_parts_met(*edges++, box, TileShape::size, add);
      } else {
        add(box);
      }
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
  constexpr std::uint32_t blocks = TileShape::blocks_of_row;
  const std::uint32_t left = box.first_column / TileShape::block,
                      right = box.last_column / TileShape::block;
  const std::uint32_t top = box.first_row / TileShape::block,
                      bottom = box.last_row / TileShape::block;
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
    // Assigning {} would keep their memory.
    entries_ = std::vector<std::uint64_t>();
    nearness_ = std::vector<Nearness>();
    next_ = std::vector<std::size_t>();
  }
}

bool is_met(const std::vector<Bins>& bins, std::uint32_t tile) {
  return std::ranges::any_of(bins, [&](const Bins& part) { return !part.is_empty(tile); });
}

}  // namespace fathom::fast
