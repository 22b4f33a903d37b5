#pragma once

#include <string>
#include <string_view>

namespace fathom::app {

/// The first document of a YAML text as JSON, for readers of JSON. JSON is YAML, too, and so is
/// what OpenCV's FileStorage writes, with its first line "%YAML:1.0". Tags are left out.
///
/// Exact    numbers are rounded once to binary64, as readers of JSON round them; "320." is one.
///          "true", "false", "null" and "~" mean what they mean in JSON, and all other scalars are
///          strings.
/// Fails    InputError "FILE: line N: …": syntax, an alias, a key that is a list or an object, a
///          number beyond binary64; and for a text above 16 MiB or without a document.
std::string json_of_yaml(std::string_view yaml, const std::string& file);

}  // namespace fathom::app
