#pragma once

#include <ImfOpaqueAttribute.h>

#include <string>
#include <vector>

namespace fathom::image {

/// EXR's attribute of the type "idmanifest" that names what the numbers in a channel stand for:
/// names[n] for n. The bytes are those of Imf::CompressedIDManifest, which, in OpenEXR 3.1, is copied
/// without a look at whether there is memory for the copy.
/// Fails    std::bad_alloc.
Imf::OpaqueAttribute id_manifest(const std::string& channel, const std::vector<std::string>& names);

}  // namespace fathom::image
