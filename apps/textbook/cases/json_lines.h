#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/shell/output_file.h"
#include "apps/textbook/cases/case_reading.h"
#include "apps/textbook/drawing/picture.h"

namespace fathom::app::cases {

/// The answer to one case, without its name. Fails with InputError where the case cannot be done.
using AnswerCase = std::function<Json(const Json&)>;
/// The same, with the number of its line.
using AnswerLine = std::function<Json(const Json&, std::size_t line)>;

/// Reads cases, a JSON object a line, and prints an answer a line; `file` "-" is standard input. A
/// case that cannot be done answers {"error"}, the others go on.
/// Fails    InputError at the end if there were such cases, naming the first.
int answer_lines(const std::string& file, const AnswerCase& answer);
int answer_lines(const std::string& file, const AnswerLine& answer);

/// "FILE", or "standard input".
std::string input_name(const std::string& file);

/// The name of a picture of steps as an argument.
/// Fails    UsageError: "'text' does not end in .svg".
std::string parse_svg_name(const std::string& text);

/// --draw FILE.svg: the pictures of all cases of a command, one below the other, in one file.
class StepsPicture {
 public:
  /// An empty name: no picture. Opened before the work.
  explicit StepsPicture(const std::string& name) {
    if (!name.empty()) output_.emplace(name);
  }
  [[nodiscard]] bool is_wanted() const { return output_.has_value(); }
  void add(drawing::Picture picture) { pictures_.push_back(std::move(picture)); }
  /// Writes the file, where one is wanted.
  void finish(const std::string& title) {
    if (output_) output_->finish(drawing::document(title, pictures_));
  }

 private:
  std::optional<TextOutput> output_;
  std::vector<drawing::Picture> pictures_;
};

}  // namespace fathom::app::cases
