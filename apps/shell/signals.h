#pragma once

#include <string>

namespace fathom::app {

/// From now on
///   SIGINT, SIGTERM and SIGHUP      end the program with 130, and nothing of its outputs is left;
///   every other signal that ends a  does so, and nothing of its outputs is left, whether the signal
///   program                         was sent or came from a crash;
///   SIGBUS of a mapped file that    is an error of reading: one line that names the file, and 3;
///   has been cut short meanwhile
///   a closed pipe and a file that   are errors of writing, not signals.
///   grows beyond the limit
/// A second call does nothing.
void handle_signals();

/// What the program says on standard error when it is interrupted, from now on: a text that ends
/// with a line feed, or nothing ("").
void say_when_interrupted(const std::string& text);

}  // namespace fathom::app
