#include "fathom/fast/tiles/frame.h"

#include <algorithm>
#include <iterator>

#include "fathom/threads/threads.h"

namespace fathom::fast {
using namespace triangle;

FastFrame::FastFrame(const Camera& the_camera, const RenderOptions& the_options, bool keeps)
    : camera(the_camera),
      options(the_options),
      keeps_memory(keeps),
      grid(camera.width, camera.height),
      range(depth_range(camera)),
      perspective(is_perspective(camera.projection)),
      by_area(std::ranges::count(options.channels, Channel::A) != 0) {}

ImageObjects image_objects(const TriangleSource& triangles, const Camera& camera,
                           VertexMemory* kept) {
  ImageObjects objects;
  triangles.for_each_part(0, [&](const TriangleSource::Part& part) {
    objects.emplace_back(part.object, part.mesh, camera, part.first_number, kept);
  });
  return objects;
}

std::vector<Bins> sort_into_tiles(const ImageObjects& objects, std::uint32_t first,
                                  std::uint32_t end, std::uint32_t parts, const FastFrame& frame,
                                  FastWorkers& workers, std::vector<Bins> bins) {
  constexpr std::uint64_t least = 1024;
  const std::uint64_t length = std::max(least, std::uint64_t{end - first} / parts + 1);
  std::size_t count = 0;
  for (std::uint64_t next = first; next < end; next += length) {
    const auto from = static_cast<std::uint32_t>(next);
    const auto to = static_cast<std::uint32_t>(std::min<std::uint64_t>(next + length, end));
    if (count == bins.size()) bins.emplace_back(from, to);
    bins[count++].restart(from, to);
  }
  bins.resize(count, Bins(0, 0));
  parallel_for(std::size_t{0}, bins.size(), [&](std::size_t i) {
    FastWorker& worker = workers.local();
    bins[i].fill({objects, frame.camera, frame.options.cull, frame.by_area, frame.grid,
                  worker.referee, worker.statistics, frame.keeps_memory});
  });
  return bins;
}

namespace {

bool covers_samples(const TileEntry& entry) {
  return (entry.nearness & nearness_without_samples) == 0;
}

/// The bounds settled all samples that were not settled exactly.
void count_intervals(RenderStatistics& statistics) {
  statistics.edges.interval = statistics.samples_tested - statistics.edges.exact;
  statistics.visibility.interval = statistics.samples_tested - statistics.visibility.exact;
  statistics.range.interval = statistics.samples_tested - statistics.range.exact;
}

}  // namespace

void draw_tile(Tile& tile, std::uint32_t number, const std::vector<Bins>& all_bins,
               const ImageObjects& objects, const DrawContext& context) {
  for (const Side side : {Side::front, Side::back}) {
    if (side == Side::back) tile.begin_back_faces();
    std::vector<TileEntry>& together = context.visible.entries();
    together.clear();
    for (const Bins& bins : all_bins) {
      const auto some = bins.in_tile(number, side);
      if (context.by_area) {
        std::ranges::copy_if(some, std::back_inserter(together), covers_samples);
      } else {
        together.insert(together.end(), some.begin(), some.end());
      }
    }
    context.visible.for_each_part(
        tile, context.switches.early_rejection, [&](std::span<const std::uint32_t> numbers) {
          for_each_object(numbers, objects,
                          [&](const ImageObject& object, std::span<const std::uint32_t> of_object) {
                            tile.draw(object, of_object, context);
                          });
        });
  }
}

RenderStatistics sum_of(const FastWorkers& workers, std::uint64_t triangles) {
  RenderStatistics statistics;
  statistics.triangles = triangles;
  workers.for_each([&](const FastWorker& worker) { add(statistics, worker.statistics); });
  count_intervals(statistics);
  return statistics;
}

std::vector<std::uint64_t> doubtful_pixels(const FastWorkers& workers, const Camera& camera) {
  std::vector<std::uint64_t> pixels;
  workers.for_each([&](const FastWorker& worker) {
    for (const auto& [column, row] : worker.doubtful)
      pixels.push_back(std::uint64_t{row} * camera.width + column);
  });
  return pixels;
}

}  // namespace fathom::fast
