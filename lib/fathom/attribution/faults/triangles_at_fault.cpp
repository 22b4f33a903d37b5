#include "fathom/attribution/faults/triangles_at_fault.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "fathom/attribution/faults/pixels_at_fault.h"
#include "fathom/geometry/eigen_arrays.h"

namespace fathom::attribution {
namespace {

/// Least number of touching pixels that the absence of a triangle, or of its neighbours, must
/// explain.
constexpr std::size_t least_pixels = 3;
/// Missing triangles that are named one by one.
constexpr std::size_t most_named = 3;

/// Pixels of a triangle that is certain to be visible: where its absence is seen, where it is.
struct Sightings {
  std::uint64_t absent = 0, present = 0;

  [[nodiscard]] bool is_missing() const { return absent > 0 && present <= absent / 10; }
};

std::map<std::uint32_t, Sightings> sightings(const Truth& truth, const Attribution& found) {
  std::map<std::uint32_t, Sightings> all;
  for (std::size_t i = 0; i < found.clues.absent.size(); ++i) {
    const std::uint32_t visible = truth.triangles[i];
    if (visible == no_surface) continue;
    if (found.clues.absent[i] != no_surface) {
      ++all[visible].absent;
    } else if (found.classes[i] <= PixelClass::arithmetic) {
      ++all[visible].present;
    }
  }
  return all;
}

/// Missing triangles of groups of pixels that are large enough.
std::set<std::uint32_t> missing(const Truth& truth, const Attribution& found,
                                const std::map<std::uint32_t, Sightings>& seen) {
  const auto shows_it = [&](std::size_t i) {
    return found.clues.absent[i] != no_surface && seen.at(found.clues.absent[i]).is_missing();
  };
  std::set<std::uint32_t> triangles;
  for (const auto& group : pixel_groups(truth.camera.width, truth.camera.height, shows_it)) {
    if (group.size() < least_pixels) continue;
    for (const std::size_t i : group) triangles.insert(found.clues.absent[i]);
  }
  return triangles;
}

/// Whether its corners run clockwise as they are seen.
bool is_turned_away(const Truth& truth, std::uint32_t triangle) {
  const auto view = geometry::as_matrix(truth.camera.world_to_camera);
  const auto corner = [&](std::size_t k) -> Eigen::Vector3d {
    const auto p = geometry::as_vector(truth.mesh.points[truth.mesh.triangles[triangle][k]]);
    return view.leftCols<3>() * p + view.col(3);
  };
  const Eigen::Vector3d a = corner(0), n = (corner(1) - a).cross(corner(2) - a);
  return is_perspective(truth.camera.projection) ? n.dot(a) > 0 : n.z() > 0;
}

/// Whether surfaces behind the missing triangles are shown.
bool shows_what_is_behind(const OtherMap& other, const Attribution& found) {
  std::uint64_t all = 0, surfaces = 0;
  for (std::size_t i = 0; i < found.clues.absent.size(); ++i) {
    if (found.clues.absent[i] == no_surface) continue;
    ++all;
    surfaces += std::isfinite(other.depths[i]) ? 1 : 0;
  }
  return surfaces * 5 >= all * 4;
}

/// Nearly all that are turned one way are missing, and hardly any that is turned the other way.
/// Edges leave some of either.
std::optional<Finding> culling(const Truth& truth, const std::map<std::uint32_t, Sightings>& seen,
                               const std::set<std::uint32_t>& gone, std::uint64_t pixels) {
  std::array<std::uint64_t, 2> all{}, lost{};
  for (const auto& [triangle, sighting] : seen) {
    const auto way = static_cast<std::size_t>(is_turned_away(truth, triangle));
    all[way] += sighting.absent + sighting.present;
    lost[way] += gone.contains(triangle) ? sighting.absent : 0;
  }
  for (const std::size_t way : {0U, 1U}) {
    const bool is_culled = gone.size() >= 2 && lost[way] >= 16 && lost[way] * 5 >= all[way] * 4 &&
                           lost[1 - way] * 5 <= all[1 - way];
    if (!is_culled) continue;
    return Finding{"culling",
                   way == 1 ? "triangles that are turned away from the camera are missing"
                            : "triangles that face the camera are missing",
                   pixels};
  }
  return std::nullopt;
}

}  // namespace

std::vector<Finding> triangles_at_fault(const Truth& truth, const OtherMap& other,
                                        const Attribution& found) {
  std::vector<Finding> findings;
  if (found.clues.wrong_ties > 0) {
    findings.push_back(
        {"ties",
         "of triangles with the same corners another one is seen than the depth test "
         "lets win",
         found.clues.wrong_ties});
  }
  const std::map<std::uint32_t, Sightings> seen = sightings(truth, found);
  const std::set<std::uint32_t> gone = missing(truth, found, seen);
  std::uint64_t pixels = 0;
  for (const std::uint32_t t : gone) pixels += seen.at(t).absent;
  const auto culled =
      shows_what_is_behind(other, found) ? culling(truth, seen, gone, pixels) : std::nullopt;
  if (culled) {
    findings.push_back(*culled);
    return findings;
  }
  if (gone.size() <= most_named) {
    for (const std::uint32_t t : gone) {
      findings.push_back(
          {"missing-triangle", fmt::format("triangle {} is missing", t), seen.at(t).absent});
    }
    return findings;
  }
  const std::vector<std::uint32_t> first(gone.begin(), std::next(gone.begin(), most_named));
  findings.push_back(
      {"missing-triangle",
       fmt::format("{} triangles are missing: {}, …", gone.size(), fmt::join(first, ", ")),
       pixels});
  return findings;
}

}  // namespace fathom::attribution
