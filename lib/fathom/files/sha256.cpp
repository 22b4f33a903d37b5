// Calls OpenSSL's SHA-256 functions directly, although they are deprecated in favour of its
// providers: setting up the providers takes longer than hashing a small file, and crashes if memory
// runs out.
#define OPENSSL_SUPPRESS_DEPRECATED
#include "fathom/files/sha256.h"

#include <openssl/sha.h>

#include <algorithm>
#include <array>
#include <vector>

#include "fathom/threads/interruption.h"

namespace fathom::files {

namespace {

/// Takes no memory and cannot fail.
class Sha256 {
 public:
  Sha256() { SHA256_Init(&state_); }
  void add(std::span<const std::byte> bytes) { SHA256_Update(&state_, bytes.data(), bytes.size()); }
  [[nodiscard]] std::string in_hexadecimal() {
    std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
    SHA256_Final(digest.data(), &state_);
    std::string text;
    for (const unsigned char byte : digest) {
      text += "0123456789abcdef"[byte >> 4];
      text += "0123456789abcdef"[byte & 15];
    }
    return text;
  }

 private:
  SHA256_CTX state_{};
};

}  // namespace

std::string sha256(std::span<const std::byte> bytes) {
  constexpr std::size_t at_once = std::size_t{1} << 20;
  Sha256 hash;
  for (; !bytes.empty(); bytes = bytes.subspan(std::min(bytes.size(), at_once))) {
    check_interruption();
    hash.add(bytes.first(std::min(bytes.size(), at_once)));
  }
  return hash.in_hexadecimal();
}

std::string sha256(const RandomAccessFile& file) {
  Sha256 hash;
  std::vector<std::byte> bytes(
      static_cast<std::size_t>(std::min<std::uint64_t>(std::uint64_t{1} << 20, file.size())));
  for (std::uint64_t offset = 0; offset < file.size();) {
    const std::span part = std::span(bytes).first(
        static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), file.size() - offset)));
    check_interruption();
    file.read(offset, part);
    hash.add(part);
    offset += part.size();
  }
  return hash.in_hexadecimal();
}

}  // namespace fathom::files
