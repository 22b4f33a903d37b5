#include "apps/formats/one_file.h"

#include <algorithm>
#include <assimp/IOStream.hpp>
#include <cstring>

namespace fathom::app {
namespace {

/// Reads the bytes. As assimp's own streams of memory do, it counts the offset of a seek from the
/// end backwards, and a seek beyond either end fails.
class MemoryStream final : public Assimp::IOStream {
 public:
  explicit MemoryStream(std::span<const std::byte> bytes) : bytes_(bytes) {}

  std::size_t Read(void* buffer, std::size_t size, std::size_t count) override {
    if (size == 0) return 0;
    const std::size_t whole = std::min(count, (bytes_.size() - at_) / size);
    if (whole > 0) std::memcpy(buffer, bytes_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  std::size_t Write(const void*, std::size_t, std::size_t) override { return 0; }
  aiReturn Seek(std::size_t offset, aiOrigin origin) override {
    const std::size_t size = bytes_.size();
    if (origin == aiOrigin_CUR) offset += at_;  // modulo 2⁶⁴: a step back is one, too
    if (offset > size) return aiReturn_FAILURE;
    at_ = origin == aiOrigin_END ? size - offset : offset;
    return aiReturn_SUCCESS;
  }
  std::size_t Tell() const override { return at_; }
  std::size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

}  // namespace

Assimp::IOStream* OneFile::Open(const char* path, const char* mode) {
  const bool writes = std::strpbrk(mode, "wa+") != nullptr;
  return Exists(path) && !writes ? new MemoryStream(bytes_) : nullptr;
}

void OneFile::Close(Assimp::IOStream* stream) {
  delete stream;
}

}  // namespace fathom::app
