#include "fathom/attribution/faults/local_faults.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "fathom/geometry/eigen_arrays.h"

namespace fathom::attribution {

std::vector<std::vector<std::size_t>> pixel_groups(std::uint32_t width, std::uint32_t height,
                                                   const std::function<bool(std::size_t)>& is_one) {
  const std::size_t count = std::size_t{width} * height;
  std::vector<bool> left(count);
  for (std::size_t i = 0; i < count; ++i) left[i] = is_one(i);
  std::vector<std::vector<std::size_t>> groups;
  for (std::size_t first = 0; first < count; ++first) {
    if (!left[first]) continue;
    left[first] = false;
    std::vector<std::size_t>& group = groups.emplace_back(1, first);
    for (std::size_t k = 0; k < group.size(); ++k) {
      const std::size_t x = group[k] % width, y = group[k] / width;
      for (std::size_t row = y == 0 ? 0 : y - 1; row <= std::min<std::size_t>(y + 1, height - 1);
           ++row) {
        for (std::size_t column = x == 0 ? 0 : x - 1;
             column <= std::min<std::size_t>(x + 1, width - 1); ++column) {
          const std::size_t i = row * width + column;
          if (!left[i]) continue;
          left[i] = false;
          group.push_back(i);
        }
      }
    }
  }
  return groups;
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Pixels that touch each other and still are by themselves.
constexpr std::size_t most_together = 4;

bool is_unexplained(const Attribution& found, std::size_t pixel) {
  return found.classes[pixel] == PixelClass::unexplained;
}

/// The finding, if it explains nine tenths of the unexplained pixels.
std::optional<PixelFinding> if_most(const Attribution& found, const std::string& kind,
                                    const std::string& text,
                                    const std::function<bool(std::size_t)>& explains) {
  PixelFinding result{{kind, text}, std::vector<std::uint8_t>(found.classes.size())};
  for (std::size_t i = 0; i < found.classes.size(); ++i) {
    result.explained[i] = is_unexplained(found, i) && explains(i) ? 1 : 0;
    result.finding.pixels += result.explained[i];
  }
  if (result.finding.pixels * 10 < found.count(PixelClass::unexplained) * 9) return std::nullopt;
  return result;
}

/// Least and greatest depth of the surfaces that a map shows where they should be.
struct Range {
  double least = infinity, greatest = -infinity;
};

Range explained_range(const Truth& truth, const Attribution& found) {
  std::vector<double> depths;
  for (std::size_t i = 0; i < truth.depths.size(); ++i) {
    const bool is_seen = truth.depths[i] < infinity && found.classes[i] <= PixelClass::arithmetic;
    if (is_seen) depths.push_back(truth.depths[i]);
  }
  if (depths.size() < 64) return {};
  // Without a thousandth on either side, because pixels at edges show surfaces behind.
  const auto some = static_cast<std::ptrdiff_t>(depths.size() / 1000);
  std::nth_element(depths.begin(), depths.begin() + some, depths.end());
  const double least = depths[static_cast<std::size_t>(some)];
  std::nth_element(depths.begin(), depths.end() - 1 - some, depths.end());
  return {least, *(depths.end() - 1 - some)};
}

/// Rows (or columns) in which nearly all pixels with a surface are unexplained.
std::vector<std::uint8_t> lost(const Truth& truth, const Attribution& found, bool rows) {
  const std::uint32_t width = truth.camera.width, height = truth.camera.height;
  std::vector<std::uint64_t> all(rows ? height : width), bad(all.size());
  for (std::size_t i = 0; i < truth.depths.size(); ++i) {
    const std::size_t line = rows ? i / width : i % width;
    const bool counts = truth.depths[i] < infinity || is_unexplained(found, i);
    all[line] += counts ? 1 : 0;
    bad[line] += is_unexplained(found, i) ? 1 : 0;
  }
  std::vector<std::uint8_t> result(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) result[k] = bad[k] >= 4 && bad[k] * 10 >= all[k] * 9;
  return result;
}

/// Whether surfaces are shown in the other rows (or columns) as they should be.
bool others_are_good(const Truth& truth, const Attribution& found,
                     const std::vector<std::uint8_t>& lost, bool rows) {
  std::uint64_t all = 0, good = 0;
  for (std::size_t i = 0; i < truth.depths.size(); ++i) {
    if (!(truth.depths[i] < infinity)) continue;
    const std::size_t line = rows ? i / truth.camera.width : i % truth.camera.width;
    ++all;
    good += lost[line] == 0 && !is_unexplained(found, i) ? 1 : 0;
  }
  return good > 0 && good * 20 >= all;
}

std::string text_of_lines(const std::vector<std::uint8_t>& lost, bool rows) {
  const auto first = std::find(lost.begin(), lost.end(), 1) - lost.begin();
  const auto last = lost.rend() - std::find(lost.rbegin(), lost.rend(), 1) - 1;
  const auto count = std::count(lost.begin(), lost.end(), 1);
  const char* what = rows ? "row" : "column";
  if (count == 1) return fmt::format("{} {} does not show what it should", what, first);
  return fmt::format("{} {}s from {} to {} do not show what they should", count, what, first, last);
}

/// The exact depths of a pixel and its neighbours, two to each side; background counts as infinite.
std::vector<double> depths_around(const Truth& truth, std::size_t pixel) {
  constexpr std::size_t reach = 2;
  const std::size_t width = truth.camera.width, height = truth.camera.height;
  const std::size_t x = pixel % width, y = pixel / width;
  std::vector<double> depths;
  for (std::size_t row = y - std::min(y, reach); row <= std::min(y + reach, height - 1); ++row) {
    for (std::size_t column = x - std::min(x, reach); column <= std::min(x + reach, width - 1);
         ++column) {
      depths.push_back(truth.depths[row * width + column]);
    }
  }
  return depths;
}

Range range_around(const Truth& truth, std::size_t pixel) {
  const std::vector<double> depths = depths_around(truth, pixel);
  const auto [least, greatest] = std::minmax_element(depths.begin(), depths.end());
  return {*least, *greatest};
}

/// The greatest relative gap between the exact depths of a pixel and its neighbours: at a
/// silhouette that between the surfaces, on a slope the little that it falls from pixel to pixel.
Range gap_around(const Truth& truth, std::size_t pixel) {
  std::vector<double> depths = depths_around(truth, pixel);
  std::sort(depths.begin(), depths.end());
  Range gap{depths.front(), depths.front()};
  for (std::size_t i = 1; i < depths.size() && depths[i - 1] < infinity; ++i) {
    if (depths[i] * gap.least > gap.greatest * depths[i - 1]) gap = {depths[i - 1], depths[i]};
  }
  return gap;
}

std::string shown(double depth) {
  return depth < infinity ? fmt::format("{:.7g}", depth) : "background";
}

}  // namespace

std::optional<PixelFinding> clipped(const Truth& truth, const OtherMap& other,
                                    const Attribution& found) {
  const Range seen = explained_range(truth, found);
  const auto missing_where = [&](const std::function<bool(double)>& is_beyond) {
    return [&truth, &other, is_beyond](std::size_t i) {
      return truth.depths[i] < infinity && is_beyond(truth.depths[i]) &&
             other.depths[i] > truth.depths[i];
    };
  };
  if (found.count(PixelClass::unexplained) < 16 || !(seen.least < seen.greatest)) {
    return std::nullopt;
  }
  const auto near = [&](double d) { return d < seen.least; };
  if (auto cut = if_most(found, "clipped",
                         fmt::format("surfaces nearer than {:.6g} are missing", seen.least),
                         missing_where(near))) {
    return cut;
  }
  const auto far = [&](double d) { return d > seen.greatest; };
  return if_most(found, "clipped",
                 fmt::format("surfaces farther than {:.6g} are missing", seen.greatest),
                 missing_where(far));
}

std::optional<PixelFinding> lost_lines(const Truth& truth, const OtherMap& /*other*/,
                                       const Attribution& found) {
  for (const bool rows : {true, false}) {
    const std::vector<std::uint8_t> lines = lost(truth, found, rows);
    const auto count = static_cast<std::size_t>(std::count(lines.begin(), lines.end(), 1));
    if (count == 0 || !others_are_good(truth, found, lines, rows)) continue;
    const std::uint32_t width = truth.camera.width;
    const auto in_one = [&](std::size_t i) { return lines[rows ? i / width : i % width] != 0; };
    if (auto result = if_most(found, rows ? "lost-rows" : "lost-columns",
                              text_of_lines(lines, rows), in_one)) {
      return result;
    }
  }
  return std::nullopt;
}

std::optional<PixelFinding> mixed(const Truth& truth, const OtherMap& other,
                                  const Attribution& found) {
  const auto is_between = [&](std::size_t i) {
    const Range range = range_around(truth, i);
    return range.least < other.depths[i] && other.depths[i] < range.greatest;
  };
  // A slightly wrong depth lies between its neighbours on every slope: only silhouettes are
  // evidence.
  constexpr double jump = 1.05, least_share = 0.05;
  std::uint64_t at_jumps = 0, between = 0;
  for (std::size_t i = 0; i < found.classes.size(); ++i) {
    const Range range = range_around(truth, i);
    if (!(range.greatest > jump * range.least)) continue;  // and no gap in it is greater
    const Range gap = gap_around(truth, i);
    if (!(gap.greatest > jump * gap.least)) continue;
    const double tenth = std::min(gap.greatest - gap.least, gap.least) / 10;
    ++at_jumps;
    between += is_unexplained(found, i) && other.depths[i] > gap.least + tenth &&
                       other.depths[i] < gap.greatest - tenth
                   ? 1
                   : 0;
  }
  if (between < 16 || static_cast<double>(between) < least_share * static_cast<double>(at_jumps)) {
    return std::nullopt;
  }
  return if_most(found, "mixed",
                 "depths lie between those of neighbouring pixels, as a filter or a resize makes "
                 "them: take the nearest pixel for depths",
                 is_between);
}

std::optional<PixelFinding> isolated(const Truth& truth, const OtherMap& other,
                                     const Attribution& found) {
  const auto groups = pixel_groups(truth.camera.width, truth.camera.height,
                                   [&](std::size_t i) { return is_unexplained(found, i); });
  const std::size_t most_groups = std::max<std::size_t>(4, truth.depths.size() / 50);
  const bool few = groups.size() <= most_groups &&
                   std::all_of(groups.begin(), groups.end(),
                               [](const auto& g) { return g.size() <= most_together; });
  if (!few || groups.empty()) return std::nullopt;
  const std::size_t first = groups.front().front();
  const std::uint64_t count = found.count(PixelClass::unexplained);
  return if_most(
      found, "isolated-pixels",
      fmt::format("{} by {}; {}({}, {}) shows {} for {}",
                  count == 1 ? "a pixel is wrong" : fmt::format("{} pixels are wrong", count),
                  count == 1 ? "itself" : "themselves", count == 1 ? "" : "the first at ",
                  first % truth.camera.width, first / truth.camera.width,
                  shown(other.depths[first]), shown(truth.depths[first])),
      [](std::size_t) { return true; });
}

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
