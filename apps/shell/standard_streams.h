#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace fathom::app {

/// Opens /dev/null for each standard stream that is closed at the start, so that no opened file
/// gets its number and is written to by mistake. The streams stay unusable: the input cannot be
/// read, the outputs cannot be written.
void open_missing_streams();

/// Fails    OutputError "NAME: why" where an open file is not open for writing, where nobody reads
///          the pipe that it is, or where a device is full.
void expect_writable(int descriptor, const std::string& name);

/// Called before the work by what will print its answer. Fails as expect_writable().
void expect_standard_output();

/// Writes a text to standard output. What could have effects on a terminal is made harmless
/// (fathom/text/printable.h): names of files and objects are not ours.
/// Fails    OutputError where standard output is closed or full.
void print(const std::string& text);

/// The text that is printed for an answer in JSON; it ends with a line feed. An indentation of -1
/// puts all on one line. Bytes that are not UTF-8, as in names of files, become U+FFFD, and
/// characters that a terminal would act on are escaped.
std::string json_answer(const nlohmann::ordered_json& answer, int indentation = 2);

/// Writes all of the bytes to an open file that the user calls `target`.
/// Fails    OutputError: "TARGET: why".
void write_all(int descriptor, const char* data, std::size_t size,
               const std::filesystem::path& target);

/// Fails    OutputError: "TARGET: " and the system's message for this errno.
[[noreturn]] void fail_with_errno(const std::filesystem::path& target, int error);

}  // namespace fathom::app
