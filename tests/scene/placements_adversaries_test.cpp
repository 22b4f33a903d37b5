// Trees of glTF nodes and the transforms of scene files, of any magnitudes and with cancellation: a
// mesh is placed where its points come to if node after node moves them in rational numbers, or it
// is refused where these are beyond what a transform may be.
#include <gmock/gmock.h>
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "fathom/failures/errors.h"
#include "fathom/scene/read_scene.h"
#include "tests/adversaries.h"
#include "tests/inputs/draw.h"
#include "tests/inputs/floating_point_modes.h"
#include "tests/numeric/random_numbers.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using checks::Draw;
using nlohmann::json;
using Q = mpq_class;
using Point = std::array<Q, 3>;
using Numbers = std::vector<double>;

/// How the numbers of a tree are drawn.
enum class Size { few_bits, ordinary, any };

double number(Draw& draw, Size size) {
  switch (size) {
    case Size::few_bits:
      return draw.few_bits(2);
    case Size::ordinary:
      return draw.within(2);
    case Size::any:
      if (draw.one_in(6)) return draw.one_in(2) ? 0.0 : -0.0;
      return draw.one_in(4) ? draw.sign() * 0x1p-1074 * draw.below(5)
                            : draw.of_exponent(draw.between(-1074, 1023));
  }
  return 0;
}

Numbers numbers(Draw& draw, Size size, std::size_t count) {
  Numbers result(count);
  for (double& x : result) x = number(draw, size);
  return result;
}

/// A node's transform as its file has it: 16 numbers column by column, or parts, some left out.
struct Node {
  Numbers matrix, translation, rotation, scale;
  std::vector<std::size_t> children;
  bool has_mesh = false;
};

Point moved_by_matrix(const Numbers& m, const Point& p) {
  Point result;
  for (std::size_t i = 0; i < 3; ++i) {
    result[i] = Q(m[i]) * p[0] + Q(m[4 + i]) * p[1] + Q(m[8 + i]) * p[2] + Q(m[12 + i]);
  }
  return result;
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// p + 2w·(u × p) + 2u × (u × p) for the quaternion (u, w): what its polynomial matrix does.
Point turned(const Numbers& q, const Point& p) {
  const Point u{q[0], q[1], q[2]}, once = cross(u, p), twice = cross(u, once);
  Point result;
  for (std::size_t i = 0; i < 3; ++i) result[i] = p[i] + 2 * Q(q[3]) * once[i] + 2 * twice[i];
  return result;
}

Point moved(const Node& node, Point p) {
  if (!node.matrix.empty()) return moved_by_matrix(node.matrix, p);
  for (std::size_t i = 0; i < node.scale.size(); ++i) p[i] *= Q(node.scale[i]);
  if (!node.rotation.empty()) p = turned(node.rotation, p);
  for (std::size_t i = 0; i < node.translation.size(); ++i) p[i] += Q(node.translation[i]);
  return p;
}

/// Undoes what can be undone of another node's transform, or nearly: most of it cancels.
Node undoing(Draw& draw, const Node& other) {
  Node node;
  for (const double x : other.translation) node.translation.push_back(draw.nudged(-x, 1));
  if (draw.one_in(2)) return node;
  for (const double x : other.scale) {
    const double inverse = 1 / x;
    node.scale.push_back(std::isfinite(inverse) ? inverse : 1);
  }
  node.rotation = other.rotation;
  for (std::size_t i = 0; i < 3 && !node.rotation.empty(); ++i) node.rotation[i] *= -1;
  return node;
}

Node any_node(Draw& draw, Size size) {
  Node node;
  if (draw.one_in(3)) {
    node.matrix = numbers(draw, size, 16);
    for (const std::size_t i : {3, 7, 11}) node.matrix[i] = 0;
    node.matrix[15] = 1;
    return node;
  }
  if (draw.one_in(2)) node.translation = numbers(draw, size, 3);
  if (draw.one_in(2)) node.rotation = numbers(draw, size, 4);
  if (draw.one_in(2)) node.scale = numbers(draw, size, 3);
  return node;
}

struct Tree {
  std::vector<Node> nodes;
  std::vector<std::size_t> roots;
};

Tree any_tree(Draw& draw) {
  Tree tree;
  const auto size = static_cast<Size>(draw.below(3));
  const int count = draw.between(1, 7);
  for (int i = 0; i < count; ++i) {
    const auto number = static_cast<std::size_t>(i);
    const auto parent = static_cast<std::size_t>(draw.below(i + 1));
    const bool undoes = parent < number && draw.one_in(3);
    Node node = undoes ? undoing(draw, tree.nodes[parent]) : any_node(draw, size);
    node.has_mesh = i + 1 == count || draw.one_in(2);
    tree.nodes.push_back(node);
    (parent < number ? tree.nodes[parent].children : tree.roots).push_back(number);
  }
  return tree;
}

const std::vector<float> positions{0, 0, 0, 1, -0x1.fffffep127F, 0x1p-149F, 0.1F, 3, -7};

json json_of(const Tree& tree) {
  json nodes = json::array();
  for (const Node& node : tree.nodes) {
    json n = json::object();
    if (!node.matrix.empty()) n["matrix"] = node.matrix;
    if (!node.translation.empty()) n["translation"] = node.translation;
    if (!node.rotation.empty()) n["rotation"] = node.rotation;
    if (!node.scale.empty()) n["scale"] = node.scale;
    if (!node.children.empty()) n["children"] = node.children;
    if (node.has_mesh) n["mesh"] = 0;
    nodes.push_back(n);
  }
  const std::size_t bytes = positions.size() * sizeof(float);
  return {
      {"asset", {{"version", "2.0"}}},
      {"scenes", {{{"nodes", tree.roots}}}},
      {"nodes", nodes},
      {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}}},
      {"accessors", {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}}}},
      {"bufferViews", {{{"buffer", 0}, {"byteLength", bytes}}}},
      {"buffers", {{{"byteLength", bytes}, {"uri", "positions.bin"}}}}};
}

/// The ways from the mesh to the root of each node with a mesh, depth first.
void add_ways(const Tree& tree, std::size_t number, std::vector<const Node*> way,
              std::vector<std::vector<const Node*>>& ways) {
  const Node& node = tree.nodes[number];
  way.insert(way.begin(), &node);
  if (node.has_mesh) ways.push_back(way);
  for (const std::size_t child : node.children) add_ways(tree, child, way, ways);
}

Q rational(const Dyadic& x) {
  Q q;
  checks::set(q.get_mpq_t(), x);
  return q;
}

/// Where the nodes of a way and then the scene file's transform move a point.
Point placed(const std::vector<const Node*>& way, const Numbers& transform, Point p) {
  for (const Node* node : way) p = moved(*node, p);
  return transform.empty() ? p : moved_by_matrix(transform, p);
}

/// Whether the matrix of it is beyond what a transform may be.
bool is_beyond(const std::vector<const Node*>& way, const Numbers& transform) {
  const Point origin = placed(way, transform, {0, 0, 0});
  std::vector<long> tops, lasts;
  for (int column = 0; column < 4; ++column) {
    Point axis{0, 0, 0};
    if (column < 3) axis[column] = 1;
    const Point image = placed(way, transform, axis);
    for (std::size_t i = 0; i < 3; ++i) {
      const Q entry = column < 3 ? Q(image[i] - origin[i]) : image[i];
      if (entry == 0) continue;
      // An integer, or an odd one over a power of two.
      const long power = static_cast<long>(mpz_sizeinbase(entry.get_den_mpz_t(), 2)) - 1;
      tops.push_back(static_cast<long>(mpz_sizeinbase(entry.get_num_mpz_t(), 2)) - power);
      lasts.push_back(static_cast<long>(mpz_scan1(entry.get_num_mpz_t(), 0)) - power);
    }
  }
  if (tops.empty()) return false;
  const long highest = *std::max_element(tops.begin(), tops.end());
  const long lowest = *std::min_element(lasts.begin(), lasts.end());
  return highest > greatest_power_of_transform || highest - lowest > most_bits_of_transform;
}

bool any_is_beyond(const std::vector<std::vector<const Node*>>& ways,
                   const std::vector<Numbers>& transforms) {
  return std::ranges::any_of(transforms, [&](const Numbers& transform) {
    return std::ranges::any_of(ways, [&](const auto& way) { return is_beyond(way, transform); });
  });
}

/// Holds an object to where its nodes and then the scene file's transform move points; those of the
/// mesh, and the four that tell what any affine map is.
void expect_placed(const Object& object, const Mesh& mesh, const std::vector<const Node*>& way,
                   const Numbers& transform) {
  std::vector<MeshPoint> points(mesh.vertices.begin(), mesh.vertices.end());
  points.insert(points.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}});
  for (const MeshPoint& p : points) {
    const Point expected = placed(way, transform, {p.x, p.y, p.z});
    const WorldPoint world = to_world(object, p);
    EXPECT_EQ(rational(world.x), expected[0]);
    EXPECT_EQ(rational(world.y), expected[1]);
    EXPECT_EQ(rational(world.z), expected[2]);
  }
}

/// Rows, as scene files have them.
json rows_of(const Numbers& matrix) {
  json rows = json::array();
  for (std::size_t i = 0; i < 3; ++i) {
    rows.push_back({matrix[i], matrix[4 + i], matrix[8 + i], matrix[12 + i]});
  }
  return rows;
}

/// A scene file that shows the asset once or twice, each time placed or as it is.
json scene_file(Draw& draw, std::vector<Numbers>& transforms) {
  json meshes = json::array();
  for (int i = draw.between(1, 2); i > 0; --i) {
    json mesh{{"file", "tree.gltf"}};
    transforms.emplace_back();
    if (draw.one_in(2)) {
      transforms.back() = numbers(draw, static_cast<Size>(draw.below(3)), 16);
      mesh["transform"] = rows_of(transforms.back());
    }
    meshes.push_back(mesh);
  }
  return {{"meshes", meshes}};
}

Scene scene_in_mode(const std::filesystem::path& path, const checks::FloatingPointMode* mode) {
  const checks::InMode in_mode(mode);
  Warnings warnings;
  return read_scene({path}, {}, warnings);
}

TEST(PlacementsAdversaries, AreComposedAsRationalNumbersAre) {
  std::string buffer(positions.size() * sizeof(float), '\0');
  std::memcpy(buffer.data(), positions.data(), buffer.size());
  checks::for_each_adversary(600, [&](std::uint64_t seed) {
    const ScratchFolder folder;  // a file that is written again may have to be on the disk first
    folder.write("positions.bin", buffer);
    Draw draw(seed);
    const Tree tree = any_tree(draw);
    const std::string asset = json_of(tree).dump();
    folder.write("tree.gltf", asset);
    std::vector<Numbers> transforms;
    const std::string text = scene_file(draw, transforms).dump();
    SCOPED_TRACE(text + "\n" + asset);
    const std::string file = folder.write("scene.json", text);
    const checks::FloatingPointMode* const mode = checks::any_mode(draw.generator());
    std::vector<std::vector<const Node*>> ways;
    for (const std::size_t root : tree.roots) add_ways(tree, root, {}, ways);
    if (any_is_beyond(ways, transforms)) {
      EXPECT_THAT(message_of<InputError>([&] { scene_in_mode(file, mode); }),
                  ::testing::HasSubstr("is placed by a transform "));
      return;
    }
    const Scene scene = scene_in_mode(file, mode);
    ASSERT_EQ(scene.objects.size(), ways.size() * transforms.size());
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
      const Object& object = scene.objects[i];
      const Mesh& mesh = scene.meshes[object.mesh];
      ASSERT_EQ(mesh.vertices.size(), positions.size() / 3);
      for (std::size_t k = 0; k < mesh.vertices.size(); ++k) {
        const MeshPoint& p = mesh.vertices[k];
        ASSERT_EQ(p, (MeshPoint{positions[3 * k], positions[3 * k + 1], positions[3 * k + 2]}));
      }
      expect_placed(object, mesh, ways[i % ways.size()], transforms[i / ways.size()]);
    }
  });
}

}  // namespace
}  // namespace fathom
