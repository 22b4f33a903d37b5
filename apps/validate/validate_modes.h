#pragma once

#include "apps/shell/console.h"
#include "apps/validate/validate_arguments.h"

/// What `fathom validate` does by its options, one source for each.
namespace fathom::app {

/// `validate --against`: has renderers draw scenes and compares every map with the truth. Returns
/// the exit status, as ValidationReport::finish().
int validate_against(const ValidateArguments& arguments, const Console& console);

/// `validate --map`: compares a map that another renderer made with the truth. Returns the exit
/// status, as ValidationReport::finish().
int validate_map(const ValidateArguments& arguments, const Console& console);

/// `validate --render`: only draws, and writes the renderer's picture as a map. Returns the exit
/// status.
int validate_render(const ValidateArguments& arguments, const Console& console);

/// `validate --colour`: has VTK draw lit scenes and compares VTK's and the pipeline's pictures with
/// the bounds of their formulas (validation/colour). Returns the exit status: answer_is_no if a
/// pixel is unexplained, unusable_input if VTK did not draw or a scene cannot be compared.
int validate_colours(const ValidateArguments& arguments, const Console& console);

/// `validate --faults --against …`: faults of the catalogue in maps of real renderers. Prints
/// faults that are not found or wrongly named, writes faults.json and faults.md, and returns the
/// exit status: answer_is_no if a right map has a finding, or a large fault is not found and
/// rightly named; unusable_input if a renderer did not draw.
int validate_faults(const ValidateArguments& arguments, const Console& console);

/// `validate --rays`: has engines trace rays and compares every answer with the truth. Prints a
/// line for each engine and kind of rays, writes rays.json, and returns the exit status:
/// answer_is_no if an answer is wrong.
int validate_rays(const ValidateArguments& arguments, const Console& console);

}  // namespace fathom::app
