#pragma once

#include <cerrno>
#include <string>
#include <system_error>

#include "fathom/failures/errors.h"

namespace fathom::files {

/// Throws an InputError that says what could not be done with the file, and why (errno).
[[noreturn]] inline void fail_with_errno(const std::string& name, const char* what) {
  throw InputError(name + ": " + what + ": " + std::generic_category().message(errno));
}

}  // namespace fathom::files
