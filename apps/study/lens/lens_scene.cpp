#include "apps/study/lens/lens_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/lens/sample_plane.h"
#include "fathom/numeric/rounding.h"
#include "fathom/scene/triangle_source.h"

namespace fathom::studies {

LensScene in_camera_frame(const SceneView& view) {
  LensScene result{view.name, {}, {}, view.camera};
  Mesh mesh;
  const TriangleSource triangles(view.scene);
  for (std::uint32_t number = 0; number < triangles.count(); ++number) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const WorldPoint& corner : triangles.world_corners(number)) {
      const CameraPoint p = to_camera(view.camera.world_to_camera, corner);
      mesh.vertices.push_back(
          {round_to_binary64(p.x), round_to_binary64(p.y), round_to_binary64(p.z)});
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    result.surfaces.push_back(triangles.origin(number).object);
  }
  mesh.face_count = mesh.triangles.size();
  result.scene.meshes = {std::move(mesh)};
  result.scene.objects = {{.name = view.name}};
  Camera& camera = result.pinhole;
  camera.world_to_camera = Camera().world_to_camera;
  camera.projection.lens.reset();
  camera.near = 0;
  camera.far = std::numeric_limits<double>::infinity();
  return result;
}

namespace {

/// Objects of four-sided faces, each of two triangles.
class SceneOfFaces {
 public:
  void begin(const std::string& name) {
    scene_.objects.push_back({.mesh = scene_.meshes.size(), .name = name});
    scene_.meshes.emplace_back();
  }
  void face(const std::array<MeshPoint, 4>& corners) {
    Mesh& mesh = scene_.meshes.back();
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const MeshPoint& p : corners) mesh.vertices.push_back(p);
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
    mesh.face_count = mesh.triangles.size();
  }
  /// The object of a face alone.
  void wall(const std::string& name, const std::array<MeshPoint, 4>& corners) {
    begin(name);
    face(corners);
  }
  /// A box from a corner to the opposite one, turned about the vertical line through the first.
  void box(const std::string& name, const MeshPoint& from, const MeshPoint& to, double turn) {
    begin(name);
    const auto corner = [&](bool right, bool down, bool back) {
      const double x = right ? to.x - from.x : 0, z = back ? to.z - from.z : 0;
      return MeshPoint{from.x + x * std::cos(turn) - z * std::sin(turn), down ? to.y : from.y,
                       from.z + x * std::sin(turn) + z * std::cos(turn)};
    };
    for (const bool end : {false, true}) {
      face({corner(end, false, false), corner(end, true, false), corner(end, true, true),
            corner(end, false, true)});
      face({corner(false, end, false), corner(true, end, false), corner(true, end, true),
            corner(false, end, true)});
      face({corner(false, false, end), corner(true, false, end), corner(true, true, end),
            corner(false, true, end)});
    }
  }
  [[nodiscard]] Scene scene() && { return std::move(scene_); }

 private:
  Scene scene_;
};

}  // namespace

SceneView corridor() {
  SceneOfFaces faces;
  constexpr double x = 1.7, y = 1.3, front = 2, back = 6;
  faces.wall("back", {{{-x, -y, back}, {x, -y, back}, {x, y, back}, {-x, y, back}}});
  faces.wall("ceiling", {{{-x, -y, front}, {x, -y, front}, {x, -y, back}, {-x, -y, back}}});
  faces.wall("floor", {{{-x, y, front}, {x, y, front}, {x, y, back}, {-x, y, back}}});
  faces.wall("left", {{{-x, -y, front}, {-x, y, front}, {-x, y, back}, {-x, -y, back}}});
  faces.wall("right", {{{x, -y, front}, {x, y, front}, {x, y, back}, {x, -y, back}}});
  faces.box("left box", {-1.35, 0.55, 2.6}, {-0.85, 1.28, 3.1}, 0.3);
  faces.box("right box", {0.75, 0.35, 2.9}, {1.35, 1.28, 3.5}, -0.2);
  faces.box("middle box", {-0.33, 0.61, 3.7}, {0.37, 1.29, 4.4}, 0.5);
  faces.box("lamp", {-0.41, -1.21, 3.2}, {0.43, -1.03, 3.9}, 0.1);
  faces.box("left post", {-1.52, -1.24, 2.4}, {-1.44, 1.27, 2.5}, 0.1);
  faces.box("right post", {1.41, -1.23, 2.4}, {1.49, 1.26, 2.5}, -0.1);

  SceneView view{"corridor", std::move(faces).scene(), {}};
  view.camera.width = 320;
  view.camera.height = 240;
  view.camera.projection.fx = view.camera.projection.fy = 240;
  view.camera.projection.cx = 160;
  view.camera.projection.cy = 120;
  return view;
}

Lens at_strength(Lens lens, double strength) {
  for (double& number : lens.distortion) number *= strength;
  return lens;
}

namespace {

/// The greatest distance of a corner of the image from the axis, in the plane at depth 1.
double farthest_corner(const Camera& camera) {
  const RoundedProjection projection(camera.projection);
  double farthest = 0;
  for (const double u : {0.0, static_cast<double>(camera.width)}) {
    for (const double v : {0.0, static_cast<double>(camera.height)}) {
      const auto [x, y] = projection.plane_point_at(u, v);
      farthest = std::max(farthest, std::hypot(x, y));
    }
  }
  return farthest;
}

/// A lens whose numbers are those of an image whose farthest corner has the distance 1; `powers`
/// are the powers of the distance that they belong to.
StudiedLens scaled_lens(const std::string& name, LensModel model, double corner,
                        const std::vector<double>& numbers, const std::vector<int>& powers) {
  StudiedLens result{name, {.model = model}};
  for (std::size_t i = 0; i < numbers.size(); ++i)
    result.lens.distortion[i] = numbers[i] / std::pow(corner, powers[i]);
  return result;
}

}  // namespace

std::vector<StudiedLens> lenses_for(const Camera& camera) {
  if (bends_rays(camera.projection)) {
    const Lens& lens = *camera.projection.lens;
    if (!is_plane(lens.model) || !has_stage(lens.model) || lens::Tilt::of(lens)) {
      throw UsageError("the study lens takes no lens " + std::string(name_of(lens.model)) +
                       (lens::Tilt::of(lens) ? " with a tilt" : "") +
                       ", expected a pinhole or a lens with radial and tangential terms");
    }
    return {{"camera", with_two_focal_lengths(lens)}};
  }
  const double corner = farthest_corner(camera);
  return {// r + k·r³ is greatest at r = 1/√(−3k), where it is 1 for this k.
          scaled_lens("barrel", LensModel::opencv, corner, {-4.0 / 27}, {2}),
          scaled_lens("pincushion", LensModel::opencv, corner, {0.5}, {2}),
          scaled_lens("decentred", LensModel::opencv, corner, {-0.2, 0.016, 0.004, -0.003},
                      {2, 4, 1, 1}),
          scaled_lens("rational", LensModel::full_opencv, corner,
                      {0.05, 0, 0.001, -0.001, 0, 0.2, 0.01}, {2, 4, 1, 1, 6, 2, 4})};
}

}  // namespace fathom::studies
