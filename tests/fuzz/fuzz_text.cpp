// Any bytes as text: what a message shows of them is one line, and stays as it is when shown again;
// lines and words end where the bytes do.
#include <cstdint>

#include "fathom/failures/errors.h"
#include "fathom/text/decimal.h"
#include "fathom/text/json_value.h"
#include "fathom/text/printable.h"
#include "fathom/text/text_cursor.h"
#include "tests/fuzz/one_line.h"

namespace {

using namespace fathom;
using namespace fathom::text;

void check_printable(const std::string& text) {
  const std::string shown = printable(text);
  for (const char c : shown)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) std::abort();
  if (printable(shown) != shown) std::abort();
}

void check_words(std::string_view text, bool comments, bool continuation) {
  const std::string file = "input";
  TextCursor cursor(text, file, {comments, continuation});
  std::uint64_t line = 0;
  while (!cursor.at_end()) {
    if (cursor.line() < line) std::abort();
    line = cursor.line();
    const std::size_t rest = cursor.rest();
    if (!cursor.at_line_end() && cursor.word().empty()) std::abort();
    cursor.skip_line();
    if (cursor.rest() >= rest && rest > 0) std::abort();
  }
}

void check_number(std::string_view text) {
  const auto [value, end, fault] = parse_decimal<double>(text.data(), text.data() + text.size());
  if (end < text.data() || end > text.data() + text.size()) std::abort();
  if (fault == DecimalFault::none && !(value - value == 0)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(data, data + size);
  check_printable(text);
  for (const bool comments : {false, true})
    for (const bool continuation : {false, true}) check_words(text, comments, continuation);
  check_number(text);
  try {
    const JsonDocument document(text, "input");
    document.root().expect_only({"a"});
  } catch (const InputError& error) {
    fuzz::expect_one_line(error.what());
  }
  return 0;
}
