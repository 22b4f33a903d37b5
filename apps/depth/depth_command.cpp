#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "apps/options/depth_format_options.h"
#include "apps/shell/console.h"
#include "apps/shell/failures.h"
#include "apps/shell/standard_streams.h"
#include "apps/shell/values.h"
#include "fathom/depth_format/depth_format.h"
#include "fathom/depth_format/resolution.h"
#include "fathom/failures/errors.h"
#include "fathom/text/ascii.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

/// A question about a depth format; `text` is one VALUE.
struct DepthQuestion {
  const DepthFormat& format;
  bool clamp;  ///< takes depths outside of [near, far] as the nearer end
  const std::string& text;
};

/// An answer: as a line of text, and as a line of JSON.
struct DepthAnswer {
  std::string text, json;
};

std::string to_text(double x) {
  return fmt::format("{}", x);
}

/// A number. Fails with a message about VALUE if the text is not a number.
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

/// Adds the members that both kinds of storage have for a stored value.
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

/// All fail with UsageError if the text is not a number, and with InputError if the format has no
/// such depth or stored value.
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

struct DepthArguments {
  DepthFormatOptions format;
  bool clamp = false, json = false;
  std::vector<std::string> values;
};

using Ask = DepthAnswer (*)(const DepthQuestion&);

/// One of the questions, as a command.
struct DepthCommand {
  const char* name;
  const char* description;
  const char* values;  ///< what VALUE is
  const char* example;
  Ask ask;
};

std::string line_of(const DepthAnswer& answer, bool json) {
  return (json ? answer.json : answer.text) + "\n";
}

/// A binary64 number needs at most 1074 digits; a reasonable text is not longer.
constexpr std::size_t longest_value = 4096;

/// Reads the next line of standard input, or its beginning if it is too long for a value.
bool read_line(std::string& line) {
  line.clear();
  for (int c = std::cin.get(); c != std::char_traits<char>::eof(); c = std::cin.get()) {
    if (c == '\n') return true;
    line += static_cast<char>(c);
    if (line.size() > longest_value) return true;
  }
  return !line.empty();
}

/// Reads one value per line from standard input and prints one answer per line, each at once.
void answer_lines(const DepthFormat& format, const DepthArguments& arguments, Ask ask,
                  const Console& console) {
  if (!console.quiet && ::isatty(STDIN_FILENO) == 1)
    console.note("reading VALUEs from standard input, one per line");
  std::string line;
  for (std::size_t number = 1; read_line(line); ++number) {
    const std::string text(text::trimmed(line));
    std::string answer;
    try {
      if (line.size() > longest_value) throw UsageError("VALUE: longer than any number");
      answer = line_of(ask({format, arguments.clamp, text}), arguments.json);
    } catch (const Error& error) {
      throw InputError(fmt::format("standard input: line {}: {}", number, error.what()));
    }
    print(answer);
  }
}

int answer_all(const DepthArguments& arguments, Ask ask, const Console& console) {
  const DepthFormat format = arguments.format.format();
  if (arguments.values.empty()) {
    answer_lines(format, arguments, ask, console);
    return done;
  }
  std::string text;
  for (const std::string& value : arguments.values) {
    text += line_of(ask({format, arguments.clamp, value}), arguments.json);
  }
  print(text);
  return done;
}

void add_question(Command& depth, const DepthCommand& question) {
  const auto arguments = std::make_shared<DepthArguments>();
  Command& command = depth.command(question.name, question.description, question.example);
  arguments->format.add_to(command);
  command.flag("--clamp", arguments->clamp, "Clamp depths outside [near, far] to the nearer end");
  command.flag("--json", arguments->json,
               "Print one JSON object per line with all details; null is infinity");
  command.arguments("VALUE", arguments->values, question.values);
  command.answers_on_standard_output();
  command.runs([arguments, ask = question.ask](const Console& console) {
    return answer_all(*arguments, ask, console);
  });
}

}  // namespace

void add_depth(Command& program) {
  Command& family = program.command(
      "depth", "Encode, decode and count depth-buffer values exactly",
      "  fathom depth encode --mapping reversed --storage unorm24 --near 1 --far 100 5\n"
      "  fathom depth resolution --storage unorm16 --near 0.1 --far 100 1 10 50\n"
      "\n'fathom depth encode --help' lists the mappings and storages.");
  family.requires_command();
  add_question(family,
               {"encode", "Compute the stored value of a depth",
                "Depths; if none is given, read from standard input, one per line",
                "  fathom depth encode --mapping log --storage unorm24 --near 0.1 --far 1e6 12.5",
                encode_answer});
  add_question(family,
               {"decode", "Compute the depth of a stored value",
                "Integer codes of unorm storages, values from 0 to 1 of float storages",
                "  fathom depth decode --storage unorm16 --near 0.1 --far 100 0 65000 65535",
                decode_answer});
  add_question(
      family,
      {"resolution",
       "Compute the larger of the distances to the depths of the two neighbouring codes, "
       "in scene units",
       "Depths", "  fathom depth resolution --storage unorm24 --near 0.1 --far 100 1 10 --json",
       resolution_answer});
  add_question(family, {"codes", "Count the codes that represent a range of depths",
                        "Depths D, for the range from near to D, or ranges NEAREST,FARTHEST",
                        "  fathom depth codes --storage unorm16 --near 0.1 --far 100 1 10,100",
                        codes_answer});
}

}  // namespace fathom::app
