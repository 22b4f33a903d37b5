#pragma once

#include <string>

namespace fathom {

/// A file that went into a scene, for provenance.
struct Source {
  std::string path;
  /// 64 hexadecimal digits; empty if no hash was requested.
  std::string sha256;
  /// Third-party library that read the file, e.g. "assimp 5.2.4"; empty if Fathom did.
  std::string reader;
};

}  // namespace fathom
