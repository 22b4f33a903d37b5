#include "apps/validate/report/z_fighting.h"

#include <fmt/format.h>

namespace fathom::validation {
namespace {

using attribution::PixelClass;

}  // namespace

std::string z_fight_count_text(const ValidationCase& c) {
  const std::uint64_t count = c.attribution.count(PixelClass::z_fight);
  if (c.has_triangle_numbers()) return std::to_string(count);
  constexpr const char* why = "no triangle numbers were read";
  return count == 0 ? fmt::format("unknown: {}", why) : fmt::format("at least {}: {}", count, why);
}

std::string z_fight_clause(const ValidationCase& c) {
  const std::uint64_t count = c.attribution.count(PixelClass::z_fight);
  const std::string name = name_of(PixelClass::z_fight);
  if (!c.has_triangle_numbers()) {
    return count == 0 ? fmt::format("{} unknown (no triangle numbers)", name)
                      : fmt::format("at least {} {} (no triangle numbers)", count, name);
  }
  if (count == 0 && c.predicted_fights.value_or(0) == 0) return "";
  return fmt::format("{} {}", count, name) +
         (c.predicted_fights ? fmt::format(" ({} by the format alone)", *c.predicted_fights) : "");
}

}  // namespace fathom::validation
