#pragma once

#include <atomic>
#include <string>

#include "apps/shell/exit_status.h"

namespace fathom::app {

/// From now on only the calling thread speaks of failures; another one that would, waits for
/// the end.
void have_the_last_word() noexcept;

/// Of processes that work together and end together, one speaks of it. What this one speaks of:
/// at first, all.
enum class Speaks { of_nothing, of_interruptions, of_all };
void speak(Speaks speaks) noexcept;
/// Such processes, on one machine, share the name of a file that is made by the one that speaks:
/// the others are silent from then on. A name that is too long is not shared.
void share_last_word(const std::string& path);
/// Where there is no such file, and none can be made, a number, which is 0 and becomes 1. nullptr: it is
/// shared no longer.
void share_last_word(std::atomic<int>* said) noexcept;
/// Whether this process may say why it ends, which it does then, so that the answer is true once at
/// most. Safe in a signal handler.
bool may_speak(Speaks of = Speaks::of_all) noexcept;

/// Says "fathom: error: out of memory: …" and returns the exit status; takes no memory for it.
ExitStatus report_out_of_memory() noexcept;
/// Adds to that line what sets the limit of memory. For one thread.
void name_memory_limit(const char* text) noexcept;
/// Says that the system starts no more threads.
ExitStatus report_lack_of_threads() noexcept;

/// The program has done what it does, and only leaves: a failure in a destructor of some library's
/// (VTK 9.1 allocates in its own) is none of the command's any more. Returns the status.
int outcome_is(int status) noexcept;

/// What becomes of a failure that no `catch` can get hold of, or should: from now on it ends the
/// program as any other failure does, with one line, no temporary file left, and its exit status.
///
///   std::terminate   an exception in a function that must not throw, or in a thread of a library's
///   operator new     out of memory, it would throw through libraries that are not made for it:
///                    writing a deep map, OpenEXR 3.1 then destroys what it has not constructed, and
///                    leaves out what a task of its pool could not write
///   GMP, MPFR        out of memory, they print a line of their own and abort. Their allocation
///                    functions cannot throw instead: mpz_mul, to take one, frees the old limbs of
///                    its result before it allocates new ones, so that a destructor on the way of
///                    an exception would free them again; GMP's manual rules exceptions out
///
/// Allocations that fail otherwise (Samples, TBB, libpng) throw std::bad_alloc. A choice for the
/// whole process, so the programs make it, not the library. Called first of all.
void prepare_last_resort();

}  // namespace fathom::app
