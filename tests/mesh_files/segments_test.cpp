// What files call their triangles: materials, groups, parts and labels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "fathom/mesh/segmentation.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/mesh_files/triangle_stream.h"
#include "tests/mesh_files/gltf/gltf_asset.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using Names = std::vector<std::string>;
constexpr const char* none = "(none)";
constexpr const char* corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";

ReadOptions with_segments() {
  ReadOptions options;
  options.segments = true;
  return options;
}

Mesh read_obj(const std::string& text, const ReadOptions& options = with_segments()) {
  Warnings warnings;
  Mesh mesh = mesh_files::read_obj(text, "a.obj", options, warnings);
  EXPECT_THAT(warnings, IsEmpty());
  return mesh;
}

/// The name of each triangle's segment.
Names names_of(const Mesh& mesh, Segmentation by) {
  Names names;
  const TriangleSegments* const segments = mesh.segments_by(by);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t number = segments ? segments->of(t) : unsegmented;
    names.push_back(number == unsegmented ? none : segments->names.at(number));
  }
  return names;
}

std::vector<std::uint32_t> labels_of(const Mesh& mesh) {
  std::vector<std::uint32_t> labels;
  const TriangleSegments* const segments = mesh.segments_by(Segmentation::label);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    labels.push_back(segments ? segments->of(t) : unsegmented);
  return labels;
}

TEST(ObjSegments, AreThoseOfTheLastLinesBefore) {
  const Mesh mesh = read_obj(std::string(corners) +
                             "f 1 2 3\n"
                             "o wheel\nusemtl steel\nf 1 2 3\nf 1 2 4 3\n"
                             "g spoke\nf 1 2 3\n"
                             "o body\nusemtl oak\nf 1 2 3\n"
                             "usemtl steel\ng\nf 1 2 3\n"
                             "o\nusemtl\nf 1 2 3\n");
  EXPECT_THAT(names_of(mesh, Segmentation::material),
              ElementsAre(none, "steel", "steel", "steel", "steel", "oak", "steel", none));
  EXPECT_THAT(names_of(mesh, Segmentation::part),
              ElementsAre(none, "wheel", "wheel", "wheel", "wheel", "body", "body", none));
  EXPECT_THAT(names_of(mesh, Segmentation::group),
              ElementsAre(none, none, none, none, "spoke", "spoke", "default", "default"));
  // A name that comes back has its first number.
  EXPECT_THAT(mesh.segments_by(Segmentation::material)->names, ElementsAre("steel", "oak"));
}

TEST(ObjSegments, AreNothingWhereTheyAreNotAskedForOrNotThere) {
  const std::string text = std::string(corners) + "o a\ng b\nusemtl c\nf 1 2 3\n";
  EXPECT_THAT(read_obj(text, {}).segments, IsEmpty());
  EXPECT_THAT(read_obj(std::string(corners) + "o\nusemtl\nf 1 2 3\nf 1 2 4\n").segments, IsEmpty());
  // A name that no triangle has is no segment.
  EXPECT_THAT(read_obj(std::string(corners) + "f 1 2 3\nusemtl a\ns off\n").segments, IsEmpty());
}

TEST(ObjSegments, OfOneKindForAllTakeOneNumber) {
  const Mesh mesh = read_obj(std::string(corners) + "usemtl a\nf 1 2 3\no x\nusemtl a\nf 1 2 4\n");
  EXPECT_THAT(mesh.segments_by(Segmentation::material)->numbers, ElementsAre(0));
  EXPECT_THAT(mesh.segments_by(Segmentation::part)->numbers, ElementsAre(unsegmented, 0));
}

TEST(ObjSegments, NamesAreTheRestOfTheLine) {
  const Mesh mesh =
      read_obj(std::string(corners) +
               "usemtl  dark  oak \t\r\nf 1 2 3\n"
               "usemtl Material #25\nf 1 2 3\n"
               "usemtl Material #26\nf 1 2 3\n"
               "usemtl long\\\nname\nf 1 2 3\n"
               "usemtl caf\xe9\nf 1 2 3\n"
               "usemtl caf\xc3\xa9\nf 1 2 3\n"
               "usemtl caf\xe8\nf 1 2 3\n" +
               std::string("usemtl a\0b\nf 1 2 3\n", 19) + "usemtl C:\\x\\y\nf 1 2 3\n");
  EXPECT_THAT(names_of(mesh, Segmentation::material),
              ElementsAre("dark  oak", "Material #25", "Material #26", "long name", "café", "café",
                          "cafè", std::string("a\0b", 3), "C:\\x\\y"));
  const Mesh groups = read_obj(std::string(corners) + "g front wheel\nf 1 2 3\ng wheel\nf 1 2 3\n");
  EXPECT_THAT(names_of(groups, Segmentation::group), ElementsAre("front wheel", "wheel"));
}

TEST(ObjSegments, OfFilesThatEndLinesWithCarriageReturns) {
  const Mesh mesh =
      read_obj("v 0 0 0\rv 1 0 0\rv 0 1 0\rusemtl a\\\rb\rf 1 2 3\rusemtl c\rf 1 2 3");
  EXPECT_THAT(names_of(mesh, Segmentation::material), ElementsAre("a b", "c"));
}

/// Over pieces of a megabyte each, against a count by this loop.
TEST(ObjSegments, OfLongFilesAreTheSameWithAnyNumberOfThreads) {
  std::string text = corners;
  Names materials, parts;
  std::string material = none, part = none;
  for (int i = 0; text.size() < 5U << 20; ++i) {
    if (i % 7 == 3) text += "usemtl " + (material = "m" + std::to_string(i * 31 % 11)) + "\n";
    if (i % 1000 == 999) text += "o " + (part = "p" + std::to_string(i)) + "\n";
    text += i % 5 == 0 ? "f 1 2 4 3\n" : "f 1 2 3\n";
    for (int k = i % 5 == 0 ? 2 : 1; k > 0; --k) {
      materials.push_back(material);
      parts.push_back(part);
    }
  }
  for (const int threads : {1, 4}) {
    ReadOptions options = with_segments();
    options.threads = threads;
    const Mesh mesh = read_obj(text, options);
    EXPECT_EQ(names_of(mesh, Segmentation::material), materials);
    EXPECT_EQ(names_of(mesh, Segmentation::part), parts);
  }
}

TEST(ObjSegments, AMillionNamesAndALongOne) {
  std::string text = corners;
  for (int i = 0; i < 1'000'000; ++i) text += "usemtl m" + std::to_string(i) + "\nf 1 2 3\n";
  text += "usemtl " + std::string(3'000'000, 'x') + "\nf 1 2 3\n";
  const Mesh mesh = read_obj(text);
  const TriangleSegments& segments = *mesh.segments_by(Segmentation::material);
  ASSERT_EQ(segments.names.size(), 1'000'001U);
  for (std::uint32_t t = 0; t < 1'000'001; ++t) ASSERT_EQ(segments.of(t), t);
  EXPECT_EQ(segments.names[999'999], "m999999");
  EXPECT_EQ(segments.names[1'000'000].size(), 3'000'000U);
}

std::string ply(const std::string& vertex_properties, const std::string& face_properties,
                const std::string& body, int vertices = 4, int faces = 2) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\n" + vertex_properties +
         "element face " + std::to_string(faces) + "\nproperty list uchar int vertex_indices\n" +
         face_properties + "end_header\n" + body;
}

struct ReadPly {
  Mesh mesh;
  Warnings warnings;
};

ReadPly read_ply(const std::string& bytes, const ReadOptions& options = with_segments()) {
  ReadPly result;
  result.mesh = mesh_files::read_ply(std::as_bytes(std::span(bytes.data(), bytes.size())), "a.ply",
                                     options, result.warnings);
  return result;
}

const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(PlyLabels, OfFacesAreNumbersOfTheFile) {
  const auto [mesh, warnings] =
      read_ply(ply("", "property int category_id\n", square + "4 0 1 2 3 17\n3 0 1 2 0\n"));
  EXPECT_THAT(labels_of(mesh), ElementsAre(17, 17, 0));
  EXPECT_THAT(warnings, IsEmpty());
}

TEST(PlyLabels, AreOfTheFirstNameInTheList) {
  const std::string body = square + "3 0 1 2 5 6 7\n3 0 2 3 8 9 10\n";
  EXPECT_THAT(labels_of(read_ply(ply("",
                                     "property int object_id\nproperty uchar segment\n"
                                     "property int other\n",
                                     body))
                            .mesh),
              ElementsAre(6, 9));
  EXPECT_THAT(labels_of(read_ply(ply("",
                                     "property int object_id\nproperty float label\n"
                                     "property int other\n",
                                     body))
                            .mesh),
              ElementsAre(5, 8));
}

TEST(PlyLabels, OfVerticesAreThoseInWhichTheCornersAgree) {
  const std::string body = "0 0 0 3\n1 0 0 3\n1 1 0 3\n0 1 0 4\n4 0 1 2 3\n3 0 1 2\n";
  const auto [mesh, warnings] = read_ply(ply("property ushort label\n", "", body));
  EXPECT_THAT(labels_of(mesh), ElementsAre(3, unsegmented, 3));
  EXPECT_THAT(warnings, IsEmpty());
  // Those of faces come before those of vertices.
  const std::string both = "0 0 0 3\n1 0 0 3\n1 1 0 3\n0 1 0 4\n3 0 1 2 9\n3 0 1 2 8\n";
  EXPECT_THAT(
      labels_of(read_ply(ply("property ushort label\n", "property int segment\n", both)).mesh),
      ElementsAre(9, 8));
}

TEST(PlyLabels, ThatAreNoNumbersFrom0AreNoneWithAWarning) {
  const auto [mesh, warnings] = read_ply(
      ply("", "property int label\n",
          square + "3 0 1 2 -1\n3 0 1 2 4294967294\n3 0 1 2 99999999999999999999\n3 0 1 2 nan\n"
                   "3 0 1 2 4294967293\n",
          4, 5));
  EXPECT_THAT(labels_of(mesh),
              ElementsAre(unsegmented, unsegmented, unsegmented, unsegmented, 4294967293U));
  EXPECT_THAT(warnings, ElementsAre("a.ply: 4 labels are no numbers from 0 to 4294967293: what has "
                                    "them counts as not labelled"));
}

TEST(PlyLabels, OfFloatsAndListsAreNotRead) {
  const auto [mesh, warnings] =
      read_ply(ply("property list uchar int label\n", "property float label\n",
                   "0 0 0 1 7\n1 0 0 0\n1 1 0 0\n0 1 0 0\n3 0 1 2 5\n3 0 1 2 5\n"));
  EXPECT_THAT(mesh.segments, IsEmpty());
  EXPECT_THAT(warnings, ElementsAre("a.ply: property label of element face is of floats: no labels "
                                    "are read from it, expected an integer",
                                    "a.ply: property label of element vertex is a list: no labels "
                                    "are read from it, expected an integer"));
}

TEST(PlyLabels, AreNothingWhereTheyAreNotAskedFor) {
  const std::string file = ply("", "property int label\n", square + "3 0 1 2 x\n3 0 1 2 1\n");
  const auto [mesh, warnings] = read_ply(file, {});
  EXPECT_THAT(mesh.segments, IsEmpty());
  EXPECT_THAT(warnings, IsEmpty());
}

template <class T>
void put(std::string& bytes, T value, bool big_endian) {
  std::array<char, sizeof(T)> raw;
  std::memcpy(raw.data(), &value, sizeof(T));
  if (big_endian) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

/// Faces of three and four corners, strips before or behind them, labels of faces or vertices.
std::string binary_ply(bool big_endian, bool of_faces, bool strips_first, bool list_in_vertices) {
  std::string header = "ply\nformat binary_" + std::string(big_endian ? "big" : "little") +
                       "_endian 1.0\nelement vertex 40\nproperty float x\n";
  header += of_faces ? "" : "property short label\n";
  header += list_in_vertices ? "property list uchar uchar more\n" : "";
  header += "property float y\nproperty float z\n";
  const std::string face_header = "element face 600\n" +
                                  std::string(of_faces ? "property uint segment_id\n" : "") +
                                  "property list uchar int vertex_indices\nproperty uchar last\n";
  const std::string strip_header = "element tristrips 1\nproperty list int int vertex_indices\n";
  header += strips_first ? strip_header + face_header : face_header + strip_header;
  std::string bytes = header + "end_header\n";
  for (int i = 0; i < 40; ++i) {
    put(bytes, static_cast<float>(i % 7), big_endian);
    if (!of_faces) put(bytes, static_cast<std::int16_t>(i / 6 - 1), big_endian);
    if (list_in_vertices) {
      put(bytes, static_cast<std::uint8_t>(i % 3), big_endian);
      bytes.append(static_cast<std::size_t>(i % 3), 'x');
    }
    put(bytes, static_cast<float>(i * i % 11), big_endian);
    put(bytes, 1.0F, big_endian);
  }
  std::string faces, strips;
  for (int i = 0; i < 600; ++i) {
    const int size = i % 9 == 0 ? 4 : 3;
    if (of_faces) put(faces, static_cast<std::uint32_t>(i * 7919 % 100000), big_endian);
    put(faces, static_cast<std::uint8_t>(size), big_endian);
    for (int k = 0; k < size; ++k) put(faces, std::int32_t{(i + k) % 40}, big_endian);
    put(faces, std::uint8_t{9}, big_endian);
  }
  put(strips, std::int32_t{12}, big_endian);
  for (int i = 0; i < 12; ++i) put(strips, std::int32_t{i}, big_endian);
  return bytes + (strips_first ? strips + faces : faces + strips);
}

TEST(PlyLabels, OfAStreamAreThoseOfTheReader) {
  const ScratchFolder folder;
  for (int bits = 0; bits < 16; ++bits) {
    const std::string bytes =
        binary_ply((bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0);
    SCOPED_TRACE(bits);
    const auto [mesh, warnings] = read_ply(bytes);
    const std::vector<std::uint32_t> labels = labels_of(mesh);
    EXPECT_THAT(labels, ::testing::Contains(unsegmented));
    EXPECT_THAT(labels, ::testing::Contains((bits & 2) != 0 ? 7919U : 2U));
    Warnings of_stream;
    const auto stream =
        open_triangle_stream(folder.write("a.ply", bytes), with_segments(), of_stream);
    ASSERT_EQ(stream->triangle_count(), labels.size());
    for (std::uint32_t t = 0; t < labels.size(); ++t)
      ASSERT_EQ(stream->label_of(t), labels[t]) << t;
    EXPECT_EQ(of_stream.size(), warnings.size());
    Warnings others;
    EXPECT_EQ(open_triangle_stream(folder.path() / "a.ply", {}, others)->label_of(0), unsegmented);
  }
}

using checks::five;
using checks::json;

checks::Read read_gltf(const json& asset) {
  return checks::read_bytes(asset.dump(), "test.gltf", with_segments());
}

TEST(GltfSegments, AreNamesOfMaterialsMeshesAndNodes) {
  checks::Asset asset = five({{"material", 1}});
  asset.tree["materials"] = {{{"name", "steel"}}, json::object(), {{"name", "steel"}}};
  json& primitives = asset.tree["meshes"][0]["primitives"];
  for (const int material : {0, 2, 1}) {
    primitives.push_back(primitives[0]);
    primitives.back()["material"] = material;
  }
  primitives.push_back(primitives[0]);
  primitives.back().erase("material");
  asset.tree["meshes"][0]["name"] = "wheel";
  asset.tree["nodes"] = {{{"mesh", 0}, {"name", "left"}}, {{"mesh", 0}}};
  asset.tree["scenes"][0]["nodes"] = {0, 1};
  const checks::Read read = read_gltf(asset.done());
  EXPECT_THAT(read.warnings, ElementsAre(HasSubstr("left over")));
  const Scene& scene = read.scene;
  ASSERT_EQ(scene.meshes.size(), 1U);
  EXPECT_THAT(names_of(scene.meshes[0], Segmentation::material),
              ElementsAre("material 1", "steel", "steel", "material 1", none));
  EXPECT_THAT(scene.meshes[0].segments_by(Segmentation::material)->names,
              ElementsAre("material 1", "steel"));
  EXPECT_THAT(names_of(scene.meshes[0], Segmentation::group),
              ElementsAre("wheel", "wheel", "wheel", "wheel", "wheel"));
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[0].segments->names.at(Segmentation::part), "left");
  EXPECT_EQ(scene.objects[1].segments->names.at(Segmentation::part), "wheel");
  EXPECT_EQ(checks::read_bytes(asset.done().dump()).scene.objects[0].segments, nullptr);
  EXPECT_THAT(checks::read_bytes(asset.done().dump()).scene.meshes[0].segments, IsEmpty());
}

TEST(GltfSegments, OfMaterialsThatAreWrongAreNone) {
  for (const json& wrong : {json(7), json("steel"), json(0.5), json(-1), json(nullptr)}) {
    checks::Asset asset = five({{"material", wrong}});
    asset.tree["materials"] = {{{"name", 5}}};
    const checks::Read read = read_gltf(asset.done());
    EXPECT_EQ(read.scene.meshes[0].segments_by(Segmentation::material), nullptr) << wrong;
    EXPECT_THAT(
        read.warnings,
        ::testing::Contains(HasSubstr("1 primitive has a material that is not in the file")));
  }
  checks::Asset asset = five({{"material", 0}});
  asset.tree["materials"] = {{{"name", 5}}};
  EXPECT_THAT(names_of(read_gltf(asset.done()).scene.meshes[0], Segmentation::material),
              ElementsAre("material 0"));
  asset.tree["materials"] = 3;
  EXPECT_EQ(read_gltf(asset.done()).scene.meshes[0].segments_by(Segmentation::material), nullptr);
}

}  // namespace
}  // namespace fathom
