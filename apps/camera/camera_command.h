#pragma once

#include "apps/shell/command.h"

namespace fathom::app {

/// `fathom camera look-at | orbit | import …`
void add_camera(Command& program);

void add_look_at(Command& camera);
void add_orbit(Command& camera);
/// `fathom camera import colmap | nerf | bop | opengl`
void add_import(Command& camera);

}  // namespace fathom::app
