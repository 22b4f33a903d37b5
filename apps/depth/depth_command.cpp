// fathom depth encode|decode|resolution|codes: depth formats as a calculator

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/options/depth_format_options.h"
#include "apps/shell/numbers.h"
#include "apps/shell/output_file.h"
#include "apps/shell/program.h"
#include "fathom/depth_format/resolution.h"
#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

using Json = nlohmann::ordered_json;

struct DepthArguments {
  DepthFormatOptions format;
  bool clamp = false, json = false;
  std::vector<std::string> values;
};

/// What the answers to one question need; `text` is one VALUE.
struct Question {
  const DepthFormat& format;
  bool clamp;
  const std::string& text;
};

/// An answer: as a line of text, and as JSON.
struct Answer {
  std::string text;
  Json json;
};
using Ask = Answer (*)(const Question&);

std::string to_text(double x) {
  return fmt::format("{:.17g}", x);
}

Ratio depth_in(const Question& question, const std::string& text) {
  const Ratio depth = Dyadic(parse_number("VALUE", text));
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

Answer encode_answer(const Question& question) {
  const Ratio depth = depth_in(question, question.text);
  const StoredDepth stored = encode(question.format, depth);
  Json json{{"depth", round_to_binary64(depth)}};
  add_stored(json, question.format, stored);
  json["decoded"] = decode_to_binary64(question.format, stored);
  return {to_text(question.format, stored), json};
}

/// A code as an integer, or a stored value, which is rounded to the storage.
StoredDepth stored_in(const Question& question) {
  const Storage storage = question.format.storage;
  const double number = parse_number("VALUE", question.text);
  const auto greatest = static_cast<double>(greatest_stored(storage).bits);
  if (is_unorm(storage)) {
    if (number < 0 || number > greatest || number != std::floor(number)) {
      throw InputError(fmt::format("'{}' is no code of {}: an integer from 0 to {}", question.text,
                                   name_of(storage), greatest_stored(storage).bits));
    }
    return {static_cast<std::uint64_t>(number)};
  }
  if (number < 0 || number > 1) {
    throw InputError(fmt::format("'{}' is no stored value: a number from 0 to 1", question.text));
  }
  return round_to_storage(storage, Ratio(Dyadic(number)));
}

Answer decode_answer(const Question& question) {
  const StoredDepth stored = stored_in(question);
  const double depth = decode_to_binary64(question.format, stored);
  Json json;
  add_stored(json, question.format, stored);
  json["depth"] = depth;  // null where it is infinity
  return {to_text(depth), json};
}

Answer resolution_answer(const Question& question) {
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
  return {to_text(larger), json};
}

Answer codes_answer(const Question& question) {
  const std::vector<std::string> ends = split_list(question.text);
  if (ends.size() > 2) {
    throw UsageError("VALUE: '" + question.text +
                     "' is neither a depth nor a range NEAREST,FARTHEST");
  }
  const Ratio nearest =
      ends.size() == 2 ? depth_in(question, ends[0]) : Ratio(Dyadic(question.format.near));
  const Ratio farthest = depth_in(question, ends.back());
  if (farthest < nearest) {
    throw InputError("'" + question.text + "' is no range NEAREST,FARTHEST: its ends are swapped");
  }
  const std::uint64_t codes = codes_between(question.format, nearest, farthest);
  return {fmt::format("{}", codes), Json{{"nearest", round_to_binary64(nearest)},
                                         {"farthest", round_to_binary64(farthest)},
                                         {"codes", codes}}};
}

std::string line_of(const Answer& answer, bool json) {
  return (json ? answer.json.dump() : answer.text) + "\n";
}

std::string trimmed(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return {};
  return line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
}

/// A binary64 number needs 1074 digits at most; no sane text is longer.
constexpr std::size_t longest_value = 4096;

/// One value a line from standard input, one answer a line, as they come.
void answer_lines(const DepthFormat& format, const DepthArguments& arguments, Ask ask) {
  std::string line;
  for (std::size_t number = 1; std::getline(std::cin, line); ++number) {
    const std::string text = trimmed(line);
    try {
      if (text.size() > longest_value) throw UsageError("VALUE: longer than any number");
      print(line_of(ask({format, arguments.clamp, text}), arguments.json));
    } catch (const Error& error) {
      if (dynamic_cast<const OutputError*>(&error) != nullptr) throw;
      throw InputError(fmt::format("standard input: line {}: {}", number, error.what()));
    }
  }
}

int answer_all(const DepthArguments& arguments, Ask ask) {
  const DepthFormat format = arguments.format.format();
  if (arguments.values.empty()) {
    answer_lines(format, arguments, ask);
    return done;
  }
  std::string text;
  for (const std::string& value : arguments.values) {
    text += line_of(ask({format, arguments.clamp, value}), arguments.json);
  }
  print(text);
  return done;
}

void add_question(Program& program, CLI::App& depth, const char* name, const char* description,
                  const char* values, const char* example, Ask ask) {
  auto arguments = std::make_shared<DepthArguments>();
  CLI::App* command = program.add_command(name, description, example, &depth);
  arguments->format.add_to(*command);
  command->add_flag("--clamp", arguments->clamp,
                    "Take depths outside [near, far] as the nearer of these");
  command->add_flag("--json", arguments->json,
                    "One JSON object a line, with all that is known; null is infinity");
  command->add_option("VALUE", arguments->values, values);
  command->callback([&program, arguments, ask] {
    program.run = [arguments, ask] { return answer_all(*arguments, ask); };
  });
}

}  // namespace

void add_depth(Program& program) {
  CLI::App* depth = program.add_command(
      "depth", "What depth buffers store, exactly",
      "  fathom depth encode --mapping reversed --storage unorm24 --near 0.1 --far 1000 5\n"
      "  fathom depth resolution --storage unorm16 --near 0.1 --far 100 1 10 50\n"
      "\n'fathom depth encode --help' lists the mappings and storages.");
  depth->require_subcommand(1);
  add_question(program, *depth, "encode", "The stored value of a depth",
               "Depths; one a line from standard input where there are none",
               "  fathom depth encode --mapping log --storage unorm24 --near 0.1 --far 1e6 12.5",
               encode_answer);
  add_question(program, *depth, "decode", "The depth that a stored value stands for",
               "Integer codes of unorm storages, values from 0 to 1 of float storages",
               "  fathom depth decode --storage unorm16 --near 0.1 --far 100 0 65000 65535",
               decode_answer);
  add_question(program, *depth, "resolution",
               "The larger distance to the depths of the two neighbouring codes, in scene units",
               "Depths",
               "  fathom depth resolution --storage unorm24 --near 0.1 --far 1000 1 10 100 --json",
               resolution_answer);
  add_question(program, *depth, "codes", "The number of codes that a range of depths is stored as",
               "Depths D, for the range from near to D, or ranges NEAREST,FARTHEST",
               "  fathom depth codes --storage unorm16 --near 0.1 --far 100 1 10,100",
               codes_answer);
}

}  // namespace fathom::app
