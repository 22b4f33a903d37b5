#include "apps/rays/scan_files.h"

#include <utility>

#include "apps/surfaces/npz_rows.h"
#include "fathom/image/map_files.h"

namespace fathom::app {
namespace {

constexpr std::array<std::pair<const char*, ScanFile>, 5> suffixes{{{".bin", ScanFile::kitti},
                                                                    {".ply", ScanFile::ply},
                                                                    {".pcd", ScanFile::pcd},
                                                                    {".npy", ScanFile::npy},
                                                                    {".exr", ScanFile::exr}}};

std::string header_of(ScanFile file, std::size_t points) {
  const std::string count = std::to_string(points);
  if (file == ScanFile::ply)
    return "ply\nformat binary_little_endian 1.0\nelement vertex " + count +
           "\nproperty double x\nproperty double y\nproperty double z\n"
           "property uint id\nproperty uint row\nproperty uint column\nend_header\n";
  if (file == ScanFile::pcd)
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
           "FIELDS x y z id row column\nSIZE 4 4 4 4 4 4\nTYPE F F F U U U\nCOUNT 1 1 1 1 1 1\n"
           "WIDTH " +
           count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
  return "";
}

/// The values of the rays in the places of an image's pixels.
template <class T, class ValueOf>
Samples<T> image_of(std::uint32_t rows, std::uint32_t columns, std::span<const std::int32_t> shifts,
                    const ValueOf& value_of) {
  Samples<T> image(std::size_t{rows} * columns);
  for (std::uint32_t row = 0; row < rows; ++row) {
    const std::int64_t shift = shifts.empty() ? 0 : shifts[row];
    const std::int64_t width = columns;
    for (std::int64_t column = 0; column < width; ++column) {
      const std::int64_t place = ((column + shift) % width + width) % width;
      const std::size_t start = std::size_t{row} * columns;
      image[start + static_cast<std::size_t>(place)] =
          value_of(start + static_cast<std::size_t>(column));
    }
  }
  return image;
}

}  // namespace

std::optional<ScanFile> scan_file_of(const std::string& name) {
  for (const auto& [suffix, file] : suffixes)
    if (name.ends_with(suffix)) return file;
  return std::nullopt;
}

template <class Real>
files::Bytes cloud_of(const Scan<Real>& scan, ScanFile file) {
  files::Bytes body;
  std::size_t points = 0;
  for (std::size_t k = 0; k < scan.ids.size(); ++k) {
    if (scan.ids[k] == no_triangle) continue;
    ++points;
    for (const Real x : scan.values[k].position) files::put_number(body, x);
    if (file == ScanFile::kitti) {
      files::put_number(body, 0.0F);
    } else {
      files::put_number(body, scan.ids[k]);
      files::put_number(body, static_cast<std::uint32_t>(k / scan.columns));
      files::put_number(body, static_cast<std::uint32_t>(k % scan.columns));
    }
  }
  files::Bytes bytes;
  files::append(bytes, header_of(file, points));
  files::append(bytes, body);
  return bytes;
}
template files::Bytes cloud_of(const Scan<float>& scan, ScanFile file);
template files::Bytes cloud_of(const Scan<double>& scan, ScanFile file);

template <class Real>
void write_range_image(const Scan<Real>& scan, ScanFile file, std::span<const std::int32_t> shifts,
                       const OutputFile& output) {
  DepthMap map;
  map.width = scan.columns;
  map.height = scan.rows;
  map.channels.push_back(
      {"distance", image_of<Real>(scan.rows, scan.columns, shifts,
                                  [&](std::size_t k) { return scan.values[k].distance; })});
  const bool is_exr = file == ScanFile::exr;
  if (is_exr)
    map.channels.push_back(
        {"id", image_of<std::uint32_t>(scan.rows, scan.columns, shifts,
                                       [&](std::size_t k) { return scan.ids[k]; })});
  output.write(
      [&](const auto& path) { write_map(map, path, is_exr ? MapFormat::exr : MapFormat::npy); });
}
template void write_range_image(const Scan<float>& scan, ScanFile file,
                                std::span<const std::int32_t> shifts, const OutputFile& output);
template void write_range_image(const Scan<double>& scan, ScanFile file,
                                std::span<const std::int32_t> shifts, const OutputFile& output);

}  // namespace fathom::app
