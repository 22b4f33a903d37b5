#pragma once

#include <stdexcept>
#include <string>
#include <vector>

/// The three ways in which a user's request can fail, and warnings. The message of a failure is one
/// line: the fault and the expectation, beginning with "FILE: " or "FILE: line N: " if a file is
/// the cause. Broken invariants of Fathom are assertions and missing results are optionals; neither
/// is an Error.
namespace fathom {

/// A setting that an error is about, by the name of its field: "subpixel_bits".
struct Setting {
  std::string name;
};

class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  /// The message begins with the setting: "subpixel_bits: expected 0 to 16".
  Error(const Setting& setting, const std::string& message)
      : std::runtime_error(setting.name + ": " + message), setting_(setting.name) {}

  /// The name of the setting; empty if the error is about no setting. A program whose users know
  /// it by another name puts that in its place at the beginning of the message.
  [[nodiscard]] const std::string& setting() const { return setting_; }

 private:
  std::string setting_;
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

/// An output cannot be written or cannot hold the requested data (exit status 4).
class OutputError : public Error {
 public:
  using Error::Error;
};

/// Findings of a reader that are not errors: one line each, with a count if it recurs.
using Warnings = std::vector<std::string>;

}  // namespace fathom
