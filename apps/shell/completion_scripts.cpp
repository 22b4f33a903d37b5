#include "apps/shell/completion_scripts.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace fathom::app {
namespace {

using Files = CompletedValue::Files;

/// A word that sh, bash and zsh take as it is.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string words_of(const CompletedCommand& command) {
  return fmt::format("{}", fmt::join(command.path, " "));
}

/// The commands directly below one.
std::vector<const CompletedCommand*> below(const CompletionTable& table,
                                           const CompletedCommand& command) {
  std::vector<const CompletedCommand*> found;
  for (const CompletedCommand& each : table) {
    const bool is_below = each.path.size() == command.path.size() + 1 &&
                          std::equal(command.path.begin(), command.path.end(), each.path.begin());
    if (is_below) found.push_back(&each);
  }
  return found;
}

/// All that may stand where a command takes arguments.
CompletedValue arguments_of(const CompletedCommand& command) {
  CompletedValue value;
  for (const CompletedOption& option : command.options) {
    if (!option.is_argument) continue;
    value.words.insert(value.words.end(), option.value.words.begin(), option.value.words.end());
    value.files = std::max(value.files, option.value.files);
  }
  return value;
}

/// "known='…' list=1 files=all"
std::string assignments(const CompletedValue& value) {
  std::string text;
  if (!value.words.empty())
    text += " known=" + quoted(fmt::format("{}", fmt::join(value.words, " ")));
  if (value.is_list) text += " list=1";
  if (value.files == Files::all) text += " files=all";
  if (value.files == Files::folders) text += " files=folders";
  return text;
}

/// The function _fathom_value, which bash and zsh share: sets takes, known (words), list and files
/// to what option $2 of command $1 takes, or, where $2 is empty, to what its arguments are.
std::string value_function(const CompletionTable& table) {
  std::string text = "_fathom_value() {\n  takes= known= list= files=\n  case \"$1 $2\" in\n";
  for (const CompletedCommand& command : table) {
    const std::string name = words_of(command);
    text += fmt::format("    {})\n      takes=1{} ;;\n", quoted(name + " "),
                        assignments(arguments_of(command)));
    for (const CompletedOption& option : command.options) {
      if (option.is_argument || !option.takes_value) continue;
      std::vector<std::string> patterns;
      for (const std::string& each : option.names) patterns.push_back(quoted(name + " " + each));
      text += fmt::format("    {})\n      takes=1{} ;;\n", fmt::join(patterns, "|"),
                          assignments(option.value));
    }
  }
  return text + "  esac\n}\n";
}

/// "name:help", as _describe of zsh takes it.
std::string described(const std::string& name, const std::string& help) {
  return quoted(name + ":" + help);
}

/// A text within single quotes of fish.
std::string fish_quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

constexpr const char* bash_functions = R"(
# What is offered: words that begin with the text, each behind $prefix and without $head, which is
# typed already.
_fathom_offer() {
  local word
  for word in $1; do
    [[ $word == "$2"* ]] && COMPREPLY+=("$prefix${word#"$head"}")
  done
}

_fathom_offer_files() {
  local file
  compopt -o filenames 2>/dev/null
  while IFS= read -r file; do
    COMPREPLY+=("$file")
  done < <(if [[ $1 == folders ]]; then compgen -d -- "$2"; else compgen -f -- "$2"; fi)
}

# Words of a list: those that are not yet in it, behind those that are.
_fathom_offer_list() {
  local word before= rest=
  [[ $2 == *,* ]] && before=${2%,*},
  for word in $1; do
    [[ ,$before == *",$word,"* ]] || rest+=" $word"
  done
  prefix+=$before
  compopt -o nospace 2>/dev/null
  _fathom_offer "$rest" "${2##*,}"
}

_fathom_offer_value() {
  if [[ $list ]]; then _fathom_offer_list "$known" "$1"; else _fathom_offer "$known" "$head$1"; fi
  [[ $files ]] && _fathom_offer_files "$files" "$1"
}

_fathom() {
  local IFS=$' \t\n' command=fathom of=fathom word i cur=${COMP_WORDS[COMP_CWORD]}
  local option= prefix= head=
  local commands options takes known list files
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    _fathom_command "$command"
    [[ $word != -* && " $commands " == *" $word "* ]] || continue
    command+=" $word"
    of=$command
    # What 'help' explains is named from the beginning on.
    [[ $command == 'fathom help' ]] && command=fathom
    [[ ${COMP_WORDS[1]} == help ]] && of='fathom help'
  done
  # Bash takes a:b and --option=value for three words each.
  ((i = COMP_CWORD - 1))
  if [[ $cur == : ]]; then
    head=${COMP_WORDS[i]}: cur=
    ((i--))
  elif ((i > 1)) && [[ ${COMP_WORDS[i]} == : ]]; then
    head=${COMP_WORDS[i - 1]}:
    ((i -= 2))
  fi
  if [[ $cur == = ]]; then
    cur=
  elif ((i > 0)) && [[ ${COMP_WORDS[i]} == = ]]; then
    ((i--))
  fi
  ((i > 0)) && option=${COMP_WORDS[i]}
  if [[ $cur == --*=* ]]; then
    option=${cur%%=*} prefix=${cur%%=*}= cur=${cur#*=}
  fi
  if [[ $option == -* ]]; then
    _fathom_value "$of" "$option"
    if [[ $takes ]]; then
      _fathom_offer_value "$cur"
      return
    fi
  fi
  _fathom_command "$command"
  [[ $cur == -* ]] || _fathom_offer "$commands" "$cur"
  _fathom_command "$of"
  _fathom_value "$of" ''
  [[ $cur == -* ]] || _fathom_offer_value "$cur"
  [[ $cur == -* || ! ${COMPREPLY[*]} ]] && _fathom_offer "$options" "$cur"
}

complete -F _fathom fathom
)";

constexpr const char* zsh_functions = R"(
_fathom() {
  local command=fathom of=fathom word option i
  local takes known list files
  local -a commands options offered
  for ((i = 2; i < CURRENT; i++)); do
    word=$words[i]
    _fathom_command $command
    [[ $word != -* && -n ${(M)commands:#$word:*} ]] || continue
    command+=" $word"
    of=$command
    # What 'help' explains is named from the beginning on.
    [[ $command == 'fathom help' ]] && command=fathom
    [[ $words[2] == help ]] && of='fathom help'
  done
  option=$words[CURRENT-1]
  if [[ $PREFIX == --*=* ]]; then
    option=${PREFIX%%=*}
    compset -P '--*='
  fi
  if [[ $option == -* ]]; then
    _fathom_value $of $option
    if [[ -n $takes ]]; then
      _fathom_offer_value
      return
    fi
  fi
  if [[ $PREFIX == -* ]]; then
    _fathom_command $of
    _describe -o option options
    return
  fi
  local found=1
  _fathom_command $command
  (($#commands)) && _describe command commands && found=0
  _fathom_value $of ''
  _fathom_offer_value && found=0
  _fathom_command $of
  ((found)) && _describe -o option options && found=0
  return found
}

_fathom_offer_value() {
  local found=1
  offered=(${=known})
  if [[ -n $list ]]; then
    compset -P '*,'
    compadd -q -S , -a offered && found=0
  elif [[ -n $known ]]; then
    compadd -a offered && found=0
  fi
  [[ $files == all ]] && _files && found=0
  [[ $files == folders ]] && _files -/ && found=0
  return found
}

if [[ $funcstack[1] == _fathom ]]; then
  _fathom "$@"
else
  compdef _fathom fathom
fi
)";

constexpr const char* fish_functions = R"(
# The command that the line names so far; of 'fathom help camera' it is 'fathom camera'.
function __fathom_command
    set -l command fathom
    for word in (commandline -opc)[2..-1]
        contains -- "$command $word" $__fathom_commands; and set command "$command $word"
        test "$command" = 'fathom help'; and set command fathom
    end
    echo $command
end

function __fathom_explains
    set -l words (commandline -opc)
    test "$words[2]" = help
end

# Whether options and arguments of this command may follow.
function __fathom_at
    if __fathom_explains
        test "$argv" = 'fathom help'
    else
        test (__fathom_command) = "$argv"
    end
end

function __fathom_below
    test (__fathom_command) = "$argv"
end

# Words of a list: those that are not yet in it, behind those that are.
function __fathom_list
    set -l before (commandline -ct | string replace -r -- '^--[^=]*=' '' |
        string replace -rf -- '(.*,)[^,]*$' '$1')
    for word in $argv
        string match -q -- "*,$word,*" ",$before"; or echo "$before$word"
    end
end

complete -c fathom -f
)";

}  // namespace

std::string bash_completion(const CompletionTable& table) {
  std::string text =
      "# Completion of fathom in bash, made by 'fathom completion bash'.\n\n"
      "_fathom_command() {\n  commands= options=\n  case $1 in\n";
  for (const CompletedCommand& command : table) {
    std::vector<std::string> commands, options;
    for (const CompletedCommand* each : below(table, command))
      commands.push_back(each->path.back());
    for (const CompletedOption& option : command.options) {
      if (option.is_argument) continue;
      options.insert(options.end(), option.names.begin(), option.names.end());
    }
    text +=
        fmt::format("    {})\n      commands={}\n      options={} ;;\n", quoted(words_of(command)),
                    quoted(fmt::format("{}", fmt::join(commands, " "))),
                    quoted(fmt::format("{}", fmt::join(options, " "))));
  }
  return text + "  esac\n}\n\n" + value_function(table) + bash_functions;
}

std::string zsh_completion(const CompletionTable& table) {
  std::string text =
      "#compdef fathom\n"
      "# Completion of fathom in zsh, made by 'fathom completion zsh'.\n\n"
      "_fathom_command() {\n  commands=() options=()\n  case $1 in\n";
  for (const CompletedCommand& command : table) {
    text += "    " + quoted(words_of(command)) + ")\n      commands=(\n";
    for (const CompletedCommand* each : below(table, command))
      text += "        " + described(each->path.back(), each->help) + "\n";
    text += "      )\n      options=(\n";
    for (const CompletedOption& option : command.options) {
      if (option.is_argument) continue;
      for (const std::string& name : option.names)
        text += "        " + described(name, option.help) + "\n";
    }
    text += "      ) ;;\n";
  }
  return text + "  esac\n}\n\n" + value_function(table) + zsh_functions;
}

namespace {

/// The part of a line of `complete` that says what may stand here.
std::string fish_value(const CompletedValue& value) {
  std::string text = value.files == Files::all ? " -F" : " -f";
  std::string words = fmt::format("{}", fmt::join(value.words, " "));
  if (value.is_list) words = "(__fathom_list " + words + ")";
  if (value.files == Files::folders) words += " (__fish_complete_directories)";
  return words.empty() ? text : text + " -a " + fish_quoted(words);
}

std::string fish_option(const std::string& command, const CompletedOption& option) {
  std::string line = "complete -c fathom -n " + fish_quoted("__fathom_at " + command);
  for (const std::string& name : option.names)
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (option.takes_value) line += " -r" + fish_value(option.value);
  return line + " -d " + fish_quoted(option.help) + "\n";
}

}  // namespace

std::string fish_completion(const CompletionTable& table) {
  std::string text =
      "# Completion of fathom in fish, made by 'fathom completion fish'.\n\n"
      "set -g __fathom_commands";
  for (const CompletedCommand& command : table) text += " " + fish_quoted(words_of(command));
  text += std::string("\n") + fish_functions;
  for (const CompletedCommand& command : table) {
    const std::string name = words_of(command);
    for (const CompletedCommand* each : below(table, command)) {
      text += fmt::format("complete -c fathom -n {} -a {} -d {}\n",
                          fish_quoted("__fathom_below " + name), fish_quoted(each->path.back()),
                          fish_quoted(each->help));
    }
    const std::string arguments = fish_value(arguments_of(command));
    if (!arguments.empty())
      text += "complete -c fathom -n " + fish_quoted("__fathom_at " + name) + arguments + "\n";
    for (const CompletedOption& option : command.options) {
      if (!option.is_argument) text += fish_option(name, option);
    }
  }
  return text;
}

}  // namespace fathom::app
