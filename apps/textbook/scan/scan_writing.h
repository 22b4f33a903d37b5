#pragma once

#include "apps/textbook/scan/scan_algorithms.h"

namespace fathom::app::scan {

/// The pixels of an answer, and the values at them where there are any.
class PixelList {
 public:
  explicit PixelList(bool runs) : runs_(runs) {}

  void add(const pipeline::Pixel& pixel);
  void add(const pipeline::Span& span);
  /// Counts `entries` more things, of the values or the trace, that the answer is about to hold.
  /// Fails    InputError where it holds too many: an answer stays in memory.
  void make_room(std::int64_t entries);
  void add_values(Json values) { values_.push_back(std::move(values)); }
  /// {"pixels"} or {"runs"}, and {"values"}.
  [[nodiscard]] Json json(bool with_values) const;

 private:
  bool runs_;
  std::int64_t total_ = 0;
  std::vector<pipeline::Span> spans_;
  Json values_ = Json::array();
};

}  // namespace fathom::app::scan
