#include "fathom/scene/draw_state_json.h"

#include <span>
#include <string_view>
#include <utility>

namespace fathom::scene {
using namespace text;

namespace {

template <class Value>
using Word = std::pair<std::string_view, Value>;

constexpr Word<Comparison> comparisons[] = {
    {"never", Comparison::never},          {"less", Comparison::less},
    {"equal", Comparison::equal},          {"lequal", Comparison::less_equal},
    {"greater", Comparison::greater},      {"notequal", Comparison::not_equal},
    {"gequal", Comparison::greater_equal}, {"always", Comparison::always}};

constexpr Word<StencilAction> actions[] = {{"keep", StencilAction::keep},
                                           {"zero", StencilAction::zero},
                                           {"replace", StencilAction::replace},
                                           {"incr", StencilAction::increment},
                                           {"incr_wrap", StencilAction::increment_wrap},
                                           {"decr", StencilAction::decrement},
                                           {"decr_wrap", StencilAction::decrement_wrap},
                                           {"invert", StencilAction::invert}};

template <class Value>
Value word_of(const JsonValue& value, std::span<const Word<Value>> words, std::string known = "") {
  const std::string& text = value.string();
  for (const auto& [word, meaning] : words) {
    if (text == word) return meaning;
    known += (known.empty() ? "" : ", ") + std::string(word);
  }
  value.fail("expected one of " + known);
}

/// Calls `take` with the member of that name, if there is one.
template <class Take>
void with(const JsonValue& object, const char* key, const Take& take) {
  if (const auto found = object.find(key)) take(*found);
}

StencilState read_stencil(const JsonValue& value) {
  value.expect_only({"test", "reference", "mask", "write_mask", "fail", "depth_fail", "pass"});
  StencilState s;
  with(value, "test", [&](const JsonValue& v) { s.test = word_of<Comparison>(v, comparisons); });
  const auto byte = [&](const char* key, std::uint8_t& into) {
    with(value, key,
         [&](const JsonValue& v) { into = static_cast<std::uint8_t>(v.integer(0, 255)); });
  };
  byte("reference", s.reference);
  byte("mask", s.mask);
  byte("write_mask", s.write_mask);
  const auto action = [&](const char* key, StencilAction& into) {
    with(value, key, [&](const JsonValue& v) { into = word_of<StencilAction>(v, actions); });
  };
  action("fail", s.fail);
  action("depth_fail", s.depth_fail);
  action("pass", s.pass);
  return s;
}

}  // namespace

DrawState read_draw_state(const JsonValue& value) {
  value.expect_only(
      {"depth_test", "depth_write", "colour_write", "polygon_offset", "alpha", "stencil"});
  DrawState s;
  with(value, "depth_test", [&](const JsonValue& v) {
    if (v.string() != "nearer") s.depth_test = word_of<Comparison>(v, comparisons, "nearer");
  });
  with(value, "depth_write", [&](const JsonValue& v) { s.depth_write = v.boolean(); });
  with(value, "colour_write", [&](const JsonValue& v) { s.colour_write = v.boolean(); });
  with(value, "polygon_offset", [&](const JsonValue& v) {
    const std::vector<double> numbers = v.numbers(2);
    s.polygon_offset = PolygonOffset{numbers[0], numbers[1]};
  });
  with(value, "alpha", [&](const JsonValue& v) {
    s.alpha = v.number();
    if (!(*s.alpha >= 0 && *s.alpha <= 1)) v.fail("expected an opacity from 0 to 1");
  });
  with(value, "stencil", [&](const JsonValue& v) { s.stencil = read_stencil(v); });
  return s;
}

}  // namespace fathom::scene
