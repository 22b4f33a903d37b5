#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace fathom::checks {

struct Outcome {
  int status = -1;
  std::string output;
};

/// What a shell command prints on both streams, and its exit status.
inline Outcome run(const std::string& command) {
  Outcome outcome;
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return outcome;
  std::array<char, 4096> part{};
  while (const std::size_t n = fread(part.data(), 1, part.size(), pipe))
    outcome.output.append(part.data(), n);
  const int status = pclose(pipe);
  outcome.status = status >= 0 && (status & 0x7F) == 0 ? status >> 8 & 0xFF : -1;
  return outcome;
}

}  // namespace fathom::checks
