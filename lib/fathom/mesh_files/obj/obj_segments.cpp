#include "fathom/mesh_files/obj/obj_segments.h"

#include <algorithm>
#include <utility>

#include "fathom/text/printable.h"

namespace fathom::mesh_files {
namespace {

constexpr std::string_view blanks = " \t\r\v\f\n";

bool ends_line(char c) {
  return c == '\n' || c == '\r';
}

/// With a blank for each '\' that joins two lines, and their line end.
std::string without_joins(std::string_view rest) {
  std::string text;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const bool joins = rest[i] == '\\' && i + 1 < rest.size() && ends_line(rest[i + 1]);
    while (joins && i + 1 < rest.size() && ends_line(rest[i + 1])) ++i;
    text += joins ? ' ' : rest[i];
  }
  return text;
}

/// The name that follows a keyword.
std::string name_in(std::string_view rest) {
  std::string name = rest.find('\\') == rest.npos ? std::string(rest) : without_joins(rest);
  const std::size_t first = std::min(name.find_first_not_of(blanks), name.size());
  name.erase(0, first);
  name.erase(name.find_last_not_of(blanks) + 1);
  return text::as_utf8(name);
}

}  // namespace

Segmentation obj_segmentation(std::string_view keyword) {
  if (keyword == "usemtl") return Segmentation::material;
  if (keyword == "g") return Segmentation::group;
  return keyword == "o" ? Segmentation::part : Segmentation::label;
}

void ObjSegmentLines::add(const ObjSegmentLine& line) {
  std::size_t& last = last_[static_cast<std::size_t>(line.by)];
  if (last > 0 && lines_[last - 1].triangle == line.triangle) {
    lines_[last - 1] = line;
  } else {
    lines_.push_back(line);
    last = lines_.size();
  }
}

std::uint32_t ObjSegments::number_of(std::string_view rest) {
  std::string name = name_in(rest);
  if (name.empty() && segments_.by == Segmentation::group) name = "default";
  if (name.empty()) return unsegmented;
  const auto [known, is_new] =
      numbers_.try_emplace(std::move(name), static_cast<std::uint32_t>(segments_.names.size()));
  if (is_new) segments_.names.push_back(known->first);
  return known->second;
}

void ObjSegments::end_run(std::uint64_t triangle) {
  if (triangle == begin_) return;
  const std::uint32_t number = has_begun_ ? number_of(rest_) : unsegmented;
  const auto end = static_cast<std::uint32_t>(triangle);
  if (!runs_.empty() && runs_.back().number == number) {
    runs_.back().end = end;
  } else {
    runs_.push_back({end, number});
  }
  begin_ = triangle;
}

void ObjSegments::add(const std::vector<ObjSegmentLine>& lines, std::uint64_t triangles_before) {
  for (const ObjSegmentLine& line : lines) {
    if (line.by != segments_.by) continue;
    end_run(triangles_before + line.triangle);
    rest_ = line.rest;
    has_begun_ = true;
  }
}

TriangleSegments ObjSegments::finish(std::uint64_t triangles) {
  end_run(triangles);
  if (segments_.names.empty()) return std::move(segments_);
  if (runs_.size() == 1) {
    segments_.numbers = {runs_[0].number};
    return std::move(segments_);
  }
  segments_.numbers.reserve(triangles);
  for (const Run& run : runs_) segments_.numbers.resize(run.end, run.number);
  return std::move(segments_);
}

}  // namespace fathom::mesh_files
