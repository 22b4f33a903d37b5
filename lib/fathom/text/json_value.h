#pragma once

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Reading JSON strictly, with errors that name the file and the key. Only for .cpp files and
/// internal headers: no public header includes it.
namespace fathom::text {

/// A value in a JSON document, with its place there.
class JsonValue {
 public:
  JsonValue(const nlohmann::json& value, const std::string& file, std::string place)
      : value_(&value), file_(&file), place_(std::move(place)) {}

  /// "FILE: PLACE"
  [[nodiscard]] std::string where() const;
  /// Throws InputError "FILE: PLACE: message".
  [[noreturn]] void fail(const std::string& message) const;

  /// An object's member; fails if it is missing or this is not an object.
  [[nodiscard]] JsonValue at(const std::string& key) const;
  [[nodiscard]] std::optional<JsonValue> find(const std::string& key) const;
  /// Fails if there is a key that is not one of `known`.
  void expect_only(std::span<const std::string_view> known) const;
  void expect_only(std::initializer_list<std::string_view> known) const {
    expect_only(std::span(known.begin(), known.size()));
  }

  /// The elements of a list.
  [[nodiscard]] std::vector<JsonValue> elements() const;
  /// Element `i` of a list that has it.
  [[nodiscard]] JsonValue element(std::size_t i) const;
  /// The elements of a list of exactly `size`.
  [[nodiscard]] std::vector<JsonValue> elements(std::size_t size) const;
  /// The members of an object, in the order of their keys.
  [[nodiscard]] std::vector<std::pair<std::string, JsonValue>> members() const;
  [[nodiscard]] std::size_t size() const;

  /// The number, its decimal text rounded once to binary64.
  [[nodiscard]] double number() const;
  /// `size` numbers.
  [[nodiscard]] std::vector<double> numbers(std::size_t size) const;
  /// An integer from `least` to `greatest`; 3.0 is one too.
  [[nodiscard]] std::uint64_t integer(std::uint64_t least, std::uint64_t greatest) const;
  [[nodiscard]] const std::string& string() const;
  [[nodiscard]] bool boolean() const;

  [[nodiscard]] bool is_null() const;
  [[nodiscard]] bool is_list() const;
  [[nodiscard]] bool is_object() const;
  [[nodiscard]] bool is_number() const;
  [[nodiscard]] bool is_string() const;

 private:
  [[noreturn]] void fail_type(const char* expected) const;

  const nlohmann::json* value_;
  const std::string* file_;
  std::string place_;
};

/// A JSON document.
class JsonDocument {
 public:
  /// Fails with InputError: syntax ("FILE: line N: …"), a key twice in one object, a number beyond
  /// binary64, nesting deeper than `deepest_json` (parse_json.h). `file` is the name for messages.
  JsonDocument(std::string_view text, std::string file);
  ~JsonDocument();
  JsonDocument(const JsonDocument&) = delete;
  JsonDocument& operator=(const JsonDocument&) = delete;

  [[nodiscard]] JsonValue root() const { return {*value_, file_, ""}; }

 private:
  /// A pointer, so that users of this header do not compile nlohmann's.
  std::unique_ptr<const nlohmann::json> value_;
  std::string file_;
};

}  // namespace fathom::text
