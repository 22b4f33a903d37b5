#pragma once

#include <optional>
#include <string>

#include "apps/textbook/cases/case_reading.h"

/// The comparison of two answers to a case by `fathom clip --against`.
namespace fathom::app::clip {

using cases::Json;

/// Two algorithms by name.
struct Names {
  std::string first, second;
};

/// The first thing in which two answers differ, both written with Form::exact; nullopt if they are
/// the same. For answers with "polygons" it is
///   {"kind": "region", "only": NAME, "inside": point, "area": "p/q", "piece": [ring, …]}
///       a piece of the plane that only one of them has: the piece with the least corner
///   {"kind": "border", "only": NAME, "edge": [point, point]}
///       if the regions are the same: an edge that is a border of only one of them
///   {"kind": "polygons", "only": NAME, "polygon": [ring, …]}
///       if the borders are the same too: a polygon that only one of them has
/// for all other answers {"kind": "value", "at": "/key/0/1", NAME: value, NAME: value}.
/// Exact    regions are compared by CGAL, borders and values directly.
std::optional<Json> first_difference(const Json& first, const Json& second, const Names& names);

/// The difference in a line, for people.
std::string to_text(const Json& difference, const Names& names);

}  // namespace fathom::app::clip
