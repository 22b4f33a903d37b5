#include "fathom/image/files/exr_id_manifest.h"

#include <ImfIDManifest.h>
#include <zlib.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>

#include "fathom/files/byte_order.h"
#include "fathom/image/files/exr_streams.h"

namespace fathom::image {
namespace {

std::vector<char> serialized(const std::vector<NamedChannel>& channels) {
  Imf::IDManifest manifest;
  for (const auto& [channel, names] : channels) {
    Imf::IDManifest::ChannelGroupManifest& group = manifest.add(channel);
    group.setLifetime(Imf::IDManifest::LIFETIME_FRAME);
    group.setHashScheme(Imf::IDManifest::NOTHASHED);
    group.setEncodingScheme(Imf::IDManifest::ID_SCHEME);
    group.setComponent("name");
    for (std::size_t n = 0; n < names.size(); ++n) group.insert(n, names[n]);
  }
  std::vector<char> bytes;
  manifest.serialize(bytes);
  return bytes;
}

}  // namespace

/// The size as it was, in eight bytes, little endian; then zlib's stream.
Imf::OpaqueAttribute id_manifest(const std::vector<NamedChannel>& channels) {
  const std::vector<char> plain = serialized(channels);
  uLongf size = ::compressBound(plain.size());
  files::Bytes value(sizeof(std::uint64_t) + size);
  store(value.data(), std::uint64_t{plain.size()}, std::endian::little);
  if (::compress(reinterpret_cast<Bytef*>(value.data() + sizeof(std::uint64_t)), &size,
                 reinterpret_cast<const Bytef*>(plain.data()), plain.size()) != Z_OK) {
    throw std::bad_alloc();  // there is room enough
  }
  value.resize(sizeof(std::uint64_t) + size);
  ByteInput stream(value, "idmanifest", {});
  Imf::OpaqueAttribute attribute("idmanifest");
  attribute.readValueFrom(stream, static_cast<int>(value.size()), 2);
  return attribute;
}

}  // namespace fathom::image
