#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "validation/child/fields.h"

namespace fathom::validation {
namespace fields_detail {

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

/// An object whose only field is called as the alternative.
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
/// structs of these; vectors of numbers as they lie in memory. Exact, infinities and NaN included.
template <class T>
std::string to_bytes(const T& value) {
  std::string bytes;
  nlohmann::json::to_cbor(fields_detail::written(value), bytes);
  return bytes;
}

}  // namespace fathom::validation
