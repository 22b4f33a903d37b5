#include "fathom/mesh_files/stl/stl_binary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "fathom/failures/errors.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace mesh_files;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// A head that claims so many triangles.
std::string head_of(std::uint32_t count, const std::string& beginning = "") {
  std::string head = beginning;
  head.resize(stl_header_size, ' ');
  std::memcpy(head.data() + 80, &count, sizeof count);
  return head;
}
auto bytes_of(const std::string& text) {
  return std::as_bytes(std::span(text));
}

TEST(StlBinary, SizesHoldTheTrianglesThatAreClaimed) {
  const std::string head = head_of(3);
  Warnings warnings;
  EXPECT_EQ(count_binary_stl(bytes_of(head), 84 + 150, "FILE", warnings), 3U);
  EXPECT_THAT(warnings, ElementsAre());
  EXPECT_EQ(count_binary_stl(bytes_of(head), 84 + 157, "FILE", warnings), 3U);
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("FILE: 7 bytes after the last triangle")));
  const auto fault = [&](const std::string& claim, std::uint64_t size) {
    return message_of<InputError>(
        [&] { count_binary_stl(bytes_of(claim), size, "FILE", warnings); });
  };
  EXPECT_THAT(fault(head, 233), HasSubstr("FILE: byte 233: the file ends, expected 234 bytes"));
  EXPECT_THAT(fault(head, 83), HasSubstr("byte 83"));
  // 2³² − 1 triangles of 50 bytes do not wrap around.
  EXPECT_THAT(fault(head_of(0xFFFFFFFF), 84), HasSubstr("expected 214748364834 bytes"));
}

TEST(StlBinary, TrianglesAreTwelveNumbers) {
  std::array<float, 12> values;
  for (std::size_t i = 0; i < 12; ++i) values[i] = static_cast<float>(i) + 0.5F;
  const auto read = [&] {
    return read_stl_triangle(reinterpret_cast<const std::byte*>(values.data()), 7, "FILE");
  };
  EXPECT_EQ(read(), values);
  values[0] = std::numeric_limits<float>::quiet_NaN();  // of the normal
  EXPECT_NO_THROW(read());
  values[4] = std::numeric_limits<float>::infinity();
  EXPECT_THAT(message_of<InputError>(read),
              HasSubstr("FILE: byte 450: a coordinate of triangle 7"));
}

TEST(StlBinary, IsToldFromText) {
  const auto is_binary = [](const std::string& head, std::uint64_t size) {
    return is_binary_stl(bytes_of(head), size);
  };
  EXPECT_TRUE(is_binary(head_of(2, "solid"), 84 + 100));  // its size says so
  EXPECT_FALSE(is_binary("solid name\n facet normal 0 0 0", 500));
  EXPECT_FALSE(is_binary("  SOLID\n", 500));
  EXPECT_TRUE(is_binary(std::string("solid\0", 6), 500));
  EXPECT_TRUE(is_binary("metal", 500));
  EXPECT_TRUE(is_binary("", 0));
}

}  // namespace
}  // namespace fathom
