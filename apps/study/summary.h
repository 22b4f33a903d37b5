#pragma once

#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "apps/study/table.h"

namespace fathom::studies {

/// What summary.json holds, in its order: values, and tables as lists of an object for each row.
/// Keys may have members and lists, as those of columns have.
using Summary = std::vector<std::pair<std::string, std::variant<Cell, Table>>>;

std::string json_of(const Summary& summary);

}  // namespace fathom::studies
