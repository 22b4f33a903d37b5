#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "fathom/mesh_files/read_mesh.h"

namespace fathom {
namespace {

using namespace mesh_files;

std::optional<FileFormat> kind_of(std::string_view text, const char* path = "file") {
  return recognise_format(std::as_bytes(std::span(text)), path);
}

TEST(RecogniseFormat, ByContentWhateverTheSuffix) {
  for (const char* path : {"file", "file.obj", "file.ply", "file.STL"}) {
    EXPECT_EQ(kind_of("glTF\2", path), FileFormat::gltf);
    EXPECT_EQ(kind_of("ply\r\nformat", path), FileFormat::ply);
    EXPECT_EQ(kind_of("\xEF\xBB\xBF"
                      "ply\n",
                      path),
              FileFormat::ply);
    EXPECT_EQ(kind_of("# a comment\n\nOFF\n", path), FileFormat::off);
    EXPECT_EQ(kind_of("STCNOFF 1 2 3", path), FileFormat::off);
    EXPECT_EQ(kind_of("Solid of steel\n facet", path), FileFormat::stl);
    EXPECT_EQ(kind_of("# Blender\nmtllib a.mtl\n", path), FileFormat::obj);
    EXPECT_EQ(kind_of(" v 1 2 3", path), FileFormat::obj);
    EXPECT_EQ(kind_of("{\"asset\": {}}", path), FileFormat::gltf);
    EXPECT_EQ(kind_of("{\"meshes\": [\"asset\"]}", path), FileFormat::scene_json);
  }
}

TEST(RecogniseFormat, BinaryStlByItsSize) {
  std::string bytes(84 + 2 * 50, ' ');
  bytes.replace(0, 5, "solid");
  bytes.replace(80, 4, std::string("\2\0\0\0", 4));
  EXPECT_EQ(kind_of(bytes, "file.obj"), FileFormat::stl);
  EXPECT_EQ(kind_of(bytes.substr(1), "file.obj"), FileFormat::obj);
  // The beginning is enough where the size is told.
  const std::string_view head(bytes.data(), 84);
  EXPECT_EQ(recognise_format(std::as_bytes(std::span(head)), 184, "file"), FileFormat::stl);
}

TEST(RecogniseFormat, ByTheSuffixWhereTheContentDoesNotTell) {
  EXPECT_EQ(kind_of("1 2 3\n", "a.Off"), FileFormat::off);
  EXPECT_EQ(kind_of("", "a.obj"), FileFormat::obj);
  EXPECT_EQ(kind_of("?", "a.json"), FileFormat::scene_json);
  EXPECT_EQ(kind_of("{", "a.gltf"), FileFormat::gltf);
  EXPECT_EQ(kind_of("1 2 3\n", "a.off.txt"), std::nullopt);
  EXPECT_EQ(kind_of("", "obj"), std::nullopt);
}

}  // namespace
}  // namespace fathom
