#pragma once

#include "apps/shell/command.h"

/// Commands that ask which surface is visible where, and how far surfaces are apart.
namespace fathom::app {

void add_probe(Command& program);
void add_evaluate(Command& program);
void add_visible(Command& program);
void add_coplanar(Command& program);

}  // namespace fathom::app
