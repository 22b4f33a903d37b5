// fathom sun --latitude B --longitude L --dates A:B

#include <fmt/core.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "apps/commands.h"
#include "apps/companions.h"
#include "apps/shell/failures.h"
#include "apps/shell/output_file.h"
#include "apps/shell/values.h"
#include "fathom/camera/sun_position.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

/// From the beginning of a day to the end of a day, in seconds of a local clock.
struct DateRange {
  UnixSeconds first = 0, end = 0;
};

constexpr UnixSeconds day = 86400;

/// A number of exactly so many digits, which are taken off the text.
std::optional<int> take_digits(std::string_view& text, std::size_t count) {
  if (text.size() < count) return std::nullopt;
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + count, number);
  if (error != std::errc() || end != text.data() + count || text.front() == '-') {
    return std::nullopt;
  }
  text.remove_prefix(count);
  return number;
}

bool take(std::string_view& text, char c) {
  if (!text.starts_with(c)) return false;
  text.remove_prefix(1);
  return true;
}

/// The first second of a date "2026-06-21".
UnixSeconds parse_date(const std::string& text) {
  std::string_view rest = text;
  std::optional<int> year, month, of_month;
  const bool has_form = (year = take_digits(rest, 4)) && take(rest, '-') &&
                        (month = take_digits(rest, 2)) && take(rest, '-') &&
                        (of_month = take_digits(rest, 2)) && rest.empty();
  if (!has_form) throw UsageError("'" + text + "' is not a date like 2026-06-21");
  const std::chrono::year_month_day date{std::chrono::year(*year),
                                         std::chrono::month(static_cast<unsigned>(*month)),
                                         std::chrono::day(static_cast<unsigned>(*of_month))};
  if (!date.ok()) throw UsageError("'" + text + "' is in no calendar");
  if (*year < 1950 || *year > 2050) {
    throw UsageError("'" + text + "' is outside the years 1950 to 2050");
  }
  return day * std::chrono::sys_days(date).time_since_epoch().count();
}

struct Clock {
  int year, hour, minute, second;
  unsigned month, day;
};

Clock clock_of(UnixSeconds local) {
  const UnixSeconds days = local / day - (local % day < 0 ? 1 : 0), rest = local - days * day;
  const std::chrono::year_month_day date{std::chrono::sys_days(std::chrono::days(days))};
  return {static_cast<int>(date.year()),       static_cast<int>(rest / 3600),
          static_cast<int>(rest / 60 % 60),    static_cast<int>(rest % 60),
          static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day())};
}

/// "2026-01-01:2026-12-31" with both days, or a single day.
/// Fails    UsageError: another form, a day that no calendar has, a year outside 1950 to 2050, days
///          in the wrong order.
DateRange parse_dates(const std::string& text) {
  const std::size_t colon = text.find(':');
  const UnixSeconds first = parse_date(text.substr(0, colon));
  const UnixSeconds last = colon == text.npos ? first : parse_date(text.substr(colon + 1));
  if (last < first) throw UsageError("'" + text + "' ends before it begins");
  return {first, last + day};
}

/// "90s", "15m", "1h" or "1d", in seconds.
/// Fails    UsageError: another form, or 0.
UnixSeconds parse_duration(const std::string& text) {
  constexpr std::pair<char, UnixSeconds> units[] = {{'s', 1}, {'m', 60}, {'h', 3600}, {'d', day}};
  for (const auto& [letter, seconds] : units) {
    UnixSeconds number = 0;
    const char* const last = text.data() + text.size() - 1;
    if (text.size() < 2 || *last != letter) continue;
    const auto [end, error] = std::from_chars(text.data(), last, number);
    constexpr UnixSeconds most = 1000000;
    if (error == std::errc() && end == last && number > 0 && number <= most) {
      return number * seconds;
    }
  }
  throw UsageError("'" + text + "' is not a time span like 1h, 15m, 30s or 1d");
}

/// "+01:00", "-5", "5.75" or "Z": the hours that a local clock is ahead of UTC, in seconds.
/// Fails    UsageError: another form, beyond ±14 hours, or not a whole number of minutes.
UnixSeconds parse_utc_offset(const std::string& text) {
  const auto refuse = [&]() -> UsageError {
    return UsageError("'" + text + "' is not an offset like +01:00, -5 or 5.75, at most 14 hours");
  };
  if (text == "Z") return 0;
  std::string_view rest = text;
  const bool is_negative = take(rest, '-');
  if (!is_negative) take(rest, '+');
  const std::size_t colon = rest.find(':');
  double minutes = 0;
  try {
    if (!rest.empty() && (rest.front() < '0' || rest.front() > '9')) throw refuse();
    minutes = 60 * parse_number(std::string(rest.substr(0, colon)));
    if (colon != rest.npos) {
      std::string_view after = rest.substr(colon + 1);
      const std::optional<int> more = take_digits(after, 2);
      if (!more || *more > 59 || !after.empty()) throw refuse();
      minutes += *more;
    }
  } catch (const UsageError&) {
    throw refuse();
  }
  if (!(minutes <= 14 * 60) || minutes != std::floor(minutes)) throw refuse();
  const auto seconds = 60 * static_cast<UnixSeconds>(minutes);
  return is_negative ? -seconds : seconds;
}

/// "2026-06-21 12:00" on a local clock; with seconds only if they are not 0.
std::string name_of_time(UnixSeconds local) {
  const Clock c = clock_of(local);
  const std::string name =
      fmt::format("{:04}-{:02}-{:02} {:02}:{:02}", c.year, c.month, c.day, c.hour, c.minute);
  return c.second == 0 ? name : name + fmt::format(":{:02}", c.second);
}

/// "2026-06-21T12:00:00+01:00", with "Z" for UTC (ISO 8601).
std::string iso_time(UnixSeconds local, UnixSeconds utc_offset) {
  const Clock c = clock_of(local);
  const std::string time = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", c.year, c.month,
                                       c.day, c.hour, c.minute, c.second);
  if (utc_offset == 0) return time + "Z";
  const UnixSeconds minutes = std::abs(utc_offset) / 60;
  return time +
         fmt::format("{}{:02}:{:02}", utc_offset < 0 ? '-' : '+', minutes / 60, minutes % 60);
}

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
      "sun", description_of_companion("sun"),
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
