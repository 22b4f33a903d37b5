#include <fmt/format.h>
#include <hwy/targets.h>

#include <algorithm>
#include <utility>

#include "apps/bench/parts/edge_kernels.h"
#include "apps/bench/parts/ideas.h"
#include "fathom/fast/render_fast.h"

namespace fathom::bench {
namespace {

/// What `lanes` pixels at once test: whole groups, beyond the end of a row too.
Counts box_counts(const std::vector<EdgeSetup>& setups, std::uint64_t lanes) {
  std::uint64_t steps = 0, in_boxes = 0;
  for (const EdgeSetup& s : setups) {
    const auto columns = static_cast<std::uint64_t>(s.columns);
    const auto rows = static_cast<std::uint64_t>(s.rows);
    steps += (columns + lanes - 1) / lanes * rows;
    in_boxes += columns * rows;
  }
  return {{"steps", static_cast<double>(steps)},
          {"edge functions", 3.0 * static_cast<double>(steps * lanes)},
          {"lanes used %", steps == 0 ? 100
                                      : 100.0 * static_cast<double>(in_boxes) /
                                            static_cast<double>(steps * lanes)}};
}

/// "4 lanes", "16 lanes: 2 vectors of 8"
std::string lanes_name(int lanes, int of_a_vector) {
  if (lanes > of_a_vector)
    return fmt::format("{} lanes: {} vectors of {}", lanes, lanes / of_a_vector, of_a_vector);
  return fmt::format("{} lane{}", lanes, lanes == 1 ? "" : "s");
}

template <class Number>
Variant box_variant(const PartsScene& scene, std::shared_ptr<PaddedImage<Number>> layers,
                    const std::shared_ptr<const Picture>& expected, int lanes) {
  return {.name = lanes_name(lanes, lanes_of_a_vector<Number>()),
          .prepare = [layers] { std::fill(layers->numbers.begin(), layers->numbers.end(), 0); },
          .draw =
              [layers, &scene, lanes] {
                if (lanes == 1)
                  add_boxes_one_by_one<Number>(scene.setups, *layers);
                else
                  add_boxes<Number>(scene.setups, lanes, *layers);
              },
          .picture = [layers] { return layers->picture(); },
          .counts = [&scene,
                     lanes] { return box_counts(scene.setups, static_cast<std::uint64_t>(lanes)); },
          .expected = expected};
}

template <class Number>
std::shared_ptr<PaddedImage<Number>> empty_layers(const PartsScene& scene) {
  return std::make_shared<PaddedImage<Number>>(scene.window.width, scene.window.height, Number(0));
}

constexpr int lane_counts[] = {1, 2, 4, 8, 16};

Idea in_binary32(const PartsScene& scene, const std::shared_ptr<const Picture>& expected) {
  const auto layers = empty_layers<float>(scene);
  const auto fit = std::count_if(scene.setups.begin(), scene.setups.end(),
                                 [](const EdgeSetup& s) { return s.fits_binary32(); });
  Idea idea{"lanes of binary32",
            {},
            fmt::format("binary32 holds the edge functions of {} of {} triangles; differ: pixels "
                        "that whole numbers decide otherwise",
                        fit, scene.setups.size())};
  for (const int lanes : lane_counts) {
    Variant variant = box_variant<float>(scene, layers, expected, lanes);
    variant.may_differ = static_cast<std::size_t>(fit) < scene.setups.size();
    idea.variants.push_back(std::move(variant));
  }
  return idea;
}

Idea in_binary64(const PartsScene& scene, const std::shared_ptr<const Picture>& expected) {
  const auto layers = empty_layers<double>(scene);
  Idea idea{"lanes of binary64", {}, "the plain loop is compiled without vector instructions"};
  for (const int lanes : lane_counts)
    idea.variants.push_back(box_variant<double>(scene, layers, expected, lanes));
  Variant integers = box_variant<double>(scene, layers, expected, 1);
  integers.name = "1 lane, integers of 64 bits";
  integers.draw = [layers, &scene] { add_boxes_one_by_one<std::int64_t>(scene.setups, *layers); };
  idea.variants.push_back(std::move(integers));
  return idea;
}

/// The kinds of vectors that the fast engine is compiled for and this processor has, the narrowest
/// first: one target for each width, by the lanes of binary64.
std::vector<std::pair<int, std::int64_t>> vector_widths() {
  std::vector<std::pair<int, std::int64_t>> widths;
  std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  std::reverse(targets.begin(), targets.end());  // the best one is the lowest bit
  for (const std::int64_t target : targets) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    const int lanes = lanes_of_a_vector<double>();
    if (widths.empty() || widths.back().first != lanes) {
      widths.emplace_back(lanes, target);
    } else {
      widths.back().second = target;  // a better one of the same width
    }
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  return widths;
}

/// The whole engine with one kind of vectors after the other.
Idea by_widths_of_vectors(const PartsScene& scene) {
  Idea idea{"lanes of the fast engine", {}, "binary64 with certified bounds; one thread"};
  std::vector<Variant> group;
  for (const auto& [lanes, target] : vector_widths()) {
    Variant variant = fast_variant(
        fmt::format("{} lane{} ({})", lanes, lanes == 1 ? "" : "s", hwy::TargetName(target)),
        scene.bench, {.threads = 1}, [](const RenderStatistics& s) -> Counts {
          return {{"samples tested", static_cast<double>(s.samples_tested)}};
        });
    variant.prepare = [target = target, prepare = std::move(variant.prepare)] {
      prepare();
      hwy::SetSupportedTargetsForTest(target);
      hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    };
    variant.draw = [draw = std::move(variant.draw)] {
      draw();
      hwy::SetSupportedTargetsForTest(0);
      hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    };
    group.push_back(std::move(variant));
  }
  add_group(idea.variants, std::move(group));
  return idea;
}

}  // namespace

std::vector<Idea> lanes(const PartsScene& scene) {
  const auto expected = std::make_shared<const Picture>(exact_layers(scene.window));
  std::vector<Idea> ideas{in_binary32(scene, expected), in_binary64(scene, expected)};
  ideas.push_back(by_widths_of_vectors(scene));
  return ideas;
}

}  // namespace fathom::bench
