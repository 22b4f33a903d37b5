#pragma once

#include <string>
#include <utility>

#include "apps/shell/command.h"

namespace fathom::app {

/// The spelling that every "-o,--output" also takes. Help and completion show one name only.
inline constexpr const char* other_name_of_output = "--out";

/// The option that says where a command writes: "-o,--output", and other_name_of_output. `target` is a
/// std::string or a TakeText.
template <class Target>
Option add_output_option(Command& command, const std::string& value_name, Target&& target,
                         const std::string& help) {
  return command.option(std::string("-o,--output,") + other_name_of_output, value_name,
                        std::forward<Target>(target), help);
}

}  // namespace fathom::app
