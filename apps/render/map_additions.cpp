#include "apps/render/map_additions.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "apps/options/depth_format_options.h"
#include "apps/shell/console.h"
#include "fathom/area/coverage.h"
#include "fathom/image/depth_map.h"
#include "fathom/reference/verify.h"
#include "fathom/render.h"
#include "fathom/text/counted.h"

namespace fathom::app {
namespace {

/// Adds the channels of the plan to a map that was rendered with these options, and a text that
/// describes the format.
DepthBufferReport add_depth_buffer_channels(DepthMap& map, const DepthBufferPlan& plan,
                                            const TriangleSource& triangles, const Camera& camera,
                                            const RenderOptions& options) {
  DepthBufferReport report{format_for(plan, camera), plan.against_exact, {}};
  report.seen =
      add_depth_buffer(map, triangles, camera, {report.format, plan.against_exact, options});
  map.texts[depth_format_text] = json_of(report.format).dump();
  return report;
}

/// Removes the channels that only the depth buffer needed.
void drop_helpers(DepthMap& map, const DepthBufferPlan& plan) {
  if (plan.drops_id) std::erase_if(map.channels, [](const auto& c) { return c.name == "id"; });
}

/// Adds to the choice all pixels at which a bound nearly failed to settle a decision. Returns their
/// number.
std::uint64_t choose_nearly_unsettled(const RenderedFrom& from, PixelChoice& chosen) {
  if (from.options.engine != Engine::fast) return 0;
  RenderOptions options = from.options;
  options.fast.widening = 16;
  options.fast.find_doubtful = true;
  const std::vector<std::uint64_t> doubtful = from.render(options).doubtful;
  PixelChoice near(chosen.size(), false);
  std::uint64_t count = 0;
  for (const std::uint64_t pixel : doubtful) {
    count += near[pixel] ? 0 : 1;
    near[pixel] = chosen[pixel] = true;
  }
  return count;
}

std::string agreement(const MapVerification& v, std::size_t pixels) {
  const std::string nearly =
      v.nearly_unsettled == 0
          ? ""
          : fmt::format(" ({} of them near the limit of an error bound)", v.nearly_unsettled);
  return fmt::format("{} of {} verified by exact arithmetic{}, all agree", v.verified,
                     text::counted(pixels, "pixel"), nearly);
}

std::string disagreement(const MapVerification& v, const Disagreement& first) {
  return fmt::format("pixel ({}, {}): {} is {}, exact arithmetic gives {}; {} of {} {}", first.x,
                     first.y, first.channel, first.found, first.expected, v.differing,
                     text::counted(v.verified, "verified pixel"),
                     v.differing == 1 ? "differs" : "differ");
}

/// `render --verify`: recomputes by exact arithmetic so many random pixels of the map, called
/// `name`, and, of the fast engine's map, every pixel at which one of its bounds nearly failed to
/// settle a decision: it would have failed if it had been 16 times as wide. Reports the result on
/// the console.
MapVerification verify_map(const DepthMap& map, const std::string& name, const RenderedFrom& from,
                           std::uint64_t pixels, const Console& console) {
  PixelChoice chosen = choose_pixels(from.camera.width, from.camera.height, pixels);
  MapVerification result;
  result.nearly_unsettled = choose_nearly_unsettled(from, chosen);
  Progress progress(console, "verifying");
  const Verification seen =
      verify(map, from.triangles, from.camera, from.options, chosen, progress.reporter());
  result.verified = seen.verified;
  result.differing = seen.differing;
  if (seen.first) {
    Console::error(name + ": " + disagreement(result, *seen.first));
  } else {
    console.note(name + ": " + agreement(result, chosen.size()));
  }
  return result;
}

}  // namespace

bool adds_channels(const MapPlan& plan) {
  return !plan.mattes.empty() || plan.samples || plan.depth_buffer;
}

bool has_additions(const MapPlan& plan) {
  return adds_channels(plan) || plan.verified_pixels;
}

void add_planned(DepthMap& map, const MapPlan& plan, const std::string& name,
                 const RenderedFrom& from, MapReport& report, const Console& console) {
  Stopwatch stopwatch;
  for (const MatteKind& by : plan.mattes) add_mattes(map, from.mattes(by));
  if (plan.samples) {
    add_sampled_coverage(map, from.triangles, from.camera, *plan.samples, from.options);
    map.texts[samples_text] = plan.samples->name;
  }
  report.seconds.render += stopwatch.lap();
  if (plan.depth_buffer) {
    report.depth_buffer = add_depth_buffer_channels(map, *plan.depth_buffer, from.triangles,
                                                    from.camera, from.options);
  }
  report.seconds.depth_format = stopwatch.lap();
  if (plan.verified_pixels) {
    report.verification = verify_map(map, name, from, *plan.verified_pixels, console);
  }
  report.seconds.verify = stopwatch.lap();
  if (plan.depth_buffer) drop_helpers(map, *plan.depth_buffer);
}

}  // namespace fathom::app
