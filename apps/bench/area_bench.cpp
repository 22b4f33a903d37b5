#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "fathom/area/areas.h"
#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/threads/threads.h"
#include "validation/scenes/scenes.h"

/// Times areas_in_direction(), from the scene in memory to the list of areas, as `fathom areas`
/// calls it: directions at the same time, each by one thread.
///   area_bench [SCENE…] [--directions N] [--by object|face|triangle] [--threads N] [--repeat N]
/// Scenes are named in scenes.h, or are mesh or scene files. The directions lie evenly on the half
/// of the sphere with y > 0. Prints the median of the wall-clock time and the least processor time,
/// which other work on the machine hardly changes, over the number of directions.
namespace {

using namespace fathom;
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::vector<std::string> scenes;
  std::size_t directions = 16;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  int repeat = 5;
  AreaItemKind by = AreaItemKind::face;
};

Arguments parse(int argc, char** argv) {
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (!name.starts_with("--")) {
      arguments.scenes.push_back(name);
      continue;
    }
    if (++i == argc) throw UsageError(name + " needs a value");
    const int number = std::max(1, std::atoi(argv[i]));
    if (name == "--directions") {
      arguments.directions = static_cast<std::size_t>(number);
    } else if (name == "--threads") {
      arguments.threads = number;
    } else if (name == "--repeat") {
      arguments.repeat = number;
    } else if (name == "--by") {
      const auto by = value_named(all_area_item_kinds, argv[i]);
      if (!by || are_segments(*by)) {
        throw UsageError("--by: expected object, face or triangle");
      }
      arguments.by = *by;
    } else {
      throw UsageError("there is no option " + name);
    }
  }
  if (arguments.scenes.empty()) arguments.scenes = {"city-2", "city-4", "mesh", "sphere-20k"};
  return arguments;
}

/// Points of a Fibonacci lattice: rings of equal height, turned by the golden angle.
std::vector<AreaDirection> directions_above_ground(std::size_t count) {
  constexpr double golden_angle = std::numbers::pi * (3 - 2.2360679774997896);
  std::vector<AreaDirection> directions;
  for (std::size_t k = 0; k < count; ++k) {
    const double y = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    const double radius = std::sqrt(1 - y * y), angle = golden_angle * static_cast<double>(k);
    directions.push_back({radius * std::cos(angle), y, radius * std::sin(angle)});
  }
  return directions;
}

void time_scene(const std::string& name, const Arguments& arguments) {
  const bench::BenchScene bench = bench::make_scene(name, 64, 64);
  const TriangleSource triangles(bench.scene);
  AreaOptions options = options_of(area_items(bench.scene, arguments.by));
  options.threads = 1;
  const std::vector<AreaDirection> directions = directions_above_ground(arguments.directions);
  std::vector<double> wall, processor;
  const auto count = static_cast<double>(directions.size());
  for (int run = 0; run < arguments.repeat; ++run) {
    const auto start = Clock::now();
    const std::clock_t used = std::clock();
    with_threads(arguments.threads, [&] {
      in_parallel(directions.size(), [&](std::size_t k) {
        static_cast<void>(areas_in_direction(triangles, directions[k], options));
      });
    });
    const std::chrono::duration<double, std::milli> time = Clock::now() - start;
    wall.push_back(time.count() / count);
    processor.push_back(1000.0 * static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC / count);
  }
  std::sort(wall.begin(), wall.end());
  std::printf(
      "%-16s %10llu triangles %4zu directions %2d threads  each %9.2f ms, %9.2f ms of processors\n",
      name.c_str(), static_cast<unsigned long long>(triangles.count()), directions.size(),
      arguments.threads, wall[wall.size() / 2],
      *std::min_element(processor.begin(), processor.end()));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Arguments arguments = parse(argc, argv);
    for (const std::string& scene : arguments.scenes) time_scene(scene, arguments);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "area_bench: error: %s\n", error.what());
    return 2;
  }
}
