#pragma once

#include "fathom/depth_format/depth_format.h"
#include "fathom/numeric/ratio.h"

/// Polygon offset and depth bias, exactly, as the interfaces define them: an offset of the window
/// depth of a polygon's fragments, added before the depth is stored.
///
///   o = clamp(m·slope_factor + r·constant_factor)
///
///   m   the greatest slope of the window depth, max(|∂z/∂x|, |∂z/∂y|). OpenGL and Vulkan define
///       √((∂z/∂x)² + (∂z/∂y)²) and allow this; Direct3D defines this.
///   r   the least difference that the format resolves.
///       float formats: 2^(e − n) for the greatest exponent e of the window depths of the polygon
///       and n bits of significand without the hidden one, in all three interfaces.
///       unorm formats: Direct3D: the least value above 0, 1/(2ⁿ − 1). OpenGL and Vulkan leave it
///       to the implementation: a constant such that depths that differ by r are stored
///       differently. The least such constant is 1/(2ⁿ − 1), used here; the 2⁻ⁿ that is often
///       quoted is too small: round((2ⁿ − 1)·x) can be the same for x and x + 2⁻ⁿ.
///   clamp   a limit of 0 (or, in OpenGL and Vulkan, NaN) leaves o as it is, a positive one is the
///       greatest o, a negative one the least.
///
/// Unit     window depths are in [0, 1], slopes per pixel.
/// Source   [GL46] 14.6.5; [VK13] Depth Bias Computation; [DX11] Depth Bias.
namespace fathom {

struct DepthBias {
  /// OpenGL's factor, Vulkan's depthBiasSlopeFactor, Direct3D's SlopeScaledDepthBias.
  double slope_factor = 0;
  /// OpenGL's units, Vulkan's depthBiasConstantFactor, Direct3D's integer DepthBias.
  double constant_factor = 0;
  double clamp = 0;
};

/// The window depth of a polygon, an affine function on the window: its slopes, and the greatest
/// magnitude that it has at a corner.
struct WindowSlopes {
  Ratio dz_dx, dz_dy;
  Ratio greatest_z;
};

/// r, exactly.
Ratio resolvable_difference(Storage storage, const Ratio& greatest_z);

/// o, exactly.
Ratio depth_offset(Storage storage, const DepthBias& bias, const WindowSlopes& slopes);

/// z + o, limited to [0, 1] as all three interfaces do before the depth is stored.
Ratio biased_depth(const Ratio& window_depth, const Ratio& offset);

}  // namespace fathom
