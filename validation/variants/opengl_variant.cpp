#include "validation/variants/opengl_variant.h"

#include "validation/variants/words.h"

namespace fathom::validation {

std::string name_of(const OpenGlVariant& variant) {
  std::string name(name_of(variant.storage));
  if (variant.reversed) name += " reversed";
  if (variant.offset_units > 0) name += " offset " + std::to_string(variant.offset_units);
  if (variant.samples > 1) name += " " + std::to_string(variant.samples) + " samples";
  return name;
}

std::optional<OpenGlVariant> opengl_variant_named(std::string_view name) {
  const std::vector<std::string_view> words = words_of(name);
  const std::optional<Storage> storage = attachment_named(words[0]);
  if (!storage) return std::nullopt;
  OpenGlVariant variant{.storage = *storage};
  for (std::size_t i = 1; i < words.size();) {
    const std::string_view next = i + 1 < words.size() ? words[i + 1] : std::string_view();
    if (words[i] == "reversed" && !variant.reversed) {
      variant.reversed = true;
      i += 1;
      continue;
    }
    const bool is_offset = words[i] == "offset" && variant.offset_units == 0;
    const bool is_samples = next == "samples" && variant.samples == 1;
    const auto count = is_offset ? count_named(next, 1) : count_named(words[i], 2);
    if (!count || (!is_offset && !is_samples)) return std::nullopt;
    (is_offset ? variant.offset_units : variant.samples) = *count;
    i += 2;
  }
  return variant;
}

std::string opengl_variant_names() {
  return "unorm16, unorm24, unorm32 and float32, each also with 'reversed', 'offset UNITS' and "
         "'N samples'";
}

}  // namespace fathom::validation
