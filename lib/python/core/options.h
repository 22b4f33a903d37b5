#pragma once

#include <ranges>
#include <string>

#include "fathom/failures/errors.h"
#include "fathom/failures/unknown_name.h"
#include "fathom/render.h"

namespace fathom::python {

/// The value that a word of Python's names, of an enumeration with name_of().
/// Fails    UsageError: "compression: expected none, rle, zips, zip or piz, found lzma".
template <class Values>
std::ranges::range_value_t<Values> named_value(const std::string& argument, const Values& values,
                                               const std::string& name) {
  if (const auto value = value_named(values, name)) return *value;
  throw UsageError(argument + ": expected " + joined(names_of(values), " or ") + ", found " + name);
}

/// What counts of the options where areas are asked for.
RenderOptions options_of(const std::string& cull, int threads);

}  // namespace fathom::python
