#pragma once

#include <string>

#include "fathom/image/compare.h"

namespace fathom::app {

/// What was compared with what.
struct Comparison {
  std::string truth, other;  ///< the names of the files
  CompareOptions options;
  MapComparison maps;
};

std::string as_text(const Comparison& comparison);
std::string as_json(const Comparison& comparison);

}  // namespace fathom::app
