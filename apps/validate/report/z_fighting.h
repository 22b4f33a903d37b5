#pragma once

#include <string>

#include "apps/validate/report/validation_case.h"

/// How reports speak of z-fighting. Where a map has no numbers of triangles, a wrong surface with
/// the depth of the right one cannot be seen: the pixels of the class are then the least number
/// that fight, and not their number.
namespace fathom::validation {

/// "2874", "at least 3: no triangle numbers were read", "unknown: no triangle numbers were read".
std::string z_fight_count_text(const ValidationCase& c);

/// In a list of counts: "2874 z-fight (0 by the format alone)", "z-fight unknown (no triangle
/// numbers)"; empty where numbers were read and nothing fights, nor would by the format alone.
std::string z_fight_clause(const ValidationCase& c);

}  // namespace fathom::validation
