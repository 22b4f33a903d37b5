#include "apps/options/lens_options.h"

#include "apps/shell/values.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

double parse_angle(const std::string& text) {
  const double degrees = parse_number(text);
  if (degrees > 0 && degrees < 180) return degrees;
  throw UsageError("'" + text + "' is not an angle between 0 and 180 degrees");
}

UpAxis parse_up(const std::string& text) {
  return parse_word<UpAxis>(text, {{"y", UpAxis::y}, {"z", UpAxis::z}});
}

}  // namespace

std::array<Option, 2> add_view_options(Command& command, View& view) {
  const Option direction = command.option(
      "--view", "AZ,EL",
      [&view](const std::string& text) {
        const auto [azimuth, elevation] = parse_pair(text);
        view.azimuth = azimuth;
        view.elevation = elevation;
      },
      "AZIMUTH,ELEVATION of the eye in degrees (default 35,25); azimuth 90 is the +x side, "
      "elevation 90 is above");
  return {direction, command.option("--up", "NAME", into(view.up, parse_up),
                                    "The axis that points up: y (default) or z")};
}

Option add_size_option(Command& command, Lens& lens) {
  return command.option(
      "--size", "WxH",
      [&lens](const std::string& text) {
        const auto [width, height] = parse_size(text);
        lens.width = width;
        lens.height = height;
      },
      "WIDTHxHEIGHT in pixels (default 1280x720)");
}

Option add_fov_option(Command& command, Lens& lens) {
  return command.option("--fov", "DEG", into(lens.vertical_fov, parse_angle),
                        "Vertical field of view in degrees (default 40)");
}

std::array<Option, 2> add_range_options(Command& command, Lens& lens) {
  return {command.option("--near", "D", into(lens.near, parse_number),
                         "Nearest depth that counts (default 0)"),
          command.option("--far", "D", into(lens.far, parse_number),
                         "Farthest depth that counts (default: infinity)")};
}

void add_lens_options(Command& command, Lens& lens) {
  add_size_option(command, lens);
  Option angle = add_fov_option(command, lens);
  Option length = command.option("--focal", "PIXELS", into(lens.focal, parse_number),
                                 "fx = fy in pixels, in place of --fov");
  const Option parallel = command.option(
      "--orthographic", "HEIGHT",
      [&lens](const std::string& text) {
        lens.projection = Projection::orthographic;
        lens.vertical_extent = parse_number(text);
      },
      "Parallel projection; scene units that the height spans");
  angle.excludes(length).excludes(parallel);
  length.excludes(parallel);
  add_range_options(command, lens);
}

}  // namespace fathom::app
