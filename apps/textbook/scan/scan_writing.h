#pragma once

#include "apps/textbook/scan/scan_algorithms.h"

namespace fathom::app::scan {

/// The pixels of an answer, and the values at them where there are any.
class PixelList {
 public:
  explicit PixelList(bool runs) : runs_(runs) {}

  /// Refuses a list that will have too many pixels before any is made.
  static void check_count(std::int64_t pixels);
  void add(const pipeline::Pixel& pixel);
  void add(const pipeline::Span& span);
  void add_values(Json values) { values_.push_back(std::move(values)); }
  /// {"pixels"} or {"runs"}, and {"values"}.
  [[nodiscard]] Json json(bool with_values) const;

 private:
  void count(std::int64_t pixels);

  bool runs_;
  std::int64_t total_ = 0;
  std::vector<pipeline::Span> spans_;
  Json values_ = Json::array();
};

}  // namespace fathom::app::scan
