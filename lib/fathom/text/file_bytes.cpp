#include "fathom/text/file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "fathom/numeric/errors.h"

namespace fathom::text {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string why(const std::filesystem::path& path, int error) {
  return path.string() + ": " + std::strerror(error);
}

}  // namespace

Bytes read_file(const std::filesystem::path& path) {
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw InputError(why(path, errno));
  std::error_code unknown;
  const auto size = std::filesystem::file_size(path, unknown);
  // One byte more than the file has, so that its end is met without growing. Pipes grow.
  Bytes bytes(unknown || size == 0 ? std::size_t{1} << 16 : size + 1);
  std::size_t length = 0;
  while (const std::size_t n =
             std::fread(bytes.data() + length, 1, bytes.size() - length, file.get())) {
    length += n;
    if (length == bytes.size()) bytes.resize(2 * bytes.size());
  }
  if (std::ferror(file.get())) throw InputError(why(path, errno));
  bytes.resize(length);
  return bytes;
}

void write_file(const std::filesystem::path& path, ByteView bytes) {
  File file(std::fopen(path.c_str(), "wb"));
  if (!file) throw OutputError(why(path, errno));
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file.get()) == bytes.size() &&
                       std::fflush(file.get()) == 0;
  const int error = errno;
  if (!written) throw OutputError(why(path, error));
  if (std::fclose(file.release()) != 0) throw OutputError(why(path, errno));
}

void append(Bytes& bytes, ByteView more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}

void append(Bytes& bytes, const std::string& text) {
  append(bytes, std::as_bytes(std::span(text)));
}

}  // namespace fathom::text
