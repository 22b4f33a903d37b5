#include "fathom/mesh_files/off/off_keyword.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace fathom::mesh_files {
namespace {

bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

}  // namespace

std::optional<OffKeyword> read_off_keyword(std::string_view word) {
  // The longest is STCN4nOFF; the capital N and the small n differ where there are capitals.
  std::string keyword(word.substr(0, word.find_last_not_of("0123456789") + 1));
  if (keyword.size() > 9) return std::nullopt;
  if (std::none_of(keyword.begin(), keyword.end(), is_capital))
    for (char& c : keyword) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  std::string_view rest = keyword;
  const auto take = [&](std::string_view prefix) {
    const bool found = rest.starts_with(prefix);
    if (found) rest.remove_prefix(prefix.size());
    return found;
  };
  OffKeyword result;
  for (bool found = true; found;) {
    found = false;
    if (take("ST")) found = result.texture = true;
    if (take("C")) {
      found = result.colours = true;
      result.colours_first = result.normals;
    }
    if (take("N")) found = result.normals = true;
    if (take("4") || take("n")) found = result.other_dimensions = true;
  }
  if (rest != "OFF") return std::nullopt;
  result.size = keyword.size();
  return result;
}

}  // namespace fathom::mesh_files
