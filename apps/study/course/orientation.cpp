#include "apps/study/course/orientation.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "apps/study/pipeline_scenes.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/pipeline/scan/arithmetic.h"

namespace fathom::studies {
namespace {

using pipeline::PipelineOptions;

/// Of radius 1 around (0, 0, z), its triangles counter-clockwise from outside; the poles lie on y.
Scene ball(std::uint32_t rings, std::uint32_t sectors, double z) {
  std::vector<MeshPoint> v{{0, -1, z}};
  for (std::uint32_t i = 1; i < rings; ++i) {
    for (std::uint32_t j = 0; j < sectors; ++j) {
      // Rings of equal area (Archimedes), so that counts of triangles are shares of the surface.
      const double a = std::acos(1 - 2.0 * i / rings);
      const double b = 2 * std::numbers::pi * (j + 0.3) / sectors;
      v.push_back({std::sin(a) * std::cos(b), -std::cos(a), z + std::sin(a) * std::sin(b)});
    }
  }
  v.push_back({0, 1, z});
  const auto at = [&](std::uint32_t ring, std::uint32_t sector) {
    return 1 + (ring - 1) * sectors + sector % sectors;
  };
  const auto last = static_cast<std::uint32_t>(v.size() - 1);
  std::vector<CornerIndices> t;
  for (std::uint32_t j = 0; j < sectors; ++j) {
    t.push_back({0, at(1, j), at(1, j + 1)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      t.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      t.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    t.push_back({at(rings - 1, j), last, at(rings - 1, j + 1)});
  }
  return scene_of(std::move(v), std::move(t));
}

FacingCount facings(double distance, pipeline::Precision precision) {
  PipelineOptions options;
  options.precision = precision;
  options.shading = pipeline::Shading::none;
  Camera camera = front_camera(80, 60, distance - 1.01, distance + 1.01);
  // So narrow that the ball fills the picture and nothing of it is clipped.
  camera.projection.fx = camera.projection.fy = 29.5 * std::sqrt(distance * distance - 1);
  const auto s = render_frame(ball(90, 180, distance), camera, options, false).statistics;
  return {distance,
          precision,
          s.facings.compared,
          s.facings.front_in_world,
          s.facings.front_in_ndc,
          s.facings.front_in_window,
          s.facings.disagreeing,
          (1 - 1 / distance) / 2};
}

/// Three corners, in units of 2^-21: with depths below 8 they are numbers of binary32.
using WholeTriangle = std::array<std::array<std::int64_t, 3>, 3>;
constexpr std::int64_t whole_units = std::int64_t{1} << 21;

/// Two corners at random and a third in the plane through them and the eye, but for its rounding.
WholeTriangle edge_on_triangle(std::mt19937_64& random) {
  const auto between = [&](std::int64_t least, std::int64_t end) {
    return least + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(end - least));
  };
  WholeTriangle t{};
  for (std::size_t k = 0; k < 2; ++k) {
    for (std::size_t i = 0; i < 2; ++i)
      t[k][i] = between(-3 * whole_units / 2, 3 * whole_units / 2);
    t[k][2] = between(5 * whole_units, 13 * whole_units / 2);
  }
  const std::int64_t along = between(200, 825), away = between(820, 1229);  // of 1024
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t place = away * ((1024 - along) * t[0][i] + along * t[1][i]);
    t[2][i] = (place + (std::int64_t{1} << 19)) >> 20;
  }
  return t;
}

std::vector<WholeTriangle> edge_on_triangles() {
  std::mt19937_64 random(2026);
  std::vector<WholeTriangle> triangles(300);
  for (WholeTriangle& t : triangles) t = edge_on_triangle(random);
  return triangles;
}

/// N·V > 0, where N·V is −det(A, B, C) as the eye is the origin. Exact: |det| < 2^76.
bool faces_the_eye(const WholeTriangle& t) {
  using pipeline::Int128;
  Int128 determinant = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    determinant += Int128{t[0][i]} * (Int128{t[1][j]} * t[2][k] - Int128{t[1][k]} * t[2][j]);
  }
  return determinant < 0;
}

EdgeOnCount edge_on_count(pipeline::Precision precision) {
  PipelineOptions options;
  options.precision = precision;
  options.shading = pipeline::Shading::none;
  const std::vector<WholeTriangle> triangles = edge_on_triangles();
  const SceneView view = edge_on_files().view;
  EdgeOnCount count{.precision = precision};
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Scene alone = view.scene;
    alone.meshes[0].triangles = {view.scene.meshes[0].triangles[i]};
    const auto s = render_frame(alone, view.camera, options, false).statistics;
    const std::uint64_t front = faces_the_eye(triangles[i]) ? 1 : 0;
    count.triangles += s.facings.compared;
    count.front += front;
    count.front_in_world += s.facings.front_in_world;
    count.front_in_ndc += s.facings.front_in_ndc;
    count.front_in_window += s.facings.front_in_window;
    count.wrong_in_world += s.facings.front_in_world != front;
    count.wrong_in_ndc += s.facings.front_in_ndc != front;
    count.wrong_in_window += s.facings.front_in_window != front;
    count.disagreeing += s.facings.disagreeing;
    count.turned_by_snapping += s.turned_by_snapping;
  }
  return count;
}

}  // namespace

SceneFiles edge_on_files() {
  Scene scene = scene_of({}, {});
  Mesh& mesh = scene.meshes[0];
  for (const WholeTriangle& t : edge_on_triangles()) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& corner : t) {
      const auto place = [&](std::size_t i) {
        return static_cast<double>(corner[i]) / static_cast<double>(whole_units);
      };
      mesh.vertices.push_back({place(0), place(1), place(2)});
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return scene_files("edge-on", scene, front_camera(160, 120, 1, 20));
}

std::vector<EdgeOnCount> count_edge_on() {
  return {edge_on_count(pipeline::Precision::binary32),
          edge_on_count(pipeline::Precision::binary64)};
}

std::vector<FacingCount> count_facings() {
  std::vector<FacingCount> counts;
  for (const auto precision : {pipeline::Precision::binary32, pipeline::Precision::binary64})
    for (const double distance : {1.5, 2.0, 4.0, 16.0, 256.0})
      counts.push_back(facings(distance, precision));
  return counts;
}

SceneFiles open_box_files() {
  // Looked at from above: turned about x by 40 degrees and about the upright axis by 30.
  std::vector<MeshPoint> v;
  const double a = std::numbers::pi * 30 / 180, b = std::numbers::pi * 40 / 180;
  for (int i = 0; i < 8; ++i) {
    const double x = i & 1 ? 1 : -1, y = i & 2 ? 0.7 : -0.7, z = i & 4 ? 1 : -1;
    const double x1 = std::cos(a) * x + std::sin(a) * z, z1 = std::cos(a) * z - std::sin(a) * x;
    v.push_back({x1, std::cos(b) * y - std::sin(b) * z1, std::sin(b) * y + std::cos(b) * z1 + 5});
  }
  // y grows down: the lid, y = −0.7, is left out. Clockwise from outside, then turned.
  Scene scene = scene_of(v, {{2, 3, 7},
                             {2, 7, 6},
                             {0, 1, 3},
                             {0, 3, 2},
                             {4, 6, 7},
                             {4, 7, 5},
                             {0, 2, 6},
                             {0, 6, 4},
                             {1, 5, 7},
                             {1, 7, 3}});
  for (CornerIndices& t : scene.meshes[0].triangles) std::swap(t[1], t[2]);
  return scene_files("box", scene, front_camera(160, 160, 1, 20));
}

RgbImage open_box(pipeline::FrontFace front_face, pipeline::Culling culling) {
  PipelineOptions options;
  options.front_face = front_face;
  options.culling = culling;
  options.background = {0.1, 0.1, 0.15};
  options.antialias = {pipeline::AntialiasMethod::msaa, 8};
  return pipeline_picture(open_box_files().view, options);
}

}  // namespace fathom::studies
