#pragma once

#include "apps/shell/command.h"

/// Commands that look at maps, and `info`, which looks at any file.
namespace fathom::app {

void add_info(Command& program);
void add_preview(Command& program);
void add_compare(Command& program);
void add_convert(Command& program);

}  // namespace fathom::app
