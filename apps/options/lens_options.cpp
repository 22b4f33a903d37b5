#include "apps/options/lens_options.h"

#include "apps/shell/numbers.h"

namespace fathom::app {

void LensOptions::add_to(CLI::App& command) {
  command.add_option("--size", size, "WIDTHxHEIGHT in pixels (default 1280x720)");
  CLI::Option* angle =
      command.add_option("--fov", fov, "Vertical field of view in degrees (default 40)");
  CLI::Option* length =
      command.add_option("--focal", focal, "fx = fy in pixels, in place of --fov");
  CLI::Option* parallel = command.add_option(
      "--orthographic", orthographic, "Parallel projection; scene units that the height spans");
  angle->excludes(length)->excludes(parallel);
  length->excludes(parallel);
  command.add_option("--near", near, "Nearest depth that counts (default 0)");
  command.add_option("--far", far, "Farthest depth that counts (default: infinity)");
}

Lens LensOptions::get() const {
  Lens lens;
  const auto [width, height] = parse_size("--size", size);
  lens.width = width;
  lens.height = height;
  if (!fov.empty()) lens.vertical_fov = parse_number("--fov", fov);
  if (!focal.empty()) lens.focal = parse_number("--focal", focal);
  if (!orthographic.empty()) {
    lens.projection = Projection::orthographic;
    lens.vertical_extent = parse_number("--orthographic", orthographic);
  }
  if (!near.empty()) lens.near = parse_number("--near", near);
  if (!far.empty()) lens.far = parse_number("--far", far);
  return lens;
}

}  // namespace fathom::app
