#pragma once

#include <string>

namespace fathom {

/// A file that went into a scene, for provenance.
struct Source {
  std::string path;
  /// 64 hexadecimal digits; empty if no hash was asked for.
  std::string sha256;
};

}  // namespace fathom
