#pragma once

#include "apps/shell/command.h"

/// The algorithms of the textbooks, by themselves and as a pipeline.
namespace fathom::app {

void add_clip(Command& program);
void add_scan(Command& program);
void add_pipeline(Command& program);

}  // namespace fathom::app
