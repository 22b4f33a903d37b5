#include "apps/textbook/cases/json_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/shell/failures.h"
#include "apps/shell/known_files.h"
#include "apps/shell/output_file.h"
#include "apps/shell/standard_streams.h"
#include "fathom/failures/errors.h"
#include "fathom/files/input_file.h"

namespace fathom::app::cases {
namespace {

/// The answer to one line, and what is wrong with the case if it cannot be done.
struct Answer {
  Json json = Json::object();
  std::optional<std::string> error;
};

Answer answer_to(std::string_view line, std::size_t number, const AnswerLine& answer_line) {
  Answer answer;
  Json name, body;
  try {
    body = answer_line(parse_case(line, name), number);
  } catch (const InputError& error) {
    answer.error = error.what();
    body = {{"error", *answer.error}};
  }
  if (name.is_null()) {
    answer.json = std::move(body);
    return answer;
  }
  answer.json["name"] = std::move(name);
  for (auto& [key, value] : body.items()) answer.json[key] = std::move(value);
  return answer;
}

bool is_blank(std::string_view line) {
  return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

}  // namespace

std::string input_name(const std::string& file) {
  return file == "-" ? "standard input" : file;
}

int answer_lines(const std::string& file, const AnswerCase& answer_case) {
  return answer_lines(
      file, AnswerLine([&](const Json& object, std::size_t) { return answer_case(object); }));
}

int answer_lines(const std::string& file, const AnswerLine& answer_line) {
  const std::string name = input_name(file);
  note_input(file);
  const files::InputFile input(file);
  std::string_view rest = input.text();
  std::size_t number = 0, count = 0, failures = 0;
  std::string first_failure;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    ++number;
    if (is_blank(line)) continue;
    ++count;
    const Answer answer = answer_to(line, number, answer_line);
    print(json_answer(answer.json, -1));
    if (answer.error && failures++ == 0)
      first_failure = fmt::format("{}: line {}: {}", name, number, *answer.error);
  }
  if (failures == 0) return done;
  throw InputError(failures == 1
                       ? first_failure
                       : fmt::format("{} (the first of {} cases of {} that cannot be done)",
                                     first_failure, failures, count));
}

std::string parse_svg_name(const std::string& text) {
  if (!text.ends_with(".svg") && !is_written_through(text))
    throw UsageError("'" + text + "' does not end in .svg");
  return text;
}

}  // namespace fathom::app::cases
