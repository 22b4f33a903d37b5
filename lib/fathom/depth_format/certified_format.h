#pragma once

#include <optional>

#include "fathom/depth_format/depth_format.h"
#include "fathom/depth_format/encode.h"
#include "fathom/numeric/certified_value.h"

/// encode() and decode() in floating point, with proved bounds: they return the exact result, or
/// nothing if a bound does not settle it. Binary64 first, then double-words; only double-words for
/// logarithms (numeric/certified_logarithm.h).
/// Needs    StandardArithmetic in the calling thread, because it is called once for each pixel.
namespace fathom {

/// A value of either width as a pair of words.
inline WordPair words_of(double x) {
  return {x, 0};
}
inline WordPair words_of(const WordPair& x) {
  return x;
}

class CertifiedFormat {
 public:
  /// Needs    a meaningful format.
  explicit CertifiedFormat(const DepthFormat& format);

  /// The stored value of every depth between near and far that the bound allows; nullopt if there
  /// is more than one, or it is not known.
  [[nodiscard]] std::optional<StoredDepth> encode(const Certified<double>& depth) const;
  [[nodiscard]] std::optional<StoredDepth> encode(const Certified<WordPair>& depth) const;

  /// The depth that a stored value means; the error is +∞ if that is infinite or not known.
  [[nodiscard]] Certified<double> decode(StoredDepth stored) const;
  [[nodiscard]] Certified<WordPair> wide_decode(StoredDepth stored) const;

  /// No depth that is stored as this value is greater; +∞ if no such bound is known.
  [[nodiscard]] double farthest_stored_as(StoredDepth stored) const;

  [[nodiscard]] const DepthFormat& format() const { return constants_.format; }

  /// Constants from the constructor, and arithmetic with or without fused multiply-adds, which give
  /// the same results.
  struct Constants {
    DepthFormat format;
    /// False if a number has a magnitude for which no bound was derived.
    bool usable = false;
    /// k of f = k·N(D)/M(D); for logarithms: log(1 + C·far) or log(far/near).
    WordPair k;
  };
  struct Arithmetic {
    std::optional<StoredDepth> (*encode)(const Constants&, const Certified<WordPair>& depth);
    Certified<WordPair> (*decode)(const Constants&, const WordPair& s, const Certified<WordPair>& t,
                                  double scale);
  };
  static const Arithmetic with_fma, without_fma;
  CertifiedFormat(const DepthFormat& format, const Arithmetic& arithmetic);

 private:
  Constants constants_;
  const Arithmetic* arithmetic_;
};

/// round_to_storage() of every number in [0, 1] that the bound allows; nullopt if there is more
/// than one result.
std::optional<StoredDepth> certified_rounding(Storage storage, const Certified<double>& value);

}  // namespace fathom
