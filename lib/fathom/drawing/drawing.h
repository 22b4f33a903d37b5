#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "fathom/area/visible_edges.h"

namespace fathom {

/// A place on the image, in pixels, y down: exact coordinates rounded once to binary32, the numbers
/// that readers of SVG and PDF compute with at least.
using DrawnPoint = std::array<float, 2>;
/// Points joined by straight lines.
using DrawnPath = std::vector<DrawnPoint>;

/// The lines of an object.
struct DrawingLayer {
  std::string name;
  std::vector<DrawnPath> paths;
};

/// Visible edges of a scene, one layer for each object, in their order.
struct Drawing {
  std::uint32_t width = 0, height = 0;
  std::vector<DrawingLayer> layers;
};

/// Draws the visible edges of a scene: each once, in the layer of the object that owns it
/// (VisibleEdge). Paths run along several edges where these meet.
/// Exact    visibility; places are rounded once.
/// Fails    as visible_edges().
Drawing draw(const TriangleSource& triangles, const Camera& camera, const EdgeOptions& options,
             const std::function<void(double)>& progress = {});

/// Lines of this width, in pixels, black, with round ends.
struct DrawingStyle {
  double stroke = 1;
};

/// The drawing as SVG 1.1. The unit is a pixel; each layer is a group with the id "object-N" and
/// the name as its title, which Inkscape shows as a layer.
/// Fails    UsageError unless the stroke is finite and positive.
std::string svg_of(const Drawing& drawing, const DrawingStyle& style = {});

/// The drawing as PDF 1.5. A pixel is 1/96 inch, or less where the page would be larger than 200
/// inches; each layer is an optional content group.
/// Fails    as svg_of().
std::string pdf_of(const Drawing& drawing, const DrawingStyle& style = {});

}  // namespace fathom
