// glTF whose geometry is compressed: what the libraries decode is what an asset without compression
// would say, and damage is one line.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "compressed_assets.h"
#include "foreign_scene.h"
#include "tests/effort.h"

namespace fathom::test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

Scene read(const json& asset) {
  return read_bytes("a.gltf", asset.dump());
}
std::string refusal_of_gltf(const json& asset) {
  return test::refusal_of("a.gltf", asset.dump());
}

/// Reads without fathom-formats, as where it is not built.
Scene read_without_program(const json& asset) {
  const ScratchFolder folder;
  Warnings warnings;
  ReadOptions options;
  options.formats_program = [] { return std::filesystem::path("/nowhere/fathom-formats"); };
  return read_scene({folder.write("a.gltf", asset.dump())}, options, warnings);
}

const Triangulated& spot() {
  static const Triangulated mesh = read_triangulated(source_dir() / "data/meshes/spot.obj");
  return mesh;
}

std::string bytes_of(const std::vector<float>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float)};
}

std::vector<float> floats_of(const std::string& bytes) {
  std::vector<float> numbers(bytes.size() / sizeof(float));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

void expect_same_geometry(const Scene& a, const Scene& b) {
  ASSERT_EQ(a.meshes.size(), 1U);
  ASSERT_EQ(b.meshes.size(), 1U);
  EXPECT_EQ(a.meshes[0].vertices, b.meshes[0].vertices);
  EXPECT_EQ(a.meshes[0].triangles, b.meshes[0].triangles);
}

class DracoMeshes : public ::testing::TestWithParam<DracoOptions> {};

TEST_P(DracoMeshes, AreWhatDracoDecodes) {
  const std::string compressed = by_draco(spot(), GetParam());
  const Scene scene = read(draco_asset(spot(), compressed));
  expect_same_geometry(scene, read(plain_asset(decoded_by_draco(compressed))));
  EXPECT_EQ(scene.sources.at(0).reader, "Draco 1.5.5");
}

INSTANTIATE_TEST_SUITE_P(All, DracoMeshes,
                         ::testing::Values(DracoOptions{0, true}, DracoOptions{0, false},
                                           DracoOptions{11, true}, DracoOptions{16, false}));

TEST(Draco, WithoutQuantizationChangesNoNumber) {
  expect_same_geometry(read(draco_asset(spot(), by_draco(spot(), {0, true}))),
                       read(plain_asset(spot())));
}

TEST(Draco, PlainAccessorsAreTakenWhereTheyAreThere) {
  json asset = plain_asset(spot());
  const std::string compressed = by_draco(spot(), {5, true});
  asset["buffers"].push_back(draco_asset(spot(), compressed)["buffers"][0]);
  asset["bufferViews"].push_back({{"buffer", 1}, {"byteLength", compressed.size()}});
  asset["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", 2}, {"attributes", {{"POSITION", 0}}}};
  asset["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  const Scene scene = read_without_program(asset);
  expect_same_geometry(scene, read(plain_asset(spot())));
  EXPECT_THAT(scene.sources.at(0).reader, IsEmpty());
  // What requires the extension means what Draco decodes, although plain numbers are there too.
  asset["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  expect_same_geometry(read(asset), read(plain_asset(decoded_by_draco(compressed))));
}

TEST(Draco, IsDecodedWhereNothingElseIsThere) {
  json asset = draco_asset(spot(), by_draco(spot(), {11, true}));
  asset.erase("extensionsRequired");
  EXPECT_EQ(read(asset).sources.at(0).reader, "Draco 1.5.5");
}

TEST(Draco, NeedsItsProgram) {
  const json asset = draco_asset(spot(), by_draco(spot(), {}));
  EXPECT_THAT(
      message_of<InputError>([&] { read_without_program(asset); }),
      HasSubstr("a.gltf: is read by a separate program, fathom-formats, that is not installed"));
}

TEST(Draco, CountsOfAccessorsAreThoseOfTheMesh) {
  const std::string compressed = by_draco(spot(), {});
  for (const int accessor : {0, 1}) {
    json asset = draco_asset(spot(), compressed);
    const std::size_t count = asset["accessors"][accessor]["count"];
    for (const std::size_t wrong : {count - 3, count + 3}) {
      asset["accessors"][accessor]["count"] = wrong;
      EXPECT_THAT(
          refusal_of_gltf(asset),
          HasSubstr("accessors[" + std::to_string(accessor) + "]: has " + std::to_string(wrong) +
                    " elements, but Draco decoded " + std::to_string(count)));
    }
  }
}

TEST(Draco, IndicesAreOfTheTypeOfTheirAccessor) {
  const Triangulated square{{0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 1, 2}};
  json asset = draco_asset(square, by_draco(square, {}));
  for (const int component : {5121, 5123, 5125}) {
    asset["accessors"][1]["componentType"] = component;
    EXPECT_EQ(triangle_count(read(asset)), 1U) << component;
  }
  json large = draco_asset(spot(), by_draco(spot(), {}));
  large["accessors"][1]["componentType"] = 5121;
  EXPECT_THAT(refusal_of_gltf(large),
              HasSubstr("Draco could not decode it: the accessor's component type"));
}

TEST(Draco, WhatIsNotAsDescribedIsNamed) {
  const json good = draco_asset(spot(), by_draco(spot(), {}));
  const std::string primitive = "meshes[0].primitives[0]";
  const std::string extension = primitive + ".extensions.KHR_draco_mesh_compression";
  const auto with = [&](const std::string& pointer, const json& value) {
    json asset = good;
    asset[json::json_pointer(pointer)] = value;
    return refusal_of_gltf(asset);
  };
  const std::string place = "/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression";
  EXPECT_THAT(
      with(place + "/attributes/POSITION", 7),
      StartsWith("a.gltf: " + extension + ": Draco could not decode it: there is no attribute 7"));
  EXPECT_THAT(with(place + "/attributes", json::object()), HasSubstr("has no POSITION"));
  EXPECT_THAT(with(place + "/bufferView", 3), HasSubstr("there is no entry 3 in bufferViews"));
  EXPECT_THAT(with("/accessors/0/type", "VEC2"),
              HasSubstr("attribute 0 has 3 numbers to a vertex, its accessor has 2"));
  EXPECT_THAT(with("/meshes/0/primitives/0/mode", 5), HasSubstr("expected 4, triangles"));
  json asset = good;
  asset["meshes"][0]["primitives"][0].erase("indices");
  EXPECT_THAT(refusal_of_gltf(asset), HasSubstr("indices"));
}

TEST(Draco, DamageIsOneLine) {
  const std::string compressed = by_draco(spot(), {11, false});
  std::mt19937_64 random(5);
  int refused = 0;
  for (int i = 0; i < 60 / checks::effort; ++i) {
    std::string bytes = compressed;
    for (int k = 0; k < 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (i % 3 == 0) bytes.resize(1 + random() % bytes.size());
    try {
      read(draco_asset(spot(), bytes));
    } catch (const InputError& error) {
      ++refused;
      EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
    }
  }
  EXPECT_GT(refused, 0);
}

TEST(Meshopt, IndicesAndPositionsAreThoseOfThePlainAsset) {
  for (const std::string mode : {"TRIANGLES", "INDICES"}) {
    const CompressedView indices = indices_by_meshopt(spot().indices, mode);
    for (const std::string extension : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
      const Scene scene = read(
          meshopt_asset(attributes_by_meshopt(bytes_of(spot().positions), 12), indices, extension));
      expect_same_geometry(scene,
                           read(plain_asset({spot().positions, decoded_by_meshopt(indices)})));
      EXPECT_EQ(scene.sources.at(0).reader, "meshoptimizer 0.18");
    }
  }
}

/// Of the filter EXPONENTIAL: mantissa · 2^exponent.
std::uint32_t exponential(int mantissa, int exponent) {
  return static_cast<std::uint32_t>(exponent) << 24U |
         (static_cast<std::uint32_t>(mantissa) & 0xFFFFFFU);
}

TEST(Meshopt, ExponentialNumbersAreExact) {
  const std::vector<std::uint32_t> encoded{
      exponential(3, -2),  exponential(-5, 0),          exponential(0, 0),
      exponential(1, 100), exponential(-8388608, -100), exponential(8388607, -23),
      exponential(7, 1),   exponential(1, -126),        exponential(-1, 3)};
  const std::string bytes(reinterpret_cast<const char*>(encoded.data()), 4 * encoded.size());
  const Scene scene = read(meshopt_asset(attributes_by_meshopt(bytes, 12, "EXPONENTIAL"),
                                         indices_by_meshopt({0, 1, 2}, "TRIANGLES")));
  const std::vector<MeshPoint> expected{
      {0.75, -5, 0}, {0x1p100, -0x1p-77, 8388607 * 0x1p-23}, {14, 0x1p-126, -8}};
  EXPECT_EQ(scene.meshes.at(0).vertices, expected);
}

TEST(Meshopt, ExponentialPositionsAreWhatTheLibraryDecodes) {
  const CompressedView indices = indices_by_meshopt(spot().indices, "TRIANGLES");
  for (const int bits : {8, 15, 24}) {
    const FilteredElements positions = by_filter("EXPONENTIAL", 12, bits, spot().positions);
    const Scene scene =
        read(meshopt_asset(attributes_by_meshopt(positions.encoded, 12, "EXPONENTIAL"), indices));
    expect_same_geometry(
        scene, read(plain_asset({floats_of(positions.decoded), decoded_by_meshopt(indices)})));
    EXPECT_NEAR(scene.meshes.at(0).vertices.at(7).y, spot().positions.at(22), 0.01);
  }
}

/// Five vertices and these elements, four normalized numbers of this component type to each, of
/// which glTF uses `type`. Those are in buffer view 1.
json five_with(const std::string& elements, std::size_t stride, const char* type) {
  checks::Asset asset = checks::five({});
  const bool are_bytes = stride == 4;
  asset.add(std::vector<char>(elements.begin(), elements.end()), "SCALAR", are_bytes ? 5120 : 5122,
            true);
  asset.tree["accessors"][1].update({{"count", elements.size() / stride}, {"type", type}});
  asset.tree["bufferViews"][1]["byteStride"] = stride;
  return asset.done();
}

/// Directions and turns of five vertices; four numbers each.
const std::vector<float> units{0.6F,  0.8F, 0, 0, 0, 0, -1, 0,    0.36F, -0.48F,
                               -0.8F, 0,    1, 0, 0, 0, 0,  0.6F, -0.8F, 0};

TEST(Meshopt, OctahedralNormalsAreWhatTheLibraryDecodes) {
  const auto normals_of = [](json asset) {
    asset["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 1;
    Warnings warnings;
    return read_bytes("a.gltf", asset.dump(), warnings, {.attributes = true}).meshes.at(0).normals;
  };
  for (const std::size_t stride : {4U, 8U}) {
    const FilteredElements normals =
        by_filter("OCTAHEDRAL", stride, static_cast<int>(2 * stride), units);
    const json plain = five_with(normals.decoded, stride, "VEC3");
    json compressed = plain;
    compress_view(compressed, 1, attributes_by_meshopt(normals.encoded, stride, "OCTAHEDRAL"));
    const auto read = normals_of(compressed);
    EXPECT_EQ(read, normals_of(plain));
    EXPECT_NEAR(read.at(2)[1], -0.48, 0.02);
  }
}

// Of a mesh, quaternions turn nothing but its instances.
TEST(Meshopt, RotationsOfInstancesAreWhatTheLibraryDecodes) {
  const auto objects_of = [](json asset) {
    asset["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = 1;
    asset["extensionsUsed"].push_back("EXT_mesh_gpu_instancing");
    return read(asset).objects;
  };
  for (const int bits : {8, 16}) {
    const FilteredElements rotations = by_filter("QUATERNION", 8, bits, units);
    const json plain = five_with(rotations.decoded, 8, "VEC4");
    json compressed = plain;
    compress_view(compressed, 1, attributes_by_meshopt(rotations.encoded, 8, "QUATERNION"));
    const std::vector<Object> read = objects_of(compressed), expected = objects_of(plain);
    ASSERT_EQ(read.size(), 5U);
    for (std::size_t i = 0; i < read.size(); ++i)
      EXPECT_EQ(read[i].world_from_mesh.rows, expected.at(i).world_from_mesh.rows);
    EXPECT_GT(read[0].world_from_mesh.rows[0][1], Dyadic(0.95));  // 0.96 without rounding
  }
}

TEST(Meshopt, PlainBytesAreTakenWhereTheyAreThere) {
  json asset = meshopt_asset(attributes_by_meshopt(bytes_of(spot().positions), 12),
                             indices_by_meshopt(spot().indices, "TRIANGLES"));
  const json plain = plain_asset(spot());
  asset["buffers"][1]["uri"] = plain["buffers"][0]["uri"];
  asset.erase("extensionsRequired");
  const Scene scene = read_without_program(asset);
  expect_same_geometry(scene, read(plain));
  EXPECT_THAT(scene.sources.at(0).reader, IsEmpty());
}

TEST(Meshopt, WhatIsNotAsDescribedIsNamed) {
  const CompressedView positions = attributes_by_meshopt(bytes_of(spot().positions), 12);
  const json good = meshopt_asset(positions, indices_by_meshopt(spot().indices, "TRIANGLES"));
  const std::string place = "/bufferViews/0/extensions/EXT_meshopt_compression";
  const auto with = [&](const std::string& key, const json& value) {
    json asset = good;
    asset[json::json_pointer(place + key)] = value;
    return refusal_of_gltf(asset);
  };
  const std::string blamed = "a.gltf: bufferViews[0].extensions.EXT_meshopt_compression";
  EXPECT_THAT(with("/mode", "STRIPS"),
              StartsWith(blamed + ".mode: expected ATTRIBUTES, TRIANGLES"));
  EXPECT_THAT(with("/filter", "COLOR"), StartsWith(blamed + ".filter: expected NONE, OCTAHEDRAL"));
  EXPECT_THAT(with("/count", 7), StartsWith(blamed + ": is of 7 times 12 bytes, expected the"));
  EXPECT_THAT(with("/byteStride", 24), HasSubstr("times 24 bytes, expected the"));
  EXPECT_THAT(
      with("/filter", "QUATERNION"),
      StartsWith(blamed + ": meshoptimizer could not decode it: expected a byteStride of 8"));
  EXPECT_THAT(with("/mode", "INDICES"), HasSubstr("expected a byteStride of indices of 2 or 4"));
  EXPECT_THAT(with("/byteLength", 99'999'999), HasSubstr("reaches beyond the end of its buffer"));
  EXPECT_THAT(with("/buffer", 9), HasSubstr("there is no buffer 9"));
}

TEST(Meshopt, DamageIsOneLine) {
  std::mt19937_64 random(6);
  int refused = 0;
  for (int i = 0; i < 60 / checks::effort; ++i) {
    CompressedView positions = attributes_by_meshopt(bytes_of(spot().positions), 12);
    CompressedView indices = indices_by_meshopt(spot().indices, "TRIANGLES");
    std::string& bytes = i % 2 == 0 ? positions.bytes : indices.bytes;
    for (int k = 0; k < 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
    if (i % 3 == 0) bytes.resize(1 + random() % bytes.size());
    try {
      read(meshopt_asset(positions, indices));
    } catch (const InputError& error) {
      ++refused;
      EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
    }
  }
  EXPECT_GT(refused, 0);
}

// A few bytes that would be gigabytes.
TEST(CompressedGltf, WhatIsDecodedIsWithinTheBudget) {
  const std::string zeros(std::size_t{12} * 8'000'000, '\0');
  const json asset =
      meshopt_asset(attributes_by_meshopt(zeros, 12), indices_by_meshopt({0, 1, 2}, "TRIANGLES"));
  EXPECT_THAT(refusal_of_gltf(asset), HasSubstr("--max-expansion"));
  Warnings warnings;
  EXPECT_EQ(triangle_count(read_bytes("a.gltf", asset.dump(), warnings, {.max_expansion = 10'000})),
            1U);
}

}  // namespace
}  // namespace fathom::test
