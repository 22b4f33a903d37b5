#include "apps/mpi/banded_exr.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <utility>

#include "apps/shell/standard_streams.h"
#include "fathom/files/byte_order.h"
#include "fathom/files/descriptor.h"

namespace fathom::app {
using namespace files;

namespace {

/// Writes an EXR from its beginning to its end; at last, the table of where its chunks are.
class ExrFile {
 public:
  ExrFile(const std::filesystem::path& path, const Bytes& beginning, std::size_t chunks)
      : path_(path),
        file_(::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC)),
        table_(chunks * sizeof(std::uint64_t)),
        table_at_(beginning.size() - table_.size()) {
    if (!file_.is_open()) fail_with_errno(path_, errno);
    write(beginning);
  }

  void add(std::uint32_t first_row, ByteView chunk) {
    store<std::uint64_t>(&table_[next_++ * sizeof(std::uint64_t)], size_, std::endian::little);
    Bytes head(2 * sizeof(std::uint32_t));
    store(&head[0], first_row, std::endian::little);
    store(&head[sizeof first_row], static_cast<std::uint32_t>(chunk.size()), std::endian::little);
    write(head);
    write(chunk);
  }

  void finish() {
    if (::lseek(file_.get(), static_cast<off_t>(table_at_), SEEK_SET) < 0)
      fail_with_errno(path_, errno);
    write(table_);
    if (!file_.close()) fail_with_errno(path_, errno);
  }

 private:
  void write(ByteView bytes) {
    write_all(file_.get(), reinterpret_cast<const char*>(bytes.data()), bytes.size(), path_);
    size_ += bytes.size();
  }

  std::filesystem::path path_;
  Descriptor file_;
  Bytes table_;
  std::size_t table_at_;
  std::size_t next_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace

void WaitingChunks::add(files::Bytes chunk) {
  const std::uint64_t size = chunk.size();
  bytes_ += size;
  if (bytes_ <= most_bytes_) {
    chunks_.push_back({std::move(chunk), 0, 0});
    return;
  }
  if (!file_) file_.emplace();
  chunks_.push_back({{}, file_->append(chunk), size});
}

files::Bytes WaitingChunks::take() {
  Chunk& chunk = chunks_.at(next_++);
  if (chunk.size == 0) return std::exchange(chunk.bytes, {});
  files::Bytes bytes(chunk.size);
  file_->read(chunk.offset, bytes);
  return bytes;
}

void write_banded_exr(const Ranks& ranks, const std::filesystem::path& path, const Bytes& beginning,
                      std::span<const int> of_chunks, std::uint32_t rows_of_chunk,
                      WaitingChunks& own_chunks) {
  std::exception_ptr failure;
  const auto unless_failed = [&](const auto& work) {
    if (failure) return;
    try {
      work();
    } catch (...) {
      failure = std::current_exception();
    }
  };
  std::optional<ExrFile> file;
  if (ranks.is_first()) unless_failed([&] { file.emplace(path, beginning, of_chunks.size()); });
  for (std::size_t i = 0; i < of_chunks.size(); ++i) {
    Bytes chunk;
    const bool is_own = of_chunks[i] == ranks.self();
    if (is_own) unless_failed([&] { chunk = own_chunks.take(); });
    if (!ranks.is_first()) {
      if (is_own) ranks.send_to_first(chunk);
      continue;
    }
    if (!is_own) chunk = ranks.receive_from(of_chunks[i]);
    unless_failed([&] { file->add(static_cast<std::uint32_t>(i) * rows_of_chunk, chunk); });
  }
  if (file) unless_failed([&] { file->finish(); });
  if (failure) std::rethrow_exception(failure);
}

}  // namespace fathom::app
