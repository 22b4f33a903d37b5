// Drawings of scenes that can be drawn by hand, and their files.
#include "fathom/drawing/drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "fathom/failures/errors.h"
#include "tests/inputs/scene_building.h"

namespace fathom {
namespace {

using ::testing::HasSubstr;

/// Leaves x, y and z as u, v and depth.
Camera plain_camera(std::uint32_t width, std::uint32_t height) {
  Camera camera = checks::camera_of(width, height, 1);
  camera.projection.model = ProjectionModel::orthographic;
  camera.projection.cx = camera.projection.cy = 0;
  return camera;
}

/// A rectangle of two triangles at a depth.
Mesh rectangle(double left, double top, double right, double bottom, double z) {
  Mesh mesh;
  mesh.vertices = {{left, top, z}, {right, top, z}, {right, bottom, z}, {left, bottom, z}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.face_count = 2;
  return mesh;
}

/// A small square in front of a wide one, whose top edge it hides between 4 and 6:
///
///        4──6
///     1──│  │──9  2
///     │  └──┘  │
///     └────────┘  8
Scene two_squares() {
  Scene scene;
  scene.meshes = {rectangle(1, 2, 9, 8, 5), rectangle(4, 1, 6, 3, 4)};
  scene.objects = {{.mesh = 0, .name = "back"}, {.mesh = 1, .name = "front <&>"}};
  return scene;
}

using Lines = std::set<std::pair<DrawnPoint, DrawnPoint>>;

Lines lines_of(const DrawingLayer& layer) {
  Lines lines;
  for (const DrawnPath& path : layer.paths) {
    for (std::size_t k = 1; k < path.size(); ++k) lines.insert(std::minmax(path[k - 1], path[k]));
  }
  return lines;
}

TEST(Drawing, HasTheVisibleEdgesOfEachObject) {
  const Drawing drawing = draw(two_squares(), plain_camera(10, 10), {});
  ASSERT_EQ(drawing.layers.size(), 2U);
  EXPECT_EQ(drawing.layers[0].name, "back");
  const Lines back{
      {{1, 2}, {4, 2}}, {{6, 2}, {9, 2}}, {{1, 2}, {1, 8}}, {{9, 2}, {9, 8}}, {{1, 8}, {9, 8}}};
  const Lines front{{{4, 1}, {6, 1}}, {{4, 1}, {4, 3}}, {{6, 1}, {6, 3}}, {{4, 3}, {6, 3}}};
  EXPECT_EQ(lines_of(drawing.layers[0]), back);
  EXPECT_EQ(lines_of(drawing.layers[1]), front);
  EXPECT_EQ(drawing.layers[0].paths.size(), 1U);
  EXPECT_EQ(drawing.layers[1].paths.size(), 1U);
}

TEST(Drawing, ShowsEdgesWithinAPlaneWhereAllAreWanted) {
  const Drawing drawing = draw(two_squares(), plain_camera(10, 10), {.edges = EdgeSelection::all});
  // The diagonal from (1, 2) to (9, 8) passes (6, 5.75): below the front square.
  EXPECT_TRUE(lines_of(drawing.layers[0]).contains({{1, 2}, {9, 8}}) ||
              lines_of(drawing.layers[0]).contains({{1, 2}, {4, 4.25}}));
  EXPECT_TRUE(lines_of(drawing.layers[1]).contains({{4, 1}, {6, 3}}));
}

TEST(Drawing, EndsAtTheFrame) {
  const Drawing drawing = draw(two_squares(), plain_camera(5, 10), {});
  EXPECT_TRUE(lines_of(drawing.layers[0]).contains({{1, 8}, {5, 8}}));
  EXPECT_TRUE(lines_of(drawing.layers[1]).contains({{4, 1}, {5, 1}}));
}

TEST(Drawing, CreasesTurnByTheAngle) {
  const Scene box = checks::box_scene(1, 1, 1);
  Camera camera = checks::camera_of(40, 40, 40);
  // The box is turned so that an edge is in front; its sides turn by 90 degrees there.
  camera.world_to_camera = {{{1, 0, 1, 0}, {0, 1, 0, 0}, {-1, 0, 1, 5}}};
  const auto count = [&](double angle) {
    return lines_of(draw(box, camera, {.crease_angle = angle}).layers[0]).size();
  };
  EXPECT_EQ(count(90), count(30));
  EXPECT_LT(count(std::nextafter(90, 180)), count(90));
  EXPECT_THROW(count(-1), UsageError);
  EXPECT_THROW(count(std::numeric_limits<double>::quiet_NaN()), UsageError);
}

TEST(Drawing, IsWrittenAsSvg) {
  const std::string svg = svg_of(draw(two_squares(), plain_camera(10, 10), {}), {.stroke = 0.25});
  EXPECT_THAT(svg, HasSubstr("viewBox=\"0 0 10 10\""));
  EXPECT_THAT(svg, HasSubstr("stroke-width=\"0.25\""));
  EXPECT_THAT(svg, HasSubstr("<g id=\"object-1\""));
  EXPECT_THAT(svg, HasSubstr("<title>front &lt;&amp;&gt;</title>"));
  const Drawing one{4, 3, {{"a", {{{0.5F, 1e-7F}, {2, 3}}}}}};
  EXPECT_THAT(svg_of(one), HasSubstr("<path d=\"M0.5 0.0000001 2 3\"/>"));
}

/// The text between two others.
std::string between(const std::string& text, const std::string& before, const std::string& after) {
  const std::size_t from = text.find(before) + before.size();
  return text.substr(from, text.find(after, from) - from);
}

TEST(Drawing, IsWrittenAsPdf) {
  const Drawing drawing{8, 4, {{"ä", {{{0, 0.5F}, {2, 3}}}}, {"\xF0\x9F\x98\x80", {}}}};
  const std::string pdf = pdf_of(drawing, {.stroke = 2});
  EXPECT_TRUE(pdf.starts_with("%PDF-1.5\n"));
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [0 0 6 3 ]"));
  EXPECT_THAT(pdf,
              HasSubstr("q 0.75 0 0 -0.75 0 3 cm 1 J 1 j 2 w\n/OC /L0 BDC\n0 0.5 m 2 3 l S\n"));
  EXPECT_THAT(pdf, HasSubstr("/Name <FEFF00E4>"));
  EXPECT_THAT(pdf, HasSubstr("/Name <FEFFD83DDE00>"));
  // The index holds the place of each object.
  const std::size_t index = std::stoul(between(pdf, "startxref\n", "\n"));
  EXPECT_EQ(pdf.substr(index, 9), "xref\n0 7\n");
  for (std::size_t object = 1; object <= 6; ++object) {
    const std::size_t entry = index + 9 + 20 * object;
    const std::size_t place = std::stoul(pdf.substr(entry, 10));
    EXPECT_EQ(pdf.substr(place, 7), std::to_string(object) + " 0 obj");
  }
  const std::size_t length = std::stoul(between(pdf, "/Length ", " "));
  EXPECT_EQ(between(pdf, "stream\n", "\nendstream").size(), length);
}

TEST(Drawing, OfALargeImageFitsAPage) {
  EXPECT_THAT(pdf_of({28800, 14400, {}}), HasSubstr("/MediaBox [0 0 14400 7200 ]"));
}

TEST(Drawing, RefusesLensesAndStrokes) {
  Camera camera = plain_camera(10, 10);
  EXPECT_THROW(svg_of(draw(two_squares(), camera, {}), {.stroke = 0}), UsageError);
  EXPECT_THROW(pdf_of({}, {.stroke = std::numeric_limits<double>::infinity()}), UsageError);
}

}  // namespace
}  // namespace fathom
