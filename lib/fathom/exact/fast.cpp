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
// image with bounds of their errors (fast_vertex), triangles are sorted into tiles (fast_boxes,
// fast_bins), each tile draws its triangles (fast_setup, fast_tile) and writes what is visible
// (fast_resolve). What the bounds
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

ImageObjects transform(const Scene& scene, const Camera& camera) {
  ImageObjects objects;
  std::uint32_t first_number = 0;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    objects.emplace_back(scene, camera, i, first_number);
    first_number += static_cast<std::uint32_t>(objects.back().mesh.triangles.size());
  }
  return objects;
}

/// Equal parts of all triangles: enough for every thread to have several, few enough for their
/// tables of tiles to stay small.
std::vector<Bins> cut(std::uint64_t triangles) {
  constexpr std::uint64_t parts = 64, least = 4096;
  const std::uint64_t length = std::max(least, triangles / parts + 1);
  std::vector<Bins> all;
  for (std::uint64_t first = 0; first < triangles; first += length) {
    all.emplace_back(static_cast<std::uint32_t>(first),
                     static_cast<std::uint32_t>(std::min(first + length, triangles)));
  }
  return all;
}

/// Draws triangles that may be of several objects, those of an object beside each other.
void draw(std::span<const std::uint32_t> numbers, const ImageObjects& objects, Tile& tile,
          const Tile::Context& context) {
  while (!numbers.empty()) {
    const ImageObject& object = object_of(objects, numbers.front());
    const auto next = std::find_if(numbers.begin(), numbers.end(), [&](std::uint32_t number) {
      return number < object.first_number || number >= object.end_number();
    });
    const auto count = static_cast<std::size_t>(next - numbers.begin());
    tile.draw(object, numbers.first(count), context);
    numbers = numbers.subspan(count);
  }
}

/// Where the tiles write.
struct Output {
  ChannelWriter& writer;
  /// For each thread one.
  tbb::enumerable_thread_specific<CertifiedWriter>& certified;
  /// The values of Z, if that is the only channel and binary32.
  float* depths;
};

std::optional<EncodingFault> render_tile(std::uint32_t number, const std::vector<Bins>& all_bins,
                                         const ImageObjects& objects, const Frame& frame,
                                         Worker& worker, const Output& output) {
  const Tile::Context context{worker.referee, worker.statistics, frame.range, frame.perspective,
                              frame.options.fast};
  worker.tile->start(frame.grid.area(number));
  for (const Bins& bins : all_bins) draw(bins.in_tile(number), objects, *worker.tile, context);
  return worker.tile->resolve(output.writer, output.certified.local(), output.depths,
                              frame.grid.width, context);
}

float* depths_alone(DepthMap& map) {
  if (map.channels.size() != 1 || map.channels[0].name != "Z") return nullptr;
  auto* values = std::get_if<std::vector<float>>(&map.channels[0].values);
  return values ? values->data() : nullptr;
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

  const ImageObjects objects = transform(scene, camera);
  std::vector<Bins> bins = cut(triangle_count(scene));
  tbb::parallel_for(std::size_t{0}, bins.size(), [&](std::size_t i) {
    Worker& worker = workers.local();
    bins[i].fill({objects, camera, options.cull, frame.grid, worker.referee, worker.statistics});
  });

  DepthMap map = make_background(camera, options);
  ChannelWriter writer(map, scene, camera, options);
  const SceneRays rays(scene, camera);
  tbb::enumerable_thread_specific<CertifiedWriter> certified(
      [&] { return CertifiedWriter(writer, rays); });
  const Output output{writer, certified, depths_alone(map)};
  FirstFault fault;
  Progress progress(options.progress, frame.grid.count());
  tbb::parallel_for(std::uint32_t{0}, frame.grid.count(), [&](std::uint32_t tile) {
    fault.add(render_tile(tile, bins, objects, frame, workers.local(), output));
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
