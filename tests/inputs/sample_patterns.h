#pragma once

#include <string>
#include <vector>

namespace fathom::checks {

/// One of every kind of sample pattern, as users name them.
inline const std::vector<std::string> all_patterns{
    "1",         "2",         "4",          "8",           "16", "rotated-grid",
    "regular:2", "regular:4", "jittered:2", "jittered:4:7"};

}  // namespace fathom::checks
