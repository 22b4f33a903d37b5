#include "apps/surfaces/sun_times.h"

#include <fmt/core.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include "apps/shell/values.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

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

}  // namespace

DateRange parse_dates(const std::string& text) {
  const std::size_t colon = text.find(':');
  const UnixSeconds first = parse_date(text.substr(0, colon));
  const UnixSeconds last = colon == text.npos ? first : parse_date(text.substr(colon + 1));
  if (last < first) throw UsageError("'" + text + "' ends before it begins");
  return {first, last + day};
}

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

std::string name_of_time(UnixSeconds local) {
  const Clock c = clock_of(local);
  const std::string name =
      fmt::format("{:04}-{:02}-{:02} {:02}:{:02}", c.year, c.month, c.day, c.hour, c.minute);
  return c.second == 0 ? name : name + fmt::format(":{:02}", c.second);
}

std::string iso_time(UnixSeconds local, UnixSeconds utc_offset) {
  const Clock c = clock_of(local);
  const std::string time = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", c.year, c.month,
                                       c.day, c.hour, c.minute, c.second);
  if (utc_offset == 0) return time + "Z";
  const UnixSeconds minutes = std::abs(utc_offset) / 60;
  return time +
         fmt::format("{}{:02}:{:02}", utc_offset < 0 ? '-' : '+', minutes / 60, minutes % 60);
}

}  // namespace fathom::app
