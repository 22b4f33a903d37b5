#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "fathom/fast/channels/resolve.h"
#include "fathom/fast/tiles/frame.h"
#include "fathom/render.h"
#include "validation/scenes/scenes.h"

/// The stages of the fast engine one by one, in one thread, at 1920×1080, each on what the stages
/// before it have left: build/…/bin/stages_bench [--benchmark_filter=…]. Rates: triangles per
/// second, for writing the map pixels per second. Besides, what reading and writing memory takes
/// without anything else, in bytes per second.
namespace {

using namespace fathom;
using namespace fathom::fast;
using triangle::ChannelWriter;
using triangle::SceneRays;

/// A scene with what the engine makes of it.
struct Stages {
  explicit Stages(const std::string& name) : bench(bench::make_scene(name, 1920, 1080)) {
    options.engine = Engine::fast;
    options.threads = 1;
  }

  [[nodiscard]] ImageObjects transform() const {
    ImageObjects objects;
    source.for_each_part(0, [&](const TriangleSource::Part& part) {
      objects.emplace_back(part.object, part.mesh, bench.camera, part.first_number);
    });
    return objects;
  }
  [[nodiscard]] std::vector<Bins> sort(const ImageObjects& objects) {
    return with_threads(1, [&] {
      return sort_into_tiles(objects, 0, static_cast<std::uint32_t>(source.count()), 64, frame,
                             workers);
    });
  }

  bench::BenchScene bench;
  RenderOptions options;
  TriangleSource source{bench.scene};
  FastFrame frame{bench.camera, options};
  SceneRays rays{source, bench.camera};
  FastWorkers workers{[this] { return FastWorker(source, bench.camera, rays); }};
};

void count_triangles(benchmark::State& state, const Stages& stages) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(stages.source.count()));
}

void transform(benchmark::State& state, const std::string& scene) {
  const Stages stages(scene);
  for (auto _ : state) benchmark::DoNotOptimize(stages.transform());
  count_triangles(state, stages);
}

void sort_into_bins(benchmark::State& state, const std::string& scene) {
  Stages stages(scene);
  const ImageObjects objects = stages.transform();
  for (auto _ : state) benchmark::DoNotOptimize(stages.sort(objects));
  count_triangles(state, stages);
}

/// Every triangle for the whole image, as many at once as there are lanes.
void set_up(benchmark::State& state, const std::string& scene) {
  const Stages stages(scene);
  const ImageObjects objects = stages.transform();
  const PixelBox image{0, stages.bench.camera.width - 1, 0, stages.bench.camera.height - 1};
  SetupBatch batch;
  for (auto _ : state) {
    for (const ImageObject& object : objects) {
      const auto& triangles = object.mesh.triangles;
      for (std::size_t first = 0; first < triangles.size(); first += SetupBatch::most) {
        certified_setups(object.vertices.get(), triangles.data() + first,
                         std::min(SetupBatch::most, triangles.size() - first), image,
                         stages.frame.range, batch);
        benchmark::DoNotOptimize(batch.empty);
      }
    }
  }
  count_triangles(state, stages);
}

/// Setting up is part of it, for every tile that a triangle meets.
void draw_tiles(benchmark::State& state, const std::string& scene) {
  Stages stages(scene);
  const ImageObjects objects = stages.transform();
  const std::vector<Bins> bins = stages.sort(objects);
  const DrawContext context = stages.frame.context(stages.workers.local());
  const auto tile = std::make_unique<Tile>();
  for (auto _ : state) {
    for (std::uint32_t i = 0; i < stages.frame.grid.count(); ++i) {
      tile->start(stages.frame.grid.area(i));
      draw_tile(*tile, i, bins, objects, context);
    }
  }
  count_triangles(state, stages);
}

/// A tile for each part of the image, drawn before.
void resolve_tiles(benchmark::State& state, const std::string& scene) {
  Stages stages(scene);
  const Camera& camera = stages.bench.camera;
  const ImageObjects objects = stages.transform();
  const std::vector<Bins> bins = stages.sort(objects);
  const DrawContext context = stages.frame.context(stages.workers.local());
  std::vector<std::unique_ptr<Tile>> tiles;
  for (std::uint32_t i = 0; i < stages.frame.grid.count(); ++i) {
    tiles.push_back(std::make_unique<Tile>());
    tiles.back()->start(stages.frame.grid.area(i));
    draw_tile(*tiles.back(), i, bins, objects, context);
  }
  DepthMap map = rendering::make_background(camera, stages.options);
  ChannelWriter writer(map, stages.source, camera, stages.options);
  FastOutput output(map, writer, stages.rays);
  for (auto _ : state) {
    for (const auto& tile : tiles) {
      benchmark::DoNotOptimize(output.write(*tile, {camera.width}, context));
    }
  }
  state.SetItemsProcessed(state.iterations() * std::int64_t{camera.width} * camera.height);
}

/// More than caches hold.
constexpr std::size_t memory_words = std::size_t{1} << 27;

void read_memory(benchmark::State& state) {
  const std::vector<std::uint64_t> words(memory_words, 1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(std::accumulate(words.begin(), words.end(), std::uint64_t{0}));
  }
  state.SetBytesProcessed(state.iterations() * std::int64_t{8 * memory_words});
}

/// So much at once goes past the caches, as rows of a map do.
void write_memory(benchmark::State& state) {
  std::vector<std::uint64_t> words(memory_words, 1);
  for (auto _ : state) {
    std::memset(words.data(), 2, 8 * words.size());
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * std::int64_t{8 * memory_words});
}

}  // namespace

int main(int argc, char** argv) {
  for (const std::string& name : fathom::bench::default_scene_names()) {
    const auto add = [&](const char* stage, auto* function) {
      benchmark::RegisterBenchmark((name + "/" + stage).c_str(), function, name)
          ->Unit(benchmark::kMillisecond);
    };
    add("transform", transform);
    add("sort", sort_into_bins);
    add("set-up", set_up);
    add("draw", draw_tiles);
    add("resolve", resolve_tiles);
  }
  benchmark::RegisterBenchmark("memory/read", read_memory)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("memory/write", write_memory)->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
