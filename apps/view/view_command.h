#pragma once

#include "apps/shell/command.h"

namespace fathom::app {

/// `view`: maps in a page for a browser.
void add_view(Command& program);

}  // namespace fathom::app
