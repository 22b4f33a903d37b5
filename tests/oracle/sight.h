#pragma once

#include "tests/oracle/ray_caster.h"

/// The slow answer to whether two points see each other (specification, section 12): brute force
/// over all triangles in rational numbers, by the sides of planes. Nothing of the library.
namespace fathom::oracle {

/// A + v·(B − A) + w·(C − A).
Vector point_of(const Triangle& triangle, const Q& v, const Q& w);

/// Whether no triangle, its edges included, has a point in the open segment pq, except triangles in
/// a plane that is parallel to it.
bool see_each_other(const Vector& p, const Vector& q, const std::vector<Triangle>& triangles);

}  // namespace fathom::oracle
