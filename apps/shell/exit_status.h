#pragma once

namespace fathom::app {

/// Exit statuses of every command.
enum ExitStatus : int {
  done = 0,
  answer_is_no = 1,
  wrong_usage = 2,
  unusable_input = 3,
  unwritable_output = 4,
  internal_error = 70,
  interrupted = 130,
};

}  // namespace fathom::app
