#include "fathom/fast/some_tiles.h"

#include <algorithm>
#include <optional>

#include "fathom/fast/channels/resolve.h"
#include "fathom/fast/rounds/coverage_in_rounds.h"
#include "fathom/fast/rounds/tile_store.h"
#include "fathom/fast/tiles/frame.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/element_checks.h"
#include "fathom/scene/scene_fault.h"

// How to read this file: in each round, sort() and draw() process some triangles as
// render_in_arena() (render_fast.cpp) processes all, and the TileStore keeps the tiles between
// rounds; rows() writes the visible surfaces at the end.
namespace fathom {
using namespace fast;
using namespace rendering;
using namespace triangle;

struct SortedTriangles::State {
  std::vector<SomeTriangles> triangles;
  ImageObjects objects;
  std::vector<Bins> bins;
  TileGrid grid;
};

SortedTriangles::SortedTriangles() = default;
SortedTriangles::SortedTriangles(SortedTriangles&& other) noexcept = default;
SortedTriangles& SortedTriangles::operator=(SortedTriangles&& other) noexcept = default;
SortedTriangles::~SortedTriangles() = default;

namespace {

/// Calls visit(entries) for the lists of a tile, one for each side and part.
template <class Visit>
void for_each_list(const std::vector<Bins>& bins, std::uint32_t tile, const Visit& visit) {
  for (const Bins& part : bins)
    for (const Side side : {Side::front, Side::back}) visit(part.in_tile(tile, side));
}

/// The number of parts of a round, enough to keep all threads busy. Each part has a table of all
/// tiles, which for a large image takes longer to fill than the triangles of a round.
std::uint32_t parts_of_round(const RenderOptions& options) {
  return options.threads == 1 ? 1 : 8;
}

}  // namespace

const std::vector<SomeTriangles>& SortedTriangles::triangles() const {
  return state_->triangles;
}

void SortedTriangles::count(std::span<std::uint64_t> of_tiles) const {
  for (std::uint32_t tile = 0; tile < of_tiles.size(); ++tile) {
    for_each_list(state_->bins, tile,
                  [&](std::span<const TileEntry> list) { of_tiles[tile] += list.size(); });
  }
}

std::vector<TileTouch> SortedTriangles::touches(const WantedTile& wanted_tile) const {
  std::vector<TileTouch> touches;
  for (std::uint32_t tile = 0; tile < state_->grid.count(); ++tile) {
    if (!is_met(state_->bins, tile) || !wanted_tile(tile)) continue;
    for_each_list(state_->bins, tile, [&](std::span<const TileEntry> list) {
      for (const TileEntry& entry : list) touches.push_back({tile, entry.number});
    });
  }
  return touches;
}

std::uint64_t SortedTriangles::count_triangles(const WantedTile& wanted_tile) const {
  const ImageObjects& objects = state_->objects;
  std::vector<bool> seen(objects.empty() ? 0 : objects.back().end_number(), false);
  for (std::uint32_t tile = 0; tile < state_->grid.count(); ++tile) {
    if (!is_met(state_->bins, tile) || !wanted_tile(tile)) continue;
    for_each_list(state_->bins, tile, [&](std::span<const TileEntry> list) {
      for (const TileEntry& entry : list) seen[entry.number] = true;
    });
  }
  return static_cast<std::uint64_t>(std::ranges::count(seen, true));
}

struct TilesInRounds::State {
  State(const TriangleSource& scene, const Camera& the_camera, const RenderOptions& the_options,
        const Limits& the_limits)
      : triangles(scene),
        options(the_options),
        camera(the_camera),
        frame(camera, options),
        rays(triangles, camera),
        workers([this] { return FastWorker(triangles, camera, rays); }),
        sorting_again([this] { return FastWorker(triangles, camera, rays); }),
        limits(the_limits),
        tiles(frame.grid, limits.tile_bytes) {}

  SortedTriangles sort(std::vector<SomeTriangles> lists, FastWorkers& by) const;
  void choose(std::vector<std::uint32_t> numbers);
  void draw(const SortedTriangles::State& sorted);
  DepthMap rows(std::uint32_t first_row, std::uint32_t end_row);

  TriangleSource triangles;
  RenderOptions options;
  const Camera& camera;
  FastFrame frame;
  SceneRays rays;
  FastWorkers workers, sorting_again;
  Limits limits;
  TileStore tiles;
  /// The tiles that are drawn here, and for each tile of the image whether it is drawn here.
  std::vector<std::uint32_t> chosen;
  std::vector<std::uint8_t> is_chosen;
  /// Where channel A is asked for.
  std::optional<CoverageInRounds> coverage;
};

// Triangles are numbered from 0 through the lists.
SortedTriangles TilesInRounds::State::sort(std::vector<SomeTriangles> lists,
                                           FastWorkers& by) const {
  SortedTriangles result;
  result.state_ = std::make_unique<SortedTriangles::State>(
      SortedTriangles::State{std::move(lists), {}, {}, frame.grid});
  SortedTriangles::State& sorted = *result.state_;
  std::uint32_t next = 0;
  for (SomeTriangles& list : sorted.triangles) {
    const std::size_t count = list.mesh.triangles.size();
    if (list.numbers.empty()) {
      list.numbers.resize(count);
      for (std::size_t i = 0; i < count; ++i)
        list.numbers[i] = list.first_number + static_cast<std::uint32_t>(i);
    }
    sorted.objects.emplace_back(triangles.objects()[list.object], list.mesh, camera, next, nullptr,
                                list.numbers);
    next += static_cast<std::uint32_t>(count);
  }
  sorted.bins = scene::explaining_faults(triangles, [&] {
    return sort_into_tiles(sorted.objects, 0, next, parts_of_round(options), frame, by);
  });
  return result;
}

void TilesInRounds::State::choose(std::vector<std::uint32_t> numbers) {
  is_chosen.assign(frame.grid.count(), 0);
  for (const std::uint32_t tile : numbers) is_chosen[tile] = 1;
  if (frame.by_area)
    coverage.emplace(CoverageInRounds::Scene{frame, triangles, rays}, numbers, limits.kept_bytes);
  chosen = std::move(numbers);
}

void TilesInRounds::State::draw(const SortedTriangles::State& sorted) {
  std::vector<std::uint32_t> met;
  for (const std::uint32_t tile : chosen)
    if (is_met(sorted.bins, tile)) met.push_back(tile);
  const std::size_t at_once = tiles.most_at_once();
  for (std::size_t first = 0; first < met.size(); first += at_once) {
    parallel_for(first, std::min(first + at_once, met.size()), [&](std::size_t i) {
      draw_tile(tiles.take(met[i]), met[i], sorted.bins, sorted.objects,
                frame.context(workers.local()));
    });
    tiles.make_room();
  }
  if (coverage) coverage->add(sorted.objects, sorted.bins);
}

DepthMap TilesInRounds::State::rows(std::uint32_t first_row, std::uint32_t end_row) {
  const TileGrid& grid = frame.grid;
  const std::uint32_t first = first_row * grid.columns, end = end_row * grid.columns;
  const MapLayout layout{grid.width, grid.area(first).first_row};
  Camera part = camera;
  part.height = grid.area(end - 1).last_row - layout.first_row + 1;
  auto [map, background] = make_unfilled_map(part, options);
  ChannelWriter writer(map, triangles, camera, options);
  FastOutput output(map, writer, rays, std::move(background));
  if (coverage) {
    float* const values = writer.values().coverage;
    coverage->write(first, end, [&](std::uint32_t number, TileCoverage& of_tile) {
      of_tile.write(tiles.take(number), number, frame.context(workers.local()), values, layout);
    });
  }
  FirstFault fault;
  parallel_for(first, end, [&](std::uint32_t number) {
    if (is_chosen[number] == 0) return;
    if (!tiles.exists(number)) {
      output.write_background(grid.area(number), layout);
      return;
    }
    fault.add(output.write(tiles.take(number), layout, frame.context(workers.local())));
    tiles.forget(number);
  });
  if (fault.get()) {
    EncodingFault in_image = *fault.get();
    in_image.pixel += layout.first_row * std::size_t{grid.width};
    fail(in_image, map);
  }
  return std::move(map);
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
    require_renderable(scene, camera, LookAtElements::later);
    state_ = std::make_unique<State>(scene, camera, options, limits);
  });
}

TilesInRounds::~TilesInRounds() = default;

SortedTriangles TilesInRounds::sort(std::vector<SomeTriangles> triangles) {
  return in_threads(state_->options.threads,
                    [&] { return state_->sort(std::move(triangles), state_->workers); });
}

SortedTriangles TilesInRounds::sort_again(std::vector<SomeTriangles> triangles) {
  return in_threads(state_->options.threads,
                    [&] { return state_->sort(std::move(triangles), state_->sorting_again); });
}

void TilesInRounds::choose(std::vector<std::uint32_t> tiles) {
  state_->choose(std::move(tiles));
}

void TilesInRounds::draw(const SortedTriangles& triangles) {
  in_threads(state_->options.threads, [&] { state_->draw(*triangles.state_); });
}

DepthMap TilesInRounds::rows(std::uint32_t first_row, std::uint32_t end_row) {
  return in_threads(state_->options.threads, [&] { return state_->rows(first_row, end_row); });
}

RenderStatistics TilesInRounds::statistics() const {
  return sum_of(state_->workers, state_->triangles.count());
}

ImageTiles tiles_of(const Camera& camera) {
  const TileGrid grid(camera.width, camera.height);
  return {Tile::size, grid.columns, grid.rows};
}

}  // namespace fathom
