#pragma once

#include <string>

/// The version of Fathom that outputs contain: maps, pictures and the reports of `fathom validate`.
namespace fathom::text {

/// Name of the environment variable that replaces the version in outputs, so that builds of
/// different versions write equal bytes, as SOURCE_DATE_EPOCH does for dates.
constexpr const char* version_variable = "FATHOM_VERSION_IN_OUTPUTS";

/// The version of this build, such as "0.1.0", or the value of the variable if it is set and not
/// empty. Reads the environment once per process.
const std::string& version_in_outputs();

/// The same with the name of the program, such as "Fathom 0.1.0".
std::string software_in_outputs();

}  // namespace fathom::text
