#include "fathom/fast/bins.h"

#include <algorithm>
#include <limits>
#include <new>

#include "fathom/failures/errors.h"
#include "fathom/fast/boxes.h"
#include "fathom/fast/setup.h"
#include "fathom/fast/tile.h"
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
                         std::uint32_t first_triangle, VertexMemory* where_kept,
                         std::span<const std::uint32_t> numbers)
    : mesh(its_mesh),
      first_number(first_triangle),
      transform(object, camera),
      vertices(where_kept ? where_kept->take(mesh.vertices.size())
                          : std::make_unique_for_overwrite<ImageVertex[]>(mesh.vertices.size())),
      kept(where_kept),
      scene_numbers(numbers.empty() ? nullptr : numbers.data()) {
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
  // Exact numbers would say the same of points that are equal, in a thousand times the time.
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
    for_parts_met(edges_of(setup), box, Tile::size,
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
  const bool perspective = context.camera.projection == Projection::perspective;
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
      if (meets_many_tiles(box, Tile::size)) {
        for_parts_met(*edges++, box, Tile::size, add);
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
