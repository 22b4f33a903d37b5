#pragma once

#include <optional>
#include <string>

#include "apps/textbook/cases/case_reading.h"

/// What `fathom clip --against` says about two answers to a case.
namespace fathom::app::clip {

using cases::Json;

/// Two algorithms by name.
struct Names {
  std::string first, second;
};

/// The first thing in which two answers differ, both written with Form::exact; nullopt if they are
/// the same. Of answers with "polygons" it is
///   {"kind": "region", "only": NAME, "inside": point, "area": "p/q", "piece": [ring, …]}
///       a piece of the plane that one of them has alone: the one with the least corner
///   {"kind": "border", "only": NAME, "edge": [point, point]}
///       where the regions are the same: an edge that is a border of one of them alone
///   {"kind": "polygons", "only": NAME, "polygon": [ring, …]}
///       where the borders are the same too: a polygon that one of them has alone
/// of all others {"kind": "value", "at": "/key/0/1", NAME: value, NAME: value}.
/// Exact    regions are compared by CGAL, borders and values as they stand.
std::optional<Json> first_difference(const Json& first, const Json& second, const Names& names);

/// The difference in a line, for people.
std::string to_text(const Json& difference, const Names& names);

}  // namespace fathom::app::clip
