#pragma once

#include <charconv>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

#include "fathom/camera/camera_import_internal.h"

/// Files of words and numbers, line by line, as COLMAP and most data sets write their cameras.
/// Fails    all of them: InputError "FILE: line N: …".
namespace fathom::camera {

/// A line of a text file and where it is.
struct Line {
  std::istringstream words;
  std::string where;
};

/// The next line that is neither empty nor a comment (#). `number` counts all lines.
bool next_line(NamedStream& file, std::size_t& number, Line& line);

/// All such lines of a text. `name` is the file's.
std::vector<Line> lines_of(std::string_view text, const std::string& name);

/// The next word; `what` it is, for messages.
std::string read_word(Line& line, const char* what);

[[noreturn]] void refuse(const Line& line, const char* what, const std::string& word);

template <class Integer>
Integer read_integer(Line& line, const char* what) {
  const std::string word = read_word(line, what);
  Integer value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size()) refuse(line, what, word);
  return value;
}

/// A finite number, its decimal text rounded once.
double read_number(Line& line, const char* what);

/// The same of a single word; NaN where the word stands for no finite number ("nan", "-inf").
/// `where` begins the message.
double number_of(const std::string& word, const std::string& where);

/// The numbers that are left on a line, as number_of().
std::vector<double> rest_of(Line& line);

}  // namespace fathom::camera
