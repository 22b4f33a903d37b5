#pragma once

#include <cstdint>
#include <string>

namespace fathom::text {

/// A share in percent, for readers: "0 %", "12.3 %", "99.995 %", "100 %".
///
/// Only nothing is 0 %, and only all is 100 %. A share nearer than 0.1 % to one of these has as
/// many decimals as the distance needs for its first digit, so that the shares of two parts of a
/// whole add up: 1 of 19567 is 0.005 %, the rest 99.995 %.
///
/// Needs    0 ≤ share ≤ 1.
std::string percentage(double share);

/// The share of `part` in `whole`.
///
/// Needs    part ≤ whole, 0 < whole < 2^53.
inline std::string percentage(std::uint64_t part, std::uint64_t whole) {
  return percentage(static_cast<double>(part) / static_cast<double>(whole));
}

}  // namespace fathom::text
