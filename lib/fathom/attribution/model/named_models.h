#pragma once

#include <string>
#include <vector>

#include "fathom/attribution/model/renderer_model.h"
#include "fathom/camera/camera.h"

/// Models of renderers of which no more is known than their kind (docs/validation.md, "Models").
namespace fathom::attribution {

/// "gl-unorm16, gl-unorm24, …".
std::string model_names();

/// All of them, in that order.
std::vector<RendererModel> named_models();

/// Whether the camera has the near and far between which a model's depths are stored.
bool has_clip_planes_for(const RendererModel& model, const Camera& camera);

/// Whether it is a model of OpenGL as VTK uses it.
bool is_of_vtk(const RendererModel& model);

/// Fails    UnknownName where there is no such model, naming those that there are.
RendererModel model_named(const std::string& name);

/// What is taken for known of how a driver rasterizes, beyond what OpenGL demands and answers: from
/// its sources, for the drivers that are named here. Of others nothing is, which gives wider
/// bounds.
struct DriverFacts {
  /// Depth is interpolated between the corners as they were before they were snapped.
  bool depth_before_snap = false;
  /// Corners are not snapped, whatever GL_SUBPIXEL_BITS says: edges are computed in binary32, anew
  /// for each triangle, so that a sample between two that share one may belong to neither.
  bool snaps = true;
  /// Depths are rounded to the nearest code; OpenGL allows either of the two about them ([GL46]
  /// 2.3.5.2).
  bool nearest_codes = false;
};

/// Of the driver that a version names: its GL_RENDERER somewhere in it.
DriverFacts driver_facts(const std::string& version);

/// Puts the facts of the driver of `version` into a model, and a grid of corners: that of
/// `subpixel_bits`, which is GL_SUBPIXEL_BITS, where the driver snaps.
/// Needs    a model whose kind is a RasterModel.
void set_driver_facts(const std::string& version, int subpixel_bits, const Camera& camera,
                      RendererModel& model);

}  // namespace fathom::attribution
