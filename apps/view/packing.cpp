#include "apps/view/packing.h"

#include <libdeflate.h>

#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace fathom::view {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// 9 makes pages 1 % to 9 % smaller than 6 and takes three times as long; 5 makes them up to 4 %
/// larger and takes a fifth less.
constexpr int level = 6;

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const {
    libdeflate_free_compressor(compressor);
  }
};

Bytes deflated(const Bytes& bytes) {
  const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
      libdeflate_alloc_compressor(level));
  if (!compressor) throw std::bad_alloc();
  Bytes result(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  result.resize(libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(),
                                         result.data(), result.size()));
  return result;
}

/// Seven bits of the bytes in each letter of UTF-8, the lowest bits first. HTML changes or
/// interprets four letters: these are 128 higher, which takes two bytes. Bits are often 0:
/// inverting every second bit makes NUL rare.
std::string letters_of(const Bytes& bytes) {
  constexpr std::string_view avoided("\0\n\r<", 4);
  std::string text;
  text.reserve(bytes.size() * 6 / 5);
  unsigned bits = 0;
  int count = 0;
  const auto add_letter = [&] {
    const auto letter = static_cast<char>((bits & 127U) ^ 0x55U);
    if (avoided.find(letter) == std::string_view::npos) {
      text += letter;
    } else {
      text += '\xC2';
      text += static_cast<char>(0x80 | letter);
    }
    bits >>= 7;
    count -= 7;
  };
  for (const std::uint8_t byte : bytes) {
    bits |= unsigned{byte} << count;
    count += 8;
    while (count >= 7) add_letter();
  }
  if (count > 0) add_letter();
  return text;
}

template <class Word>
std::vector<Word> words_of(std::span<const Word> plane, std::uint32_t width,
                           const TilePlace& tile) {
  std::vector<Word> words;
  words.reserve(std::size_t{tile.columns} * tile.rows);
  for (std::size_t j = 0; j < tile.rows; ++j) {
    const Word* row = plane.data() + (tile.y + j * tile.step) * width + tile.x;
    for (std::size_t i = 0; i < tile.columns; ++i) words.push_back(row[i * tile.step]);
  }
  return words;
}

/// Small differences of either sign as small numbers.
template <class Word>
Word zigzag(Word difference) {
  constexpr int sign = std::numeric_limits<Word>::digits - 1;
  const Word negative = static_cast<Word>(0) - static_cast<Word>(difference >> sign);
  return static_cast<Word>(static_cast<Word>(difference << 1) ^ negative);
}

enum class Prediction : std::uint8_t { left, gradient, unit, planes };

/// value − prediction of all values of a tile.
template <class Word>
std::vector<Word> residuals(const std::vector<Word>& words, std::size_t columns,
                            Prediction prediction) {
  std::vector<Word> result(words.size());
  for (std::size_t k = 0; k < words.size(); ++k) {
    const bool has_left = k % columns != 0, has_upper = k >= columns;
    Word expected = has_left ? words[k - 1] : has_upper ? words[k - columns] : Word{0};
    if (prediction == Prediction::gradient && has_left && has_upper) {
      expected = static_cast<Word>(expected + words[k - columns] - words[k - columns - 1]);
    }
    result[k] = zigzag(static_cast<Word>(words[k] - expected));
  }
  return result;
}

/// About how many bits the numbers need, each by itself.
template <class Word>
std::uint64_t bits_of(const std::vector<Word>& numbers) {
  std::uint64_t sum = 0;
  for (const Word number : numbers) sum += static_cast<std::uint64_t>(std::bit_width(number));
  return sum;
}

/// The residuals of a tile by the prediction that fits best so far.
template <class Word>
struct Residuals {
  Prediction prediction;
  std::vector<Word> words;
  bool is_by_segment = false;

  /// Takes another prediction if it leaves fewer bits.
  void improve(Prediction other, std::vector<Word> its_words) {
    if (bits_of(its_words) >= bits_of(words)) return;
    prediction = other;
    words = std::move(its_words);
  }
};

template <class Word>
Residuals<Word> by_neighbours(const std::vector<Word>& words, const TilePlace& tile) {
  Residuals<Word> best{Prediction::left, residuals(words, tile.columns, Prediction::left)};
  if (tile.rows > 1) {
    best.improve(Prediction::gradient, residuals(words, tile.columns, Prediction::gradient));
  }
  return best;
}

template <class Word>
std::string packed_residuals(const Residuals<Word>& best) {
  constexpr int by_segment = 4;
  Bytes bytes{static_cast<std::uint8_t>(static_cast<int>(best.prediction) |
                                        (best.is_by_segment ? by_segment : 0))};
  bytes.reserve(1 + sizeof(Word) * best.words.size());
  for (std::size_t byte = 0; byte < sizeof(Word); ++byte) {
    for (const Word word : best.words) bytes.push_back(static_cast<std::uint8_t>(word >> 8 * byte));
  }
  return letters_of(deflated(bytes));
}

template <class Word>
std::string packed_words(std::span<const Word> plane, std::uint32_t width, const TilePlace& tile) {
  return packed_residuals(by_neighbours(words_of(plane, width, tile), tile));
}

/// The bits of |z| of a unit vector with x and y; those of 0 where there is none, or a NaN.
std::uint32_t third_of_unit(float x, float y) {
  const double square = 1 - double{x} * x - double{y} * y;
  return std::bit_cast<std::uint32_t>(square > 0 ? static_cast<float>(std::sqrt(square)) : 0.0F);
}

/// value − prediction of the Z of unit vectors.
std::vector<std::uint32_t> unit_residuals(const std::vector<std::uint32_t>& z,
                                          const std::vector<float>& x, const std::vector<float>& y,
                                          std::size_t columns) {
  constexpr std::uint32_t sign = 0x80000000U;
  std::vector<std::uint32_t> result(z.size());
  for (std::size_t k = 0; k < z.size(); ++k) {
    const bool has_left = k % columns != 0;
    const std::uint32_t left = has_left ? z[k - 1] : 0;
    const bool is_as_left = has_left && x[k] == x[k - 1] && y[k] == y[k - 1];
    const std::uint32_t expected = is_as_left ? left : third_of_unit(x[k], y[k]) | (left & sign);
    result[k] = zigzag(z[k] - expected);
  }
  return result;
}

/// A part of directions; x and y are empty unless it is the Z of unit vectors.
struct Direction {
  std::vector<std::uint32_t> words;
  std::vector<float> x, y;
};

Residuals<std::uint32_t> residuals_of(const Direction& direction, const TilePlace& tile) {
  Residuals<std::uint32_t> best = by_neighbours(direction.words, tile);
  if (!direction.x.empty()) {
    best.improve(Prediction::unit,
                 unit_residuals(direction.words, direction.x, direction.y, tile.columns));
  }
  return best;
}

/// The values at the first pixel of each segment.
template <class Value>
std::vector<Value> at_firsts(const std::vector<Value>& values, const Segments& segments) {
  std::vector<Value> found;
  if (values.empty()) return found;
  found.reserve(segments.firsts.size());
  for (const std::uint32_t first : segments.firsts) found.push_back(values[first]);
  return found;
}

/// One value for each segment; nullopt if a segment has several.
std::optional<Direction> by_segment(const Direction& direction, const Segments& segments) {
  for (std::size_t k = 0; k < direction.words.size(); ++k) {
    if (direction.words[k] != direction.words[segments.firsts[segments.places[k]]]) {
      return std::nullopt;
    }
  }
  return Direction{at_firsts(direction.words, segments), at_firsts(direction.x, segments),
                   at_firsts(direction.y, segments)};
}

}  // namespace

std::string packed(std::span<const std::uint8_t> plane, std::uint32_t width,
                   const TilePlace& tile) {
  return packed_words(plane, width, tile);
}

std::string packed(std::span<const std::uint16_t> plane, std::uint32_t width,
                   const TilePlace& tile) {
  return packed_words(plane, width, tile);
}

std::string packed(std::span<const std::uint32_t> plane, std::uint32_t width,
                   const TilePlace& tile) {
  return packed_words(plane, width, tile);
}

std::string packed(std::span<const std::uint64_t> plane, std::uint32_t width,
                   const TilePlace& tile) {
  return packed_words(plane, width, tile);
}

Segments segments_of(std::span<const std::uint32_t> identifiers, std::uint32_t width,
                     const TilePlace& tile) {
  const std::vector<std::uint32_t> all = words_of(identifiers, width, tile);
  Segments segments;
  segments.places.reserve(all.size());
  std::unordered_map<std::uint32_t, std::uint32_t> places;
  for (std::uint32_t k = 0; k < all.size(); ++k) {
    const auto next = static_cast<std::uint32_t>(segments.firsts.size());
    const auto [found, is_new] = places.try_emplace(all[k], next);
    if (is_new) segments.firsts.push_back(k);
    segments.places.push_back(found->second);
  }
  return segments;
}

std::string packed_depth(std::span<const std::uint32_t> plane, const PlaneHints& hints,
                         std::uint32_t width, const TilePlace& tile) {
  const std::vector<std::uint32_t> words = words_of(plane, width, tile);
  Residuals<std::uint32_t> best = by_neighbours(words, tile);
  const std::vector<ExpectedDepth> expected = expected_depths(words, hints, width, tile);
  std::vector<std::uint32_t> others(words.size());
  std::size_t next = 0, end = words.size();
  for (std::size_t k = 0; k < words.size(); ++k) {
    others[expected[k].is_on_known_plane ? next++ : --end] = zigzag(words[k] - expected[k].word);
  }
  best.improve(Prediction::planes, std::move(others));
  return packed_residuals(best);
}

std::string packed_direction(std::span<const std::uint32_t> plane, const DirectionHints& hints,
                             std::uint32_t width, const TilePlace& tile) {
  Direction direction{words_of(plane, width, tile), {}, {}};
  if (!hints.x.empty()) {
    direction.x = words_of(hints.x, width, tile);
    direction.y = words_of(hints.y, width, tile);
  }
  Residuals<std::uint32_t> best = residuals_of(direction, tile);
  if (hints.segments != nullptr) {
    if (const auto row = by_segment(direction, *hints.segments)) {
      const auto columns = static_cast<std::uint32_t>(row->words.size());
      Residuals<std::uint32_t> other = residuals_of(*row, {.columns = columns, .rows = 1});
      other.is_by_segment = true;
      if (bits_of(other.words) < bits_of(best.words)) best = std::move(other);
    }
  }
  return packed_residuals(best);
}

}  // namespace fathom::view
