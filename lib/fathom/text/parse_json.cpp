#include "fathom/text/parse_json.h"

#include <optional>
#include <set>

namespace fathom::text {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// nlohmann's message, without its "[json.exception.…] parse error at line 1, column 2: ".
std::string in_words(std::string text) {
  for (const char* mark : {"] ", "column "})
    if (const auto at = text.find(mark); at != std::string::npos)
      text.erase(0, at + std::string_view(mark).size());
  if (const auto at = text.find(": "); at != std::string::npos) text.erase(0, at + 2);
  for (char& c : text)
    if (c == '\n') c = ' ';
  return text;
}

/// Builds the document from what the parser reports. (nlohmann's own builder for strict readers
/// looks at all elements of a list after each object in it, and an ordered object at all its keys
/// before each member.)
template <class Json>
class Builder {
 public:
  explicit Builder(Json& root) : root_(&root) {}

  // The parser calls these functions; false ends it.
  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(std::int64_t value) { return put(value); }
  bool number_unsigned(std::uint64_t value) { return put(value); }
  bool number_float(double value, const std::string&) { return put(value); }
  bool string(std::string& value) { return put(std::move(value)); }
  bool binary(typename Json::binary_t& value) { return put(Json::binary(std::move(value))); }
  bool start_object(std::size_t) { return open(Json::value_t::object); }
  bool start_array(std::size_t) { return open(Json::value_t::array); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(std::string& key) {
    Level& level = levels_.back();
    level.step.key = std::move(key);
    if (is_new(level)) return true;
    // dump() escapes what would break the line; only CBOR has keys that are not UTF-8.
    return refuse(JsonFault::Kind::key_twice,
                  "the key " +
                      Json(level.step.key).dump(-1, ' ', false, Json::error_handler_t::replace) +
                      " stands twice in one object");
  }

  bool parse_error(std::size_t byte, const std::string&, const json::exception& e) {
    constexpr int number_overflow = 406;
    return refuse(e.id == number_overflow ? JsonFault::Kind::not_finite : JsonFault::Kind::syntax,
                  in_words(e.what()), byte);
  }

  [[nodiscard]] const std::optional<JsonFault>& fault() const { return fault_; }

 private:
  /// A list or object that is open.
  struct Level {
    Json* value;
    JsonStep step;
    /// The keys of an object type that does not sort them itself.
    std::set<std::string> keys;
  };

  bool refuse(JsonFault::Kind kind, const std::string& reason, std::size_t byte = 0) {
    std::vector<JsonStep> path;
    for (const Level& level : levels_) path.push_back(level.step);
    fault_.emplace(kind, reason, byte, std::move(path));
    return false;
  }

  /// Whether the object has had no member of this key yet.
  static bool is_new(Level& level) {
    if constexpr (std::is_same_v<Json, ordered_json>)
      return level.keys.insert(level.step.key).second;
    else
      return !level.value->contains(level.step.key);
  }

  /// Puts a value where it belongs, and returns it there.
  Json& place(Json value) {
    if (levels_.empty()) return *root_ = std::move(value);
    Level& level = levels_.back();
    if (level.step.in_list)
      return level.value->template get_ref<typename Json::array_t&>().emplace_back(
          std::move(value));
    auto& members = level.value->template get_ref<typename Json::object_t&>();
    if constexpr (std::is_same_v<Json, ordered_json>) {
      append_member(*level.value, level.step.key, std::move(value));
      return members.back().second;
    } else {
      return members.emplace(level.step.key, std::move(value)).first->second;
    }
  }

  bool put(Json value) {
    place(std::move(value));
    count();
    return true;
  }

  void count() {
    if (!levels_.empty()) ++levels_.back().step.index;
  }

  bool open(typename Json::value_t kind) {
    if (levels_.size() == deepest_json)
      return refuse(JsonFault::Kind::too_deep,
                    "nested more than " + std::to_string(deepest_json) + " deep");
    Json& value = place(Json(kind));
    levels_.push_back({&value, {kind == Json::value_t::array, 0, ""}, {}});
    return true;
  }

  bool close() {
    levels_.pop_back();
    count();
    return true;
  }

  Json* root_;
  std::vector<Level> levels_;
  std::optional<JsonFault> fault_;
};

/// Fills `root` by passing a builder to `parse`.
template <class Json, class Parse>
void build(Json& root, const Parse& parse) {
  root = nullptr;
  Builder<Json> builder(root);
  parse(builder);
  if (builder.fault()) throw *builder.fault();
}

}  // namespace

template <class Json>
void parse_json(std::string_view text, Json& root) {
  // NUL is no character of JSON; the parser would take it for the end of the text.
  const std::size_t nul = text.find('\0');
  const std::string_view before = text.substr(0, nul);
  std::vector<JsonStep> path;
  try {
    build(root, [&](auto& builder) { Json::sax_parse(before.begin(), before.end(), &builder); });
  } catch (const JsonFault& fault) {
    const bool is_at_end = fault.kind() == JsonFault::Kind::syntax && fault.byte() > before.size();
    if (nul == text.npos || !is_at_end) throw;
    path = fault.path();
  }
  if (nul != text.npos) throw JsonFault(JsonFault::Kind::syntax, "a NUL character", nul + 1, path);
}

template void parse_json(std::string_view, json&);
template void parse_json(std::string_view, ordered_json&);

json parse_cbor(std::string_view bytes) {
  json root;
  build(root, [&](auto& builder) {
    json::sax_parse(bytes.begin(), bytes.end(), &builder, json::input_format_t::cbor);
  });
  return root;
}

}  // namespace fathom::text
