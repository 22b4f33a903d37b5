#include "apps/view/packing.h"

#include <libdeflate.h>

#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include "apps/page_data.h"

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

enum class Prediction : std::uint8_t { left, gradient, unit };

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
  Bytes bytes{static_cast<std::uint8_t>(best.prediction)};
  bytes.reserve(1 + sizeof(Word) * best.words.size());
  for (std::size_t byte = 0; byte < sizeof(Word); ++byte) {
    for (const Word word : best.words) bytes.push_back(static_cast<std::uint8_t>(word >> 8 * byte));
  }
  return app::base64(deflated(bytes));
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

std::string packed_third(std::span<const std::uint32_t> plane, const UnitParts& parts,
                         std::uint32_t width, const TilePlace& tile) {
  const std::vector<std::uint32_t> words = words_of(plane, width, tile);
  Residuals<std::uint32_t> best = by_neighbours(words, tile);
  best.improve(Prediction::unit, unit_residuals(words, words_of(parts.x, width, tile),
                                                words_of(parts.y, width, tile), tile.columns));
  return packed_residuals(best);
}

}  // namespace fathom::view
