#pragma once

#include <sys/types.h>

#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "fathom/mesh_files/expansion_budget.h"
#include "fathom/mesh_files/formats_program/messages.h"
#include "fathom/mesh_files/read_options.h"
#include "fathom/text/printable.h"

/// The program fathom-formats, which reads what others' libraries read. They run in a process of
/// their own, with limits on its memory and its time, because a file can make them crash, loop or
/// eat all memory: here that becomes the reason for an InputError.
namespace fathom::mesh_files::formats_program {

/// What reading `bytes` bytes may cost.
struct Limits {
  std::uint64_t memory = 0;
  std::uint32_t seconds = 0;
};
/// `max_expansion`: see ReadOptions.
Limits limits_of(std::uint64_t bytes, std::uint64_t max_expansion);

/// Why there is no answer: "it crashed (Segmentation fault)". Callers name the file.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class Process {
 public:
  /// Starts the program that the options name, or else the program next to the running one. `file`
  /// is the file that needs it, for messages.
  /// Fails    InputError: it is not there, or cannot be started.
  Process(const ReadOptions& options, const std::string& file);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;
  ~Process();

  /// The reply to one request; its bytes are taken from the budget.
  /// Fails    Refusal; InputError if the budget is exceeded.
  std::vector<std::byte> ask(Task task, std::span<const std::byte> parameters,
                             std::span<const std::byte> bytes, ExpansionBudget& budget);

 private:
  [[noreturn]] void fail_as_ended(const Limits& limits);

  std::filesystem::path program_;
  std::uint64_t max_expansion_;
  int socket_ = -1;
  pid_t process_ = -1;
};

/// A library's message about a file, shortened to the end of a one-line message: it can be long and
/// of several lines.
inline std::string as_reason(std::string text) {
  constexpr std::size_t longest = 300;
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  if (text.size() > longest) text = text.substr(0, longest) + "…";
  return text::printable(std::move(text));
}

}  // namespace fathom::mesh_files::formats_program
