// fathom sun --latitude B --longitude L --dates A:B

#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "apps/commands.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/values.h"
#include "apps/surfaces/sun_times.h"
#include "fathom/camera/sun_position.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

struct SunArguments {
  EarthPlace place;
  DateRange dates;
  UnixSeconds every = 3600, utc_offset = 0;
  std::optional<double> above;
  std::string output = "-";
};

double parse_latitude(const std::string& text) {
  const double degrees = parse_number(text);
  if (std::abs(degrees) <= 90) return degrees;
  throw UsageError("'" + text + "' is not a latitude from -90 to 90");
}

double parse_longitude(const std::string& text) {
  const double degrees = parse_number(text);
  if (std::abs(degrees) <= 180) return degrees;
  throw UsageError("'" + text + "' is not a longitude from -180 to 180");
}

void expect_in_memory(const SunArguments& a) {
  constexpr UnixSeconds most = 10'000'000;
  const UnixSeconds lines = (a.dates.end - a.dates.first) / a.every;
  if (lines <= most) return;
  throw UsageError(fmt::format("--every: {} positions; expected at most {}", lines, most));
}

/// In steps that are finer than the formula is accurate.
double in_steps(double degrees) {
  return std::round(degrees * 1e4) / 1e4 + 0.0;  // not −0
}

std::string line_of(const SunPosition& sun, const std::string& time, const std::string& name) {
  double azimuth = in_steps(sun.azimuth);
  if (azimuth == 360) azimuth = 0;
  const double elevation = in_steps(sun.elevation);
  const auto [x, y, z] = compass_direction(azimuth, elevation);
  return fmt::format("{},{},{},{},{},{},{}\n", time, azimuth, elevation, x, y, z, name);
}

int run_sun(const SunArguments& a, const Console&) {
  expect_in_memory(a);
  TextOutput output(a.output);
  std::string table = "time,azimuth,elevation,x,y,z,name\n";
  for (UnixSeconds local = a.dates.first; local < a.dates.end; local += a.every) {
    const UnixSeconds time = local - a.utc_offset;
    if (time < first_second_of_sun || time >= end_of_sun) {
      throw UsageError("--dates: " + iso_time(local, a.utc_offset) +
                       " is outside the years 1950 to 2050 in UTC");
    }
    const SunPosition sun = sun_position(a.place, time);
    if (a.above && !(sun.elevation > *a.above)) continue;
    table += line_of(sun, iso_time(local, a.utc_offset), name_of_time(local));
  }
  output.finish(table);
  return done;
}

}  // namespace

void add_sun(Command& program) {
  const auto arguments = std::make_shared<SunArguments>();
  Command& command = program.command(
      "sun", "Print directions towards the sun, for areas",
      "  fathom sun --latitude 48.1 --longitude 11.6 --dates 2026-01-01:2026-12-31\n"
      "  fathom sun --latitude 48 --longitude 11 --dates 2026-06-21 -o suns.csv\n"
      "\nEach line of the CSV table has the columns time, azimuth, elevation, x, y, z and name. "
      "The azimuth is in degrees clockwise from north, the elevation in degrees above the "
      "horizon; x is east, y north and z up. The positions follow the low-precision formula of "
      "the Astronomical Almanac, which is accurate to 0.01 degrees in the years 1950 to 2050. "
      "They do not include the refraction of the air.");
  command
      .option("--latitude", "DEGREES", into(arguments->place.latitude, parse_latitude),
              "Latitude of the place; north is positive")
      .required();
  command
      .option("--longitude", "DEGREES", into(arguments->place.longitude, parse_longitude),
              "Longitude of the place; east is positive")
      .required();
  command
      .option("--dates", "FIRST:LAST", into(arguments->dates, parse_dates),
              "List these days, e.g. 2026-01-01:2026-12-31, or a single day")
      .required();
  command.option("--every", "SPAN", into(arguments->every, parse_duration),
                 "List a position every SPAN from midnight of the first day, e.g. 15m, 30s or 1d "
                 "(default 1h)");
  command.option("--utc-offset", "HOURS", into(arguments->utc_offset, parse_utc_offset),
                 "Use a clock that is this far ahead of UTC, e.g. +01:00, -5 or 5.75 (default 0)");
  command.option(
      "--above", "DEGREES",
      [arguments](const std::string& text) { arguments->above = parse_number(text); },
      "Leave out times at which the sun is not above this elevation, e.g. 0 (default: "
      "list day and night)");
  add_output_option(command, "FILE", arguments->output,
                    "Write the table to this CSV file (default -, standard output)");
  command.runs([arguments](const Console& console) { return run_sun(*arguments, console); });
}

}  // namespace fathom::app
