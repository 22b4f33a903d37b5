// Pieces of a file through blocks that are kept: the same bytes as the file has, or an error.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/files/random_access_file.h"
#include "tests/scratch_folder.h"

namespace fathom::files {
namespace {

using ::testing::HasSubstr;

/// Bytes that tell their place.
std::string numbered(std::size_t size) {
  std::string text(size, '\0');
  for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>((i * 2654435761U) >> 13);
  return text;
}

std::string read(const FileBlocks& blocks, std::uint64_t offset, std::size_t size) {
  std::string text(size, 'x');
  blocks.read(offset, std::as_writable_bytes(std::span(text)));
  return text;
}

TEST(FileBlocks, HoldTheBytesOfAnyPlace) {
  const ScratchFolder folder;
  const std::string text = numbered(10001);
  const RandomAccessFile file(folder.write("file", text));
  const FileBlocks blocks(file);
  for (const std::size_t offset : {0U, 1U, 4088U, 4095U, 4096U, 8191U, 9999U}) {
    for (const std::size_t size : {0U, 1U, 2U, 8U, 5000U}) {
      if (offset + size > text.size()) continue;
      EXPECT_TRUE(read(blocks, offset, size) == text.substr(offset, size)) << offset << " " << size;
    }
  }
}

/// More blocks than are kept, read by several threads: each takes the place of others.
TEST(FileBlocks, ManyTakeTurns) {
  const ScratchFolder folder;
  const std::string text = numbered(std::size_t{12} << 20);
  const RandomAccessFile file(folder.write("file", text));
  const FileBlocks blocks(file);
  std::vector<std::jthread> readers;
  for (unsigned seed = 0; seed < 3; ++seed) {
    readers.emplace_back([&, seed] {
      std::mt19937 draw(seed);
      for (int i = 0; i < 20000; ++i) {
        const std::size_t offset = draw() % (text.size() - 8);
        EXPECT_TRUE(read(blocks, offset, 8) == text.substr(offset, 8)) << offset;
      }
    });
  }
}

TEST(FileBlocks, AFileThatIsCutShortIsAnError) {
  const ScratchFolder folder;
  const auto path = folder.write("file", numbered(10000));
  const RandomAccessFile file(path);
  const FileBlocks blocks(file);
  std::filesystem::resize_file(path, 5000);
  for (int i = 0; i < 2; ++i)
    EXPECT_THAT(message_of<InputError>([&] { read(blocks, 6000, 4); }),
                HasSubstr("file: byte 5000: the file ends"));
  EXPECT_TRUE(read(blocks, 100, 4) == numbered(104).substr(100));
}

TEST(FileBlocks, BeyondTheEndIsAnError) {
  const ScratchFolder folder;
  const RandomAccessFile file(folder.write("file", "0123456789"));
  const FileBlocks blocks(file);
  EXPECT_THROW(read(blocks, 8, 4), InputError);
}

}  // namespace
}  // namespace fathom::files
