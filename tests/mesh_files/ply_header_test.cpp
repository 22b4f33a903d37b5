#include "fathom/mesh_files/ply/ply_header.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace mesh_files;
using ::testing::HasSubstr;

const std::string good =
    "ply\n"
    "format binary_big_endian 1.0\n"
    "comment made by hand\n"
    "obj_info nothing\n"
    "element vertex 8\n"
    "property float x\n"
    "property double y\n"
    "property uchar red\n"
    "element face 6\n"
    "property short flags\n"
    "property list uint8 int32 vertex_indices\n"
    "end_header\n";

TEST(PlyHeader, SaysWhatStandsInTheBody) {
  Warnings warnings;
  const PlyHeader header = read_ply_header(good + "body", "FILE", warnings);
  EXPECT_EQ(header.encoding, PlyHeader::Encoding::big_endian);
  EXPECT_EQ(header.size, good.size());
  EXPECT_EQ(header.lines, 12U);
  ASSERT_EQ(header.elements.size(), 2U);
  const PlyElement& vertex = header.elements[0];
  EXPECT_EQ(vertex.count, 8U);
  EXPECT_EQ(vertex.least_row_size(), 4U + 8 + 1);
  EXPECT_FALSE(vertex.has_lists());
  EXPECT_EQ(vertex.find({"green", "red", "x"}), 0U);  // the first property that has a name
  EXPECT_EQ(vertex.find({"z"}), std::nullopt);
  EXPECT_EQ(vertex.properties[1].type, PlyType::float64);
  const PlyElement* face = header.find("face");
  ASSERT_EQ(face, &header.elements[1]);
  EXPECT_TRUE(face->has_lists());
  EXPECT_EQ(face->least_row_size(), 2U + 1);
  EXPECT_EQ(face->properties[1].count_type, PlyType::uint8);
  EXPECT_EQ(face->properties[1].type, PlyType::int32);
  EXPECT_EQ(header.find("edge"), nullptr);
}

TEST(PlyHeader, LinesEndAsTheFirstDoes) {
  Warnings warnings;
  for (const std::string end : {"\r\n", "\r"}) {
    std::string text;
    for (const char c : good) text += c == '\n' ? end : std::string(1, c);
    const PlyHeader header = read_ply_header(text + "\n\r\n", "FILE", warnings);
    EXPECT_EQ(header.size, text.size());
    EXPECT_EQ(header.elements.size(), 2U);
  }
}

TEST(PlyHeader, FaultsNameTheLine) {
  const auto fault = [](const std::string& from, const std::string& to) {
    std::string text = good;
    Warnings warnings;
    text.replace(text.find(from), from.size(), to);
    return message_of<InputError>([&] { read_ply_header(text, "FILE", warnings); });
  };
  EXPECT_THAT(fault("1.0", "1.1"), HasSubstr("FILE: line 2: expected version 1.0"));
  EXPECT_THAT(fault("binary_big", "big"), HasSubstr("line 2: expected ascii"));
  EXPECT_THAT(fault("vertex 8", "vertex -8"), HasSubstr("line 5"));
  EXPECT_THAT(fault("float x", "number x"), HasSubstr("line 6: expected a type"));
  EXPECT_THAT(fault("double y", "double x"), HasSubstr("line 7: property 'x' stands twice"));
  EXPECT_THAT(fault("face 6", "vertex 6"), HasSubstr("line 9: element 'vertex' stands twice"));
  EXPECT_THAT(fault("list uint8", "list float"), HasSubstr("line 11: the count of a list"));
  EXPECT_THAT(fault("element vertex 8\n", ""), HasSubstr("line 5: expected an element"));
  EXPECT_THAT(fault("format binary_big_endian 1.0\n", ""), HasSubstr("has no format"));
  EXPECT_THAT(fault("end_header\n", ""), HasSubstr("expected end_header"));
  EXPECT_THAT(fault("property uchar red", "porperty uchar red"),
              HasSubstr("line 8: expected format"));
  EXPECT_THAT(fault("element vertex", "elment vertex"), HasSubstr("line 6: expected an element"));
}

TEST(PlyHeader, LinesBeforeTheFirstElementAreIgnoredWithAWarning) {
  std::string text = good;
  text.replace(text.find("comment made"), 12, "Created");
  Warnings warnings;
  EXPECT_EQ(read_ply_header(text, "FILE", warnings).elements.size(), 2U);
  EXPECT_EQ(warnings, Warnings{"FILE: 1 line of the header begins with no keyword and is ignored, "
                               "the first is line 3"});
  text.insert(text.find("Created"), "and\nmore\n");
  EXPECT_EQ(read_ply_header(text, "FILE", warnings).elements.size(), 2U);
  EXPECT_EQ(
      warnings.back(),
      "FILE: 3 lines of the header begin with no keyword and are ignored, the first is line 3");
}

TEST(PlyHeader, SizesOfTypes) {
  const std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  for (int type = 0; type < 8; ++type) {
    EXPECT_EQ(size_of(static_cast<PlyType>(type)), sizes[type]);
    EXPECT_EQ(is_integer(static_cast<PlyType>(type)), type < 6);
  }
}

}  // namespace
}  // namespace fathom
