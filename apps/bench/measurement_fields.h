#pragma once

#include "apps/bench/measurement.h"
#include "validation/child/fields.h"

namespace fathom::validation {

/// The names under which a measurement comes from its process.
template <>
struct Fields<bench::Measurement> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    auto& [renderer, description, first_ms, milliseconds, peak_bytes, covered_pixels] = s;
    visit("renderer", renderer);
    visit("description", description);
    visit("first_ms", first_ms);
    visit("milliseconds", milliseconds);
    visit("peak_bytes", peak_bytes);
    visit("covered_pixels", covered_pixels);
  }
};

}  // namespace fathom::validation
