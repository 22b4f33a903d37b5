#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fathom/failures/errors.h"

/// The only function that parses JSON: of files, of texts within files, and of other processes.
/// Only for .cpp files and internal headers.
namespace fathom::text {

/// How many lists and objects may stand in each other. Copying, comparing and writing nlohmann's
/// values is recursive, so that no deeper one may exist.
inline constexpr std::size_t deepest_json = 100;

/// One step down into a document: to an element of a list, or to a member of an object.
struct JsonStep {
  bool in_list;
  std::size_t index;
  std::string key;
};

/// Why bytes are refused as JSON. what() describes the reason without a place.
class JsonFault : public InputError {
 public:
  enum class Kind { syntax, not_finite, key_twice, too_deep };

  JsonFault(Kind kind, const std::string& reason, std::size_t byte, std::vector<JsonStep> path)
      : InputError(reason), kind_(kind), byte_(byte), path_(std::move(path)) {}

  [[nodiscard]] Kind kind() const { return kind_; }
  /// How many bytes had been read, the one at fault included; only for Kind::syntax.
  [[nodiscard]] std::size_t byte() const { return byte_; }
  /// The steps from the root to the faulty value.
  [[nodiscard]] const std::vector<JsonStep>& path() const { return path_; }

 private:
  Kind kind_;
  std::size_t byte_;
  std::vector<JsonStep> path_;
};

/// Reads a document into `root`; Json is nlohmann::json or nlohmann::ordered_json. Where it fails,
/// `root` holds what had been read by then.
///
/// Cost     n log n of n bytes, for all inputs.
/// Fails    JsonFault where the text is no JSON, NUL behind it included, and for what nlohmann
///          would accept: a key twice in one object, a number beyond binary64, more than
///          `deepest_json` levels.
template <class Json>
void parse_json(std::string_view text, Json& root);

template <class Json>
Json parse_json(std::string_view text) {
  Json root;
  parse_json(text, root);
  return root;
}

/// The same of a document in the binary form CBOR.
nlohmann::json parse_cbor(std::string_view bytes);

/// Appends a member to an object that has no such key yet. (operator[] and emplace of an
/// ordered_json compare the key with each that is there.)
inline void append_member(nlohmann::ordered_json& object, std::string key,
                          nlohmann::ordered_json value) {
  using Members = nlohmann::ordered_json::object_t;
  static_cast<Members::Container&>(object.get_ref<Members&>())
      .emplace_back(std::move(key), std::move(value));
}

}  // namespace fathom::text
