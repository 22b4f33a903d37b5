#pragma once

#include "apps/camera/shutter_command.h"
#include "apps/shell/command.h"

/// Commands of `fathom`, `fathom-surfaces` and `fathom-textbook`. `render` is in
/// render/render_command.h, and `dataset` in dataset/dataset_command.h.
namespace fathom::app {

// Commands that look at maps, and `info`, which looks at any file.

void add_info(Command& program);
void add_preview(Command& program);
void add_compare(Command& program);
void add_convert(Command& program);

// Commands about visible surfaces and distances between surfaces.

void add_probe(Command& program);
void add_evaluate(Command& program);
void add_visible(Command& program);
void add_areas(Command& program);
void add_coplanar(Command& program);

/// `fathom sun`: directions towards the sun, for `areas`.
void add_sun(Command& program);

/// `fathom draw`: visible edges as SVG or PDF.
void add_draw(Command& program);

/// `fathom cast`: which triangles rays meet.
void add_cast(Command& program);
/// `fathom sees`: which points see each other.
void add_sees(Command& program);

/// `fathom doctor`: faults of the cameras and depth images of a mesh.
void add_doctor(Command& program);

/// `fathom depth encode | decode | resolution | codes`: depth formats as a calculator.
void add_depth(Command& program);

/// `fathom camera look-at | orbit | directions | shutter | import …`: makes camera files and rays.
void add_camera(Command& program, const ShutterRun& shutter);
/// `fathom camera shutter` alone, as fathom-surfaces has it.
void add_camera_shutter(Command& program);

// The algorithms of the textbooks, by themselves and as a pipeline.

void add_clip(Command& program);
void add_scan(Command& program);
void add_pipeline(Command& program);

}  // namespace fathom::app
