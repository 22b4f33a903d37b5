#pragma once

#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"
#include "fathom/failures/unknown_name.h"

/// Models of renderers of which only the kind is known (docs/validation.md, "Models").
namespace fathom::attribution {

/// "gl-unorm16, gl-unorm24, …".
std::string model_names();

/// All models, in that order.
std::vector<RendererModel> named_models();

/// Whether the camera has the near and far between which a model's depths are stored.
bool has_clip_planes_for(const RendererModel& model, const Camera& camera);

/// Whether it is a model of OpenGL as VTK uses it.
bool is_of_vtk(const RendererModel& model);

/// Fails    UnknownName, with the existing names, if there is no such model.
RendererModel model_named(const std::string& name);

/// The failure for a name that no model has, and that is not in `more`, the other words that the
/// user may write. Suggests similar names, and the models of a renderer or a storage of that name:
/// "; did you mean 'gl-unorm24' or 'vtk-unorm24'?" for D24.
UnknownName unknown_model(const std::string& name, const std::vector<std::string>& more = {});

/// Assumptions about how a driver rasterizes, beyond the requirements and the queries of OpenGL:
/// taken from the sources of the drivers that are named here. Nothing is assumed about other
/// drivers, which gives wider bounds.
struct DriverFacts {
  /// Depth is interpolated between the corners before snapping.
  bool depth_before_snap = false;
  /// If false, corners are not snapped, whatever GL_SUBPIXEL_BITS is: edges are computed in
  /// binary32, for each triangle separately, so that a sample between two triangles that share an
  /// edge may belong to neither.
  bool snaps = true;
  /// Depths are rounded to the nearest code; OpenGL allows either neighbouring code ([GL46]
  /// 2.3.5.2).
  bool nearest_codes = false;
};

/// The facts about the driver whose GL_RENDERER occurs in `version`.
DriverFacts driver_facts(const std::string& version);

/// Puts the facts about the driver of `version` into a model, and the grid of corners of
/// `subpixel_bits`, which is GL_SUBPIXEL_BITS, if the driver snaps.
/// Needs    a model whose kind is a RasterModel.
void set_driver_facts(const std::string& version, int subpixel_bits, const Camera& camera,
                      RendererModel& model);

}  // namespace fathom::attribution
