#include "fathom/fast/stream.h"

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <optional>

#include "fathom/failures/errors.h"
#include "fathom/fast/channels/resolve.h"
#include "fathom/fast/render_lens.h"
#include "fathom/fast/rounds/coverage_in_rounds.h"
#include "fathom/fast/tiles/frame.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rendering/map_background.h"
#include "fathom/scene/element_checks.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/threads/threads.h"

// How to read this file: start with render_in_arena(). The image is rendered in bands of rows of
// tiles. For each band the files are read from beginning to end, some triangles at a time, which
// are transformed, sorted into tiles and drawn like those of a scene in memory; the tiles of the
// band keep the visible surfaces so far. The number of rows of a band is found during the work: as
// many rows as have tiles that fit into the allowed memory. Bands after the first leave out
// triangles that the first found to lie elsewhere. Channel A needs all triangles that meet a tile
// together: it is written at the end of the band (CoverageInRounds).
namespace fathom {
using namespace fast;
using namespace rendering;
using namespace triangle;

namespace {

/// Rows of tiles [first_row, end_row); a tile exists from the first triangle on that may be visible
/// in it.
class Band {
 public:
  Band(const TileGrid& grid, std::uint32_t first_row, std::uint64_t most_bytes)
      : grid_(grid),
        most_tiles_(most_bytes / Tile::most_packed_bytes),
        first_row_(first_row),
        end_row_(grid.rows),
        tiles_(std::size_t{grid.columns} * (end_row_ - first_row)) {}

  [[nodiscard]] std::uint32_t end_row() const { return end_row_; }
  /// Numbers of the tiles.
  [[nodiscard]] std::uint32_t first() const { return first_row_ * grid_.columns; }
  [[nodiscard]] std::uint32_t end() const { return end_row_ * grid_.columns; }
  [[nodiscard]] std::vector<std::uint32_t> tiles() const {
    std::vector<std::uint32_t> numbers(end() - first());
    std::iota(numbers.begin(), numbers.end(), first());
    return numbers;
  }

  /// Gives up the last rows, but never all, until the existing tiles and the tiles that these
  /// triangles need are not too many.
  void make_room(const std::vector<Bins>& bins) {
    std::uint64_t needed = 0;
    for (std::uint32_t row = first_row_; row < end_row_; ++row) {
      for (std::uint32_t column = 0; column < grid_.columns; ++column) {
        const std::uint32_t number = row * grid_.columns + column;
        if (at(number) || is_met(bins, number)) ++needed;
      }
      if (needed <= most_tiles_ || row == first_row_) continue;
      end_row_ = row;
      tiles_.resize(end() - first());
    }
  }

  void draw(const std::vector<Bins>& bins, const ImageObjects& objects, const FastFrame& frame,
            FastWorkers& workers) {
    parallel_for(first(), end(), [&](std::uint32_t number) {
      if (!is_met(bins, number)) return;
      auto& tile = at(number);
      if (!tile) {
        tile = std::make_unique_for_overwrite<Tile>();
        tile->start(grid_.area(number));
      }
      draw_tile(*tile, number, bins, objects, frame.context(workers.local()));
      tile->pack();
    });
  }

  /// Writes channel A, to an image of this width, for the tiles whose triangles were kept.
  void write_coverage(CoverageInRounds& kept, float* values, const FastFrame& frame,
                      FastWorkers& workers) {
    kept.write(first(), end(), [&](std::uint32_t number, TileCoverage& coverage) {
      coverage.write(*at(number), number, frame.context(workers.local()), values, {grid_.width});
    });
  }

  void resolve(FastOutput& output, const FastFrame& frame, FastWorkers& workers,
               FirstFault& fault) {
    parallel_for(first(), end(), [&](std::uint32_t number) {
      auto& tile = at(number);
      if (!tile) return;
      fault.add(output.write(*tile, {grid_.width}, frame.context(workers.local())));
      tile.reset();
    });
  }

 private:
  std::unique_ptr<Tile>& at(std::uint32_t number) { return tiles_[number - first()]; }

  const TileGrid& grid_;
  std::uint64_t most_tiles_;
  std::uint32_t first_row_, end_row_;
  std::vector<std::unique_ptr<Tile>> tiles_;
};

/// The rows of tiles in which parts of the scene may be visible, known once they have been sorted.
class RowsOfParts {
 public:
  void note(std::uint32_t first_number, const std::vector<Bins>& bins, const TileGrid& grid) {
    Rows rows{grid.rows, 0};
    for (std::uint32_t number = 0; number < grid.count(); ++number) {
      if (!is_met(bins, number)) continue;
      rows.first = std::min(rows.first, number / grid.columns);
      rows.last = number / grid.columns;
    }
    rows_[first_number] = rows;
  }

  /// False only if no triangle of the part can be visible in rows [begin, end).
  [[nodiscard]] bool may_meet(std::uint32_t first_number, std::uint32_t begin,
                              std::uint32_t end) const {
    const auto found = rows_.find(first_number);
    return found == rows_.end() || (found->second.first < end && found->second.last >= begin);
  }

 private:
  struct Rows {
    std::uint32_t first, last;
  };
  std::map<std::uint32_t, Rows> rows_;
};

/// Reports progress from the thread that reads: rows of tiles that are done, and, of the band under
/// way, the share of its triangles.
void report(const std::function<void(double)>& progress, const Band& band, const TileGrid& grid,
            std::uint32_t first_row, double share_of_triangles) {
  if (!progress) return;
  progress((first_row + share_of_triangles * (band.end_row() - first_row)) / grid.rows);
}

Rendered render_in_arena(const StreamedScene& scene, const Camera& camera,
                         const RenderOptions& options, const StreamLimits& limits,
                         const RenderContext& context) {
  const FastFrame frame(camera, options);
  const TriangleSource triangles(scene);
  const SceneRays rays(triangles, camera);
  const auto new_worker = [&] { return FastWorker(triangles, camera, rays); };
  FastWorkers workers(new_worker);
  // Sorts triangles for bands after the first, whose statistics would count them again.
  FastWorkers sorting_again(new_worker);

  DepthMap map = make_background(camera, options, context);
  ChannelWriter writer(map, triangles, camera, options);
  FastOutput output(map, writer, rays);
  float* const coverage = writer.values().coverage;
  FirstFault fault;
  RowsOfParts rows;
  for (std::uint32_t first_row = 0; first_row < frame.grid.rows;) {
    Band band(frame.grid, first_row, limits.tile_bytes);
    std::optional<CoverageInRounds> kept;
    if (coverage) {
      kept.emplace(CoverageInRounds::Scene{frame, triangles, rays}, band.tiles(),
                   limits.kept_bytes);
    }
    const auto draw = [&](const TriangleSource::Part& part) {
      ImageObjects objects;
      objects.emplace_back(part.object, part.mesh, camera, part.first_number);
      const std::uint32_t end = objects.front().end_number();
      const std::vector<Bins> bins =
          sort_into_tiles(objects, part.first_number, end, parts_of_chunk, frame,
                          first_row == 0 ? workers : sorting_again);
      if (first_row == 0) rows.note(part.first_number, bins, frame.grid);
      band.make_room(bins);
      band.draw(bins, objects, frame, workers);
      if (kept) {
        kept->give_up_from(band.end());
        kept->add(objects, bins);
      }
      report(context.progress, band, frame.grid, first_row,
             static_cast<double>(end) / static_cast<double>(triangles.count()));
    };
    triangles.for_each_part(limits.triangles_at_once, draw, [&](std::uint32_t first_number) {
      return rows.may_meet(first_number, first_row, band.end_row());
    });
    if (kept) band.write_coverage(*kept, coverage, frame, workers);
    band.resolve(output, frame, workers, fault);
    if (fault.get()) fail(*fault.get(), map);
    report(context.progress, band, frame.grid, first_row, 1);
    first_row = band.end_row();
  }
  return {std::move(map), sum_of(workers, triangles.count()), doubtful_pixels(workers, camera)};
}

}  // namespace

Rendered render_streamed(const StreamedScene& scene, const Camera& camera,
                         const RenderOptions& options, const StreamLimits& limits,
                         const RenderContext& context) {
  const StandardArithmetic standard;
  require_meaningful(options);
  if (limits.triangles_at_once == 0) {
    throw UsageError(Setting{"triangles_at_once"}, "expected at least 1");
  }
  return with_threads(options.threads, [&] {
    require_renderable_by_rays(scene, camera);
    require_channels_of(camera, options);
    return scene::explaining_faults(scene, [&] {
      return bends_rays(camera.projection)
                 ? render_lens_streamed(scene, camera, options, limits, context)
                 : render_in_arena(scene, camera, options, limits, context);
    });
  });
}

}  // namespace fathom
