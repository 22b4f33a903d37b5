#pragma once

#include <ImfPixelType.h>

#include <array>
#include <cstddef>

#include "fathom/image/deep_map.h"

namespace fathom::image {

struct DeepChannel {
  const char* name;
  Imf::PixelType type;
  /// Where the value is within a sample, in bytes.
  std::size_t offset;
};

/// The channels of a deep file.
inline constexpr std::array<DeepChannel, 5> deep_channels{
    {{"A", Imf::FLOAT, offsetof(DeepSample, A)},
     {"Z", Imf::FLOAT, offsetof(DeepSample, Z)},
     {"ZBack", Imf::FLOAT, offsetof(DeepSample, ZBack)},
     {"area", Imf::FLOAT, offsetof(DeepSample, area)},
     {"id", Imf::UINT, offsetof(DeepSample, id)}}};

}  // namespace fathom::image
