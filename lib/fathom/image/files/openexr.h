#pragma once

#include <Iex.h>
#include <ImfHeader.h>
#include <ImfIO.h>

#include <cstring>
#include <new>
#include <utility>
#include <vector>

#include "fathom/files/byte_order.h"
#include "fathom/files/file_bytes.h"
#include "fathom/image/depth_map.h"
#include "fathom/image/map_files.h"

namespace fathom::image {

/// OpenEXR reading from bytes in memory. At the positions `defused` (see check_exr_claims()) it
/// reads the letter X.
class ByteInput : public Imf::IStream {
 public:
  ByteInput(files::ByteView bytes, const std::string& name, std::vector<std::size_t> defused)
      : IStream(name.c_str()), bytes_(bytes), defused_(std::move(defused)) {}

  bool read(char to[], int count) override {
    if (count < 0 || static_cast<std::size_t>(count) > bytes_.size() - position_)
      throw Iex::InputExc("unexpected end of file");
    std::memcpy(to, bytes_.data() + position_, static_cast<std::size_t>(count));
    for (const std::size_t at : defused_) {
      if (at - position_ < static_cast<std::size_t>(count)) to[at - position_] = 'X';
    }
    position_ += static_cast<std::size_t>(count);
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override {
    if (position > bytes_.size()) throw Iex::InputExc("unexpected end of file");
    position_ = position;
  }

 private:
  files::ByteView bytes_;
  std::vector<std::size_t> defused_;
  std::size_t position_ = 0;
};

/// OpenEXR writing to bytes in memory.
class ByteOutput : public Imf::OStream {
 public:
  explicit ByteOutput(const std::string& name) : OStream(name.c_str()) {}

  void write(const char from[], int count) override {
    const auto length = static_cast<std::size_t>(count);
    if (position_ + length > bytes_.size()) bytes_.resize(position_ + length);
    std::memcpy(bytes_.data() + position_, from, length);
    position_ += length;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  /// The table of chunks, before which all else was written, ends here: the position just after the
  /// file has been opened.
  void table_of_chunks_ends_here() { end_of_table_ = position_; }
  /// Makes sure that the file, which has been closed by now, has all its chunks.
  /// Fails    std::bad_alloc if chunks are missing: if a task of OpenEXR's pool runs out of
  ///          memory, OpenEXR 3.1 takes the chunk for incomplete and stops without an error.
  void require_chunks(std::size_t chunks) const {
    constexpr std::size_t entry = sizeof(std::uint64_t);
    for (std::size_t i = 0; i < chunks; ++i) {
      const std::size_t at = end_of_table_ - entry * (i + 1);
      if (load<std::uint64_t>(&bytes_[at], std::endian::little) == 0) throw std::bad_alloc();
    }
  }

  [[nodiscard]] files::Bytes take() { return std::move(bytes_); }

 private:
  files::Bytes bytes_;
  std::size_t position_ = 0, end_of_table_ = 0;
};

/// Lets OpenEXR use this many threads (0: all of the machine). Returns the number of threads, which
/// is smaller if the system starts no more. OpenEXR has one pool for the whole process, which grows
/// to that number and never shrinks.
int reserve_exr_threads(int threads);

/// OpenEXR's message about a failure, on one line.
std::string exr_reason(const std::exception& failure);

/// OpenEXR's name of the compression.
Imf::Compression compression_of(Compression compression);
/// How many rows of pixels are compressed together.
std::uint32_t rows_of_a_chunk(Compression compression);

/// Puts the map's texts, its camera and the names of its objects into an EXR header.
void set_attributes(Imf::Header& header, const DepthMap& map);

/// Reads them back; every string attribute becomes a text.
void get_attributes(const Imf::Header& header, DepthMap& map);

}  // namespace fathom::image
