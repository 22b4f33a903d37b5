#include "fathom/text/json_value.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "fathom/failures/errors.h"
#include "fathom/text/parse_json.h"
#include "fathom/text/printable.h"

namespace fathom::text {
namespace {

using nlohmann::json;

std::string in_quotes(const std::string& key) {
  // dump() escapes what would break the line; keys that are not UTF-8 never get here.
  return json(key).dump();
}

std::size_t line_of(std::string_view text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'));
}

/// "a.b[2]: ", or nothing at the root.
std::string place_of(const std::vector<JsonStep>& path) {
  std::string place;
  for (const JsonStep& step : path) {
    if (step.in_list) {
      place += "[" + std::to_string(step.index) + "]";
    } else {
      place += (place.empty() ? "" : ".") + step.key;
    }
  }
  return place.empty() ? "" : printable(place) + ": ";
}

json parse_strictly(std::string_view text, const std::string& file) {
  try {
    return parse_json<json>(text);
  } catch (const JsonFault& fault) {
    const std::string reason = fault.what();
    switch (fault.kind()) {
      case JsonFault::Kind::syntax:
        throw InputError(file + ": line " +
                         std::to_string(line_of(text, fault.byte() == 0 ? 0 : fault.byte() - 1)) +
                         ": not JSON: " + reason);
      case JsonFault::Kind::not_finite:
        throw InputError(file + ": " + place_of(fault.path()) + reason);
      default:
        throw InputError(file + ": " + reason);
    }
  }
}

const char* kind_of(const json& value) {
  switch (value.type()) {
    case json::value_t::null:
      return "null";
    case json::value_t::object:
      return "an object";
    case json::value_t::array:
      return "a list";
    case json::value_t::string:
      return "a string";
    case json::value_t::boolean:
      return "true or false";
    default:
      return "a number";
  }
}

}  // namespace

JsonDocument::JsonDocument(std::string_view text, std::string file)
    : value_(std::make_unique<const json>(parse_strictly(text, file))), file_(std::move(file)) {}

JsonDocument::~JsonDocument() = default;

std::string JsonValue::where() const {
  return place_.empty() ? *file_ : *file_ + ": " + place_;
}

void JsonValue::fail(const std::string& message) const {
  throw InputError(where() + ": " + message);
}

void JsonValue::fail_type(const char* expected) const {
  fail(std::string("is ") + kind_of(*value_) + ", expected " + expected);
}

JsonValue JsonValue::at(const std::string& key) const {
  if (auto member = find(key)) return *std::move(member);
  fail("the key " + in_quotes(key) + " is missing");
}

std::optional<JsonValue> JsonValue::find(const std::string& key) const {
  if (!value_->is_object()) fail_type("an object");
  const auto member = value_->find(key);
  if (member == value_->end()) return std::nullopt;
  return JsonValue(*member, *file_, place_ + (place_.empty() ? "" : ".") + key);
}

void JsonValue::expect_only(std::span<const std::string_view> known) const {
  if (!value_->is_object()) fail_type("an object");
  for (const auto& [key, member] : value_->items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string list;
    for (const auto& name : known) list += (list.empty() ? "" : ", ") + std::string(name);
    fail("unknown key " + in_quotes(key) + ", expected one of " + list);
  }
}

std::vector<JsonValue> JsonValue::elements() const {
  if (!value_->is_array()) fail_type("a list");
  std::vector<JsonValue> result;
  result.reserve(value_->size());
  for (std::size_t i = 0; i < value_->size(); ++i) result.push_back(element(i));
  return result;
}

JsonValue JsonValue::element(std::size_t i) const {
  if (!value_->is_array()) fail_type("a list");
  return {(*value_)[i], *file_, place_ + "[" + std::to_string(i) + "]"};
}

std::vector<JsonValue> JsonValue::elements(std::size_t size) const {
  if (!value_->is_array() || value_->size() != size)
    fail("expected a list of " + std::to_string(size) +
         (value_->is_array() ? ", found one of " + std::to_string(value_->size()) : ""));
  return elements();
}

std::vector<std::pair<std::string, JsonValue>> JsonValue::members() const {
  if (!value_->is_object()) fail_type("an object");
  std::vector<std::pair<std::string, JsonValue>> result;
  for (const auto& [key, member] : value_->items())
    result.emplace_back(key, JsonValue(member, *file_, place_ + (place_.empty() ? "" : ".") + key));
  return result;
}

std::size_t JsonValue::size() const {
  return value_->size();
}

bool JsonValue::is_null() const {
  return value_->is_null();
}

bool JsonValue::is_list() const {
  return value_->is_array();
}

bool JsonValue::is_object() const {
  return value_->is_object();
}

bool JsonValue::is_number() const {
  return value_->is_number();
}

bool JsonValue::is_string() const {
  return value_->is_string();
}

double JsonValue::number() const {
  if (!value_->is_number()) fail_type("a number");
  return value_->get<double>();
}

std::vector<double> JsonValue::numbers(std::size_t size) const {
  std::vector<double> result;
  result.reserve(size);
  for (const JsonValue& element : elements(size)) result.push_back(element.number());
  return result;
}

std::uint64_t JsonValue::integer(std::uint64_t least, std::uint64_t greatest) const {
  const auto refuse = [&]() {
    fail("expected an integer from " + std::to_string(least) + " to " + std::to_string(greatest));
  };
  std::uint64_t result = 0;
  if (value_->is_number_unsigned()) {
    result = value_->get<std::uint64_t>();
  } else if (value_->is_number_float()) {
    const double number = value_->get<double>();
    // 2⁵³: above it, the text of a float need not be the integer that it is read as.
    if (!(number >= 0 && number <= 0x1p53) || number != std::floor(number)) refuse();
    result = static_cast<std::uint64_t>(number);
  } else {
    refuse();
  }
  if (result < least || result > greatest) refuse();
  return result;
}

const std::string& JsonValue::string() const {
  if (!value_->is_string()) fail_type("a string");
  return value_->get_ref<const std::string&>();
}

bool JsonValue::boolean() const {
  if (!value_->is_boolean()) fail_type("true or false");
  return value_->get<bool>();
}

}  // namespace fathom::text
