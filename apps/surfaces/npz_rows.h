#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fathom/files/file_bytes.h"

namespace fathom::app {

/// Writes an NPZ whose arrays grow together, row by row, without keeping them in memory. The shapes
/// are known at the beginning, so each array has its place in the file. Numbers of the archive have
/// 64 bits (ZIP64 [ZIP]): arrays may be larger than 4 GiB.
///
/// It does not compress.
class NpzRows {
 public:
  struct Array {
    std::string name;
    /// As NPY names it: "<f8".
    std::string type;
    /// The bytes of an element of that type.
    std::size_t element_bytes = 0;
    std::vector<std::uint64_t> shape;
  };

  /// `descriptor` is of an empty ordinary file, and `target` its name, for messages.
  NpzRows(int descriptor, std::string target, std::vector<Array> arrays);

  /// Appends bytes to an array.
  /// Fails    OutputError "TARGET: why".
  void append(std::size_t array, files::ByteView bytes);
  /// Writes the directory.
  /// Needs    arrays that are complete.
  void finish();

 private:
  struct Place {
    Array array;
    std::uint64_t header_at = 0, content_at = 0, written = 0, size = 0;
    std::uint32_t crc = 0;
  };
  void write_at(std::uint64_t at, files::ByteView bytes) const;

  int descriptor_;
  std::string target_;
  std::vector<Place> places_;
  std::uint64_t end_ = 0;
};

}  // namespace fathom::app
