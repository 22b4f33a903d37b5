#pragma once

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>

#include "fathom/geometry/frames.h"

/// What the writers of mesh files in tests have in common.
namespace fathom::test {

inline std::string decimal(double x, const char* format = "%.9g") {
  char text[64];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

inline std::string point(const MeshPoint& p, const char* format = "%.9g") {
  return decimal(p.x, format) + " " + decimal(p.y, format) + " " + decimal(p.z, format);
}

/// The bytes of a value.
template <class T>
std::string raw(T value, bool big = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

}  // namespace fathom::test
