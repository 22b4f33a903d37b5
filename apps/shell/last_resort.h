#pragma once

#include <string>

#include "apps/shell/failures.h"

namespace fathom::app {

/// From now on only the calling thread may report a failure; any other thread blocks until the
/// process exits.
void have_the_last_word() noexcept;

/// Why a process ends early.
enum class Ending { failure, interruption };
/// Whether this process may report on standard error why it ends. True once at most, because the
/// caller then reports it. Safe in a signal handler.
bool may_report(Ending ending = Ending::failure) noexcept;
/// From now on `decide` answers instead, for processes that end together (apps/mpi/together.h).
void let_decide(bool (*decide)(Ending) noexcept) noexcept;

/// Prints "fathom: error: out of memory: …" and returns the exit status; takes no memory for it.
ExitStatus report_out_of_memory() noexcept;
/// Adds to that line what sets the limit of memory. For one thread.
void name_memory_limit(const char* text) noexcept;
/// Reports that the system starts no more threads.
ExitStatus report_lack_of_threads() noexcept;

/// The work is done and the exit status is known. A failure after this, in a destructor of a
/// library (VTK 9.1 allocates in its own), no longer changes it. Returns the status.
int outcome_is(int status) noexcept;

/// Handles failures that no `catch` can or should handle: they then end the program as any other
/// failure does, with one line, no temporary file left, and an exit status.
///
///   std::terminate   an exception in a function that must not throw, or in a thread of a library
///   operator new     out of memory, it would throw through libraries that do not expect it:
///                    while writing a deep map, OpenEXR 3.1 then destroys objects that it has not
///                    constructed, and omits parts that a task of its pool could not write
///   GMP, MPFR        out of memory, they print a line of their own and abort. Their allocation
///                    functions cannot throw instead: mpz_mul, for example, frees the old limbs of
///                    its result before it allocates new ones, so that a destructor would free them
///                    again during an exception; GMP's manual rules exceptions out
///
/// Other failing allocations (Samples, TBB, libpng) throw std::bad_alloc. This is a choice for the
/// whole process, so the programs make it, not the library. Called first of all.
void prepare_last_resort();

/// From now on
///   SIGINT, SIGTERM and SIGHUP   end the program with 130 and remove its partial outputs
///   every other ending signal    ends it, sent or a crash, and its partial outputs are removed
///   SIGBUS of a mapped file      that was truncated: an error of reading, exit status 3, one line
///                                that names the file
///   a closed pipe, a file that   are errors of writing, not signals
///   grows beyond the limit
/// A second call does nothing.
void handle_signals();

/// Sets the text that the program prints on standard error when it is interrupted; it ends with a
/// line feed or is empty.
void say_when_interrupted(const std::string& text);

}  // namespace fathom::app
