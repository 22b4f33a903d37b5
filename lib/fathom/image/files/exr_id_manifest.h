#pragma once

#include <ImfOpaqueAttribute.h>

#include <string>
#include <vector>

namespace fathom::image {

/// A channel, and what the numbers in it stand for: names[n] for n.
struct NamedChannel {
  std::string channel;
  const std::vector<std::string>& names;
};

/// EXR's attribute of the type "idmanifest" that names what the numbers in channels stand for. The
/// bytes are those of Imf::CompressedIDManifest, which, in OpenEXR 3.1, is copied
/// without a look at whether there is memory for the copy.
/// Fails    std::bad_alloc.
Imf::OpaqueAttribute id_manifest(const std::vector<NamedChannel>& channels);

}  // namespace fathom::image
