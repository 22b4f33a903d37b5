#include "apps/depth/depth_answers.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/shell/failures.h"
#include "apps/shell/values.h"
#include "fathom/depth_format/resolution.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

std::string to_text(double x) {
  return fmt::format("{:.17g}", x);
}

/// A number; where it is none, VALUE is to blame.
double number_in(const std::string& text) {
  return about_option("VALUE", [&] { return parse_number(text); });
}

Ratio depth_in(const DepthQuestion& question, const std::string& text) {
  const Ratio depth = Dyadic(number_in(text));
  return question.clamp ? clamp_to_range(question.format, depth) : depth;
}

double value_in_binary64(const DepthFormat& format, StoredDepth stored) {
  return round_to_binary64(value_of(format.storage, stored));
}

/// The code of a unorm, the value of a float storage: what encode prints and decode reads.
std::string to_text(const DepthFormat& format, StoredDepth stored) {
  return is_unorm(format.storage) ? fmt::format("{}", stored.bits)
                                  : to_text(value_in_binary64(format, stored));
}

/// What both kinds of storage say about a stored value.
void add_stored(Json& json, const DepthFormat& format, StoredDepth stored) {
  json[is_unorm(format.storage) ? "code" : "bits"] = stored.bits;
  json["value"] = value_in_binary64(format, stored);
}

/// A code as an integer, or a stored value, which is rounded to the storage.
StoredDepth stored_in(const DepthQuestion& question) {
  const Storage storage = question.format.storage;
  const double number = number_in(question.text);
  const auto greatest = static_cast<double>(greatest_stored(storage).bits);
  if (is_unorm(storage)) {
    if (number < 0 || number > greatest || number != std::floor(number)) {
      throw InputError(fmt::format("'{}' is not a code of {}: an integer from 0 to {}",
                                   question.text, name_of(storage), greatest_stored(storage).bits));
    }
    return {static_cast<std::uint64_t>(number)};
  }
  if (number < 0 || number > 1) {
    throw InputError(
        fmt::format("'{}' is not a stored value: a number from 0 to 1", question.text));
  }
  return round_to_storage(storage, Ratio(Dyadic(number)));
}

}  // namespace

DepthAnswer encode_answer(const DepthQuestion& question) {
  const Ratio depth = depth_in(question, question.text);
  const StoredDepth stored = encode(question.format, depth);
  Json json{{"depth", round_to_binary64(depth)}};
  add_stored(json, question.format, stored);
  json["decoded"] = decode_to_binary64(question.format, stored);
  return {to_text(question.format, stored), json.dump()};
}

DepthAnswer decode_answer(const DepthQuestion& question) {
  const StoredDepth stored = stored_in(question);
  const double depth = decode_to_binary64(question.format, stored);
  Json json;
  add_stored(json, question.format, stored);
  json["depth"] = depth;  // null where it is infinity
  return {to_text(depth), json.dump()};
}

DepthAnswer resolution_answer(const DepthQuestion& question) {
  const Ratio depth = depth_in(question, question.text);
  const Resolution step = resolution(question.format, depth);
  const double larger = std::max(step.to_nearer.value_or(0), step.to_farther.value_or(0));
  Json json{{"depth", round_to_binary64(depth)}};
  add_stored(json, question.format, step.stored);
  json["decoded"] = decode_to_binary64(question.format, step.stored);
  json["resolution"] = larger;
  if (step.to_nearer) json["to_nearer"] = *step.to_nearer;
  if (step.to_farther) json["to_farther"] = *step.to_farther;
  const std::optional<double> behind = separation_behind(question.format, depth);
  if (behind) json["separation_behind"] = *behind;
  json["bin_width"] = bin_width(question.format, depth);
  return {to_text(larger), json.dump()};
}

DepthAnswer codes_answer(const DepthQuestion& question) {
  const std::vector<std::string> ends = parse_list(question.text);
  if (ends.size() > 2) {
    throw UsageError("VALUE: '" + question.text +
                     "' is neither a depth nor a range NEAREST,FARTHEST");
  }
  const Ratio nearest =
      ends.size() == 2 ? depth_in(question, ends[0]) : Ratio(Dyadic(question.format.near));
  const Ratio farthest = depth_in(question, ends.back());
  if (farthest < nearest) {
    throw InputError("'" + question.text +
                     "' is not a range NEAREST,FARTHEST: its ends are swapped");
  }
  const std::uint64_t codes = codes_between(question.format, nearest, farthest);
  const Json json{{"nearest", round_to_binary64(nearest)},
                  {"farthest", round_to_binary64(farthest)},
                  {"codes", codes}};
  return {fmt::format("{}", codes), json.dump()};
}

}  // namespace fathom::app
