#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "fathom/failures/errors.h"
#include "fathom/text/parse_json.h"

/// Messages between processes: structs with named fields as bytes (CBOR), and back.
namespace fathom::validation {

/// The names of a struct's fields, given once for both directions. Specialised with
///
///   template <class Visit, class S> static void each(Visit&& visit, S& s) {
///     auto& [first, second] = s;
///     visit("first", first);
///     visit("second", second);
///   }
///
/// where the structured binding makes a forgotten field a compilation error.
template <class Struct>
struct Fields;

/// The names of an enumeration: `static constexpr E all[]` and `static std::string name(E)`.
template <class Enum>
struct Enumerators;

/// The names of a variant's alternatives, in their order: `static constexpr const char* names[]`.
template <class Variant>
struct Alternatives;

/// The bytes are not the expected value.
class ForeignAnswer : public InputError {
 public:
  using InputError::InputError;
};

namespace fields_detail {

template <class T, template <class...> class Template>
inline constexpr bool is_a = false;
template <template <class...> class Template, class... Arguments>
inline constexpr bool is_a<Template<Arguments...>, Template> = true;
template <class T>
inline constexpr bool is_array = false;
template <class T, std::size_t N>
inline constexpr bool is_array<std::array<T, N>> = true;

using Json = nlohmann::json;

template <class T>
Json written(const T& value);

template <class T>
Json written_list(const std::vector<T>& values) {
  if constexpr (std::is_arithmetic_v<T>) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(values.data());
    return Json::binary({bytes, bytes + values.size() * sizeof(T)});
  } else {
    Json list = Json::array();
    for (const T& value : values) list.push_back(written(value));
    return list;
  }
}

/// An object whose only field has the name of the alternative.
template <class Variant>
Json written_variant(const Variant& variant) {
  Json json;
  std::visit(
      [&](const auto& value) {
        json[Alternatives<Variant>::names[variant.index()]] = written(value);
      },
      variant);
  return json;
}

template <class S>
Json written_struct(const S& value) {
  Json json = Json::object();
  Fields<S>::each([&](const char* name, const auto& field) { json[name] = written(field); }, value);
  return json;
}

template <class T>
Json written(const T& value) {
  if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    return value;
  } else if constexpr (std::is_enum_v<T>) {
    return Enumerators<T>::name(value);
  } else if constexpr (is_a<T, std::optional>) {
    return value ? written(*value) : Json(nullptr);
  } else if constexpr (is_a<T, std::vector>) {
    return written_list(value);
  } else if constexpr (is_a<T, std::variant>) {
    return written_variant(value);
  } else if constexpr (is_array<T>) {
    Json list = Json::array();
    for (const auto& element : value) list.push_back(written(element));
    return list;
  } else {
    return written_struct(value);
  }
}

}  // namespace fields_detail

/// A value as bytes (CBOR): numbers, texts, enumerations, optionals, vectors, arrays, variants and
/// structs of these; vectors of numbers have the layout of memory. Exact, also for infinities and
/// NaN.
template <class T>
std::string to_bytes(const T& value) {
  std::string bytes;
  nlohmann::json::to_cbor(fields_detail::written(value), bytes);
  return bytes;
}

namespace fields_detail {

[[noreturn]] inline void refuse(const std::string& where, const std::string& what) {
  throw ForeignAnswer((where.empty() ? "it" : where) + " " + what);
}

inline std::string inside(const std::string& where, const std::string& field) {
  return where.empty() ? field : where + "." + field;
}

template <class T>
void read(const Json& json, T& value, const std::string& where);

template <class T>
void read_list(const Json& json, std::vector<T>& values, const std::string& where) {
  if constexpr (std::is_arithmetic_v<T>) {
    if (!json.is_binary()) refuse(where, "is not an array of numbers");
    const auto& bytes = json.get_binary();
    if (bytes.size() % sizeof(T) != 0) refuse(where, "is cut short");
    values.resize(bytes.size() / sizeof(T));
    if (!bytes.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
  } else {
    if (!json.is_array()) refuse(where, "is not a list");
    values.resize(json.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      read(json[i], values[i], inside(where, std::to_string(i)));
    }
  }
}

template <class E>
void read_enumerator(const Json& json, E& value, const std::string& where) {
  for (const E candidate : Enumerators<E>::all) {
    if (!json.is_string() || json.get_ref<const std::string&>() != Enumerators<E>::name(candidate))
      continue;
    value = candidate;
    return;
  }
  refuse(where, "has none of the values that it may have");
}

template <class Variant, std::size_t I = 0>
void read_variant(const Json& json, Variant& variant, const std::string& where) {
  if constexpr (I == std::variant_size_v<Variant>) {
    refuse(where, "is not one of its alternatives");
  } else {
    const std::string name = Alternatives<Variant>::names[I];
    if (!json.is_object() || json.size() != 1 || !json.contains(name)) {
      read_variant<Variant, I + 1>(json, variant, where);
      return;
    }
    read(json[name], variant.template emplace<I>(), inside(where, name));
  }
}

template <class S>
void read_struct(const Json& json, S& value, const std::string& where) {
  if (!json.is_object()) refuse(where, "is not an object");
  std::size_t count = 0;
  Fields<S>::each(
      [&](const char* name, auto& field) {
        const auto found = json.find(name);
        if (found == json.end()) refuse(inside(where, name), "is missing");
        read(*found, field, inside(where, name));
        ++count;
      },
      value);
  if (count != json.size()) refuse(where, "has fields that are not known");
}

template <class T>
void read_number(const Json& json, T& value, const std::string& where) {
  if constexpr (std::is_same_v<T, bool>) {
    if (!json.is_boolean()) refuse(where, "is not true or false");
    value = json.get<bool>();
  } else if constexpr (std::is_floating_point_v<T>) {
    if (!json.is_number()) refuse(where, "is not a number");
    value = json.get<T>();
  } else {
    const bool is_whole =
        std::is_unsigned_v<T> ? json.is_number_unsigned() : json.is_number_integer();
    if (is_whole) value = json.get<T>();
    if (!is_whole || Json(value) != json) refuse(where, "is not a whole number of its type");
  }
}

template <class T>
void read(const Json& json, T& value, const std::string& where) {
  if constexpr (std::is_arithmetic_v<T>) {
    read_number(json, value, where);
  } else if constexpr (std::is_same_v<T, std::string>) {
    if (!json.is_string()) refuse(where, "is not a text");
    value = json.get<std::string>();
  } else if constexpr (std::is_enum_v<T>) {
    read_enumerator(json, value, where);
  } else if constexpr (is_a<T, std::optional>) {
    if (json.is_null()) {
      value.reset();
    } else {
      read(json, value.emplace(), where);
    }
  } else if constexpr (is_a<T, std::vector>) {
    read_list(json, value, where);
  } else if constexpr (is_a<T, std::variant>) {
    read_variant(json, value, where);
  } else if constexpr (is_array<T>) {
    if (!json.is_array() || json.size() != value.size()) {
      refuse(where, "is not a list of " + std::to_string(value.size()));
    }
    for (std::size_t i = 0; i < value.size(); ++i) {
      read(json[i], value[i], inside(where, std::to_string(i)));
    }
  } else {
    read_struct(json, value, where);
  }
}

}  // namespace fields_detail

/// The value that was passed to to_bytes().
/// Fails    ForeignAnswer, in one line, unless the bytes are exactly such a value.
template <class T>
T from_bytes(const std::string& bytes) {
  nlohmann::json json;
  try {
    json = text::parse_cbor(bytes);
  } catch (const text::JsonFault&) {
    throw ForeignAnswer("it is cut short or in another format");
  }
  T value{};
  fields_detail::read(json, value, "");
  return value;
}

}  // namespace fathom::validation
