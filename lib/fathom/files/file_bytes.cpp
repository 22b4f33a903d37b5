#include "fathom/files/file_bytes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "fathom/failures/errors.h"

namespace fathom::files {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

std::string why(const std::filesystem::path& path, int error) {
  return path.string() + ": " + std::strerror(error);
}

}  // namespace

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

}  // namespace fathom::files
