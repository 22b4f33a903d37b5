#include "apps/render/map_verification.h"

#include <fmt/core.h>

#include <vector>

#include "apps/shell/progress.h"
#include "fathom/reference/verify.h"
#include "fathom/text/counted.h"

namespace fathom::app {
namespace {

/// Adds them to the choice; how many of them there are.
std::uint64_t choose_nearly_unsettled(const VerificationRequest& request, PixelChoice& chosen) {
  if (request.options.engine != Engine::fast) return 0;
  std::vector<std::uint64_t> doubtful;
  RenderOptions options = request.options;
  options.statistics = nullptr;
  options.progress = {};
  options.fast.widening = 16;
  options.fast.doubtful = &doubtful;
  request.render(options);
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

}  // namespace

MapVerification verify_map(const DepthMap& map, const std::string& name,
                           const VerificationRequest& request, const Console& console) {
  const Camera& camera = request.camera;
  PixelChoice chosen = choose_pixels(camera.width, camera.height, request.pixels);
  MapVerification result;
  result.nearly_unsettled = choose_nearly_unsettled(request, chosen);
  Progress progress(console, "verifying");
  RenderOptions options = request.options;
  options.progress = progress.reporter();
  const Verification seen = verify(map, request.triangles, camera, options, chosen);
  result.verified = seen.verified;
  result.differing = seen.differing;
  if (seen.first) {
    Console::error(name + ": " + disagreement(result, *seen.first));
  } else {
    console.note(name + ": " + agreement(result, chosen.size()));
  }
  return result;
}

}  // namespace fathom::app
