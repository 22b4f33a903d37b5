#pragma once

#include <stdexcept>
#include <string>
#include <utility>

/// The three ways in which a user's request can fail. The message is one line: what is wrong and
/// what was expected, beginning with "FILE: " or "FILE: line N: " if a file is to blame.
/// Our own broken invariants are assertions, "nothing there" is an optional; neither is an Error.
namespace fathom {

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The request makes no sense: options that contradict each other (exit status 2).
class UsageError : public Error {
 public:
  using Error::Error;
};

/// An input cannot be used (exit status 3).
class InputError : public Error {
 public:
  using Error::Error;
};

/// An output cannot be written or cannot hold what was asked for (exit status 4).
class OutputError : public Error {
 public:
  using Error::Error;
};

}  // namespace fathom
