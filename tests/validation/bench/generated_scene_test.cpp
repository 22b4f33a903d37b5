#include "validation/scenes/generated/generated_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/render.h"
#include "tests/engines/expect_same_map.h"

/// Triangles that are generated: the same however they are asked for, and within their bounds.
namespace fathom::bench {
namespace {

constexpr GeneratedKind kinds[] = {GeneratedKind::terrain, GeneratedKind::soup};

StreamedScene scene_of(GeneratedKind kind, std::uint32_t triangles) {
  return generated_scene({.kind = kind, .triangles = triangles, .edge = {}});
}

void expect_read_as_each(const TriangleStream& stream, std::uint32_t first, std::uint32_t count) {
  SCOPED_TRACE(std::to_string(count) + " from " + std::to_string(first) + " of " +
               std::to_string(stream.triangle_count()));
  const TriangleChunk chunk = stream.read(first, count);
  const Mesh& mesh = chunk.mesh;
  EXPECT_EQ(chunk.first, std::min(first, stream.triangle_count()));
  ASSERT_EQ(mesh.triangles.size(), std::min(count, stream.triangle_count() - chunk.first));
  EXPECT_EQ(mesh.face_count, mesh.triangles.size());
  EXPECT_TRUE(mesh.face_of_triangle.empty());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const TriangleStream::Triangle triangle = stream.triangle(first + i);
    ASSERT_EQ(triangle.face, first + i);
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_EQ(mesh.vertices.at(mesh.triangles[i][k]), triangle.corners[k]) << i << " " << k;
  }
}

TEST(GeneratedScene, ATriangleIsTheSameHoweverItIsAskedFor) {
  std::mt19937 random(1);
  for (const GeneratedKind kind : kinds) {
    for (const std::uint32_t count : {1U, 2U, 3U, 8U, 9U, 199U, 200U, 1000U, 4294967294U}) {
      const StreamedScene scene = scene_of(kind, count);
      const TriangleStream& stream = *scene.streams.front();
      ASSERT_EQ(stream.triangle_count(), count);
      for (int i = 0; i < 50; ++i) {
        const std::uint32_t first = random() % count;
        expect_read_as_each(stream, first, random() % 100);
      }
      expect_read_as_each(stream, 0, std::min(count, 1000U));
      expect_read_as_each(stream, count - 1, 10);
      expect_read_as_each(stream, count, 10);
    }
  }
}

/// Where chunks begin and end within rows and at their ends: a grid of 7 columns, all chunks.
TEST(GeneratedScene, TheChunksOfATerrain) {
  for (const std::uint32_t count : {74U, 85U, 97U, 98U}) {
    const StreamedScene scene = scene_of(GeneratedKind::terrain, count);
    for (std::uint32_t first = 0; first < count; ++first)
      for (std::uint32_t size = 1; first + size <= count; ++size)
        expect_read_as_each(*scene.streams.front(), first, size);
  }
}

TEST(GeneratedScene, NeighboursInATerrainShareTheirVertices) {
  const StreamedScene scene = scene_of(GeneratedKind::terrain, 2 * 100 * 100);
  const Mesh mesh = scene.streams.front()->read(0, 2 * 100 * 100).mesh;
  EXPECT_EQ(mesh.vertices.size(), 101U * 101U);
  const Mesh part = scene.streams.front()->read(2 * 150, 2 * 130).mesh;  // 50 cells, 80 cells
  std::set<std::tuple<double, double, double>> places;
  for (const MeshPoint& p : part.vertices) places.insert({p.x, p.y, p.z});
  EXPECT_EQ(places.size(), part.vertices.size());
  EXPECT_EQ(places.size(), 51U + 101U + 81U);
}

TEST(GeneratedScene, BoundsHoldAllCornersAndAreNotFar) {
  for (const GeneratedKind kind : kinds) {
    const StreamedScene scene = scene_of(kind, 200000);
    const TriangleStream& stream = *scene.streams.front();
    const TriangleStream::Bounds bounds = *stream.bounds();
    MeshPoint lower = stream.triangle(0).corners[0], upper = lower;
    const Mesh all = stream.read(0, 200000).mesh;
    for (const MeshPoint& p : all.vertices) {
      lower = {std::min(lower.x, p.x), std::min(lower.y, p.y), std::min(lower.z, p.z)};
      upper = {std::max(upper.x, p.x), std::max(upper.y, p.y), std::max(upper.z, p.z)};
    }
    EXPECT_LE(bounds.lower.x, lower.x);
    EXPECT_LE(bounds.lower.y, lower.y);
    EXPECT_LE(bounds.lower.z, lower.z);
    EXPECT_GE(bounds.upper.x, upper.x);
    EXPECT_GE(bounds.upper.y, upper.y);
    EXPECT_GE(bounds.upper.z, upper.z);
    EXPECT_GT(upper.x - lower.x, 0.99);
    EXPECT_GT(upper.y - lower.y, 0.5 * (bounds.upper.y - bounds.lower.y));
    EXPECT_GT(upper.z - lower.z, 0.99);
  }
}

/// The same triangles in memory.
Scene as_scene_in_memory(const StreamedScene& streamed) {
  Scene scene;
  scene.objects = streamed.objects;
  scene.sources = streamed.sources;
  const TriangleStream& stream = *streamed.streams.front();
  scene.meshes.push_back(stream.read(0, stream.triangle_count()).mesh);
  return scene;
}

TEST(GeneratedScene, TheMapIsThatOfTheSameTrianglesInMemory) {
  for (const GeneratedKind kind : kinds) {
    SCOPED_TRACE(name_of(kind));
    const StreamedScene streamed = scene_of(kind, 100000);
    const Camera camera = camera_of(kind, {320, 180});
    const RenderOptions options{.channels = {Channel::Z, Channel::id}};
    checks::expect_same_map(render(streamed, camera, options).map,
                            render(as_scene_in_memory(streamed), camera, options).map);
  }
}

double part_with_surface(GeneratedKind kind, const ImageSize& size) {
  const Rendered rendered =
      render(scene_of(kind, 100000), camera_of(kind, size), {.channels = {Channel::Z}});
  return static_cast<double>(rendered.statistics.pixels_with_surface) / size.width / size.height;
}

TEST(GeneratedScene, ATerrainFillsItsImage) {
  for (const ImageSize size : {ImageSize{320, 180}, {200, 200}, {100, 300}})
    EXPECT_EQ(part_with_surface(GeneratedKind::terrain, size), 1);
  EXPECT_GT(part_with_surface(GeneratedKind::soup, {320, 180}), 0.1);
}

TEST(GeneratedScene, WhatCannotBe) {
  EXPECT_THROW(scene_of(GeneratedKind::soup, 4294967295U), InputError);
  for (const double edge : {0.0, -1.0, 1.5})
    EXPECT_THROW(generated_scene({.kind = GeneratedKind::soup, .triangles = 9, .edge = edge}),
                 UsageError);
  const StreamedScene none = scene_of(GeneratedKind::terrain, 0);
  EXPECT_FALSE(none.streams.front()->bounds());
  EXPECT_TRUE(none.streams.front()->read(0, 5).mesh.triangles.empty());
}

}  // namespace
}  // namespace fathom::bench
