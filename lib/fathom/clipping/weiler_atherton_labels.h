#pragma once

#include <vector>

#include "fathom/clipping/even_odd.h"
#include "fathom/clipping/points.h"
#include "fathom/clipping/weiler_atherton.h"

/// Weiler–Atherton, step 2: what lies beside every edge, and what that makes of every contact.
namespace fathom::clipping {

/// A piece of border between neighbouring corners or contacts: one, however many rings run there.
template <class Number>
struct LabelledEdge {
  Point2<Number> from, to;
  /// The polygons that have a ring along this edge.
  Border border;
  /// What lies beside it.
  Beside of_subject, of_clip;
};

/// Both sides, with their contacts entered.
template <class Number>
struct ContactLists {
  Rings<Number> subject, clip;
};

/// The labelled edges, in the order of the rings.
template <class Number>
std::vector<LabelledEdge<Number>> label_edges(const ContactLists<Number>& lists);

/// The contacts of the subject rings with the clip rings, in the order of the rings.
template <class Number>
std::vector<Contact<Number>> label_contacts(const ContactLists<Number>& lists);

}  // namespace fathom::clipping
