#pragma once

#include <vector>

#include "apps/shell/program.h"

namespace fathom::app {

using AddCommand = void (*)(Program&);

/// The whole of a program that has these subcommands: reads the arguments, runs the command that
/// they name, and turns a failure into one line on standard error and its exit status. A command
/// that is none of these is started as a program of its own, if there is one (see companion.h).
int program_main(int argc, char** argv, const std::vector<AddCommand>& commands);

/// The whole of `fathom-NAME`, which takes the arguments of `fathom NAME` and speaks as that.
int companion_main(int argc, char** argv, const char* name, AddCommand command);

}  // namespace fathom::app
