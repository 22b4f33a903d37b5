#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/shell/output_file.h"
#include "fathom/files/file_bytes.h"
#include "fathom/rays/hit_values.h"

/// Files of the scan of a lidar.
namespace fathom::app {

enum class ScanFile { kitti, ply, pcd, npy, exr };

/// By the name's suffix; nullopt for other names.
std::optional<ScanFile> scan_file_of(const std::string& name);
/// Whether the file holds points; the others hold images.
constexpr bool is_cloud(ScanFile file) {
  return file != ScanFile::npy && file != ScanFile::exr;
}
/// Whether the file holds binary64 numbers; the others hold binary32 numbers.
constexpr bool is_binary64(ScanFile file) {
  return file == ScanFile::ply || file == ScanFile::npy;
}

/// The answers of the rays of a scan, rows × columns.
template <class Real>
struct Scan {
  std::uint32_t rows = 0, columns = 0;
  /// The triangle of each ray, or no_triangle.
  std::vector<std::uint32_t> ids;
  /// Points and distances.
  std::vector<HitValues<Real>> values;
};

/// Binary, little endian, a record for each ray with a hit, row by row:
///   .bin   KITTI: x, y, z and the reflectance, which is 0, float32
///   .ply   x, y, z double; id, row, column uint
///   .pcd   version 0.7: x, y, z float32; id, row, column uint32
template <class Real>
files::Bytes cloud_of(const Scan<Real>& scan, ScanFile file);

/// Writes an image of rows × columns: the channel `distance`, +∞ where no triangle is met, and, in
/// an EXR, `id`. `shifts` move each row to the right; empty: no row is moved.
template <class Real>
void write_range_image(const Scan<Real>& scan, ScanFile file, std::span<const std::int32_t> shifts,
                       const OutputFile& output);

}  // namespace fathom::app
