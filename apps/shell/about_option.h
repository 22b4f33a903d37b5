#pragma once

#include <string>

#include "fathom/numeric/errors.h"

namespace fathom::app {

/// What `call` returns. A UsageError of it gets the option before it: "--size: 'big' is not …".
template <class Call>
auto about_option(const std::string& option, const Call& call) {
  try {
    return call();
  } catch (const UsageError& error) {
    throw UsageError(option + ": " + error.what());
  }
}

}  // namespace fathom::app
