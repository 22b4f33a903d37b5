#include "apps/render/map_verification.h"

#include <fmt/format.h>

#include <vector>

#include "apps/shell/progress.h"
#include "fathom/reference/verify.h"

namespace fathom::app {
namespace {

/// Adds them to the choice; how many of them there are.
std::uint64_t choose_nearly_unsettled(const VerificationRequest& request,
                                      const std::function<void(const RenderOptions&)>& render,
                                      PixelChoice& chosen) {
  if (request.options.engine != Engine::fast) return 0;
  std::vector<std::uint64_t> doubtful;
  RenderOptions options = request.options;
  options.statistics = nullptr;
  options.progress = {};
  options.fast.widening = 16;
  options.fast.doubtful = &doubtful;
  render(options);
  PixelChoice near(chosen.size(), false);
  std::uint64_t count = 0;
  for (const std::uint64_t pixel : doubtful) {
    count += near[pixel] ? 0 : 1;
    near[pixel] = chosen[pixel] = true;
  }
  return count;
}

}  // namespace

bool verify_map(const DepthMap& map, const std::string& name, const VerificationRequest& request,
                const std::function<void(const RenderOptions&)>& render, const Console& console,
                nlohmann::ordered_json& report) {
  const Camera& camera = request.camera;
  PixelChoice chosen = choose_pixels(camera.width, camera.height, request.pixels);
  const std::uint64_t near = choose_nearly_unsettled(request, render, chosen);
  Progress progress(console, "verifying");
  RenderOptions options = request.options;
  options.progress = progress.reporter();
  const Verification v = verify(map, request.triangles, camera, options, chosen);
  report["verified"] = v.verified;
  report["nearly_unsettled"] = near;
  report["differing"] = v.differing;
  if (!v.first) {
    const std::string of_which =
        near == 0 ? ""
                  : fmt::format(" ({} of them at which a bound hardly settles something)", near);
    console.note(fmt::format("{}: {} of {} pixels verified by exact arithmetic{}, all agree", name,
                             v.verified, chosen.size(), of_which));
    return true;
  }
  Console::error(fmt::format(
      "{}: pixel ({}, {}): {} is {}, exact arithmetic gives {}; {} of {} verified pixels differ",
      name, v.first->x, v.first->y, v.first->channel, v.first->found, v.first->expected,
      v.differing, v.verified));
  return false;
}

}  // namespace fathom::app
