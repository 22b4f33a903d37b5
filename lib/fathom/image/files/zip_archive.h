#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fathom/files/file_bytes.h"

/// Archives of the ZIP format ([ZIP]), as far as NPZ needs them: written without compression, read
/// with or without DEFLATE; not encrypted, split or beyond 4 GiB (ZIP64).
namespace fathom::image {

/// Puts files into an archive, one after the other.
class ZipWriter {
 public:
  /// `name` is the archive's, for messages.
  explicit ZipWriter(std::string name) : name_(std::move(name)) {}
  /// Fails    OutputError if the archive would reach 4 GiB, or have more than 65534 files.
  void add(const std::string& file, files::ByteView content);
  /// The archive. Nothing can be added after that.
  files::Bytes take();

 private:
  void require_space(std::size_t more) const;

  std::string name_;
  files::Bytes bytes_, directory_;
  std::size_t files_ = 0;
};

/// A file in an archive. According to the directory it lies within the archive and overlaps no
/// other file.
struct ZipEntry {
  std::string name;
  bool deflated = false;
  std::uint32_t crc = 0;
  files::ByteView stored;
  /// Unpacked size in bytes: the stored size, or at most the size that DEFLATE can expand it to.
  std::size_t size = 0;
};

/// The directory of an archive, checked against the archive; nothing is unpacked.
/// Fails    InputError "NAME: corrupt or truncated ZIP archive: …".
std::vector<ZipEntry> read_zip_directory(files::ByteView bytes, const std::string& name);

/// The content of a file, in the archive itself or in `room`.
/// Fails    InputError if it is not as long as the directory says, or its checksum differs.
files::ByteView unpack(const ZipEntry& entry, files::Bytes& room, const std::string& name);

}  // namespace fathom::image
