#include "apps/depth/depth_command.h"

#include <fmt/core.h>

#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "apps/depth/depth_answers.h"
#include "apps/options/depth_format_options.h"
#include "apps/shell/failures.h"
#include "apps/shell/standard_streams.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

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

std::string trimmed(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(" \t\r");
  if (begin == std::string::npos) return {};
  return line.substr(begin, line.find_last_not_of(" \t\r") - begin + 1);
}

/// A binary64 number needs 1074 digits at most; no sane text is longer.
constexpr std::size_t longest_value = 4096;

/// The next line of standard input, or its beginning where it is too long for a value.
bool read_line(std::string& line) {
  line.clear();
  for (int c = std::cin.get(); c != std::char_traits<char>::eof(); c = std::cin.get()) {
    if (c == '\n') return true;
    line += static_cast<char>(c);
    if (line.size() > longest_value) return true;
  }
  return !line.empty();
}

/// One value a line from standard input, one answer a line, as they come.
void answer_lines(const DepthFormat& format, const DepthArguments& arguments, Ask ask) {
  std::string line;
  for (std::size_t number = 1; read_line(line); ++number) {
    const std::string text = trimmed(line);
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

void add_question(Command& depth, const DepthCommand& question) {
  const auto arguments = std::make_shared<DepthArguments>();
  Command& command = depth.command(question.name, question.description, question.example);
  arguments->format.add_to(command);
  command.flag("--clamp", arguments->clamp, "Clamp depths outside [near, far] to the nearer end");
  command.flag("--json", arguments->json,
               "Print one JSON object per line with all details; null is infinity");
  command.arguments("VALUE", arguments->values, question.values);
  command.answers_on_standard_output();
  command.runs(
      [arguments, ask = question.ask](const Console&) { return answer_all(*arguments, ask); });
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
