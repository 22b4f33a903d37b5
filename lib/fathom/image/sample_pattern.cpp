#include "fathom/image/sample_pattern.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {
namespace {

/// Offsets in sixteenths of a pixel from the centre.
/// Source   [DX11] D3D11_STANDARD_MULTISAMPLE_PATTERN; [VK13] Standard Sample Locations has the
///          same positions, counted from the upper left corner.
using Sixteenths = std::vector<std::array<int, 2>>;

Sixteenths standard_positions(int count) {
  switch (count) {
    case 1:
      return {{0, 0}};
    case 2:
      return {{4, 4}, {-4, -4}};
    case 4:
      return {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
    case 8:
      return {{1, -3}, {-1, 3}, {5, 1}, {-3, -5}, {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
    case 16:
      return {{1, 1},  {-1, -3}, {-3, 2},  {4, -1}, {-5, -2}, {2, 5},  {5, 3}, {3, -5},
              {-2, 6}, {0, -7},  {-4, -6}, {-6, 4}, {-8, 0},  {7, -4}, {6, 7}, {-7, -8}};
    default:
      return {};
  }
}

SamplePattern from_sixteenths(const std::string& name, const Sixteenths& positions) {
  SamplePattern pattern{.name = name};
  for (const auto& [u, v] : positions) pattern.offsets.push_back({u / 16.0, v / 16.0});
  return pattern;
}

/// One sample in each cell of an n×n grid, a given share of the way across it.
SamplePattern grid(const std::string& name, int n, double share) {
  SamplePattern pattern{.name = name, .cell = 1.0 / n};
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      pattern.offsets.push_back({(column + share) / n - 0.5, (row + share) / n - 0.5});
    }
  }
  return pattern;
}

std::optional<std::uint64_t> number(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<int> side(const std::string& text) {
  const auto n = number(text);
  if (n && (*n == 1 || *n == 2 || *n == 4 || *n == 8 || *n == 16)) return static_cast<int>(*n);
  return std::nullopt;
}

/// splitmix64 ([SLF14]): the output for a state.
std::uint64_t scrambled(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15U;
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9U;
  x = (x ^ x >> 27) * 0x94D049BB133111EBU;
  return x ^ x >> 31;
}

}  // namespace

SampleOffset SamplePattern::at(std::size_t k, std::uint32_t column, std::uint32_t row) const {
  const SampleOffset& least = offsets[k];
  if (!jittered) return least;
  const std::uint64_t pixel = std::uint64_t{row} << 32 | column;
  const std::uint64_t bits = scrambled(scrambled(scrambled(seed) ^ pixel) ^ k);
  const auto share = [&](int shift) {
    return static_cast<double>(bits >> shift & 0xFFFF) * 0x1p-16;
  };
  return {least[0] + share(0) * cell, least[1] + share(16) * cell};
}

void require_valid(const SamplePattern& pattern) {
  const StandardArithmetic standard;
  constexpr std::size_t most = 256;
  const auto is_within = [](const SampleOffset& offset) {
    return std::abs(offset[0]) <= 0.5 && std::abs(offset[1]) <= 0.5;
  };
  if (pattern.count() == 0 || pattern.count() > most || !(pattern.cell >= 0 && pattern.cell <= 1) ||
      !std::all_of(pattern.offsets.begin(), pattern.offsets.end(), is_within)) {
    throw UsageError(Setting{"pattern"}, "expected 1 to 256 samples within the pixel");
  }
}

SamplePattern sample_pattern(const std::string& name) {
  const StandardArithmetic standard;
  if (const auto count = side(name)) return from_sixteenths(name, standard_positions(*count));
  if (name == "rotated-grid") {
    return from_sixteenths(name, {{-6, -2}, {2, -6}, {-2, 6}, {6, 2}});
  }
  const std::size_t colon = name.find(':');
  const std::string kind = name.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : name.substr(colon + 1);
  if (kind == "regular") {
    if (const auto n = side(rest)) return grid(name, *n, 0.5);
  }
  if (kind == "jittered") {
    const std::size_t second = rest.find(':');
    const auto n = side(rest.substr(0, second));
    const auto seed = second == std::string::npos ? 1 : number(rest.substr(second + 1));
    if (n && seed) {
      SamplePattern pattern = grid(name, *n, 0);
      pattern.jittered = true;
      pattern.seed = *seed;
      return pattern;
    }
  }
  throw UnknownName(
      "there is no sample pattern '" + name +
          "'; there are 1, 2, 4, 8, 16, rotated-grid, regular:N, jittered:N and "
          "jittered:N:SEED, with N one of 1, 2, 4, 8 and 16",
      name,
      {"1", "2", "4", "8", "16", "rotated-grid", "regular:2", "regular:4", "regular:8",
       "regular:16", "jittered:2", "jittered:4", "jittered:8", "jittered:16"});
}

}  // namespace fathom
