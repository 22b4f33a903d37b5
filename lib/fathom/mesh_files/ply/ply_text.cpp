#include "fathom/mesh_files/ply/ply_text.h"

namespace fathom::mesh_files {
using namespace text;

void PlyTextRows::note_break(const std::string& message) {
  std::uint64_t lines = 0;
  for (TextCursor line = start_; line.next_line_with_words(); line.skip_line()) ++lines;
  if (lines == rows_) throw InputError(message);
  break_ = message;
}

void PlyTextRows::go_to_next_line(const char* what) {
  if (break_.empty())
    note_break(file_ + ": " + place() + ": expected " + what + ", found the end of the line");
  if (!cursor_.next_line_with_words()) cursor_.fail("the file ends");
}

void PlyTextRows::note_long_row() {
  std::string message;
  try {
    TextCursor(cursor_).fail_here("expected the line to end");
  } catch (const InputError& failure) {
    message = failure.what();
  }
  note_break(message);
}

}  // namespace fathom::mesh_files
