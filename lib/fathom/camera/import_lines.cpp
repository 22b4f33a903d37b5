#include "fathom/camera/import_lines.h"

#include <limits>

#include "fathom/failures/errors.h"
#include "fathom/text/decimal.h"
#include "fathom/text/printable.h"

namespace fathom::camera {

using text::DecimalFault;
using text::parse_decimal;
using text::printable;

bool next_line(NamedStream& file, std::size_t& number, Line& line) {
  for (std::string text; std::getline(file.stream, text);) {
    ++number;
    if (!text.empty() && text.back() == '\r') text.pop_back();
    const auto first = text.find_first_not_of(" \t");
    if (first == std::string::npos || text[first] == '#') continue;
    line = {std::istringstream(text), file.name + ": line " + std::to_string(number)};
    return true;
  }
  return false;
}

std::vector<Line> lines_of(std::string_view text, const std::string& name) {
  std::istringstream stream{std::string(text)};
  NamedStream file{stream, name};
  std::vector<Line> lines;
  Line line;
  for (std::size_t number = 0; next_line(file, number, line);) lines.push_back(std::move(line));
  return lines;
}

std::string read_word(Line& line, const char* what) {
  std::string word;
  if (!(line.words >> word)) throw InputError(line.where + ": " + what + " is missing");
  return word;
}

void refuse(const Line& line, const char* what, const std::string& word) {
  throw InputError(line.where + ": expected " + what + ", found '" + printable(word) + "'");
}

double read_number(Line& line, const char* what) {
  const std::string word = read_word(line, what);
  const auto result = parse_decimal<double>(word.data(), word.data() + word.size());
  if (result.fault != DecimalFault::none || result.end != word.data() + word.size())
    refuse(line, what, word);
  return result.value;
}

double number_of(const std::string& word, const std::string& where) {
  const auto result = parse_decimal<double>(word.data(), word.data() + word.size());
  if (result.end == word.data() + word.size()) {
    if (result.fault == DecimalFault::none) return result.value;
    if (result.fault == DecimalFault::not_finite) return std::numeric_limits<double>::quiet_NaN();
  }
  throw InputError(where + ": expected a number, found '" + printable(word) + "'");
}

std::vector<double> rest_of(Line& line) {
  std::vector<double> numbers;
  for (std::string word; line.words >> word;) numbers.push_back(number_of(word, line.where));
  return numbers;
}

}  // namespace fathom::camera
