#include "validation/variants/words.h"

#include <algorithm>
#include <charconv>

namespace fathom::validation {

std::vector<std::string_view> words_of(std::string_view name) {
  std::vector<std::string_view> words;
  for (;;) {
    const std::size_t blank = name.find(' ');
    words.push_back(name.substr(0, blank));
    if (blank == std::string_view::npos) return words;
    name.remove_prefix(blank + 1);
  }
}

std::optional<int> count_named(std::string_view word, int least) {
  int count = 0;
  const char* const end = word.data() + word.size();
  const auto [read_to, error] = std::from_chars(word.data(), end, count);
  if (error != std::errc() || read_to != end || count < least) return std::nullopt;
  return count;
}

std::optional<Storage> attachment_named(std::string_view word) {
  const auto* const found =
      std::find_if(std::begin(attachment_storages), std::end(attachment_storages),
                   [&](Storage storage) { return name_of(storage) == word; });
  if (found == std::end(attachment_storages)) return std::nullopt;
  return *found;
}

}  // namespace fathom::validation
