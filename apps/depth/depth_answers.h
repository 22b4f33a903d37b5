#pragma once

#include <string>

#include "fathom/depth_format/depth_format.h"

namespace fathom::app {

/// What is asked about a depth format: `text` is one VALUE.
struct DepthQuestion {
  const DepthFormat& format;
  bool clamp;  ///< takes depths outside of [near, far] as the nearer end
  const std::string& text;
};

/// An answer: as a line of text, and as a line of JSON.
struct DepthAnswer {
  std::string text, json;
};

/// All fail with UsageError where the text is no number, with InputError where the format has no
/// such depth or stored value.
DepthAnswer encode_answer(const DepthQuestion& question);
DepthAnswer decode_answer(const DepthQuestion& question);
DepthAnswer resolution_answer(const DepthQuestion& question);
DepthAnswer codes_answer(const DepthQuestion& question);

}  // namespace fathom::app
