#include "tests/engines/tested_engine.h"

#include <gtest/gtest.h>

#include <iostream>
#include <string_view>

namespace fathom::checks {
namespace {

Engine engine = Engine::reference;

/// Whether the argument names an engine, which then is the tested one.
bool take(std::string_view argument) {
  if (argument == "--engine=reference") {
    engine = Engine::reference;
  } else if (argument == "--engine=fast") {
    engine = Engine::fast;
  } else {
    return false;
  }
  return true;
}

}  // namespace

Engine tested_engine() {
  return engine;
}

}  // namespace fathom::checks

int main(int count, char** arguments) {
  testing::InitGoogleTest(&count, arguments);  // takes its own arguments out of the list
  for (int i = 1; i < count; ++i) {
    if (fathom::checks::take(arguments[i])) continue;
    std::cerr << "unknown argument: " << arguments[i] << '\n';
    return 2;
  }
  return RUN_ALL_TESTS();
}
