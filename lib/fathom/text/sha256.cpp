#include "fathom/text/sha256.h"

#include <openssl/err.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

namespace fathom::text {

namespace {

using Digest = std::array<unsigned char, 32>;

/// OpenSSL says nothing at all where it has no memory to say it.
[[noreturn]] void fail() {
  const unsigned long error = ERR_peek_last_error();
  if (error == 0 || ERR_GET_REASON(error) == ERR_R_MALLOC_FAILURE) throw std::bad_alloc();
  throw std::runtime_error("SHA-256 is not available in this libcrypto");
}

std::string in_hexadecimal(const Digest& digest) {
  std::string text;
  for (const unsigned char byte : digest) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

}  // namespace

std::string sha256(std::span<const std::byte> bytes) {
  Digest digest{};
  unsigned int size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr) != 1)
    fail();
  return in_hexadecimal(digest);
}

std::string sha256(const RandomAccessFile& file) {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(),
                                                                        EVP_MD_CTX_free);
  if (!context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1) fail();
  std::vector<std::byte> bytes(
      static_cast<std::size_t>(std::min<std::uint64_t>(std::uint64_t{1} << 20, file.size())));
  for (std::uint64_t offset = 0; offset < file.size();) {
    const std::span part = std::span(bytes).first(
        static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), file.size() - offset)));
    file.read(offset, part);
    if (EVP_DigestUpdate(context.get(), part.data(), part.size()) != 1) fail();
    offset += part.size();
  }
  Digest digest{};
  unsigned int size = 0;
  if (EVP_DigestFinal_ex(context.get(), digest.data(), &size) != 1) fail();
  return in_hexadecimal(digest);
}

}  // namespace fathom::text
