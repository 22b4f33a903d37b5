#include "fathom/fast/certified_writer.h"

#include <algorithm>
#include <bit>

// How to read this file: CertifiedWriter::write() is the list of channels. What follows from q
// alone is rounded for a whole row (channel_rows.h); for the rest, PixelWriter has a function for
// each channel, which goes through the tiers. Values and their bounds come from
// triangle/certified_surface.h and double_word_surface.h, roundings from
// numeric/certified_rounding.h.
namespace fathom::fast {
using namespace triangle;

namespace {

template <class Visit>
void for_each_bit(std::uint64_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<std::size_t>(std::countr_zero(bits)));
}

/// Copies settled values of a row to its pixels; returns the samples that are left.
template <class T>
std::uint64_t copy(const VisibleRow& row, const RoundedValues<T>& rounded, T* target,
                   RenderStatistics& statistics) {
  const std::uint64_t settled = row.surface & rounded.settled;
  for (std::uint64_t rest = settled; rest != 0;) {
    const int first = std::countr_zero(rest), count = std::countr_one(rest >> first);
    std::copy_n(rounded.values.data() + first, count,
                target + row.first_pixel + static_cast<std::size_t>(first));
    if (first + count == 64) break;
    rest &= ~std::uint64_t{0} << (first + count);
  }
  statistics.rounding.interval += static_cast<std::uint64_t>(std::popcount(settled));
  return row.surface & ~settled;
}

}  // namespace

CertifiedWriter::CertifiedWriter(ChannelWriter& exact, const SceneRays& rays)
    : exact_(exact),
      values_(exact.values()),
      frame_(rays),
      each_pixel_(values_.barycentric[0] || values_.low || values_.shading_normal[0]),
      shading_normals_(exact.corner_normals()) {}

struct CertifiedWriter::Open {
  std::uint64_t depth = 0, distance = 0;
  std::array<std::uint64_t, 3> position{};

  [[nodiscard]] std::uint64_t any() const {
    return depth | distance | position[0] | position[1] | position[2];
  }
};

std::uint64_t CertifiedWriter::write_encoded(const VisibleRow& row, const EncodedValues& values,
                                             bool distance, RenderStatistics& statistics) const {
  if (!values.wanted() || values.binary64) return values.wanted() ? row.surface : 0;
  if (values.codes) {
    RoundedValues<std::uint16_t> codes;
    round_to_codes(row.lanes, frame_.rays, distance, exact_.scale(), codes);
    return copy(row, codes, values.codes, statistics);
  }
  RoundedValues<float> rounded;
  round_depths(row.lanes, frame_.rays, distance, rounded);
  return copy(row, rounded, values.binary32, statistics);
}

void CertifiedWriter::write_origins(const VisibleRow& row) const {
  if (values_.id) {
    for_each_bit(row.surface, [&](std::size_t k) {
      const VisibleSurface surface = row.at(k);
      values_.id[surface.pixel] = surface.triangle;
    });
  }
  if (!values_.wants_origins()) return;
  std::uint32_t last = no_surface;
  OriginNumbers numbers;
  for_each_bit(row.surface, [&](std::size_t k) {
    const VisibleSurface surface = row.at(k);
    if (surface.triangle != last) numbers = exact_.numbers_of(last = surface.triangle);
    values_.write(surface.pixel, numbers);
  });
}

void CertifiedWriter::write_normals(const VisibleRow& row, Normal normal,
                                    const std::array<float*, 3>& values,
                                    const WriterTarget& target) {
  std::uint32_t last = no_surface;
  std::array<float, 3> n{};
  for_each_bit(row.surface, [&](std::size_t k) {
    const VisibleSurface surface = row.at(k);
    if (surface.triangle != last) {
      n = (PixelWriter(surface, facts(surface.triangle), frame_, target).*normal)();
      last = surface.triangle;
    }
    for (std::size_t i = 0; i < 3; ++i) values[i][surface.pixel] = n[i];
  });
}

CertifiedWriter::Open CertifiedWriter::write_settled(const VisibleRow& row,
                                                     RenderStatistics& statistics) const {
  Open open;
  write_origins(row);
  open.depth = write_encoded(row, values_.depth, false, statistics);
  open.distance = write_encoded(row, values_.distance, true, statistics);
  if (!values_.position[0]) return open;
  open.position.fill(row.surface);
  if (!frame_.rays.world().usable) return open;
  std::array<RoundedValues<float>, 3> rounded;
  round_positions(row.lanes, frame_.rays.world().rays, frame_.world_sizes, frame_.image.perspective,
                  rounded);
  for (std::size_t k = 0; k < 3; ++k) {
    open.position[k] = copy(row, rounded[k], values_.position[k], statistics);
  }
  return open;
}

std::optional<EncodingFault> CertifiedWriter::write(const VisibleRow& row, Referee& referee,
                                                    RenderStatistics& statistics) {
  const Open open = write_settled(row, statistics);
  const WriterTarget target{values_, exact_, referee, statistics};
  if (values_.normal[0]) write_normals(row, &PixelWriter::normal, values_.normal, target);
  if (values_.camera_normal[0]) {
    write_normals(row, &PixelWriter::camera_normal, values_.camera_normal, target);
  }
  for (std::uint64_t bits = each_pixel_ ? row.surface : open.any(); bits != 0; bits &= bits - 1) {
    const auto k = static_cast<std::size_t>(std::countr_zero(bits));
    const auto is_open = [&](std::uint64_t samples) { return (samples >> k & 1) != 0; };
    const VisibleSurface surface = row.at(k);
    PixelWriter pixel(surface, facts(surface.triangle), frame_, target);
    for (std::size_t i = 0; i < 3; ++i) {
      if (is_open(open.position[i])) pixel.write_position(i);
    }
    for (std::size_t i = 0; values_.barycentric[0] && i < 2; ++i) pixel.write_barycentric(i);
    if (values_.shading_normal[0]) pixel.write_shading_normal(shading_normals_);
    if (is_open(open.distance)) {
      if (auto fault = pixel.write_distance()) return fault;
    }
    if (values_.low) pixel.write_low_part();
    if (is_open(open.depth)) {
      if (auto fault = pixel.write_depth()) return fault;
    }
  }
  return std::nullopt;
}

}  // namespace fathom::fast
