#pragma once

#include <vector>

#include "apps/shell/arguments.h"

namespace fathom::app {

/// The whole of a program that has these commands, and companions for others: does what the
/// arguments ask for, and turns a failure into one line on standard error and its exit status.
int program_main(int argc, char** argv, const std::vector<AddCommand>& commands,
                 const std::vector<Companion>& companions = {});

/// The whole of `fathom-NAME`, which takes the arguments of `fathom NAME` and speaks as that.
int companion_main(int argc, char** argv, const char* name, const AddCommand& command);

}  // namespace fathom::app
