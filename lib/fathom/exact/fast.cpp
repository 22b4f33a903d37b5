#include "fathom/exact/fast.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <mutex>

#include "fathom/exact/engine_frame.h"
#include "fathom/exact/fast_bins.h"
#include "fathom/exact/fast_tile.h"

// How to read this file: render_in_arena() is the whole story. Vertices are transformed to the
// image with bounds of their errors (fast_vertex), triangles are sorted into tiles (fast_bins),
// each tile draws its triangles (fast_setup, fast_tile) and writes what is visible. What the bounds
// do not settle goes to the referee (fast_referee), who computes exactly.
namespace fathom {
namespace {

/// What a thread works with.
struct Worker {
  Worker(const Scene& scene, const Camera& camera)
      : referee(scene, camera), tile(std::make_unique<Tile>()) {}
  Referee referee;
  RenderStatistics statistics;
  std::unique_ptr<Tile> tile;
};
using Workers = tbb::enumerable_thread_specific<Worker>;

/// What all threads share.
struct Frame {
  const Camera& camera;
  const RenderOptions& options;
  TileGrid grid;
  DepthRange range;
  bool perspective;
};

/// Whether depths at samples of the triangle may leave the range that counts: q of a covered sample
/// lies between those of the corners.
bool may_leave_range(const ImageVertex& A, const ImageVertex& B, const ImageVertex& C,
                     const DepthRange& range) {
  const double error = 2 * static_cast<double>(std::max({A.q_error, B.q_error, C.q_error}));
  return !range.certainly_contains(std::min({A.q, B.q, C.q}) - error,
                                   std::max({A.q, B.q, C.q}) + error);
}

PixelBox intersection(const PixelBox& a, const PixelBox& b) {
  return {std::max(a.first_column, b.first_column), std::min(a.last_column, b.last_column),
          std::max(a.first_row, b.first_row), std::min(a.last_row, b.last_row)};
}

/// Draws one triangle in the worker's tile.
void draw(const ImageObject& object, std::uint32_t triangle, const Frame& frame, Worker& worker,
          const Tile::Context& context) {
  Tile& tile = *worker.tile;
  const auto& [a, b, c] = object.mesh.triangles[triangle];
  const ImageVertex& A = object.vertices[a];
  const ImageVertex& B = object.vertices[b];
  const ImageVertex& C = object.vertices[c];
  PixelBox box = tile.area();
  bool test_range = true;
  TriangleSetup setup;
  setup.number = object.first_number + triangle;
  if (A.is_usable() && B.is_usable() && C.is_usable()) {
    box = intersection(box, sample_box(A, B, C, frame.grid.width, frame.grid.height));
    test_range = may_leave_range(A, B, C, frame.range);
    if (certified_setup(A, B, C, box, setup)) {
      tile.draw(setup, box, test_range, context);
      return;
    }
  }
  ++worker.statistics.exact_setups;
  tile.draw(exact_setup(worker.referee.projected(setup.number), frame.perspective, box), box,
            test_range, context);
}

std::deque<ImageObject> transform(const Scene& scene, const Camera& camera) {
  std::deque<ImageObject> objects;
  std::uint32_t first_number = 0;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    objects.emplace_back(scene, camera, i, first_number);
    first_number += static_cast<std::uint32_t>(objects.back().mesh.triangles.size());
  }
  return objects;
}

/// Equal parts of all triangles: enough for every thread to have several, few enough for their
/// tables of tiles to stay small.
std::vector<Bins> cut(const std::deque<ImageObject>& objects, std::uint64_t triangles) {
  constexpr std::uint64_t parts = 64, least = 4096;
  const std::uint64_t length = std::max(least, triangles / parts + 1);
  std::vector<Bins> all;
  for (const ImageObject& object : objects) {
    const std::uint64_t count = object.mesh.triangles.size();
    for (std::uint64_t first = 0; first < count; first += length) {
      all.emplace_back(object, static_cast<std::uint32_t>(first),
                       static_cast<std::uint32_t>(std::min(first + length, count)));
    }
  }
  return all;
}

std::optional<EncodingFault> render_tile(std::uint32_t number, const std::vector<Bins>& all_bins,
                                         const Frame& frame, Worker& worker,
                                         ChannelWriter& writer) {
  const Tile::Context context{worker.referee, worker.statistics, frame.range, frame.perspective};
  worker.tile->start(frame.grid.area(number));
  for (const Bins& bins : all_bins) {
    for (const std::uint32_t triangle : bins.in_tile(number)) {
      draw(bins.object(), triangle, frame, worker, context);
    }
  }
  return worker.tile->resolve(writer, frame.grid.width, context);
}

/// The fault of the first pixel in row order, over all tiles.
class FirstFault {
 public:
  void add(std::optional<EncodingFault> fault) {
    if (!fault) return;
    const std::lock_guard lock(mutex_);
    if (!first_ || fault->pixel < first_->pixel) first_ = std::move(fault);
  }
  [[nodiscard]] const std::optional<EncodingFault>& get() const { return first_; }

 private:
  std::optional<EncodingFault> first_;
  std::mutex mutex_;
};

/// Samples settled by the bounds are those that were not settled exactly.
void count_intervals(RenderStatistics& statistics) {
  statistics.edges.interval = statistics.samples_tested - statistics.edges.exact;
  statistics.visibility.interval = statistics.samples_tested - statistics.visibility.exact;
  statistics.range.interval = statistics.samples_tested - statistics.range.exact;
}

DepthMap render_in_arena(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  const Frame frame{camera, options, TileGrid(camera.width, camera.height), depth_range(camera),
                    camera.projection == Projection::perspective};
  Workers workers([&] { return Worker(scene, camera); });

  const std::deque<ImageObject> objects = transform(scene, camera);
  std::vector<Bins> bins = cut(objects, triangle_count(scene));
  tbb::parallel_for(std::size_t{0}, bins.size(), [&](std::size_t i) {
    Worker& worker = workers.local();
    bins[i].fill(
        {camera, options.cull, frame.range, frame.grid, worker.referee, worker.statistics});
  });

  DepthMap map = make_background(camera, options);
  ChannelWriter writer(map, scene, camera, options);
  FirstFault fault;
  Progress progress(options.progress, frame.grid.count());
  tbb::parallel_for(std::uint32_t{0}, frame.grid.count(), [&](std::uint32_t tile) {
    fault.add(render_tile(tile, bins, frame, workers.local(), writer));
    progress.part_done();
  });
  if (fault.get()) fail(*fault.get(), map);

  if (options.statistics) {
    RenderStatistics statistics;
    statistics.triangles = triangle_count(scene);
    for (const Worker& worker : workers) add(statistics, worker.statistics);
    count_intervals(statistics);
    *options.statistics = statistics;
  }
  return map;
}

}  // namespace

DepthMap render_fast(const Scene& scene, const Camera& camera, const RenderOptions& options) {
  return with_threads(options.threads, [&] { return render_in_arena(scene, camera, options); });
}

}  // namespace fathom
