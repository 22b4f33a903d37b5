#pragma once

#include <cstdint>
#include <string>

#include "fathom/camera/sun_position.h"

namespace fathom::app {

/// From the beginning of a day to the end of a day, in seconds of a local clock.
struct DateRange {
  UnixSeconds first = 0, end = 0;
};

/// "2026-01-01:2026-12-31" with both days, or a single day.
/// Fails    UsageError: another form, a day that no calendar has, a year outside 1950 to 2050, days
///          in the wrong order.
DateRange parse_dates(const std::string& text);

/// "90s", "15m", "1h" or "1d", in seconds.
/// Fails    UsageError: another form, or 0.
UnixSeconds parse_duration(const std::string& text);

/// "+01:00", "-5", "5.75" or "Z": the hours that a local clock is ahead of UTC, in seconds.
/// Fails    UsageError: another form, beyond ±14 hours, or not a whole number of minutes.
UnixSeconds parse_utc_offset(const std::string& text);

/// "2026-06-21 12:00" on a local clock; with seconds only if they are not 0.
std::string name_of_time(UnixSeconds local);
/// "2026-06-21T12:00:00+01:00", with "Z" for UTC (ISO 8601).
std::string iso_time(UnixSeconds local, UnixSeconds utc_offset);

}  // namespace fathom::app
