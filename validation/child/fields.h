#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "fathom/failures/errors.h"

/// What one process hands to another are structs with named fields: here are the names. Values go
/// by write_fields.h and come by read_fields.h.
namespace fathom::validation {

/// The names of a struct's fields, given once for both directions. Specialised with
///
///   template <class Visit, class S> static void each(Visit&& visit, S& s) {
///     auto& [first, second] = s;
///     visit("first", first);
///     visit("second", second);
///   }
///
/// where the structured binding makes a field that was forgotten an error of compilation.
template <class Struct>
struct Fields;

/// The names of an enumeration: `static constexpr E all[]` and `static std::string name(E)`.
template <class Enum>
struct Enumerators;

/// The names of a variant's alternatives, in their order: `static constexpr const char* names[]`.
template <class Variant>
struct Alternatives;

/// What was handed over is not what was expected.
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

}  // namespace fields_detail

}  // namespace fathom::validation
