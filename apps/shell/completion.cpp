#include "apps/shell/completion.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>

namespace fathom::app {
namespace {

using Files = CompletedValue::Files;

/// What values and arguments are called that are names of files.
constexpr std::array<std::string_view, 10> files{"FILE",  "MAP",    "SCENE", "TRUTH", "OTHER",
                                                 "INPUT", "REPORT", "PNG",   "SVG",   "PATH"};

Files files_called(const std::string& name) {
  if (name == "DIR") return Files::folders;
  return std::ranges::count(files, name) > 0 ? Files::all : Files::none;
}

constexpr std::array<const char*, 3> file_names{"none", "all", "folders"};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::string line_of(const CompletedOption& option) {
  return fmt::format("option\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", fmt::join(option.names, " "),
                     option.is_argument, option.takes_value, fmt::join(option.value.words, " "),
                     option.value.is_list, file_names[static_cast<std::size_t>(option.value.files)],
                     option.help);
}

CompletedOption option_of(const std::vector<std::string>& fields) {
  CompletedOption option;
  option.names = split(fields[1], ' ');
  option.is_argument = fields[2] == "true";
  option.takes_value = fields[3] == "true";
  option.value.words = split(fields[4], ' ');
  option.value.is_list = fields[5] == "true";
  for (std::size_t i = 0; i < file_names.size(); ++i) {
    if (fields[6] == file_names[i]) option.value.files = static_cast<Files>(i);
  }
  option.help = fields[7];
  return option;
}

}  // namespace

CompletedOption completed(const OptionText& option, std::vector<std::string> words, bool is_list) {
  CompletedOption made;
  made.names = option.names;
  made.help = option.help;
  made.is_argument = option.is_argument;
  made.takes_value = option.is_argument || !option.value.empty();
  made.value.words = std::move(words);
  made.value.is_list = is_list;
  made.value.files = files_called(option.is_argument ? option.names[0] : option.value);
  return made;
}

std::string to_lines(const CompletionTable& table) {
  std::string lines;
  for (const CompletedCommand& command : table) {
    lines += fmt::format("command\t{}\t{}\n", fmt::join(command.path, " "), command.help);
    for (const CompletedOption& option : command.options) lines += line_of(option);
  }
  return lines;
}

CompletionTable table_from_lines(const std::string& lines) {
  CompletionTable table;
  for (const std::string& line : split(lines, '\n')) {
    const std::vector<std::string> fields = split(line, '\t');
    if (fields.size() == 3 && fields[0] == "command")
      table.push_back({split(fields[1], ' '), fields[2], {}});
    else if (fields.size() == 8 && fields[0] == "option" && !table.empty())
      table.back().options.push_back(option_of(fields));
  }
  return table;
}

namespace {

using Files = CompletedValue::Files;
using Path = std::vector<std::string>;

/// The words of a line, those joined that bash took apart.
struct Line {
  Path words;
  /// Of the last word, the text that stands in bash's words before its last one.
  std::string before;
};

Line joined_line(const std::vector<std::string>& parts) {
  Line line;
  bool joins_next = false;
  for (const std::string& part : parts) {
    const bool is_break = part == "=" || part == ":";
    line.before.clear();
    if (line.words.size() > 1 && (is_break || joins_next)) {
      if (!is_break) line.before = line.words.back();
      line.words.back() += part;
      if (is_break) line.before = line.words.back();
    } else {
      line.words.push_back(part);
    }
    joins_next = is_break;
  }
  return line;
}

const CompletedCommand* command_at(const CompletionTable& table, const Path& path) {
  const auto found = std::ranges::find(table, path, &CompletedCommand::path);
  return found == table.end() ? nullptr : &*found;
}

/// The commands that the words before the last one name.
struct Place {
  Path above;    ///< commands below this one may follow
  Path options;  ///< options and arguments of this one may follow
};

Place place_of(const CompletionTable& table, const Path& words) {
  const Path help{"fathom", "help"};
  Place place{{"fathom"}, {"fathom"}};
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    Path below = place.above;
    below.push_back(words[i]);
    if (command_at(table, below) == nullptr) continue;
    place.above = place.options = below;
    // `help` takes the names of commands from the first on.
    if (place.above == help) place.above = {"fathom"};
    if (words[1] == "help") place.options = help;
  }
  return place;
}

/// Collects the offers for a word.
class Offers {
 public:
  explicit Offers(Line line) : line_(std::move(line)) {}

  void add(const std::string& word, const std::string& help) {
    if (word.starts_with(line_.before))
      words_ += word.substr(line_.before.size()) + "\t" + help + "\n";
  }
  /// What an option or an argument takes; `prefix` is "--option=" where it stands in the same word.
  void add_value(const CompletedValue& value, const std::string& prefix, const std::string& text) {
    const std::size_t comma = value.is_list ? text.rfind(',') : std::string::npos;
    const std::string before = comma == std::string::npos ? "" : text.substr(0, comma + 1);
    for (const std::string& word : value.words) {
      if (("," + before).find("," + word + ",") == std::string::npos)
        add(prefix + before + word, "");
    }
    is_list_ = is_list_ || value.is_list;
    files_ = std::max(files_, value.files);
  }
  void add_options(const CompletedCommand& command) {
    for (const CompletedOption& option : command.options) {
      if (option.is_argument) continue;
      for (const std::string& name : option.names) add(name, option.help);
    }
  }
  [[nodiscard]] bool has_any() const { return !words_.empty() || files_ != Files::none; }
  [[nodiscard]] std::string lines() const {
    constexpr std::array<const char*, 3> names{"none", "all", "folders"};
    return std::string(names[static_cast<std::size_t>(files_)]) + (is_list_ ? " list" : " word") +
           "\n" + words_;
  }

 private:
  Line line_;
  std::string words_;
  bool is_list_ = false;
  Files files_ = Files::none;
};

/// The option of this name, if it takes a value.
const CompletedOption* option_with_value(const CompletedCommand& command, const std::string& name) {
  const auto found = std::ranges::find_if(command.options, [&](const CompletedOption& option) {
    return !option.is_argument && option.takes_value && std::ranges::count(option.names, name) > 0;
  });
  return found == command.options.end() ? nullptr : &*found;
}

}  // namespace

std::string offers_for(const CompletionTable& table, const std::vector<std::string>& words) {
  const Line line = joined_line(words);
  Offers offers(line);
  if (line.words.size() < 2) return offers.lines();
  const Place place = place_of(table, line.words);
  const CompletedCommand* const command = command_at(table, place.options);
  if (command == nullptr) return offers.lines();
  const std::string& last = line.words.back();

  const std::size_t equals = last.starts_with("--") ? last.find('=') : std::string::npos;
  const bool has_name = equals != std::string::npos;
  const std::string prefix = has_name ? last.substr(0, equals + 1) : "";
  const std::string name = has_name ? last.substr(0, equals) : line.words[line.words.size() - 2];
  if (const CompletedOption* const option = option_with_value(*command, name)) {
    offers.add_value(option->value, prefix, last.substr(prefix.size()));
    return offers.lines();
  }
  if (last.starts_with("-")) {
    offers.add_options(*command);
    return offers.lines();
  }
  for (const CompletedCommand& each : table) {
    const bool is_below = !each.path.empty() && each.path.size() == place.above.size() + 1 &&
                          std::equal(place.above.begin(), place.above.end(), each.path.begin());
    if (is_below) offers.add(each.path.back(), each.help);
  }
  for (const CompletedOption& option : command->options) {
    if (option.is_argument) offers.add_value(option.value, "", last);
  }
  if (!offers.has_any()) offers.add_options(*command);
  return offers.lines();
}

const char* const bash_completion =
    R"(# Completion of fathom in bash, made by 'fathom completion bash'.

_fathom() {
  local program=${1:-fathom} cur=${COMP_WORDS[COMP_CWORD]} kind='' line
  program=${BASH_ALIASES[$program]:-$program}
  program=${program/#~\//"$HOME"/}
  [[ $cur == [=:] ]] && cur=
  COMPREPLY=()
  while IFS= read -r line; do
    if [[ ! $kind ]]; then
      kind=$line
    elif [[ $line == "$cur"* ]]; then
      COMPREPLY+=("${line%%$'\t'*}")
    fi
  done < <("$program" complete -- "${COMP_WORDS[@]:0:COMP_CWORD+1}" 2>/dev/null)
  [[ $kind == *list ]] && compopt -o nospace 2>/dev/null
  [[ $kind == none* || ! $kind ]] && return
  compopt -o filenames 2>/dev/null
  while IFS= read -r line; do
    COMPREPLY+=("$line")
  done < <(if [[ $kind == folders* ]]; then compgen -d -- "$cur"; else compgen -f -- "$cur"; fi)
}

complete -F _fathom fathom
)";

const char* const zsh_completion = R"(#compdef fathom
# Completion of fathom in zsh, made by 'fathom completion zsh'.

_fathom() {
  local -a lines plain described
  local program=${${(Q)words[1]}/#\~\//$HOME/} kind line found=1
  lines=("${(@f)$("$program" complete -- "${(@)words[1,CURRENT-1]}" "$PREFIX" 2>/dev/null)}")
  kind=$lines[1]
  [[ $PREFIX == --*=* ]] && compset -P '--*='
  [[ $kind == *list ]] && compset -P '*,'
  for line in "${(@)lines[2,-1]}"; do
    line=${line#"$IPREFIX"}
    if [[ $line == *$'\t' ]]; then
      plain+=("${line%$'\t'}")
    else
      described+=("${${line%%$'\t'*}//:/\\:}:${line#*$'\t'}")
    fi
  done
  if (($#plain)); then
    if [[ $kind == *list ]]; then compadd -q -S , -a plain; else compadd -a plain; fi && found=0
  fi
  if (($#described)); then
    if [[ $described[1] == -* ]]; then
      _describe -o option described
    else
      _describe command described
    fi && found=0
  fi
  [[ $kind == all* ]] && _files && found=0
  [[ $kind == folders* ]] && _files -/ && found=0
  return found
}

if [[ $funcstack[1] == _fathom ]]; then
  _fathom "$@"
else
  compdef _fathom fathom
fi
)";

const char* const fish_completion =
    R"(# Completion of fathom in fish, made by 'fathom completion fish'.

function __fathom_complete
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    set -l lines ($words[1] complete -- $words "$current" 2>/dev/null)
    set -q lines[1]; or return
    set -l before (string match -r -- '^--[^=]*=' "$current")
    set -l text (string replace -- "$before" '' "$current")
    switch $lines[1]
        case 'all *'
            printf "$before%s\n" (__fish_complete_path "$text")
        case 'folders *'
            printf "$before%s\n" (__fish_complete_directories "$text" '')
    end
    set -q lines[2]; and printf '%s\n' $lines[2..-1]
end

complete -c fathom -f -k -a '(__fathom_complete)'
)";

}  // namespace fathom::app
