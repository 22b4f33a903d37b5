#include "apps/shell/known_files.h"

#include <algorithm>
#include <vector>

#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> inputs, outputs;

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error) return true;
  const fs::path full_a = fs::weakly_canonical(fs::absolute(a), error);
  return !error && full_a == fs::weakly_canonical(fs::absolute(b), error) && !error;
}

bool contains(const std::vector<fs::path>& files, const fs::path& file) {
  return std::any_of(files.begin(), files.end(),
                     [&](const fs::path& known) { return is_same_file(known, file); });
}

}  // namespace

void note_input(const fs::path& file) {
  std::error_code error;
  if (fs::is_regular_file(file, error)) inputs.push_back(file);
}

void claim_output(const fs::path& target, const fs::path& place) {
  if (contains(inputs, place)) {
    throw UsageError(target.string() + ": is an input of this command; name another output");
  }
  if (contains(outputs, place)) {
    throw UsageError(target.string() + ": would be written twice; every output needs its own name");
  }
  outputs.push_back(place);
}

}  // namespace fathom::app
