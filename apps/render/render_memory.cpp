#include "apps/render/render_memory.h"

#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "apps/options/channel_list.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

/// Bytes that the channels of a map take.
double size_of_map(const Camera& camera, const RenderOptions& options,
                   std::size_t more_channels = 0) {
  const auto channels = static_cast<double>(count_parts(options.channels) + more_channels);
  const double bytes_per_value =
      options.depth_encoding.type == DepthEncoding::Type::binary64 ? 8 : 4;
  return 1.0 * camera.width * camera.height * channels * bytes_per_value;
}

double memory_of_machine() {
  return 1.0 * static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace

void check_size(const Camera& camera, const RenderOptions& options, std::size_t more_channels) {
  const double needed = size_of_map(camera, options, more_channels), memory = memory_of_machine();
  if (needed > memory) {
    throw InputError(fmt::format(
        "an image of {}x{} pixels needs {:.1f} GB for its channels; this machine has {:.1f} GB",
        camera.width, camera.height, needed / 1e9, memory / 1e9));
  }
}

StreamLimits stream_limits(const Camera& camera, const RenderOptions& options) {
  double memory = memory_of_machine();
  rlimit allowed{};
  if (::getrlimit(RLIMIT_AS, &allowed) == 0 && allowed.rlim_cur != RLIM_INFINITY) {
    memory = std::min(memory, static_cast<double>(allowed.rlim_cur));
  }
  const double left = std::max(memory - size_of_map(camera, options), 0x1p28);
  StreamLimits limits;
  limits.tile_bytes = static_cast<std::uint64_t>(left / 4);
  limits.triangles_at_once = static_cast<std::uint32_t>(
      std::min<double>(limits.triangles_at_once, left / 16 / StreamLimits::bytes_per_triangle));
  return limits;
}

}  // namespace fathom::app
