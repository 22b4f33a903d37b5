#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "apps/shell/console.h"

namespace fathom::app {

/// Exit statuses of every command.
enum ExitStatus : int {
  done = 0,
  answer_is_no = 1,
  wrong_usage = 2,
  unusable_input = 3,
  unwritable_output = 4,
  internal_error = 70,
};

/// The command line: the subcommands, what they share, and the one that was chosen.
struct Program {
  Program();

  CLI::App app;
  Console console;
  /// Set by the subcommand that the arguments name; returns the exit status.
  std::function<int()> run;

  /// A subcommand of `parent` (default: of the program) with what all of them have.
  /// `examples` is shown at the end of its help.
  CLI::App* add_command(const std::string& name, const std::string& description,
                        const std::string& examples, CLI::App* parent = nullptr);

  /// Says in the help what kind of value each option takes; called when all commands are there.
  void name_values();
};

void add_render(Program& program);
void add_probe(Program& program);
void add_info(Program& program);
void add_preview(Program& program);
void add_compare(Program& program);
void add_convert(Program& program);
void add_camera(Program& program);
void add_clip(Program& program);
void add_scan(Program& program);
void add_visible(Program& program);
void add_coplanar(Program& program);
void add_pipeline(Program& program);
void add_depth(Program& program);
void add_study(Program& program);
/// `fathom camera import …`.
void add_camera_import(Program& program, CLI::App& camera);

}  // namespace fathom::app
