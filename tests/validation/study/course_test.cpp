// The figures of the study `course` against what can be known about them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "apps/study/antialiasing/curve.h"
#include "apps/study/antialiasing/sampling.h"
#include "apps/study/course/demo.h"
#include "apps/study/course/demonstrations.h"
#include "apps/study/course/exercises.h"
#include "apps/study/course/gallery.h"
#include "apps/study/course/orientation.h"
#include "apps/study/course/shared_edges.h"
#include "apps/study/pipeline_scenes.h"
#include "fathom/pipeline/geometry/back_face_culling.h"
#include "fathom/pipeline/geometry/primitive_assembly.h"
#include "fathom/pipeline/geometry/subpixel_grid.h"
#include "fathom/pipeline/render_pipeline.h"
#include "fathom/pipeline/scan/arithmetic.h"
#include "fathom/pipeline/scan/line.h"
#include "fathom/render.h"
#include "fathom/scene/motion.h"

namespace fathom::studies {
namespace {

constexpr Rgb white{255, 255, 255};

std::size_t different_pixels(const RgbImage& a, const RgbImage& b) {
  if (a.width != b.width || a.height != b.height) return a.pixels.size() + 1;
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i];
  return count;
}

// What the scan converter by itself gives; later lines are hidden at the middle.
TEST(Course, EightLinesAreThoseOfTheScanConverterByEveryAlgorithm) {
  using enum pipeline::WireLine;
  const RgbImage picture = eight_lines(bresenham);
  RgbImage lines(65, 65, white);
  for (int k = 7; k >= 0; --k) {
    const double angle = k * std::numbers::pi / 4;
    const auto share = static_cast<float>(k) / 8;
    const auto byte = [](float x) { return static_cast<std::uint8_t>(std::lround(255 * x)); };
    pipeline::bresenham_line(
        {32, 32, 32 + std::lround(30 * std::cos(angle)), 32 - std::lround(30 * std::sin(angle))},
        {0, 0, 65, 65}, [&](const pipeline::Pixel& p, std::int64_t) {
          lines.at(static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y)) = {
              byte(share), 0, byte(1 - share)};
        });
  }
  EXPECT_EQ(different_pixels(picture, lines), 0u);
  for (const auto algorithm : {explicit_equation, dda, midpoint})
    EXPECT_EQ(different_pixels(eight_lines(algorithm), picture), 0u);
}

TEST(Course, EdgeFunctionsArePositiveWhereThePipelineDraws) {
  const RgbImage signs = edge_function_signs();
  pipeline::PipelineOptions options = precise_options();
  const auto id =
      render_frame(scene_of({{50, 20, 0.5}, {200, 150, 0.5}, {30, 180, 0.5}}, {{0, 1, 2}}),
                   window_camera(256, 256), options, false)
          .id;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < id.size(); ++i) {
    const bool positive = std::ranges::all_of(signs.pixels[i], [](int c) { return c == 230; });
    EXPECT_EQ(positive, id[i] != no_surface) << i;
    inside += positive;
  }
  EXPECT_NEAR(static_cast<double>(inside), 26600 / 2.0, 100);
}

TEST(Course, EdgeFunctionsAreTheTextbooksWithTheOtherSign) {
  const auto values = edge_function_values();
  const double corners[3][2] = {{50, 20}, {200, 150}, {30, 180}};
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_EQ(values[k].size(), 65536u);
    const double *a = corners[(k + 1) % 3], *b = corners[(k + 2) % 3];
    for (std::size_t i = 0; i < values[k].size(); ++i) {
      const double x = static_cast<double>(i % 256) + 0.5, y = static_cast<double>(i / 256) + 0.5;
      EXPECT_EQ(values[k][i], -((x - a[0]) * (b[1] - a[1]) - (y - a[1]) * (b[0] - a[0])));
    }
  }
}

TEST(Course, TablesAreThoseOfTheSource) {
  const Tables t = z_buffer_tables();
  const std::vector<std::string> depths{"1 1 1 1 1 0.5 1 1 1 1 1 1",
                                        "1 1 1 1 1 0.5 1 1 1 1 1 0.95",
                                        "1 1 1 1 0.5 0.5 0.5 1 0.65 0.75 0.85 0.95",
                                        "1 1 1 1 0.5 0.5 0.45 0.5 0.65 0.75 0.85 0.95",
                                        "1 1 1 0.5 0.25 0.35 0.45 0.5 0.65 0.75 0.85 0.95",
                                        "1 1 1 0.5 0.5 0.5 0.45 0.5 0.5 0.75 0.85 0.95",
                                        "1 1 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.75 0.85 0.95",
                                        "1 1 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.85 0.95",
                                        "1 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.5 0.95"};
  EXPECT_EQ(t.black_then_grey.depths, depths);
  EXPECT_EQ(t.grey_then_black.depths, depths);
  EXPECT_EQ(t.grey_then_black.colours, t.black_then_grey.colours);
  const std::vector<std::string> colours{
      "W W W W W B W W W W W W", "W W W W W B W W W W W G", "W W W W B B B W G G G G",
      "W W W W B B G B G G G G", "W W W B G G G B G G G G", "W W W B B B G B B G G G",
      "W W B B B B B B B G G G", "W W B B B B B B B B G G", "W B B B B B B B B B B G"};
  EXPECT_EQ(t.black_then_grey.colours, colours);
  // Before the grey one: depth 0.5 where it is black, as the source's rows but for E31.
  const std::vector<std::string> black{
      "W W W W W B W W W W W W", "W W W W W B W W W W W W", "W W W W B B B W W W W W",
      "W W W W B B B B W W W W", "W W W B B B B B W W W W", "W W W B B B B B B W W W",
      "W W B B B B B B B W W W", "W W B B B B B B B B W W", "W B B B B B B B B B B W"};
  EXPECT_EQ(t.black.colours, black);
  for (std::size_t y = 0; y < black.size(); ++y) {
    std::string half;
    for (const char c : black[y]) half += c == 'B' ? "0.5" : c == 'W' ? "1" : " ";
    EXPECT_EQ(t.black.depths[y], half);
  }
}

TEST(Course, DemoCountsAddUp) {
  const Demo d = demo();
  EXPECT_EQ(d.near_fragments + d.far_fragments, d.union_of_both + d.overlap);
  EXPECT_EQ(d.passed_far_first, d.near_fragments + d.far_fragments);
  EXPECT_EQ(d.passed_near_first, d.union_of_both);
  // By both rules, as a program of ten lines counts them. 140 centres lie on the far triangle's two
  // edges that are neither left nor top, none on its left one (areas: 13950 and 16900).
  EXPECT_EQ(d.near_fragments, 13955u);
  EXPECT_EQ(d.far_fragments, 16830u);
  EXPECT_EQ(d.near_closed, 13955u);
  EXPECT_EQ(d.far_closed, 16970u);
  // What the textbook's program prints.
  EXPECT_EQ(d.near_closed + d.far_closed, 30925u);
  EXPECT_EQ(d.union_closed, 26933u);
}

// The page says so: its picture is the pipeline's, and so are its numbers.
TEST(Course, ThePictureOfTheTablesIsTheirColours) {
  const RgbImage picture = z_buffer_picture();
  const Tables t = z_buffer_tables();
  for (std::uint32_t y = 0; y < 9; ++y) {
    for (std::uint32_t x = 0; x < 12; ++x) {
      const char colour = t.black_then_grey.colours[y][2 * x];
      const int grey = colour == 'W' ? 255 : colour == 'G' ? 128 : 0;
      EXPECT_EQ(picture.at(x, y)[0], grey) << x << " " << y;
    }
  }
}

// The share of a pixel's samples, asked one by one, against what the pipeline resolves.
TEST(Course, PicturesOfAnEdgeAreTheShareOfCoveredSamples) {
  const PartialPixels p = partial_pixels();
  EXPECT_EQ(p.counted, (std::array<std::size_t, 4>{0, 20, 45, 58}));
  EXPECT_EQ(p.exact, 83u);
  const SceneView view = half_plane_files().view;
  std::array<pipeline::GridPoint, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const MeshPoint& corner = view.scene.meshes[0].vertices[k];
    corners[k] = pipeline::snap(corner.x, corner.y, 16);
  }
  const auto triangle = pipeline::GridTriangle::of(corners);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto pattern = pipeline::GridSamples::of(sample_pattern(std::to_string(1 << i)));
    for (std::uint32_t y = 0; y < 64; ++y) {
      for (std::uint32_t x = 0; x < 64; ++x) {
        int covered = 0;
        for (std::size_t k = 0; k < pattern.size(); ++k) {
          const pipeline::GridPoint d = pattern.at({x, y}, k);
          covered += triangle->covers(pipeline::sample_of({x, y}, d.x, d.y));
        }
        ASSERT_EQ(p.pictures[i].at(x, y)[0], std::lround(255.0 * covered / (1 << i)))
            << x << " " << y << " " << (1 << i);
      }
    }
  }
  // Channel A of the command that the page names.
  const DepthMap map = render(view.scene, view.camera, {.channels = {Channel::A}}).map;
  const auto& area = *map.values<float>("A");
  for (std::size_t k = 0; k < area.size(); ++k)
    ASSERT_EQ(p.exact_picture.pixels[k][0], std::lround(255 * static_cast<double>(area[k])));
}

// The page names the edge: a pixel is cut where corners of it lie on both sides, by the signs of
// integers, in tenths.
TEST(Course, TheEdgeOfExercise6CutsItsPixels) {
  const auto side = [](std::int64_t x, std::int64_t y) {
    return (1402 + 1003) * (10 * y + 107) - (614 + 107) * (10 * x + 1003);
  };
  std::size_t cut = 0;
  for (std::int64_t y = 0; y < 64; ++y) {
    for (std::int64_t x = 0; x < 64; ++x) {
      const auto [least, greatest] =
          std::minmax({side(x, y), side(x + 1, y), side(x, y + 1), side(x + 1, y + 1)});
      cut += least < 0 && greatest > 0;
    }
  }
  EXPECT_EQ(cut, partial_pixels().exact);
}

TEST(Course, MoreSamplesFindMoreOfTheCutPixels) {
  const PartialPixels p = partial_pixels();
  EXPECT_EQ(p.counted[0], 0u);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_GT(p.counted[i], p.counted[i - 1]);
    EXPECT_LT(p.mean_error[i], p.mean_error[i - 1]);
  }
  EXPECT_LE(p.counted[3], p.exact);
}

TEST(Course, AffineTextureCoordinatesAreWrongAndPerspectiveOnesAreNot) {
  const Checkerboard affine = checkerboard(pipeline::Interpolation::affine);
  const Checkerboard perspective = checkerboard(pipeline::Interpolation::perspective);
  EXPECT_GT(affine.greatest_error, 0.1);
  // Colours are kept in binary32, the exact weights too; corners are snapped to 2^-16 of a pixel,
  // which far away is a depth of some 10^-3.
  EXPECT_LT(perspective.greatest_error, 2e-3);
}

TEST(Course, SixteenBitsFightAndFartherSurfacesFightMore) {
  EXPECT_LT(fight(0.5, Storage::float32).wrong_share, 0.01);
  EXPECT_GT(fight(10, Storage::unorm16).wrong_share, 0.2);
  // "A buffer of unorm32 is no better."
  for (const double distance : {0.5, 2.0, 10.0, 50.0})
    EXPECT_EQ(fight(distance, Storage::unorm32).wrong_share,
              fight(distance, Storage::float32).wrong_share);
  EXPECT_NEAR(steps_of_unorm16(), 6.55, 0.005);
}

TEST(Course, TheTiltOfFightsIsThatOfTheirCorners) {
  for (const double d : {0.5, 50.0}) {
    const MeshArray<MeshPoint> v = fight_files(d).view.scene.meshes[0].vertices;
    ASSERT_EQ(v.size(), 8u);
    for (std::size_t k = 0; k < 4; ++k)  // as the page says
      EXPECT_NEAR(v[k].z, 1.2 * d + 0.3 * v[k].x + 0.3 * v[k].y, 1e-12 * d);
  }
  // Its normal, (0.3, 0.3, −1), against the view's direction.
  EXPECT_NEAR(std::cos(tilt_of_fight() * std::numbers::pi / 180), 1 / std::sqrt(1.18), 1e-12);
  EXPECT_NEAR(tilt_of_fight(), 23.0, 0.05);
}

// Red where the surface behind wins, white where the one in front does, and nothing else.
TEST(Course, PicturesOfFightsShowTheirShare) {
  const Fight f = fight(10, Storage::float32);
  std::size_t red = 0, front = 0;
  for (const Rgb& pixel : f.picture.pixels) {
    // 0.1 lies halfway between two codes: interpolation rounds it either way.
    const bool is_red = pixel[0] == 204 && pixel[1] + 1 >= 26 && pixel[1] <= 26;
    red += is_red;
    front += pixel == white;
    EXPECT_TRUE(is_red || pixel == white || pixel == Rgb{});
  }
  EXPECT_EQ(static_cast<double>(red) / static_cast<double>(red + front), f.wrong_share);
}

TEST(Course, BallsShowWhatGeometrySays) {
  for (const FacingCount& f : count_facings()) {
    EXPECT_EQ(f.triangles, 2u * 180 * 89);
    // Triangles are of equal area but for the curvature of one of them; the outline passes through
    // some 200 of them.
    const auto n = static_cast<double>(f.triangles);
    EXPECT_NEAR(static_cast<double>(f.front_in_window) / n, f.seen_share, 0.01) << f.distance;
    EXPECT_EQ(f.disagreeing, 0u);  // the page says so
  }
}

/// N·V of a triangle, V from its first corner to the eye at the origin.
pipeline::Exact facing_exactly(const std::array<MeshPoint, 3>& t) {
  using pipeline::Exact;
  std::array<std::array<Exact, 3>, 3> p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = {Exact(t[k].x), Exact(t[k].y), Exact(t[k].z)};
  Exact sum(0);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Exact N =
        (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) - (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
    sum -= N * p[0][i];
  }
  return sum;
}

// Signs of rational numbers, the world's test and snapping, each by itself.
TEST(Course, EdgeOnTrianglesAreJudgedExactly) {
  const SceneView view = edge_on_files().view;
  const Mesh& mesh = view.scene.meshes.at(0);
  std::uint64_t front = 0, wrong_in_world = 0, turned = 0;
  for (const CornerIndices& t : mesh.triangles) {
    std::array<MeshPoint, 3> corners;
    std::array<pipeline::WorldVertex<float>, 3> in_binary32;
    std::array<pipeline::GridPoint, 3> snapped;
    for (std::size_t k = 0; k < 3; ++k) {
      const MeshPoint& p = corners[k] = mesh.vertices[t[k]];
      in_binary32[k] = {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
      EXPECT_EQ(static_cast<double>(in_binary32[k].x), p.x);
      EXPECT_EQ(static_cast<double>(in_binary32[k].y), p.y);
      EXPECT_EQ(static_cast<double>(in_binary32[k].z), p.z);
      snapped[k] = pipeline::snap(160 * p.x / p.z + 80, 160 * p.y / p.z + 60, 8);
    }
    const pipeline::Exact facing = facing_exactly(corners);
    EXPECT_NE(facing, pipeline::Exact(0));
    const bool is_front = facing > pipeline::Exact(0);
    front += is_front;
    wrong_in_world += is_front != (facing_in_world(in_binary32, {0, 0, 0}, true, false,
                                                   pipeline::FrontFace::counter_clockwise) ==
                                   pipeline::Facing::front);
    const auto on_grid = pipeline::GridTriangle::of(snapped);
    turned += !on_grid || on_grid->counter_clockwise() != is_front;
  }
  const std::vector<EdgeOnCount> counts = count_edge_on();
  ASSERT_EQ(counts.size(), 2u);
  for (const EdgeOnCount& c : counts) {
    EXPECT_EQ(c.triangles, 300u);
    EXPECT_EQ(c.front, front);
  }
  const EdgeOnCount &rough = counts[0], &fine = counts[1];
  EXPECT_EQ(rough.wrong_in_world, wrong_in_world);
  // As the page says: more errors the more was rounded before.
  EXPECT_GT(rough.wrong_in_world, 0u);
  EXPECT_GT(rough.wrong_in_ndc, rough.wrong_in_world);
  EXPECT_GT(rough.wrong_in_window, rough.wrong_in_ndc);
  EXPECT_EQ(fine.wrong_in_world + fine.wrong_in_ndc + fine.wrong_in_window, 0u);
  EXPECT_EQ(fine.front_in_window, front);
  EXPECT_EQ(fine.turned_by_snapping, turned);
  EXPECT_NEAR(static_cast<double>(turned), 150, 30);
  // The tests disagree about a triangle where one or two of them are wrong.
  EXPECT_EQ(fine.disagreeing, 0u);
  EXPECT_GE(rough.disagreeing, rough.wrong_in_window - rough.wrong_in_world);
  EXPECT_LE(rough.disagreeing, rough.wrong_in_world + rough.wrong_in_ndc + rough.wrong_in_window);
}

TEST(Course, WhatIsFrontAndWhatIsCulledChangePlaces) {
  using enum pipeline::FrontFace;
  using pipeline::Culling;
  const RgbImage outer = open_box(counter_clockwise, Culling::back);
  const RgbImage inner = open_box(counter_clockwise, Culling::front);
  EXPECT_EQ(different_pixels(open_box(clockwise, Culling::front), outer), 0u);
  EXPECT_EQ(different_pixels(open_box(clockwise, Culling::back), inner), 0u);
  EXPECT_GT(different_pixels(outer, inner), 1000u);
}

// By formulas in whole numbers, for the upright squares and those turned by 45 degrees.
TEST(Course, SquaresHaveTheValuesOfTwoStepsAndTrianglesThoseOfWeights) {
  const std::vector<TurnedSquare> squares = turned_squares();
  ASSERT_EQ(squares.size(), 3u);
  const auto expect_tenths = [](const RgbImage& picture, int x, int y, int tenths) {
    const Rgb& colour = picture.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    EXPECT_EQ(colour[0], 30 + 225 * tenths / 10) << x << " " << y;
  };
  for (int y = 0; y < 61; ++y) {
    for (int x = 0; x < 61; ++x) {
      const bool covered = x >= 10 && x < 51 && y >= 10 && y < 51;
      const bool turned_covered = std::abs(x - 30) + std::abs(y - 30) < 29;
      if (covered) {
        const int upright = 10 * (2 * x - 19) * (101 - 2 * y) / (82 * 82);
        const int triangles = 10 * std::max(0, x - y) / 41;
        expect_tenths(squares[0].square_picture, x, y, upright);
        expect_tenths(squares[0].triangles_picture, x, y, triangles);
        expect_tenths(squares[2].square_picture, 60 - y, x, upright);
        expect_tenths(squares[2].triangles_picture, 60 - y, x, triangles);
      } else {
        EXPECT_EQ(squares[0].square_picture.at(static_cast<std::uint32_t>(x),
                                               static_cast<std::uint32_t>(y)),
                  white);
      }
      if (turned_covered) {
        expect_tenths(squares[1].square_picture, x, y, 10 * (x - 1 - std::abs(y - 30)) / 58);
        expect_tenths(squares[1].triangles_picture, x, y, 10 * std::max(0, x - 30) / 29);
      }
    }
  }
}

// What the page says of the middle.
TEST(Course, OnlyTheSquareDependsOnHowItIsTurned) {
  const std::vector<TurnedSquare> squares = turned_squares();
  ASSERT_EQ(squares.size(), 3u);
  EXPECT_EQ(squares[0].square, 0.25);
  EXPECT_EQ(squares[1].square, 0.5);
  EXPECT_EQ(squares[2].square, 0.25);
  for (const TurnedSquare& square : squares) {
    EXPECT_EQ(square.by_scan_lines, 0);
    EXPECT_EQ(square.by_weights, 0);
  }
}

TEST(Course, SharedEdgesAreCoveredOnceAndFlipsExplainTheRest) {
  std::uint64_t turned = 0;
  for (int bits = 0; bits <= 16; bits += 4) {
    const SharedEdges e = count_shared_edges(bits);
    EXPECT_EQ(e.signed_not_one, 0u) << bits;
    EXPECT_EQ(e.unexplained, 0u) << bits;
    turned += e.turned_over;
  }
  EXPECT_GT(turned, 0u);
}

TEST(Course, ThePipelineDrawsTheMeshOfSharedEdges) {
  for (const int bits : {0, 2, 8}) {
    const SharedEdges counted = count_shared_edges(bits);
    const SceneView view = shared_edges_files(bits).view;
    const auto frame = render_frame(view.scene, view.camera, precise_options(), false);
    EXPECT_EQ(frame.statistics.fragments, counted.covers) << bits;
    const RgbImage picture = shared_edges_picture(bits);
    ASSERT_EQ(picture.pixels.size(), counted.samples);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      const Rgb& colour = picture.pixels[i];
      EXPECT_EQ(colour[0] > colour[2], counted.covered_by_turned[i]) << bits << " " << i;
      EXPECT_NE(colour, Rgb{}) << "not covered: " << i;
    }
  }
}

/// What a place of the wheel shows by its definition, `degrees` turned: 0 outside and between
/// spokes, 1 on a spoke, 2 on the red one; nothing where an edge is near.
std::optional<int> wheel_by_definition(double dx, double dy, double degrees) {
  const double radius = std::hypot(dx, dy), spoke = 2 * std::numbers::pi / 12;
  double angle = std::fmod(std::atan2(dy, dx) - degrees * std::numbers::pi / 180, 24 * spoke);
  if (angle < 0) angle += 24 * spoke;
  const double place = std::fmod(angle / spoke, 12);
  const double part = place - std::floor(place);
  for (const double edge : {0.1, 0.6})
    if (std::abs(part - edge) * spoke * radius < 0.05) return std::nullopt;
  // A spoke ends at a chord, from 0.1 to 0.6 of its twelfth.
  const double end = 46 * std::cos(0.25 * spoke) / std::cos((part - 0.35) * spoke);
  if (part > 0.1 && part < 0.6 && std::abs(radius - end) < 0.05) return std::nullopt;
  if (radius > end || part < 0.1 || part > 0.6) return 0;
  return place < 1 ? 2 : 1;
}

TEST(Course, TheWheelIsTurnedByItsMotion) {
  const std::vector<RgbImage> pictures = wheel_at_instants();
  ASSERT_EQ(pictures.size(), std::size_t{wheel_pictures});
  for (std::size_t time = 0; time < pictures.size(); ++time) {
    std::size_t asked = 0;
    for (std::uint32_t y = 0; y < 96; ++y) {
      for (std::uint32_t x = 0; x < 96; ++x) {
        const auto known = wheel_by_definition(x + 0.5 - 48, y + 0.5 - 48,
                                               wheel_degrees * static_cast<double>(time));
        if (!known) continue;
        ++asked;
        const Rgb& colour = pictures[time].at(x, y);
        const int seen = colour[0] > 220 ? 0 : colour[0] == colour[2] ? 1 : 2;
        ASSERT_EQ(seen, *known) << time << ": " << x << " " << y;
      }
    }
    EXPECT_GT(asked, 96u * 96 * 9 / 10);
  }
}

// The mean of sixteen pictures of the pipeline, at the middles of the parts of the time.
TEST(Course, TheOpenShutterAveragesInstants) {
  const SceneFiles files = wheel_files();
  MovingScene scene(files.view.scene,
                    read_motion(files.files.back().content, files.files.back().name));
  pipeline::PipelineOptions options;
  options.shading = pipeline::Shading::none;
  options.background = {0.92, 0.92, 0.92};
  std::vector<double> sums(std::size_t{96} * 96);
  for (int i = 0; i < 16; ++i) {
    const auto picture =
        render_frame(scene.at(3 + (i + 0.5) / 16), files.view.camera, options, true).picture;
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += picture.pixels[k][1] / 16;
  }
  const std::vector<RgbImage> blurred = wheel_with_open_shutter();
  ASSERT_EQ(blurred.size(), std::size_t{wheel_pictures});
  for (std::size_t k = 0; k < sums.size(); ++k)
    EXPECT_NEAR(blurred[3].pixels[k][1], 255 * sums[k], 0.5 + 1e-6);
}

TEST(Course, WhatThePageSaysOfTheWheel) {
  const WheelSeen seen = wheel_seen(wheel_degrees);
  EXPECT_NEAR(seen.apparent, -3, 0.05);
  EXPECT_NEAR(seen.contrast, seen.sinc, 0.005);
}

// A pixel that lies wholly inside or outside of the curve has its colour, or none.
TEST(Course, TheCurveIsDrawnWhereItsAreaIs) {
  for (const std::uint32_t size : {48U, 384U}) {
    const RgbImage picture = curve_at(size).picture;
    std::vector<pipeline::CubicBezier> outline;
    for (const pipeline::CubicBezier& curve : heart()) outline.push_back(curve.scaled(size));
    const pipeline::ColourImage areas = outline_areas(outline, size);
    std::size_t inside = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      const double area = areas.pixels[i][0];
      if (area < 1e-6) {
        EXPECT_EQ(picture.pixels[i], white) << size << " " << i;
      }
      if (area > 1 - 1e-6) {
        EXPECT_EQ(picture.pixels[i], (Rgb{41, 79, 161})) << size << " " << i;
        ++inside;
      }
    }
    EXPECT_GT(inside, picture.pixels.size() / 3);
  }
}

// What the page draws is what its files say, number for number.
TEST(Course, FilesHoldTheSceneThatIsDrawn) {
  Scene scene =
      scene_of({{0.1, 1.0 / 3, -0.0}, {1e-300, 2e22, 5}, {7, 8, 9}}, {{0, 1, 2}, {2, 1, 0}});
  Mesh& mesh = scene.meshes[0];
  mesh.colours = {{0.1F, 1.0F / 3, 1, 1}, {0, 0.7F, 0.2F, 1}, {1, 1, 1, 1}};
  mesh.texture_coordinates = {{0.1, 0.2}, {1.0 / 3, 0}, {1, 1}};
  mesh.lines = {{0, 2}};
  const SceneFiles files = scene_files("name", scene, front_camera(3, 4, 0.1, 1.0 / 3));
  const Mesh& read = files.view.scene.meshes.at(0);
  ASSERT_EQ(read.vertices.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(read.vertices[i].x, mesh.vertices[i].x);
    EXPECT_EQ(read.vertices[i].y, mesh.vertices[i].y);
    EXPECT_EQ(read.vertices[i].z, mesh.vertices[i].z);
  }
  EXPECT_EQ(read.triangles, mesh.triangles);
  EXPECT_EQ(read.colours, mesh.colours);
  EXPECT_EQ(read.texture_coordinates, mesh.texture_coordinates);
  EXPECT_EQ(read.lines, mesh.lines);
  EXPECT_EQ(files.view.scene.objects.at(0).name, "name");
  EXPECT_EQ(files.view.camera.near, 0.1);
  EXPECT_EQ(files.view.camera.far, 1.0 / 3);
}

// What an index per place would give; the file has 417 points twice.
TEST(Course, TheTeapotOfTheGalleryHasOneNormalAtEachPlace) {
  const std::vector<GalleryMesh> meshes = gallery_meshes();
  ASSERT_EQ(meshes.size(), 4u);
  const Scene& teapot = meshes[3].view.scene;
  EXPECT_EQ(teapot.meshes.at(0).triangles.size(), 6320u);
  std::map<std::array<double, 3>, std::set<std::array<double, 3>>> normals;
  for (const pipeline::InputTriangle& t : pipeline::assemble_triangles(
           teapot, 0, 0, pipeline::FrontFace::counter_clockwise, meshes[3].normals_from))
    for (const pipeline::InputVertex& v : t.corners)
      normals[{v.position.x, v.position.y, v.position.z}].insert(v.normal);
  for (const auto& [place, there] : normals) EXPECT_EQ(there.size(), 1u);
  for (const GalleryMesh& mesh : meshes)
    EXPECT_EQ(mesh.has_texture_coordinates, mesh.view.name == "spot") << mesh.view.name;
}

}  // namespace
}  // namespace fathom::studies
