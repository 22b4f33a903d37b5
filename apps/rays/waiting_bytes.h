#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "fathom/files/file_bytes.h"
#include "fathom/files/spill_file.h"

namespace fathom::app {

/// Bytes that are written now and read at the end. All but the last ones wait in a SpillFile.
class WaitingBytes {
 public:
  /// Fails    OutputError as SpillFile.
  void append(files::ByteView bytes);
  /// Calls take(piece) for one piece after the other, at least once if there are bytes.
  /// Fails    InputError as SpillFile.
  void for_each_piece(const std::function<void(files::ByteView)>& take) const;

 private:
  /// Behind the bytes of the file.
  files::Bytes last_;
  std::unique_ptr<files::SpillFile> file_;
};

}  // namespace fathom::app
