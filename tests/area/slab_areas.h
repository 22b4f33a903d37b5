#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tests/oracle/areas.h"

/// The slow answer to what a distant light sees of triangles, straight from the definition: the
/// plane is cut into slabs between which nothing crosses, in GMP's rational numbers. No cameras, no
/// forms, no parts.
namespace fathom::checks {

/// What is visible of a triangle: its share of the triangle, and its centre times that.
struct SlabArea {
  oracle::Q share;
  oracle::Vector moment;
};

/// By the numbers of triangles; the lowest of equally near ones is visible.
std::vector<SlabArea> slab_areas(const std::vector<oracle::Triangle>& triangles,
                                 const oracle::Vector& direction);

}  // namespace fathom::checks
