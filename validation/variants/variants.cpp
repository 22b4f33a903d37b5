#include "validation/variants/variants.h"

#include <algorithm>
#include <charconv>

namespace fathom::validation {
namespace {

using Encoding = VtkVariant::Encoding;
using Mesh = VtkVariant::Mesh;

constexpr Driver named_drivers[] = {Driver::llvmpipe, Driver::softpipe};

struct NamedEncoding {
  Encoding encoding;
  std::string_view name;
};
constexpr NamedEncoding encodings[] = {{Encoding::interpolated, ""},
                                       {Encoding::reversed, "reversed"},
                                       {Encoding::reversed_by_shader, "reversed by shader"},
                                       {Encoding::logarithmic, "logarithmic"}};

constexpr std::string_view peeled = "own peeled", behind_peeled = "own behind peeled";

}  // namespace

std::string name_of(Driver driver) {
  constexpr const char* names[] = {"", "llvmpipe", "softpipe"};
  return names[static_cast<std::size_t>(driver)];
}

std::optional<Driver> driver_named(std::string_view name) {
  for (const Driver driver : named_drivers) {
    if (name_of(driver) == name) return driver;
  }
  return std::nullopt;
}

std::string driver_names() {
  return "llvmpipe and softpipe";
}

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

std::string name_of(const VtkVariant& variant) {
  if (variant.mesh == Mesh::peeled) return std::string(peeled);
  if (variant.mesh == Mesh::behind_peeled) return std::string(behind_peeled);
  std::string name = variant.attachment ? std::string(name_of(*variant.attachment)) : "own";
  for (const NamedEncoding& e : encodings) {
    if (e.encoding == variant.encoding && !e.name.empty()) name += " " + std::string(e.name);
  }
  if (variant.samples > 0) name += " " + std::to_string(variant.samples) + " samples";
  return name;
}

std::optional<VtkVariant> vtk_variant_named(std::string_view name) {
  if (name == peeled) return VtkVariant{.mesh = Mesh::peeled};
  if (name == behind_peeled) return VtkVariant{.mesh = Mesh::behind_peeled};
  const std::vector<std::string_view> words = words_of(name);
  VtkVariant variant{.attachment = attachment_named(words[0])};
  if (!variant.attachment && words[0] != "own") return std::nullopt;
  if (words.size() == 1) return variant;
  if (words.size() == 3 && words[2] == "samples") {
    const auto samples = count_named(words[1], 1);
    if (!samples) return std::nullopt;
    variant.samples = *samples;
    return variant;
  }
  const std::string_view encoding = name.substr(words[0].size() + 1);
  for (const NamedEncoding& e : encodings) {
    if (e.name != encoding || encoding.empty()) continue;
    variant.encoding = e.encoding;
    return variant;
  }
  return std::nullopt;
}

std::string vtk_variant_names() {
  return "own, unorm16, unorm24, unorm32 and float32, each also with 'reversed', 'reversed by "
         "shader', 'logarithmic' or 'N samples'; and own peeled and own behind peeled";
}

}  // namespace fathom::validation
