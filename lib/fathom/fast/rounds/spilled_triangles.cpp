#include "fathom/fast/rounds/spilled_triangles.h"

#include <map>

namespace fathom::fast {
namespace {

/// The elements of a mesh array or of a vector as bytes.
template <class Array>
files::ByteView bytes_of(const Array& array) {
  return std::as_bytes(std::span(array.data(), array.size()));
}

/// Fills an array from a file; returns where it ends there.
template <class T>
std::uint64_t read_array(const files::SpillFile& file, std::uint64_t offset, std::vector<T>& array,
                         std::size_t count) {
  array.resize(count);
  file.read(offset, std::as_writable_bytes(std::span(array)));
  return offset + count * sizeof(T);
}

}  // namespace

void SpilledTriangles::add(std::size_t bucket, std::span<const KeptTriangles> kept) {
  for (const KeptTriangles& some : kept) {
    files::Bytes bytes;
    bytes.reserve(bytes_of(some.mesh.vertices).size() + bytes_of(some.mesh.triangles).size() +
                  bytes_of(some.numbers).size());
    files::append(bytes, bytes_of(some.mesh.vertices));
    files::append(bytes, bytes_of(some.mesh.triangles));
    files::append(bytes, bytes_of(some.numbers));
    buckets_[bucket].push_back({file_.append(bytes), some.object,
                                static_cast<std::uint32_t>(some.mesh.vertices.size()),
                                static_cast<std::uint32_t>(some.mesh.triangles.size())});
  }
}

KeptTriangles SpilledTriangles::read(const Block& block) const {
  KeptTriangles kept;
  kept.object = block.object;
  std::uint64_t next = block.offset;
  next = read_array(file_, next, kept.mesh.vertices.own(), block.vertices);
  next = read_array(file_, next, kept.mesh.triangles.own(), block.triangles);
  read_array(file_, next, kept.numbers, block.triangles);
  return kept;
}

KeptSize SpilledTriangles::size_of_bucket(std::size_t bucket) const {
  KeptSize size;
  for (const Block& block : buckets_[bucket]) size += {block.vertices, block.triangles};
  return size;
}

void SpilledTriangles::gather(std::size_t bucket, GatheredTriangles& to) const {
  std::map<std::uint32_t, KeptSize> sizes;
  for (const Block& block : buckets_[bucket]) {
    sizes[block.object] += {block.vertices, block.triangles};
  }
  for (const auto& [object, size] : sizes) to.reserve(object, size);
  for_each(bucket, [&](const KeptTriangles& kept) { to.add(kept); });
}

}  // namespace fathom::fast
