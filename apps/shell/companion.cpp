#include "apps/shell/companion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <numeric>
#include <string_view>

#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

/// Commands that are programs of their own, because of what they are built with.
constexpr std::string_view companions[] = {"bench", "validate"};

/// Levenshtein's distance: the least number of letters to insert, remove or replace.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
      diagonal = above;
    }
  }
  return row.back();
}

template <class Names>
bool contains(const Names& names, std::string_view name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

}  // namespace

void start_companion(const std::string& name, const std::vector<char*>& arguments) {
  if (name.find('/') != std::string::npos) return;
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) return;
  const std::string companion = self.parent_path() / ("fathom-" + name);
  if (!std::filesystem::exists(companion, error)) return;

  std::vector<char*> list{const_cast<char*>(companion.c_str())};
  list.insert(list.end(), arguments.begin(), arguments.end());
  list.push_back(nullptr);
  ::execv(companion.c_str(), list.data());
  throw UsageError(fmt::format("{}: {}", companion, std::strerror(errno)));
}

std::string unknown_command(const std::string& name, const std::vector<std::string>& existing) {
  const std::string list = fmt::format("{}", fmt::join(existing, ", "));
  if (contains(companions, name)) {
    return fmt::format(
        "'{}' is a program of its own, fathom-{}, that is not built: 'scripts/fathom {}' installs "
        "what it needs and builds it",
        name, name, name);
  }
  const auto nearest = std::min_element(existing.begin(), existing.end(),
                                        [&](const std::string& a, const std::string& b) {
                                          return edit_distance(name, a) < edit_distance(name, b);
                                        });
  const bool near = nearest != existing.end() && edit_distance(name, *nearest) <= 2;
  return fmt::format("there is no command '{}'{}; the commands are {}", name,
                     near ? fmt::format(": did you mean '{}'?", *nearest) : "", list);
}

}  // namespace fathom::app
