#include "fathom/mesh_files/triangle_stream.h"

#include <algorithm>
#include <future>

#include "fathom/failures/errors.h"
#include "fathom/files/sha256.h"
#include "fathom/mesh_files/mesh_formats.h"
#include "fathom/mesh_files/read_mesh.h"
#include "fathom/mesh_files/stl/stl_binary.h"
#include "fathom/mesh_files/streams.h"
#include "fathom/numeric/standard_arithmetic.h"
#include "fathom/threads/meanwhile.h"

namespace fathom {
using namespace mesh_files;
using namespace files;

namespace {

[[noreturn]] void fail_format(const std::string& file) {
  throw InputError(file + ": is not a binary STL or PLY, the formats that can be streamed");
}

std::vector<std::byte> beginning_of(const RandomAccessFile& file, std::size_t size) {
  std::vector<std::byte> bytes(
      static_cast<std::size_t>(std::min<std::uint64_t>(size, file.size())));
  file.read(0, bytes);
  return bytes;
}

FileFormat format_of(const RandomAccessFile& file, const std::filesystem::path& path,
                     const ReadOptions& options) {
  if (file.size() == 0) throw InputError(file.name() + ": is empty, expected a mesh");
  const auto format = options.format ? options.format
                                     : recognise_format(beginning_of(file, 512), file.size(), path);
  if (!format || !can_be_streamed(*format)) fail_format(file.name());
  return *format;
}

std::unique_ptr<TriangleStream> open(std::unique_ptr<RandomAccessFile> file, FileFormat format,
                                     const ReadOptions& options, Warnings& warnings) {
  const std::string name = file->name();
  if (format == FileFormat::stl) {
    if (!is_binary_stl(beginning_of(*file, 512), file->size())) fail_format(name);
    return open_stl_stream(std::move(file), options.check_when_opened, warnings);
  }
  const std::vector<std::byte> head = beginning_of(*file, longest_ply_header);
  const PlyHeader header =
      read_ply_header({reinterpret_cast<const char*>(head.data()), head.size()}, name, warnings);
  if (header.encoding == PlyHeader::Encoding::ascii) fail_format(name);
  return open_ply_stream(std::move(file), header, options, warnings);
}

}  // namespace

std::unique_ptr<TriangleStream> open_triangle_stream(const std::filesystem::path& path,
                                                     const ReadOptions& options,
                                                     Warnings& warnings) {
  const StandardArithmetic standard;
  auto file = std::make_unique<RandomAccessFile>(path);
  const FileFormat format = format_of(*file, path, options);
  // The hash is computed during the reading, from a second open file.
  std::future<std::string> hash;
  if (options.hash) hash = meanwhile([&path] { return sha256(RandomAccessFile(path)); });
  std::unique_ptr<TriangleStream> stream = open(std::move(file), format, options, warnings);
  stream->source.path = path.string();
  if (hash.valid()) stream->source.sha256 = hash.get();
  return stream;
}

bool is_streamable(const std::filesystem::path& path, const ReadOptions& options) {
  try {
    const RandomAccessFile file(path);
    if (format_of(file, path, options) == FileFormat::stl)
      return is_binary_stl(beginning_of(file, 512), file.size());
    const std::vector<std::byte> head = beginning_of(file, longest_ply_header);
    Warnings warnings;
    return read_ply_header({reinterpret_cast<const char*>(head.data()), head.size()}, file.name(),
                           warnings)
               .encoding != PlyHeader::Encoding::ascii;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace fathom
