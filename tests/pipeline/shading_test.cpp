#include "fathom/pipeline/fragments/shading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fathom/pipeline/geometry/vertex_transform.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/scene/framing.h"
#include "tests/inputs/scene_building.h"

/// Colours worked out by hand, and by the textbooks' formulas in long double from the rays on,
/// which share nothing with the stages.
namespace fathom::pipeline {
namespace {

using checks::scene_of;
using Vector = std::array<double, 3>;

constexpr std::uint32_t size = 16;

/// At the origin, along z. A point (x·z/8, y·z/8, z) is seen at (x, y) in pixels, exactly.
Camera camera() {
  Camera camera = checks::camera_of(size, size, 8);
  camera.projection.cx = camera.projection.cy = 0;
  camera.near = 1;
  camera.far = 64;
  return camera;
}

/// A corner seen at (x, y) in depth z.
MeshPoint seen_at(double x, double y, double z) {
  return {x * z / 8, y * z / 8, z};
}

/// Lower left, lower right, upper left corner: counter-clockwise as seen.
Scene triangle(double z_a, double z_b, double z_c, const std::vector<Vector>& normals) {
  Scene scene =
      scene_of({seen_at(0, 16, z_a), seen_at(16, 16, z_b), seen_at(0, 0, z_c)}, {{0, 1, 2}});
  scene.meshes[0].normals = normals;
  return scene;
}

PipelineOptions options(Shading shading, const Vector& towards_light, const Material& material) {
  PipelineOptions o;
  o.shading = shading;
  o.precision = Precision::binary64;
  o.light = {.towards = towards_light, .in_world = true};
  o.material = material;
  return o;
}

Colour colour_at(const Scene& scene, const PipelineOptions& o, std::size_t x, std::size_t y,
                 const Camera& seen_by = camera()) {
  return render_frame(scene, seen_by, o, true).picture.pixels.at(y * size + x);
}

// Directions in the world: towards the camera is −z.
const Vector straight{0, 0, -1};
const Vector at_60{std::sqrt(0.75), 0, -0.5};
const Vector at_90{1, 0, 0};
const Material matte{.ambient = 0.15, .diffuse = 0.75, .specular = 0, .shininess = 1};

/// Pictures are kept in binary32: half an ulp below 1. Before that are some hundred roundings in
/// binary64 of numbers of about 1, those of a cosine enlarged 40 times by (cosine)^40.
constexpr double rounded = 0x1p-25 + 1e-13;
constexpr std::array areas{Shading::flat, Shading::gouraud, Shading::phong};

TEST(Shading, LambertsLightByHand) {
  // A wall that faces the camera, lit along its normal, at 60° and from behind.
  const Scene wall = triangle(8, 8, 8, {straight, straight, straight});
  for (const Shading shading : areas) {
    const auto lit = [&](const Vector& towards) {
      return colour_at(wall, options(shading, towards, matte), 3, 9)[0];
    };
    EXPECT_NEAR(lit(straight), 0.15 + 0.75, rounded);
    EXPECT_NEAR(lit(at_60), 0.15 + 0.375, rounded);
    EXPECT_NEAR(lit(at_90), 0.15, rounded);
    EXPECT_NEAR(lit({0, 0, 1}), 0.15, rounded);
    EXPECT_NEAR(lit({0, 0, -1e300}), 0.9, rounded);  // a direction has any length
    EXPECT_NEAR(lit({0, 0, -1e-300}), 0.9, rounded);
  }
}

TEST(Shading, BlinnsAndPhongsHighlightsByHand) {
  // Parallel rays, so V = (0, 0, −1) everywhere; L at 60°. Halfway is at 30°: cos² = 3/4. The
  // mirrored light is at 60° on the other side: cos² = 1/4. Lambert: 1/2.
  Camera parallel = camera();
  parallel.projection.model = ProjectionModel::orthographic;
  parallel.projection.fx = parallel.projection.fy = 1;
  const Scene wall = scene_of({{0, 16, 8}, {16, 16, 8}, {0, 0, 8}}, {{0, 1, 2}});
  Material material{.ambient = 0.1, .diffuse = 0.2, .specular = 0.5, .shininess = 2};
  for (const Shading shading : areas) {
    material.highlight = SpecularModel::blinn;
    EXPECT_NEAR(colour_at(wall, options(shading, at_60, material), 3, 9, parallel)[1],
                0.1 + 0.2 / 2 + 0.5 * 0.75, rounded);
    material.highlight = SpecularModel::phong;
    EXPECT_NEAR(colour_at(wall, options(shading, at_60, material), 3, 9, parallel)[1],
                0.1 + 0.2 / 2 + 0.5 * 0.25, rounded);
    // No light, no highlight: from 120°, halfway is at 60° still.
    material.highlight = SpecularModel::blinn;
    EXPECT_NEAR(
        colour_at(wall, options(shading, {std::sqrt(0.75), 0, 0.5}, material), 3, 9, parallel)[1],
        0.1, rounded);
  }
}

/// Where the eye is counts for highlights: a camera and all before it moved and turned together see
/// the same, with the light moved along.
TEST(Shading, HighlightsMoveWithTheEye) {
  const Material shiny{.ambient = 0.1, .diffuse = 0.2, .specular = 0.7, .shininess = 10};
  const Scene scene = triangle(8, 12, 6, {straight, straight, straight});
  Scene moved = scene;
  for (MeshPoint& p : moved.meshes[0].vertices) p = {p.z + 4, p.x - 8, p.y + 2};
  for (auto& n : moved.meshes[0].normals) n = {n[2], n[0], n[1]};
  Camera there = camera();
  there.world_to_camera = {{{0, 1, 0, 8}, {0, 0, 1, -2}, {1, 0, 0, -4}}};
  for (const Shading shading : areas) {
    const PipelineOptions here = options(shading, {0.25, -0.125, -1}, shiny);
    const PipelineOptions turned = options(shading, {-1, 0.25, -0.125}, shiny);
    const ColourImage picture = render_frame(scene, camera(), here, true).picture;
    const ColourImage other = render_frame(moved, there, turned, true).picture;
    double greatest = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      ASSERT_NEAR(picture.pixels[i][0], other.pixels[i][0], rounded) << i;
      greatest = std::max(greatest, picture.pixels[i][0]);
    }
    EXPECT_GT(greatest, 0.32);  // ambient and diffuse light alone are 0.3 at most
  }
}

TEST(Shading, GouraudMixesTheLightOfTheCorners) {
  // Corners at (0,16), (16,16), (0,0) with 0.9, 0.525, 0.15. The centre of pixel (3, 9) has the
  // weights 1 − 3.5/16 − 6.5/16 = 6/16, 3.5/16 and 6.5/16.
  const std::vector<Vector> normals{straight, at_60, at_90};
  const double by_hand = (6 * 0.9 + 3.5 * 0.525 + 6.5 * 0.15) / 16;
  PipelineOptions o = options(Shading::gouraud, straight, matte);
  EXPECT_NEAR(colour_at(triangle(8, 8, 8, normals), o, 3, 9)[2], by_hand, rounded);
  // With depths 8, 16, 4: weights over depth, in proportion 6/8 : 3.5/16 : 6.5/4 = 24 : 7 : 52.
  const double in_perspective = (24 * 0.9 + 7 * 0.525 + 52 * 0.15) / 83;
  EXPECT_NEAR(colour_at(triangle(8, 16, 4, normals), o, 3, 9)[2], in_perspective, rounded);
  o.interpolation = Interpolation::affine;
  EXPECT_NEAR(colour_at(triangle(8, 16, 4, normals), o, 3, 9)[2], by_hand, rounded);
  // In binary32: ten roundings on the way.
  o.precision = Precision::binary32;
  EXPECT_NEAR(colour_at(triangle(8, 16, 4, normals), o, 3, 9)[2], by_hand, 11 * 0x1p-24);
}

TEST(Shading, PhongMixesTheNormals) {
  // Normals (0,0,−1), (1,0,0), (0,−1,0) with the weights 6, 3.5, 6.5: N = (3.5, −6.5, −6)/√90.5.
  const Scene scene = triangle(8, 8, 8, {straight, {1, 0, 0}, {0, -1, 0}});
  EXPECT_NEAR(colour_at(scene, options(Shading::phong, straight, matte), 3, 9)[0],
              0.15 + 0.75 * 6 / std::sqrt(90.5), rounded);
  EXPECT_NEAR(colour_at(scene, options(Shading::phong, {0, -3, 0}, matte), 3, 9)[0],
              0.15 + 0.75 * 6.5 / std::sqrt(90.5), rounded);
  // The lengths of a mesh's normals mean nothing, however great or small.
  const Scene uneven = triangle(8, 8, 8, {{0, 0, -1e300}, {1e-300, 0, 0}, {0, -7, 0}});
  EXPECT_NEAR(colour_at(uneven, options(Shading::phong, straight, matte), 3, 9)[0],
              0.15 + 0.75 * 6 / std::sqrt(90.5), rounded);
}

TEST(Shading, ACornerWithoutANormalHasAmbientLightAlone) {
  const Scene scene = triangle(8, 8, 8, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  for (const Shading shading : {Shading::gouraud, Shading::phong})
    EXPECT_EQ(colour_at(scene, options(shading, straight, {}), 3, 9)[0], 0.15F);
}

// Which side is seen is a matter of the triangle, not of the normal at a fragment.
TEST(Shading, NormalsAreTurnedByFacing) {
  // It leans away from the eye, as it does on a silhouette, and is lit from behind.
  const Vector away{std::sqrt(0.75), 0, 0.5};
  const Vector from_front{-std::sqrt(0.75), 0, -0.5};
  Scene front = triangle(8, 8, 8, {away, away, away});
  Scene back = front;
  std::swap(back.meshes[0].triangles[0][1], back.meshes[0].triangles[0][2]);
  for (const Shading shading : {Shading::gouraud, Shading::phong}) {
    const auto lit = [&](const Scene& scene, const Vector& towards, FrontFace rule) {
      PipelineOptions o = options(shading, towards, matte);
      o.front_face = rule;
      return colour_at(scene, o, 3, 9)[0];
    };
    constexpr FrontFace ccw = FrontFace::counter_clockwise, cw = FrontFace::clockwise;
    EXPECT_NEAR(lit(front, away, ccw), 0.9, rounded);
    EXPECT_NEAR(lit(front, from_front, ccw), 0.15, rounded);
    EXPECT_NEAR(lit(back, away, ccw), 0.15, rounded);
    EXPECT_NEAR(lit(back, from_front, ccw), 0.9, rounded);
    EXPECT_NEAR(lit(front, away, cw), 0.15, rounded);
    EXPECT_NEAR(lit(back, away, cw), 0.9, rounded);
  }
}

TEST(Shading, FlatShowsTheFaceThatIsSeen) {
  // Normals of the mesh do not matter, nor which way the corners run.
  Scene scene = triangle(8, 8, 8, {at_90, at_90, at_90});
  for (int turned = 0; turned < 2; ++turned) {
    for (const FrontFace rule : {FrontFace::counter_clockwise, FrontFace::clockwise}) {
      PipelineOptions o = options(Shading::flat, at_60, matte);
      o.front_face = rule;
      EXPECT_NEAR(colour_at(scene, o, 3, 9)[0], 0.525, rounded);
    }
    std::swap(scene.meshes[0].triangles[0][1], scene.meshes[0].triangles[0][2]);
  }
}

/// The textbooks' formulas on the ray of a pixel, in long double.
struct Oracle {
  using Long3 = std::array<long double, 3>;
  std::array<Long3, 3> corners{}, normals{};  ///< normals of unit length, of the side that is seen
  Long3 light{};
  Material material;

  static Long3 minus(const Long3& a, const Long3& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }
  static long double dot(const Long3& a, const Long3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }
  static Long3 cross(const Long3& a, const Long3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Long3 unit(const Long3& a) {
    const long double length = std::sqrt(dot(a, a));
    return {a[0] / length, a[1] / length, a[2] / length};
  }
  static Long3 mixed(const std::array<Long3, 3>& of, const Long3& weights) {
    Long3 sum{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < 3; ++i) sum[i] += weights[k] * of[k][i];
    return sum;
  }

  [[nodiscard]] long double lit(const Long3& point, const Long3& n) const {
    const Long3 N = unit(n), L = unit(light), V = unit(minus({0, 0, 0}, point));
    const long double cosine = dot(N, L);
    if (cosine <= 0) return material.ambient;
    Long3 halfway, mirrored;
    for (std::size_t i = 0; i < 3; ++i) {
      halfway[i] = (L[i] + V[i]) / 2;
      mirrored[i] = 2 * cosine * N[i] - L[i];
    }
    const long double highlight =
        material.highlight == SpecularModel::blinn ? dot(N, unit(halfway)) : dot(mirrored, V);
    return material.ambient + material.diffuse * cosine +
           material.specular *
               std::pow(std::max(0.0L, highlight), static_cast<long double>(material.shininess));
  }

  [[nodiscard]] long double at(std::size_t x, std::size_t y, Shading shading) const {
    const Long3 plane = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
    const Long3 ray{(static_cast<long double>(x) + 0.5L) / 8,
                    (static_cast<long double>(y) + 0.5L) / 8, 1};
    const long double depth = dot(plane, corners[0]) / dot(plane, ray);
    const Long3 point{ray[0] * depth, ray[1] * depth, depth};
    Long3 weights{};  // areas in the world
    for (std::size_t k = 0; k < 3; ++k)
      weights[k] =
          dot(cross(minus(corners[(k + 1) % 3], point), minus(corners[(k + 2) % 3], point)),
              plane) /
          dot(plane, plane);
    if (shading == Shading::phong) return lit(point, mixed(normals, weights));
    if (shading == Shading::gouraud) {
      long double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += weights[k] * lit(corners[k], normals[k]);
      return sum;
    }
    return lit(mixed(corners, {1.0L / 3, 1.0L / 3, 1.0L / 3}),
               dot(plane, corners[0]) < 0 ? plane : minus({0, 0, 0}, plane));
  }
};

TEST(Shading, AgreesWithTheFormulasInLongDouble) {
  const std::vector<Vector> normals{{0.6, 0, -0.8}, {0, 0.6, -0.8}, {-0.36, 0.48, -0.8}};
  const Scene scene = triangle(8, 16, 4, normals);
  const Vector light{-0.3, 0.2, -1};
  for (const SpecularModel highlight : {SpecularModel::blinn, SpecularModel::phong}) {
    const Material material{
        .ambient = 0.05, .diffuse = 0.4, .specular = 0.5, .shininess = 40, .highlight = highlight};
    Oracle oracle;
    oracle.material = material;
    oracle.light = {light[0], light[1], light[2]};
    for (std::size_t k = 0; k < 3; ++k) {
      const MeshPoint& p = scene.meshes[0].vertices[k];
      oracle.corners[k] = {p.x, p.y, p.z};
      oracle.normals[k] = {normals[k][0], normals[k][1], normals[k][2]};
    }
    for (const Shading shading : areas) {
      for (const ScanConversion scan : {ScanConversion::edge_function, ScanConversion::scan_line}) {
        PipelineOptions o = options(shading, light, material);
        o.scan = scan;
        const PipelineFrame frame = render_frame(scene, camera(), o, true);
        int covered = 0;
        double least = 1, greatest = 0;
        for (std::size_t i = 0; i < frame.id.size(); ++i) {
          if (frame.id[i] == no_surface) continue;
          ++covered;
          const double value = frame.picture.pixels[i][0];
          least = std::min(least, value);
          greatest = std::max(greatest, value);
          ASSERT_NEAR(value, static_cast<double>(oracle.at(i % size, i / size, shading)), rounded)
              << i % size << ", " << i / size;
        }
        EXPECT_EQ(covered, 120);
        if (shading != Shading::flat) {
          EXPECT_GT(greatest - least, 0.1);  // there is something to agree about
        }
      }
    }
  }
}

/// A fan about (8, 8), of eight triangles on a shallow pyramid, whose file has no normals.
Scene pyramid() {
  Scene scene = scene_of({seen_at(8, 8, 6)}, {});
  constexpr std::array<std::array<double, 2>, 8> ring{
      {{15, 8}, {13, 2.75}, {8, 1}, {3, 2.75}, {1, 8}, {3, 13.5}, {8, 15}, {13, 13.5}}};
  for (std::uint32_t k = 0; k < 8; ++k) {
    scene.meshes[0].vertices.push_back(seen_at(ring[k][0], ring[k][1], 8));
    scene.meshes[0].triangles.push_back({0, k + 1, (k + 1) % 8 + 1});  // counter-clockwise
  }
  scene.meshes[0].face_count = 8;
  return scene;
}

void expect_same(const ColourImage& a, const ColourImage& b, double tolerance, bool mirrored) {
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  for (std::size_t y = 0; y < size; ++y) {
    for (std::size_t x = 0; x < size; ++x) {
      const std::size_t other = mirrored ? size - 1 - x : x;
      ASSERT_NEAR(a.pixels[y * size + x][0], b.pixels[y * size + other][0], tolerance)
          << x << ", " << y;
    }
  }
}

/// A cube whose normals are those of its corners, seen from a corner but one.
PipelineFrame cube(Shading shading) {
  Scene scene;
  std::vector<MeshPoint> corners;
  for (const double z : {-1, 1})
    for (const double y : {-1, 1})
      for (const double x : {-1, 1}) corners.push_back({x, y, z});
  scene = scene_of(corners, {{0, 2, 3},
                             {0, 3, 1},
                             {4, 5, 7},
                             {4, 7, 6},
                             {0, 1, 5},
                             {0, 5, 4},
                             {2, 6, 7},
                             {2, 7, 3},
                             {0, 4, 6},
                             {0, 6, 2},
                             {1, 3, 7},
                             {1, 7, 5}});
  const Camera framing = frame_scene(scene, {}, {.width = 192, .height = 144});
  PipelineOptions o;
  o.shading = shading;
  o.material = matte;
  return render_frame(scene, framing, o, true);
}

// Its edges are as smooth as its faces. From corner to corner a normal turns by 2/√3 over its least
// length on the way, 1/√3: two radians over a face, which is some 70 pixels wide, and 20 where it
// is most foreshortened. So two pixels side by side differ by at most 0.75·2/20. A normal that is
// turned at a fragment makes up to 0.75 of difference.
TEST(Shading, ThereAreNoBordersWhereNormalsAreShared) {
  for (const Shading shading : {Shading::gouraud, Shading::phong}) {
    const PipelineFrame frame = cube(shading);
    double greatest = 0, darkest = 1, brightest = 0;
    const auto compare = [&](std::size_t i, std::size_t j) {
      if (frame.id[i] == no_surface || frame.id[j] == no_surface) return;
      const double a = frame.picture.pixels[i][0], b = frame.picture.pixels[j][0];
      greatest = std::max(greatest, std::abs(a - b));
      darkest = std::min(darkest, a);
      brightest = std::max(brightest, a);
    };
    for (std::size_t y = 0; y + 1 < 144; ++y) {
      for (std::size_t x = 0; x + 1 < 192; ++x) {
        compare(y * 192 + x, y * 192 + x + 1);
        compare(y * 192 + x, y * 192 + 192 + x);
      }
    }
    EXPECT_LT(greatest, 0.75 * 2 / 20);
    EXPECT_LT(darkest, 0.3);
    EXPECT_GT(brightest, 0.7);
  }
}

TEST(Shading, TheOrderOfCornersAndTheFrontFaceTurnedTogetherChangeNothing) {
  Scene clockwise = pyramid();
  for (CornerIndices& t : clockwise.meshes[0].triangles) std::swap(t[1], t[2]);
  for (const Shading shading : areas) {
    PipelineOptions o = options(shading, {-1, -1, -1}, {});
    const ColourImage picture = render_frame(pyramid(), camera(), o, true).picture;
    o.front_face = FrontFace::clockwise;
    expect_same(picture, render_frame(clockwise, camera(), o, true).picture, rounded, false);
    // Without normals in the file, the option alone changes nothing either.
    expect_same(picture, render_frame(pyramid(), camera(), o, true).picture, rounded, false);
  }
}

TEST(Shading, AMirroredCameraShowsTheMirrorImage) {
  Camera mirrored = camera();
  mirrored.projection.fx = -8;
  mirrored.projection.cx = size;
  for (const Shading shading : areas) {
    const PipelineOptions o = options(shading, {-1, -1, -1}, {});
    expect_same(render_frame(pyramid(), camera(), o, true).picture,
                render_frame(pyramid(), mirrored, o, true).picture, rounded, true);
  }
}

// Placed by a matrix that stretches, shears and mirrors: the normals in the file, those of the flat
// faces, are those of the placed faces still.
TEST(Shading, NormalsGoThroughTheInverseTranspose) {
  for (const int sign : {1, -1}) {
    Scene scene = scene_of({{0, 2, 8}, {3, 2, 10}, {0, -1, 8}}, {{0, 1, 2}});
    scene.meshes[0].normals.assign(3, {2, 0, -3});  // (3, 0, 2) × (0, −3, 0) = (6, 0, −9)
    // Mirrored at the plane y = 1.
    scene.objects[0].placed_as_is = false;
    auto& rows = scene.objects[0].world_from_mesh.rows;
    rows[0][0] = Dyadic(2), rows[0][1] = Dyadic(1);
    rows[1][1] = Dyadic(sign), rows[1][3] = Dyadic(sign < 0 ? 2 : 0);
    for (const Vector& light : {straight, at_60, Vector{-3, 1, -1}}) {
      const PipelineFrame flat =
          render_frame(scene, camera(), options(Shading::flat, light, matte), true);
      EXPECT_GT(std::count_if(flat.id.begin(), flat.id.end(),
                              [](std::uint32_t id) { return id != no_surface; }),
                5);
      for (const Shading shading : {Shading::gouraud, Shading::phong})
        expect_same(flat.picture,
                    render_frame(scene, camera(), options(shading, light, matte), true).picture,
                    rounded, false);
    }
  }
}

// No product or sum on the way is greater than a number can be.
TEST(Shading, NormalsMayBeAsLongAsANumberCanBe) {
  Object object;
  object.placed_as_is = false;
  object.world_from_mesh.rows[0][1] = Dyadic(1);  // a turn, and larger
  object.world_from_mesh.rows[1][0] = Dyadic(-1);
  PipelineOptions o;
  o.depth_format.near = 1;
  o.depth_format.far = 2;
  const VertexTransform<double> transform(camera(), object, o);
  const auto vertex = transform({.position = {0, 0, 1}, .normal = {1.5e308, 1.5e308, 0}});
  EXPECT_NEAR(vertex.attributes[attribute::normal], 1, 1e-15);
  EXPECT_NEAR(vertex.attributes[attribute::normal + 1], 0, 1e-15);
}

// What is cut off must not change the light of what is left: a face is lit as a whole, and
// Gouraud's light is that of the mesh's corners.
TEST(Shading, ClippingChangesNoColour) {
  const Scene scene = triangle(2, 16, 4, {{0.6, 0, -0.8}, {0, 0.6, -0.8}, {-0.36, 0.48, -0.8}});
  const Material glossy{.ambient = 0.05, .diffuse = 0.4, .specular = 0.5, .shininess = 10};
  for (const Shading shading : areas) {
    const PipelineOptions o = options(shading, {-0.3, 0.2, -1}, glossy);
    Camera cutting = camera();
    cutting.near = 3.5;
    const PipelineFrame whole = render_frame(scene, camera(), o, true);
    const PipelineFrame cut = render_frame(scene, cutting, o, true);
    EXPECT_EQ(cut.statistics.clipped, 1U);
    int compared = 0;
    for (std::size_t i = 0; i < cut.id.size(); ++i) {
      if (cut.id[i] == no_surface) continue;
      ++compared;
      // The corners of the cut are snapped to 1/256 of a pixel; in a pixel, the light changes by
      // less than 0.1.
      EXPECT_NEAR(cut.picture.pixels[i][0], whole.picture.pixels[i][0],
                  shading == Shading::flat ? 0 : 0.1 / 256);
    }
    EXPECT_GT(compared, 40);
  }
}

TEST(Lighting, OfACamera) {
  Camera camera = checks::camera_of(8, 8, 4);
  camera.world_to_camera[2][3] = 3;  // the eye at z = −3
  const Lighting lighting = lighting_of(camera, {});
  EXPECT_FALSE(lighting.orthographic);
  EXPECT_FALSE(lighting.mirrored);
  EXPECT_NEAR(lighting.eye[2], -3, 1e-12);
  const auto& L = lighting.towards_light;
  EXPECT_NEAR(std::hypot(L[0], L[1], L[2]), 1, 1e-15);
  EXPECT_LT(L[2], 0);  // from the camera's side
  EXPECT_LT(L[1], 0);  // above: y points down
  EXPECT_LT(L[0], 0);  // left
}

TEST(Lighting, TurnsWithTheCameraUnlessItIsInTheWorld) {
  Camera camera = checks::camera_of(8, 8, 4);
  camera.world_to_camera = {{{0, 0, -1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}}};  // looks along x
  PipelineOptions o;
  o.light = {.towards = {0, 0, -2}};
  EXPECT_EQ(lighting_of(camera, o).towards_light, (Vector{-1, 0, 0}));
  o.light.in_world = true;
  EXPECT_EQ(lighting_of(camera, o).towards_light, (Vector{0, 0, -1}));
}

}  // namespace
}  // namespace fathom::pipeline
