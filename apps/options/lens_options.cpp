#include "apps/options/lens_options.h"

#include "apps/shell/values.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

double parse_angle(const std::string& text) {
  const double degrees = parse_number(text);
  if (degrees > 0 && degrees < 180) return degrees;
  throw UsageError("'" + text + "' is not an angle between 0 and 180 degrees");
}

Vector3 parse_up(const std::string& text) {
  if (text.find(',') != std::string::npos) return parse_vector(text);
  return parse_word<Vector3>(text,
                             {{"x", {1, 0, 0}},
                              {"y", {0, 1, 0}},
                              {"z", {0, 0, 1}},
                              {"-x", {-1, 0, 0}},
                              {"-y", {0, -1, 0}},
                              {"-z", {0, 0, -1}}},
                             "a direction X,Y,Z");
}

}  // namespace

Option add_up_option(Command& command, Vector3& up) {
  return command.option("--up", "DIRECTION", into(up, parse_up),
                        "World direction that points up: x, y (default), z, -x, -y, -z or X,Y,Z");
}

std::array<Option, 2> add_view_options(Command& command, View& view) {
  const Option direction = command.option(
      "--view", "AZ,EL",
      [&view](const std::string& text) {
        const auto [azimuth, elevation] = parse_pair(text);
        view.azimuth = azimuth;
        view.elevation = elevation;
      },
      "Direction of the eye, AZIMUTH,ELEVATION in degrees (default 35,25): at azimuth 0 the right "
      "of the image is +x (+y if x or -x is up), azimuth 90 is on that side; elevation 90 is "
      "above");
  return {direction, add_up_option(command, view.up)};
}

std::vector<Option> add_lens_options(Command& command, Lens& lens) {
  const Option size = command.option(
      "--size", "WxH",
      [&lens](const std::string& text) {
        const auto [width, height] = parse_size(text);
        lens.width = width;
        lens.height = height;
      },
      "Image size in pixels, WIDTHxHEIGHT (default 1280x720)");
  Option angle = command.option("--fov", "DEG", into(lens.vertical_fov, parse_angle),
                                "Vertical field of view in degrees (default 40)");
  Option length = command.option("--focal", "PIXELS", into(lens.focal, parse_number),
                                 "Focal length in pixels (fx = fy), instead of --fov");
  const Option parallel = command.option(
      "--orthographic", "HEIGHT",
      [&lens](const std::string& text) {
        lens.projection = Projection::orthographic;
        lens.vertical_extent = parse_number(text);
      },
      "Parallel projection; height of the image in scene units");
  angle.excludes(length).excludes(parallel);
  length.excludes(parallel);
  const Option near = command.option("--near", "D", into(lens.near, parse_number),
                                     "Nearest depth that is rendered (default 0)");
  const Option far = command.option("--far", "D", into(lens.far, parse_number_or_infinity),
                                    "Farthest depth that is rendered (default inf)");
  return {size, angle, length, parallel, near, far};
}

}  // namespace fathom::app
