#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "fathom/attribution/attribution.h"
#include "fathom/attribution/faults/residuals.h"
#include "fathom/attribution/model/named_models.h"
#include "tests/attribution/float_rasterizer.h"
#include "tests/effort.h"
#include "validation/scenes/shapes.h"

/// Meshes of two triangles and of a few: what is measured of a fault is no farther from the truth
/// than its standard deviation says. Every corner is rounded to binary32, once, and its triangles
/// share that.
namespace fathom::attribution {
namespace {

Camera small_camera() {
  Camera camera{.width = 64, .height = 48, .projection = {.fx = 60, .fy = 60, .cx = 32, .cy = 24}};
  camera.near = 0.5;
  camera.far = 20;
  return camera;
}

/// Quads of two triangles, one above the other, each tilted by chance.
Scene tilted_quads(std::mt19937& random, int count) {
  std::uniform_real_distribution<double> depth(2, 5), noise(-0.1, 0.1);
  Mesh mesh;
  for (int k = 0; k < count; ++k) {
    const double top = -1.6 + 3.2 * k / count, bottom = -1.6 + 3.2 * (k + 1) / count;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto add = [&](double x, double y) {
      const double z = depth(random);
      mesh.vertices.push_back({x + noise(random), y + noise(random), z});
    };
    add(-1.5, top);
    add(1.5, top);
    add(1.5, bottom);
    add(-1.5, bottom);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return bench::as_scene({mesh}, "quads");
}

/// How far what was measured is from the truth, in its standard deviations.
struct Deviations {
  std::vector<double> of_all;
  std::string worst;
  int unnamed = 0;

  void add(const Finding& finding, double true_x, double true_y) {
    for (const Estimate& e : finding.estimates) {
      const double off = (e.value - (e.name == "centre x" ? true_x : true_y)) / e.deviation;
      if (of_all.empty() || std::abs(off) > greatest()) worst = finding.text;
      of_all.push_back(std::abs(off));
    }
  }
  [[nodiscard]] double greatest() const { return *std::max_element(of_all.begin(), of_all.end()); }
  [[nodiscard]] double share_within(double limit) const {
    const auto within =
        std::count_if(of_all.begin(), of_all.end(), [limit](double off) { return off <= limit; });
    return static_cast<double>(within) / static_cast<double>(of_all.size());
  }
};

Deviations measured(int quads, int scenes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.45, 0.45);
  Deviations deviations;
  for (int k = 0; k < scenes; ++k) {
    const Truth truth = make_truth(tilted_quads(random, quads), small_camera());
    const test::Fault fault{.shift_x = shift(random), .shift_y = shift(random)};
    OtherMap map = test::trace_in_binary32(truth.mesh, truth.camera, fault);
    map.triangles.clear();
    const Attribution found = attribute_and_name(truth, map, model_named("float32-ray"));
    // Where one parameter explains it all, the other is not measured.
    if (found.findings.size() != 1 || found.findings.front().kind != "shift" ||
        found.findings.front().estimates.size() != 2) {
      ++deviations.unnamed;
      continue;
    }
    deviations.add(found.findings.front(), -fault.shift_x, -fault.shift_y);
  }
  return deviations;
}

class StandardDeviations : public ::testing::TestWithParam<int> {};

// Were they those of independent pixels, the truth would be tens of them away.
TEST_P(StandardDeviations, SayHowFarTheTruthIs) {
  const int scenes = 60 / fathom::checks::effort;
  const Deviations off = measured(GetParam(), scenes);
  EXPECT_LE(off.unnamed, scenes / 10);
  ASSERT_FALSE(off.of_all.empty());
  EXPECT_LE(off.greatest(), 4) << off.worst;
  EXPECT_GE(off.share_within(3), 0.99) << off.worst;
  EXPECT_GE(off.share_within(1), 0.68) << off.worst;
  EXPECT_LE(off.share_within(0.01), 0.9);  // nor are they so large that they say nothing
}

INSTANTIATE_TEST_SUITE_P(Quads, StandardDeviations, ::testing::Values(1, 2, 6));

}  // namespace
}  // namespace fathom::attribution
