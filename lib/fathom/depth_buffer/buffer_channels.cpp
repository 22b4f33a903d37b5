#include "fathom/depth_buffer/buffer_channels.h"

#include <bit>
#include <limits>

#include "fathom/numeric/rounding.h"

namespace fathom::depth_buffer {
namespace {

/// The value of a stored value of float16 or float32 as a binary32 number.
float value_of_float(Storage storage, StoredDepth stored) {
  if (storage == Storage::float32) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(stored.bits));
  }
  return widen_binary16(static_cast<std::uint16_t>(stored.bits));
}

StoredDepth stored_of(Storage storage, float value) {
  if (storage == Storage::float32) return {std::bit_cast<std::uint32_t>(value)};
  if (value < 0x1p-14F) return {static_cast<std::uint64_t>(value * 0x1p24F)};
  // Exponents are biased by 127 and 15, significands have 23 and 10 bits.
  return {(std::bit_cast<std::uint32_t>(value) >> 13) - ((127U - 15U) << 10)};
}

template <class T>
T* values(DepthMap& map, const char* name) {
  Samples<T>* found = map.values<T>(name);
  return found ? found->data() : nullptr;
}

}  // namespace

BufferChannels::BufferChannels(DepthMap& map, const DepthFormat& format, bool against_exact)
    : storage_(format.storage) {
  const std::size_t pixels = static_cast<std::size_t>(map.width) * map.height;
  const auto add = [&](const char* name, auto background) {
    map.channels.push_back({name, Samples<decltype(background)>(pixels, background)});
  };
  const StoredDepth farthest =
      is_reversed(format.mapping) ? StoredDepth{} : greatest_stored(format.storage);
  if (is_unorm(storage_)) {
    add("Zwindow", static_cast<std::uint32_t>(farthest.bits));
  } else if (storage_ != Storage::float64) {
    add("Zwindow", value_of_float(storage_, farthest));
  } else {
    add("Zwindow.high", static_cast<std::uint32_t>(farthest.bits >> 32));
    add("Zwindow.low", static_cast<std::uint32_t>(farthest.bits));
  }
  add("Zdecoded", std::numeric_limits<float>::infinity());
  if (against_exact) {
    add("Zerror", 0.0F);
    add("Zwinner", no_surface);
    add("Zfight", std::uint32_t{0});
  }

  id = values<std::uint32_t>(map, "id");
  decoded = values<float>(map, "Zdecoded");
  if (against_exact) {
    error = values<float>(map, "Zerror");
    winner = values<std::uint32_t>(map, "Zwinner");
    fight = values<std::uint32_t>(map, "Zfight");
  }
  if (storage_ == Storage::float64) {
    codes_ = values<std::uint32_t>(map, "Zwindow.high");
    low_ = values<std::uint32_t>(map, "Zwindow.low");
  } else if (is_unorm(storage_)) {
    codes_ = values<std::uint32_t>(map, "Zwindow");
  } else {
    values_ = values<float>(map, "Zwindow");
  }
}

void BufferChannels::store(std::size_t pixel, StoredDepth stored) {
  if (values_) {
    values_[pixel] = value_of_float(storage_, stored);
  } else if (low_) {
    codes_[pixel] = static_cast<std::uint32_t>(stored.bits >> 32);
    low_[pixel] = static_cast<std::uint32_t>(stored.bits);
  } else {
    codes_[pixel] = static_cast<std::uint32_t>(stored.bits);
  }
}

StoredDepth BufferChannels::stored(std::size_t pixel) const {
  if (values_) return stored_of(storage_, values_[pixel]);
  if (low_) return {static_cast<std::uint64_t>(codes_[pixel]) << 32 | low_[pixel]};
  return {codes_[pixel]};
}

}  // namespace fathom::depth_buffer
