#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "apps/textbook/cases/case_reading.h"

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

}  // namespace fathom::app::cases
