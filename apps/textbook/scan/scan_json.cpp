#include "apps/textbook/scan/scan_json.h"

#include <fmt/format.h>

#include <cmath>

#include "fathom/failures/errors.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/text/counted.h"
#include "fathom/threads/interruption.h"

namespace fathom::app::scan {
namespace {

std::int64_t size_of(const Json& object, const char* key) {
  const Json& value = cases::member(object, key);
  if (!value.is_number()) throw InputError(fmt::format("\"{}\": expected a number", key));
  const double size = value.get<double>();
  if (!(size >= 1 && size <= pipeline::greatest_coordinate) || size != std::floor(size))
    throw InputError(
        fmt::format("\"{}\" is {}; expected a whole number from 1 to 2147483648", key, size));
  return static_cast<std::int64_t>(size);
}

/// Removes the entries of the corners that close their rings.
template <class Entry>
void drop_closing(std::vector<Entry>& entries, const std::vector<ClosingCorner>& closing,
                  const char* name) {
  for (const auto& [corner, first] : closing)
    if (entries[corner] != entries[first])
      throw InputError(
          fmt::format("{0}[{1}] differs from {0}[{2}], but both are of one corner: it "
                      "closes the ring that corner {2} begins",
                      name, corner, first));
  for (auto c = closing.rbegin(); c != closing.rend(); ++c)
    entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(c->corner));
}

constexpr std::int64_t most_entries = std::int64_t{1} << 22;

}  // namespace

pipeline::PixelWindow window_of(const Json& object) {
  if (!object.contains("width") && !object.contains("height")) return {};
  return {0, 0, size_of(object, "width"), size_of(object, "height")};
}

double checked_coordinate(double x, const std::string& where) {
  if (std::abs(x) > pipeline::greatest_coordinate)
    throw InputError(fmt::format("{}: {} is beyond 2^31 = 2147483648", where, x));
  return x;
}

clipping::Rings<double> polygon_of(const Json& object, std::vector<ClosingCorner>* closing) {
  clipping::Rings<double> rings = cases::rings(object, "polygon");
  if (rings.empty()) throw InputError("polygon: expected at least one ring");
  std::size_t written = 0;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    const std::size_t first = written;
    written += rings[r].size();
    if (rings[r].size() > 1 && rings[r].front() == rings[r].back()) {
      rings[r].pop_back();
      if (closing != nullptr) closing->push_back({written - 1, first});
    }
    if (rings[r].size() < 3)
      throw InputError(fmt::format("polygon ring {} has {}; expected at least 3", r,
                                   text::counted(rings[r].size(), "corner")));
    for (const auto& p : rings[r]) {
      checked_coordinate(p.x, fmt::format("polygon ring {}", r));
      checked_coordinate(p.y, fmt::format("polygon ring {}", r));
    }
  }
  return rings;
}

clipping::Ring<double> triangle_of(const Json& object, const Form& form) {
  const auto corners = cases::points(object, "triangle", 2, 2);
  if (corners.size() != 3)
    throw InputError(
        fmt::format("triangle: {}; expected 3", text::counted(corners.size(), "corner")));
  clipping::Ring<double> triangle;
  for (const auto& p : corners) {
    const double x = checked_coordinate(p[0], "triangle"), y = checked_coordinate(p[1], "triangle");
    if (!form.subpixel_bits) {
      triangle.push_back({x, y});
    } else {
      const pipeline::GridPoint snapped = pipeline::snap(x, y, *form.subpixel_bits);
      triangle.push_back({static_cast<double>(snapped.x) / pipeline::grid_one,
                          static_cast<double>(snapped.y) / pipeline::grid_one});
    }
  }
  return triangle;
}

CarriedAlong carried_along(const Json& object, std::size_t corners,
                           const std::vector<ClosingCorner>& closing) {
  const std::size_t written = corners + closing.size();
  CarriedAlong carried{cases::attributes(object, written), {}};
  drop_closing(carried.attributes, closing, "attributes");
  if (!object.contains("w")) return carried;
  carried.w = cases::numbers(object["w"], "w", written, written);
  for (std::size_t i = 0; i < written; ++i)
    if (carried.w[i] == 0)
      throw InputError(fmt::format("w[{}] is 0: the corner lies at infinity", i));
  drop_closing(carried.w, closing, "w");
  if (!carried.any()) throw InputError("\"w\" stands without \"attributes\"");
  return carried;
}

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
