#pragma once

#include <functional>
#include <string>

#include "apps/textbook/cases/case_reading.h"

namespace fathom::app::cases {

/// The answer to one case, without its name. Fails with InputError where the case cannot be done.
using AnswerCase = std::function<Json(const Json&)>;

/// Reads cases, a JSON object a line, and prints an answer a line; `file` "-" is standard input. A
/// case that cannot be done answers {"error"}, the others go on.
/// Fails    InputError at the end if there were such cases, naming the first.
int answer_lines(const std::string& file, const AnswerCase& answer);

}  // namespace fathom::app::cases
