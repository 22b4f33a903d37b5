#include "fathom/fast/lens_drawing.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "fathom/fast/channels/fast_output.h"
#include "fathom/fast/lenses/ray_by_ray.h"
#include "fathom/threads/threads.h"

namespace fathom::fast {
using namespace triangle;

namespace {

/// The triangles of one side in tiles of the window, each once.
class Gathered {
 public:
  Gathered(std::vector<TileEntry>& entries, std::vector<std::uint64_t>& taken,
           std::uint32_t first_number)
      : entries_(entries), taken_(taken), first_number_(first_number) {
    entries_.clear();
  }
  ~Gathered() {
    for (const TileEntry& entry : entries_) word_of(entry) = 0;
  }
  Gathered(const Gathered&) = delete;
  Gathered& operator=(const Gathered&) = delete;

  void add(const std::vector<Bins>& all_bins, std::uint32_t tile, Side side) {
    for (const Bins& bins : all_bins) {
      for (const TileEntry& entry : bins.in_tile(tile, side)) {
        const std::uint64_t bit = std::uint64_t{1} << (entry.number - first_number_) % 64;
        if (word_of(entry) & bit) continue;
        word_of(entry) |= bit;
        entries_.push_back(entry);
      }
    }
  }
  /// Leaves out what is certainly hidden by surfaces that are nowhere farther than a q.
  void leave_out_behind(float farthest) {
    const auto is_hidden = [&](const TileEntry& entry) {
      return std::bit_cast<float>(entry.nearness & nearness_of_q) < farthest;
    };
    for (const TileEntry& entry : entries_)
      if (is_hidden(entry)) word_of(entry) = 0;
    std::erase_if(entries_, is_hidden);
  }

 private:
  std::uint64_t& word_of(const TileEntry& entry) {
    return taken_[(entry.number - first_number_) / 64];
  }

  std::vector<TileEntry>& entries_;
  std::vector<std::uint64_t>& taken_;
  std::uint32_t first_number_;
};

/// Calls visit(number) for the tiles of the window that an area meets.
template <class Visit>
void for_each_tile(const PixelBox& area, const TileGrid& grid, const Visit& visit) {
  for (std::uint32_t row = area.first_row / Tile::size; row <= area.last_row / Tile::size; ++row) {
    for (std::uint32_t column = area.first_column / Tile::size;
         column <= area.last_column / Tile::size; ++column) {
      visit(row * grid.columns + column);
    }
  }
}

void draw_side(LensTile& tile, Side side, const WindowScene& scene,
               std::vector<std::uint64_t>& taken, const LensContext& context) {
  const DrawContext& window = context.window;
  Gathered gathered(window.visible.entries(), taken, scene.first_number);
  for_each_tile(tile.where().area, scene.grid,
                [&](std::uint32_t number) { gathered.add(scene.bins, number, side); });
  if (side == Side::back && window.switches.early_rejection)
    gathered.leave_out_behind(tile.farthest());
  window.visible.for_each_part(tile.tile(), false, [&](std::span<const std::uint32_t> numbers) {
    for_each_object(numbers, scene.objects,
                    [&](const ImageObject& object, std::span<const std::uint32_t> of_object) {
                      tile.draw(object, of_object, context);
                    });
  });
}

}  // namespace

void draw_lens_tile(LensTile& tile, const WindowScene& scene, std::vector<std::uint64_t>& taken,
                    const LensContext& context) {
  draw_side(tile, Side::front, scene, taken, context);
  tile.begin_back_faces();
  draw_side(tile, Side::back, scene, taken, context);
}

bool is_met(const PixelBox& area, const WindowScene& scene) {
  bool met = false;
  for_each_tile(area, scene.grid,
                [&](std::uint32_t number) { met = met || is_met(scene.bins, number); });
  return met;
}

void write_valid(const Places& places, const TileGrid& image, std::uint32_t* valid) {
  if (valid == nullptr) return;
  parallel_for(std::uint32_t{0}, image.count(), [&](std::uint32_t tile) {
    const PixelBox area = image.area(tile);
    for (std::uint32_t row = area.first_row; row <= area.last_row; ++row) {
      for (std::uint32_t column = area.first_column; column <= area.last_column; ++column) {
        const std::size_t i = Tile::index(column - area.first_column, row - area.first_row);
        valid[std::size_t{row} * image.width + column] = places.has_ray(tile, i) ? 1 : 0;
      }
    }
  });
}

void add_view(Rendered& rendered, const FastWorkers& workers, const TriangleSource& triangles,
              const Camera& camera) {
  RenderStatistics of_view = sum_of(workers, triangles.count());
  if (rendered.statistics.triangles != 0)
    of_view.triangles = of_view.degenerate_triangles = of_view.culled_triangles = 0;
  add(rendered.statistics, of_view);
  const std::vector<std::uint64_t> doubtful = doubtful_pixels(workers, camera);
  rendered.doubtful.insert(rendered.doubtful.end(), doubtful.begin(), doubtful.end());
}

Rendered write_ray_by_ray(const TriangleSource& triangles, const Camera& camera,
                          const RenderOptions& options, DepthMap map, const Places& places) {
  ChannelWriter writer(map, triangles, camera, options);
  RenderStatistics statistics;
  statistics.triangles = triangles.count();
  FirstFault fault;
  RayByRay{triangles, camera, options.cull, places.preimages()}.write(writer, statistics, fault);
  if (fault.get()) fail(*fault.get(), map);
  return {std::move(map), statistics, {}};
}

}  // namespace fathom::fast
