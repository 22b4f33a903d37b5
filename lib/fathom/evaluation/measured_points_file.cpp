#include <bit>
#include <string>

#include "fathom/evaluation/surface_distances.h"
#include "fathom/files/byte_order.h"
#include "fathom/files/file_bytes.h"
#include "fathom/numeric/standard_arithmetic.h"

namespace fathom {

using namespace files;

std::vector<std::byte> ply_of(const std::vector<MeasuredPoint>& points) {
  const StandardArithmetic standard;
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment distances by Fathom\n";
  header += "element vertex " + std::to_string(points.size()) + "\n";
  for (const char* name : {"x", "y", "z", "quality"})
    header += std::string("property double ") + name + "\n";
  header += "end_header\n";
  Bytes file;
  append(file, header);
  std::size_t at = file.size();
  file.resize(at + points.size() * 4 * sizeof(double));
  for (const auto& [place, distance] : points) {
    for (const double number : {place[0], place[1], place[2], distance}) {
      store(&file[at], number, std::endian::little);
      at += sizeof(double);
    }
  }
  return file;
}

}  // namespace fathom
