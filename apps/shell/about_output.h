#pragma once

#include <string>

#include "fathom/numeric/errors.h"

namespace fathom::app {

/// What `call` returns. An OutputError of it gets the name of the output before it:
/// "map.png: pixel (3, 5): …".
template <class Call>
auto about_output(const std::string& name, const Call& call) {
  try {
    return call();
  } catch (const OutputError& error) {
    throw OutputError(name + ": " + error.what());
  }
}

}  // namespace fathom::app
