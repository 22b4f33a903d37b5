#include "fathom/fast/some_tiles.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "fathom/fast/image_in_rounds.h"
#include "fathom/fast/rounds/coverage_in_rounds.h"
#include "fathom/fast/rounds/tile_store.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/rendering/map_background.h"
#include "fathom/scene/element_checks.h"
#include "fathom/scene/scene_fault.h"

// How to read this file: in each round, sort() and draw() of StraightImage do with some triangles
// what render_in_arena() (render_fast.cpp) does with all, and the TileStore keeps the tiles between
// rounds; rows() writes what is visible in the end. Images of lenses: some_tiles_lens.cpp.
namespace fathom {
using namespace fast;
using namespace rendering;
using namespace triangle;

struct SortedTriangles::State {
  std::vector<SomeTriangles> triangles;
  SortedViews views;
  std::uint32_t tiles;

  /// Calls visit(tile, entries) for the lists of the wanted tiles.
  template <class Wanted, class Visit>
  void for_each_list(const Wanted& wanted_tile, const Visit& visit) const {
    for (std::uint32_t tile = 0; tile < tiles; ++tile) {
      if (!wanted_tile(tile)) continue;
      for (const SortedView& view : views)
        view.for_each_list(tile, [&](std::span<const TileEntry> list) { visit(tile, list); });
    }
  }
};

SortedTriangles::SortedTriangles() = default;
SortedTriangles::SortedTriangles(SortedTriangles&& other) noexcept = default;
SortedTriangles& SortedTriangles::operator=(SortedTriangles&& other) noexcept = default;
SortedTriangles::~SortedTriangles() = default;

const std::vector<SomeTriangles>& SortedTriangles::triangles() const {
  return state_->triangles;
}

void SortedTriangles::count(std::span<std::uint64_t> of_tiles) const {
  state_->for_each_list(
      [](std::uint32_t) { return true; },
      [&](std::uint32_t tile, std::span<const TileEntry> list) { of_tiles[tile] += list.size(); });
}

std::vector<TileTouch> SortedTriangles::touches(const WantedTile& wanted_tile) const {
  std::vector<TileTouch> touches;
  state_->for_each_list(wanted_tile, [&](std::uint32_t tile, std::span<const TileEntry> list) {
    for (const TileEntry& entry : list) touches.push_back({tile, entry.number});
  });
  return touches;
}

std::uint64_t SortedTriangles::count_triangles(const WantedTile& wanted_tile) const {
  std::size_t count = 0;
  for (const SomeTriangles& list : state_->triangles) count += list.mesh.triangles.size();
  std::vector<bool> seen(count, false);
  state_->for_each_list(wanted_tile, [&](std::uint32_t, std::span<const TileEntry> list) {
    for (const TileEntry& entry : list) seen[entry.number] = true;
  });
  return static_cast<std::uint64_t>(std::ranges::count(seen, true));
}

namespace fast {
namespace {

/// The number of parts of a round, enough to keep all threads busy. Each part has a table of all
/// tiles, which for a large image takes longer to fill than the triangles of a round.
std::uint32_t parts_of_round(const RenderOptions& options) {
  return options.threads == 1 ? 1 : 8;
}

}  // namespace

SortedView sort_round(const std::vector<SomeTriangles>& lists, const TriangleSource& triangles,
                      const FastFrame& frame, FastWorkers& workers) {
  SortedView sorted{{}, {}, frame.grid};
  std::uint32_t next = 0;
  for (const SomeTriangles& list : lists) {
    sorted.objects.emplace_back(triangles.objects()[list.object], list.mesh, frame.camera, next,
                                nullptr, list.numbers);
    next += static_cast<std::uint32_t>(list.mesh.triangles.size());
  }
  sorted.bins = scene::explaining_faults(triangles, [&] {
    return sort_into_tiles(sorted.objects, 0, next, parts_of_round(frame.options), frame, workers);
  });
  return sorted;
}

RowsOfTiles::RowsOfTiles(const Camera& of_image, const TileGrid& grid, std::uint32_t first_row,
                         std::uint32_t end_row)
    : first_tile(first_row * grid.columns),
      end_tile(end_row * grid.columns),
      layout{grid.width, grid.area(first_tile).first_row},
      camera(of_image) {
  camera.height = grid.area(end_tile - 1).last_row - layout.first_row + 1;
}

void RowsOfTiles::require_no_fault(const FirstFault& fault, const DepthMap& map) const {
  if (!fault.get()) return;
  EncodingFault in_image = *fault.get();
  in_image.pixel += layout.first_row * std::size_t{layout.width};
  fail(in_image, map);
}

namespace {

/// An image of a camera with straight edges.
class StraightImage : public ImageInRounds {
 public:
  StraightImage(const TriangleSource& triangles, const Camera& camera, const RenderOptions& options,
                const TilesInRounds::Limits& limits)
      : triangles_(triangles),
        options_(options),
        camera_(camera),
        frame_(camera, options),
        rays_(triangles, camera),
        workers_([this] { return FastWorker(triangles_, camera_, rays_); }),
        sorting_again_([this] { return FastWorker(triangles_, camera_, rays_); }),
        limits_(limits),
        tiles_(frame_.grid, limits.tile_bytes) {}

  [[nodiscard]] std::uint32_t view_count() const override { return 1; }
  SortedViews sort(const std::vector<SomeTriangles>& lists, Counted counted) override;
  void choose(std::vector<std::uint32_t> numbers) override;
  void draw(const SortedViews& views) override;
  DepthMap rows(std::uint32_t first_row, std::uint32_t end_row) override;
  [[nodiscard]] RenderStatistics statistics() const override {
    return sum_of(workers_, triangles_.count());
  }

 private:
  const TriangleSource& triangles_;
  const RenderOptions& options_;
  const Camera& camera_;
  FastFrame frame_;
  SceneRays rays_;
  FastWorkers workers_, sorting_again_;
  TilesInRounds::Limits limits_;
  TileStore tiles_;
  /// The tiles that are drawn here, and for each tile of the image whether it is drawn here.
  std::vector<std::uint32_t> chosen_;
  std::vector<std::uint8_t> is_chosen_;
  /// Where channel A is asked for.
  std::optional<CoverageInRounds> coverage_;
};

SortedViews StraightImage::sort(const std::vector<SomeTriangles>& lists, Counted counted) {
  SortedViews views;
  views.push_back(
      sort_round(lists, triangles_, frame_, counted == Counted::here ? workers_ : sorting_again_));
  return views;
}

void StraightImage::choose(std::vector<std::uint32_t> numbers) {
  is_chosen_.assign(frame_.grid.count(), 0);
  for (const std::uint32_t tile : numbers) is_chosen_[tile] = 1;
  if (frame_.by_area)
    coverage_.emplace(CoverageInRounds::Scene{frame_, triangles_, rays_}, numbers,
                      limits_.kept_bytes);
  chosen_ = std::move(numbers);
}

void StraightImage::draw(const SortedViews& views) {
  const SortedView& sorted = views.front();
  std::vector<std::uint32_t> met;
  for (const std::uint32_t tile : chosen_)
    if (is_met(sorted.bins, tile)) met.push_back(tile);
  const std::size_t at_once = tiles_.most_at_once();
  for (std::size_t first = 0; first < met.size(); first += at_once) {
    parallel_for(first, std::min(first + at_once, met.size()), [&](std::size_t i) {
      draw_tile(tiles_.take(met[i]), met[i], sorted.bins, sorted.objects,
                frame_.context(workers_.local()));
    });
    tiles_.make_room();
  }
  if (coverage_) coverage_->add(sorted.objects, sorted.bins);
}

DepthMap StraightImage::rows(std::uint32_t first_row, std::uint32_t end_row) {
  const TileGrid& grid = frame_.grid;
  const RowsOfTiles part(camera_, grid, first_row, end_row);
  auto [map, background] = make_unfilled_map(part.camera, options_);
  ChannelWriter writer(map, triangles_, camera_, options_);
  FastOutput output(map, writer, rays_, std::move(background));
  if (coverage_) {
    float* const values = writer.values().coverage;
    coverage_->write(part.first_tile, part.end_tile,
                     [&](std::uint32_t number, TileCoverage& of_tile) {
                       of_tile.write(tiles_.take(number), number, frame_.context(workers_.local()),
                                     values, part.layout);
                     });
  }
  FirstFault fault;
  parallel_for(part.first_tile, part.end_tile, [&](std::uint32_t number) {
    if (is_chosen_[number] == 0) return;
    if (!tiles_.exists(number)) {
      output.write_background(grid.area(number), part.layout);
      return;
    }
    fault.add(output.write(tiles_.take(number), part.layout, frame_.context(workers_.local())));
    tiles_.forget(number);
  });
  part.require_no_fault(fault, map);
  return std::move(map);
}

}  // namespace
}  // namespace fast

struct TilesInRounds::State {
  State(const TriangleSource& scene, const Camera& camera, const RenderOptions& the_options,
        const Limits& limits)
      : triangles(scene),
        options(the_options),
        tiles(tiles_of(camera)),
        image(bends_rays(camera.projection)
                  ? lens_image(triangles, camera, options, limits)
                  : std::make_unique<StraightImage>(triangles, camera, options, limits)) {}

  SortedTriangles sort(std::vector<SomeTriangles> lists, ImageInRounds::Counted counted) const;

  TriangleSource triangles;
  RenderOptions options;
  ImageTiles tiles;
  std::unique_ptr<ImageInRounds> image;
};

// Triangles are numbered from 0 through the lists.
SortedTriangles TilesInRounds::State::sort(std::vector<SomeTriangles> lists,
                                           ImageInRounds::Counted counted) const {
  SortedTriangles result;
  result.state_ = std::make_unique<SortedTriangles::State>(
      SortedTriangles::State{std::move(lists), {}, tiles.count()});
  SortedTriangles::State& sorted = *result.state_;
  for (SomeTriangles& list : sorted.triangles) {
    if (!list.numbers.empty()) continue;
    list.numbers.resize(list.mesh.triangles.size());
    std::iota(list.numbers.begin(), list.numbers.end(), list.first_number);
  }
  sorted.views = image->sort(sorted.triangles, counted);
  return result;
}

namespace {

/// Runs work() in the requested number of threads.
template <class Work>
auto in_threads(int threads, const Work& work) {
  const StandardArithmetic standard;
  return with_threads(threads, work);
}

}  // namespace

TilesInRounds::TilesInRounds(const TriangleSource& scene, const Camera& camera,
                             const RenderOptions& options, const Limits& limits) {
  require_meaningful(options);
  in_threads(options.threads, [&] {
    require_renderable_by_rays(scene, camera, LookAtElements::later);
    require_channels_of(camera, options);
    state_ = std::make_unique<State>(scene, camera, options, limits);
  });
}

TilesInRounds::~TilesInRounds() = default;

std::uint32_t TilesInRounds::view_count() const {
  return state_->image->view_count();
}

SortedTriangles TilesInRounds::sort(std::vector<SomeTriangles> triangles) {
  return in_threads(state_->options.threads, [&] {
    return state_->sort(std::move(triangles), ImageInRounds::Counted::here);
  });
}

SortedTriangles TilesInRounds::sort_again(std::vector<SomeTriangles> triangles) {
  return in_threads(state_->options.threads, [&] {
    return state_->sort(std::move(triangles), ImageInRounds::Counted::elsewhere);
  });
}

void TilesInRounds::choose(std::vector<std::uint32_t> tiles) {
  state_->image->choose(std::move(tiles));
}

void TilesInRounds::draw(const SortedTriangles& triangles) {
  in_threads(state_->options.threads, [&] { state_->image->draw(triangles.state_->views); });
}

DepthMap TilesInRounds::rows(std::uint32_t first_row, std::uint32_t end_row) {
  return in_threads(state_->options.threads,
                    [&] { return state_->image->rows(first_row, end_row); });
}

RenderStatistics TilesInRounds::statistics() const {
  return state_->image->statistics();
}

ImageTiles tiles_of(const Camera& camera) {
  const TileGrid grid(camera.width, camera.height);
  return {Tile::size, grid.columns, grid.rows};
}

}  // namespace fathom
