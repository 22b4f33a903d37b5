#include "apps/textbook/scan/scan_writing.h"

#include <fmt/format.h>

#include "fathom/failures/errors.h"
#include "fathom/threads/interruption.h"

namespace fathom::app::scan {
namespace {

constexpr std::int64_t most_entries = std::int64_t{1} << 22;

}  // namespace

void PixelList::make_room(std::int64_t entries) {
  if ((total_ += entries) > most_entries)
    throw InputError(
        fmt::format("more than {} {} and numbers with them; \"width\" and \"height\" limit them{}",
                    most_entries, runs_ ? "runs" : "pixels", runs_ ? "" : ", --runs counts runs"));
}

void PixelList::add(const pipeline::Pixel& p) {
  check_interruption();
  // Neighbours along a row join to a run, in either direction.
  if (runs_ && !spans_.empty() && spans_.back().y == p.y) {
    if (spans_.back().x_end == p.x) {
      ++spans_.back().x_end;
      return;
    }
    if (spans_.back().x_begin == p.x + 1) {
      --spans_.back().x_begin;
      return;
    }
  }
  make_room(1);
  spans_.push_back({p.y, p.x, p.x + 1});
}

void PixelList::add(const pipeline::Span& span) {
  if (span.x_begin >= span.x_end) return;
  make_room(runs_ ? 1 : span.x_end - span.x_begin);
  spans_.push_back(span);
}

Json PixelList::json(bool with_values) const {
  Json list = Json::array();
  for (const auto& [y, x_begin, x_end] : spans_) {
    check_interruption();
    if (runs_) {
      list.push_back({y, x_begin, x_end});
    } else {
      for (std::int64_t x = x_begin; x < x_end; ++x) list.push_back({x, y});
    }
  }
  Json result{{runs_ ? "runs" : "pixels", std::move(list)}};
  if (with_values) result["values"] = values_;
  return result;
}

}  // namespace fathom::app::scan
