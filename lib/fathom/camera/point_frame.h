#pragma once

#include <array>
#include <string_view>

namespace fathom {

/// Where points and directions are.
enum class PointFrame { world, camera };
inline constexpr std::array all_point_frames{PointFrame::world, PointFrame::camera};
/// "world" or "camera".
constexpr std::string_view name_of(PointFrame frame) {
  return frame == PointFrame::world ? "world" : "camera";
}

}  // namespace fathom
