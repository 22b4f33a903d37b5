#pragma once

#include <array>

#include "apps/shell/command.h"
#include "fathom/camera/camera_making.h"

namespace fathom::app {

/// `--view --up`: where a camera stands as seen from what it looks at.
std::array<Option, 2> add_view_options(Command& command, View& view);

/// Parts of a lens, an option or two each; `--fov` is the vertical angle.
Option add_size_option(Command& command, Lens& lens);
Option add_fov_option(Command& command, Lens& lens);
/// `--near --far`
std::array<Option, 2> add_range_options(Command& command, Lens& lens);

/// `--size --fov --focal --orthographic --near --far`: the whole lens of a camera that is made.
void add_lens_options(Command& command, Lens& lens);

}  // namespace fathom::app
