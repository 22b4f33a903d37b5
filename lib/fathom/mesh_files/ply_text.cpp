#include "fathom/mesh_files/ply_text.h"

namespace fathom::mesh_files {
using namespace text;

void PlyTextRows::go_to_next_line(const char* what) {
  if (break_.empty())
    break_ = file_ + ": " + place() + ": expected " + what + ", found the end of the line";
  if (!cursor_.next_line_with_words()) cursor_.fail("the file ends");
}

void PlyTextRows::note_long_row() {
  try {
    TextCursor(cursor_).fail_here("expected the line to end");
  } catch (const InputError& failure) {
    break_ = failure.what();
  }
}

}  // namespace fathom::mesh_files
