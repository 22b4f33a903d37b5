#include "fathom/scene/view_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "fathom/camera/pose.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/scene/element_checks.h"
#include "fathom/scene/scene_fault.h"
#include "fathom/scene/sight.h"

namespace fathom {
using namespace camera;
using namespace scene;

namespace {

using Kind = ViewWarning::Kind;

/// Enough triangles to judge a guess by.
std::size_t step_of_guess(const Scene& scene) {
  constexpr std::uint64_t enough = 20000;
  std::uint64_t triangles = 0;
  for (const Object& object : scene.objects)
    triangles += scene.meshes[object.mesh].triangles.size();
  return static_cast<std::size_t>(triangles / enough + 1);
}

/// Whether the scene, made larger or smaller about the world's origin, is a picture that somebody
/// would take: all of it is seen, and is no speck.
bool is_framed_at_scale(const Scene& scene, const Camera& camera, double scale) {
  const ApproximateCamera scaled(camera, camera.world_to_camera, scale);
  const Sight sight = scaled.sight_of(scene, step_of_guess(scene));
  constexpr double least = 0.05;
  return sight.points > 0 && sight.in_image == sight.points &&
         (sight.last[0] - sight.first[0] >= least * camera.width ||
          sight.last[1] - sight.first[1] >= least * camera.height);
}

constexpr double thousand = 1000;

/// Another scale is no evidence if the view is as good at the scene's own scale: from the world's
/// origin all scales look the same.
std::optional<ViewWarning> warning_of_units(const Scene& scene, const Camera& camera,
                                            double scale) {
  if (is_framed_at_scale(scene, camera, 1) || !is_framed_at_scale(scene, camera, scale))
    return std::nullopt;
  return ViewWarning{
      Kind::units,
      scale > 1 ? "the scene looks as if in metres and the translation of world_to_camera in "
                  "millimetres: a thousand times as large, all of the scene would be seen; divide "
                  "the translation by 1000, or scale the mesh by \"transform\" in a scene file"
                : "the scene looks as if in millimetres and the translation of world_to_camera in "
                  "metres: a thousandth as large, all of the scene would be seen; multiply the "
                  "translation by 1000, or scale the mesh by \"transform\" in a scene file"};
}

/// diag(1, −1, −1) · pose: OpenGL's camera axes to ours.
Pose with_axes_of_opengl(Pose pose) {
  for (std::size_t i : {1, 2})
    for (double& entry : pose[i]) entry = 0.0 - entry;
  return pose;
}

/// Another interpretation of world_to_camera, and advice if it is the intended one.
struct Reading {
  Pose pose;
  const char* advice;
};

/// The likeliest first.
std::vector<Reading> other_readings(const Pose& pose) {
  std::vector<Reading> readings;
  readings.push_back({with_axes_of_opengl(pose),
                      "; with OpenGL's axes (y up, z backward) the scene would be seen: negate the "
                      "second and third rows of world_to_camera"});
  if (const auto inverted = inverse(pose)) {
    readings.push_back({*inverted,
                        "; world_to_camera looks like a camera-to-world matrix, which would show "
                        "the scene: write it as \"camera_to_world\""});
    readings.push_back({with_axes_of_opengl(*inverted),
                        "; world_to_camera looks like OpenGL's camera-to-world matrix, which would "
                        "show the scene: write it as \"camera_to_world\", with the numbers of its "
                        "second and third columns negated"});
  }
  return readings;
}

/// The advice of the reading that shows the scene best, if one shows at least half of it.
std::string advice_for(const Scene& scene, const Camera& camera) {
  double best = 0;
  std::string advice;
  for (const auto& [pose, how] : other_readings(camera.world_to_camera)) {
    const ApproximateCamera other(camera, pose);
    const Sight sight = other.sight_of(scene, step_of_guess(scene));
    if (2 * sight.in_image < sight.points) continue;
    // Among interpretations that show the whole scene, prefers the view that looks straight at it,
    // then the likelier one.
    const double seen = static_cast<double>(sight.in_image) / static_cast<double>(sight.points) +
                        1 / (1 + other.distance_from_middle(sight.middle()));
    if (seen <= best + 0.05) continue;
    best = seen;
    advice = how;
  }
  return advice;
}

std::string in_camera_frame(const Vector& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) in the camera's frame (x right, y down, z forward)",
                     p[0], p[1], p[2]);
}

/// The side of the image on which the box of all points in front lies; nullptr if it is not on one
/// side.
const char* side_of_image(const Sight& sight, const Camera& camera) {
  if (sight.last[0] < 0) return "to the left of";
  if (sight.first[0] > camera.width) return "to the right of";
  if (sight.last[1] < 0) return "above";
  if (sight.first[1] > camera.height) return "below";
  return nullptr;
}

/// Why a map shows nothing; nothing itself where most of the scene is in view, and its triangles
/// are seen edge on or culled.
std::optional<ViewWarning> warning_of_nothing(const Scene& scene, const Camera& camera,
                                              const ApproximateCamera& approximate,
                                              const Sight& sight) {
  const Vector middle = approximate.camera_point(sight.middle());
  if (sight.in_front == 0) {
    return ViewWarning{Kind::behind,
                       "nothing of the scene is in front of the camera: its middle lies at " +
                           in_camera_frame(middle) + advice_for(scene, camera)};
  }
  if (const char* const side = side_of_image(sight, camera)) {
    const std::string advice = advice_for(scene, camera);
    return ViewWarning{
        Kind::outside,
        fmt::format("the camera looks past the scene, which lies {} the image: its middle lies "
                    "at {}{}",
                    side, in_camera_frame(middle),
                    advice.empty() ? "; check world_to_camera, cx and cy" : advice)};
  }
  if (sight.greatest_depth < camera.near || sight.least_depth > camera.far) {
    return ViewWarning{
        Kind::out_of_range,
        fmt::format("no depth of the scene, from {:.6g} to {:.6g}, is between near {:.6g} and "
                    "far {:.6g}: change near and far, or leave them out",
                    sight.least_depth, sight.greatest_depth, camera.near, camera.far)};
  }
  const double width = sight.last[0] - sight.first[0], height = sight.last[1] - sight.first[1];
  if (sight.in_front == sight.points && width < 2 && height < 2) {
    return ViewWarning{
        Kind::too_small,
        fmt::format("the scene is seen as small as {:.2g}x{:.2g} pixels, between their "
                    "centres; check the units of mesh and camera",
                    width, height)};
  }
  if (2 * sight.in_image >= sight.points) return std::nullopt;
  return ViewWarning{
      Kind::nothing_shown,
      "the map shows nothing, though a part of the scene lies in front of the camera: no triangle "
      "that is drawn covers the centre of a pixel; the scene's middle lies at " +
          in_camera_frame(middle) + advice_for(scene, camera)};
}

/// The eye in the frame of an object's mesh; nullopt if the object's transform has no inverse.
std::optional<Vector> eye_in_mesh(const Object& object, const Vector& eye) {
  if (object.placed_as_is) return eye;
  const Pose placement = rounded_placement(object);
  for (const auto& row : placement)
    if (!std::ranges::all_of(row, [](double x) { return std::isfinite(x); })) return std::nullopt;
  const auto mesh_from_world = inverse(placement);
  if (!mesh_from_world) return std::nullopt;
  return applied(*mesh_from_world, eye);
}

/// The object that a perspective camera's eye is in.
const Object* object_around_eye(const Scene& scene, const Camera& camera) {
  if (!is_perspective(camera.projection)) return nullptr;
  const Pose world_from_camera = camera_to_world(camera.world_to_camera);
  const Vector eye{world_from_camera[0][3], world_from_camera[1][3], world_from_camera[2][3]};
  for (const Object& object : scene.objects) {
    const Mesh& mesh = scene.meshes[object.mesh];
    const auto in_mesh = eye_in_mesh(object, eye);
    if (in_mesh && crossings_along_x(mesh, *in_mesh) > 0 &&
        winding_number(mesh, *in_mesh) >= closed_winding)
      return &object;
  }
  return nullptr;
}

/// The warning if the eye is inside a solid. The meshes have not been checked yet.
/// Fails    ElementFault.
std::optional<ViewWarning> warning_of_inside(const Scene& scene, const Camera& camera) {
  const Object* const object = object_around_eye(scene, camera);
  if (object == nullptr) return std::nullopt;
  require_valid(scene);
  if (auto units = warning_of_units(scene, camera, 1 / thousand)) return units;
  return ViewWarning{
      Kind::inside_solid,
      fmt::format("the camera is inside {}, whose surface is closed and faces outwards: only back "
                  "faces are seen; check the translation of world_to_camera and the units",
                  object->name.empty() ? "an object" : "object " + object->name)};
}

/// For a map without background, one pass over the triangles (at most 5 % of the render time)
/// checks whether the eye is inside a solid.
std::optional<ViewWarning> warning_of_full_map(const Scene& scene, const Camera& camera) {
  require_valid(scene, LookAtElements::later);
  return explaining_faults(scene, [&] { return warning_of_inside(scene, camera); });
}

std::optional<ViewWarning> warning_of_empty_map(const Scene& scene, const Camera& camera) {
  const ApproximateCamera approximate(camera, camera.world_to_camera);
  const Sight sight = approximate.sight_of(scene);
  if (sight.points == 0) return std::nullopt;
  for (const double scale : {thousand, 1 / thousand})
    if (auto units = warning_of_units(scene, camera, scale)) return units;
  if (sight.in_image > 0)
    if (auto inside = warning_of_inside(scene, camera)) return inside;
  return warning_of_nothing(scene, camera, approximate, sight);
}

std::optional<ViewWarning> warning_of_speck(const Scene& scene, const Camera& camera,
                                            std::uint64_t shown_pixels) {
  require_valid(scene);
  return shown_pixels == 0 ? warning_of_empty_map(scene, camera)
                           : warning_of_units(scene, camera, thousand);
}

}  // namespace

std::vector<ViewWarning> warnings_of_view(const Scene& scene, const Camera& camera,
                                          std::uint64_t shown_pixels) {
  const StandardArithmetic standard;
  const bool is_full = shown_pixels == std::uint64_t{camera.width} * camera.height;
  const bool is_speck = shown_pixels <= most_pixels_of_a_speck;
  if (!is_full && !is_speck) return {};
  require_valid(camera);
  std::optional<ViewWarning> warning;
  if (is_full) warning = warning_of_full_map(scene, camera);
  if (!warning && is_speck) warning = warning_of_speck(scene, camera, shown_pixels);
  return warning ? std::vector{*warning} : std::vector<ViewWarning>{};
}

std::vector<ViewWarning> view_warnings(const Scene& scene, const Camera& camera,
                                       std::uint64_t shown_pixels) {
  const StandardArithmetic standard;
  std::vector<ViewWarning> warnings = warnings_of_camera(camera);
  if (bends_rays(camera.projection)) return warnings;
  std::ranges::move(warnings_of_view(scene, camera, shown_pixels), std::back_inserter(warnings));
  return warnings;
}

Warnings told_once(std::span<const std::vector<ViewWarning>> of_cameras) {
  const StandardArithmetic standard;
  struct Told {
    const ViewWarning* first;
    std::size_t camera, count;
  };
  std::vector<Told> told;
  for (std::size_t i = 0; i < of_cameras.size(); ++i) {
    for (const ViewWarning& warning : of_cameras[i]) {
      const auto same =
          std::ranges::find_if(told, [&](const Told& t) { return t.first->kind == warning.kind; });
      if (same == told.end())
        told.push_back({&warning, i, 1});
      else
        ++same->count;
    }
  }
  Warnings lines;
  for (const auto& [first, camera, count] : told) {
    std::string line = first->text;
    if (of_cameras.size() > 1) {
      line = fmt::format("camera {}: {}", camera, line);
      if (count > 1) line += fmt::format(" (likewise {} of {} cameras)", count, of_cameras.size());
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace fathom
