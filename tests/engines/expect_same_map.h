#pragma once

#include <gtest/gtest.h>

#include <cstring>

#include "fathom/fast/render_fast.h"
#include "fathom/reference/reference.h"

namespace fathom::checks {

inline const std::vector<Channel> every_channel{
    Channel::Z,     Channel::A,    Channel::Zlow,   Channel::distance,
    Channel::id,    Channel::face, Channel::object, Channel::material,
    Channel::group, Channel::part, Channel::label,  Channel::N,
    Channel::P,     Channel::bary, Channel::Nc,     Channel::Ns};
/// All that a scene that stays in its files can have.
inline const std::vector<Channel> streamed_channels = [] {
  std::vector<Channel> channels = every_channel;
  std::erase(channels, Channel::Ns);
  return channels;
}();
inline const std::vector<Channel> quick_channels{Channel::Z, Channel::A, Channel::id, Channel::face,
                                                 Channel::object};

/// The first pixel at which the values differ in a bit; nullopt if none.
template <class T>
std::optional<std::size_t> first_difference(const Samples<T>& a, const Samples<T>& b) {
  if (a.size() != b.size()) return std::min(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::memcmp(&a[i], &b[i], sizeof(T)) != 0) return i;
  }
  return std::nullopt;
}

inline void expect_same_map(const DepthMap& ours, const DepthMap& truth) {
  ASSERT_EQ(ours.channels.size(), truth.channels.size());
  for (std::size_t k = 0; k < truth.channels.size(); ++k) {
    const ImageChannel& a = ours.channels[k];
    const ImageChannel& b = truth.channels[k];
    ASSERT_EQ(a.name, b.name);
    ASSERT_EQ(a.values.index(), b.values.index());
    std::visit(
        [&](const auto& values) {
          const auto& others = std::get<std::decay_t<decltype(values)>>(a.values);
          const auto pixel = first_difference(others, values);
          if (!pixel) return;
          ADD_FAILURE() << b.name << " differs first at pixel (" << *pixel % truth.width << ", "
                        << *pixel / truth.width << "): " << std::hexfloat << others[*pixel]
                        << ", the reference has " << values[*pixel];
        },
        b.values);
  }
}

/// Renders with both engines and compares; returns the fast engine's statistics.
inline RenderStatistics expect_same(const Scene& scene, const Camera& camera,
                                    const RenderOptions& options) {
  const DepthMap truth = render_reference(scene, camera, options).map;
  const Rendered ours = render_fast(scene, camera, options);
  expect_same_map(ours.map, truth);
  return ours.statistics;
}

}  // namespace fathom::checks
