// Whole files: mapped where they are large, read where they are small, with the same bytes; and
// written back.
#include "fathom/text/input_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "fathom/numeric/errors.h"
#include "fathom/text/file_bytes.h"
#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace text;
using ::testing::HasSubstr;

/// Bytes that tell their place.
std::string numbered(std::size_t size) {
  std::string text(size, '\0');
  for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>((i * 2654435761U) >> 13);
  return text;
}

TEST(InputFile, SmallAndLargeFilesAreTheirBytes) {
  const ScratchFolder folder;
  for (const std::size_t size : {0U, 1U, 4095U, 65536U, 1U << 20, (5U << 20) + 7}) {
    const std::string text = numbered(size);
    const auto path = folder.write(std::to_string(size), text);
    EXPECT_TRUE(InputFile(path).text() == text) << size;
  }
}

/// Above 64 MiB, which are not written out: a file has a hole there.
TEST(InputFile, FilesThatAreMappedAreTheirBytesToo) {
  const ScratchFolder folder;
  const auto path = folder.write("large", "begin");
  constexpr std::uint64_t size = (std::uint64_t{64} << 20) + 3;
  std::filesystem::resize_file(path, size - 3);
  std::ofstream(path, std::ios::binary | std::ios::app) << "end";
  const InputFile file(path);
  ASSERT_EQ(file.text().size(), size);
  EXPECT_TRUE(file.text().starts_with("begin"));
  EXPECT_EQ(file.text()[size / 2], '\0');
  EXPECT_TRUE(file.text().ends_with("end"));
}

TEST(InputFile, NamesWhatCannotBeRead) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of<InputError>([&] { InputFile file(folder.path() / "none"); }),
              HasSubstr("none: "));
  EXPECT_THAT(message_of<InputError>([&] { InputFile file(folder.path()); }),
              HasSubstr("is a directory"));
}

TEST(FileBytes, WhatIsWrittenIsReadAgain) {
  const ScratchFolder folder;
  Bytes bytes;
  append(bytes, "ab");
  append(bytes, Bytes{std::byte{0}, std::byte{255}});
  write_file(folder.path() / "file", bytes);
  EXPECT_EQ(InputFile(folder.path() / "file").text(), std::string_view("ab\0\xFF", 4));
}

TEST(FileBytes, NamesWhatCannotBeWritten) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of<OutputError>([&] { write_file(folder.path() / "no/file", {}); }),
              HasSubstr("no/file: "));
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const Bytes much(1U << 20);
  EXPECT_THAT(message_of<OutputError>([&] { write_file("/dev/full", much); }),
              HasSubstr("/dev/full: No space left"));
}

}  // namespace
}  // namespace fathom
