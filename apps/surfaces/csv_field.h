#pragma once

#include <string>

#include "fathom/text/ascii.h"
#include "fathom/text/printable.h"

namespace fathom::app {

/// A name that is not ours as a field of CSV, in quotes.
inline std::string quoted(const std::string& text) {
  return text::in_csv_quotes(text::printable(text));
}

}  // namespace fathom::app
