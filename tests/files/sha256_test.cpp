// The examples of FIPS 180-4, and a file that is read piece by piece.
#include "fathom/files/sha256.h"

#include <gtest/gtest.h>

#include <string_view>

#include "tests/scratch_folder.h"

namespace fathom {
namespace {

using namespace files;

std::string hash_of(std::string_view text) {
  return sha256(std::as_bytes(std::span(text)));
}

TEST(Sha256, ExamplesOfTheStandard) {
  EXPECT_EQ(hash_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash_of("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

/// A million letters a, the standard's long example; and more than the 2²⁰ bytes of a piece.
TEST(Sha256, FilesAreWhatTheirBytesAre) {
  const ScratchFolder folder;
  const std::string million(1000000, 'a');
  const RandomAccessFile file(folder.write("million", million));
  EXPECT_EQ(sha256(file), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  const std::string more = million + "b" + million + "c" + million;
  EXPECT_EQ(sha256(RandomAccessFile(folder.write("more", more))), hash_of(more));
  EXPECT_EQ(sha256(RandomAccessFile(folder.write("empty", ""))), hash_of(""));
}

}  // namespace
}  // namespace fathom
