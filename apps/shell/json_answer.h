#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fathom/text/printable.h"

namespace fathom::app {

/// An answer in JSON as it is printed, with an end of the line. An indentation of -1: all in one
/// line. Names of files that are not UTF-8 are shown with U+FFFD in place of what is not; what
/// could have effects on a terminal is escaped.
inline std::string json_answer(const nlohmann::ordered_json& answer, int indentation = 2) {
  return text::escaped_json(answer.dump(indentation, ' ', false,
                                        nlohmann::ordered_json::error_handler_t::replace)) +
         "\n";
}

}  // namespace fathom::app
