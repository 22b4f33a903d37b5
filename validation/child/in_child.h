#pragma once

#include <new>
#include <optional>
#include <string>

#include "validation/child/child_process.h"
#include "validation/child/fields.h"

namespace fathom::validation {

/// How work in another process ended.
enum class Ending { done, wrong_usage, unusable_input };

template <>
struct Enumerators<Ending> {
  static constexpr Ending all[] = {Ending::done, Ending::wrong_usage, Ending::unusable_input};
  static std::string name(Ending ending) {
    constexpr const char* names[] = {"done", "wrong usage", "unusable input"};
    return names[static_cast<std::size_t>(ending)];
  }
};

/// The answer of the process: a result if the work is done, else the reason.
template <class Result>
struct Answer {
  Ending ending = Ending::done;
  std::string message;
  std::optional<Result> result;
};

template <class Result>
struct Fields<Answer<Result>> {
  template <class Visit, class S>
  static void each(Visit&& visit, S& s) {
    auto& [ending, message, result] = s;
    visit("ending", ending);
    visit("message", message);
    visit("result", result);
  }
};

/// The result or the exception of `work` as an answer.
template <class Work, class Result = std::invoke_result_t<Work>>
Answer<Result> answer_of(const Work& work) {
  try {
    return {Ending::done, "", work()};
  } catch (const UsageError& error) {
    return {Ending::wrong_usage, error.what(), {}};
  } catch (const std::bad_alloc&) {
    return {Ending::unusable_input, "out of memory", {}};
  } catch (const std::exception& error) {
    return {Ending::unusable_input, error.what(), {}};
  }
}

/// Decodes the bytes of an answer: returns or throws as the work did. `name` is the sender.
/// Fails    ChildFailure if the bytes are not such an answer.
template <class Result>
Result result_from(const std::string& bytes, const std::string& name) {
  Answer<Result> answer;
  try {
    answer = from_bytes<Answer<Result>>(bytes);
    if (answer.ending == Ending::done && !answer.result) throw ForeignAnswer("it has no result");
  } catch (const ForeignAnswer& error) {
    throw ChildFailure(name + ": its answer is not understood: " + error.what());
  }
  if (answer.ending == Ending::wrong_usage) throw UsageError(answer.message);
  if (answer.ending == Ending::unusable_input) throw InputError(answer.message);
  return std::move(*answer.result);
}

/// Runs `work` in a separate process and returns its result: any type that fields.h
/// supports.
///
/// Needs    a process that has started no threads.
/// Fails    as `work` does, with the same kind of error and message; else ChildFailure.
template <class Work>
std::invoke_result_t<Work> in_child(const Work& work, const ChildOptions& options = {}) {
  return result_from<std::invoke_result_t<Work>>(
      bytes_from_child([&] { return to_bytes(answer_of(work)); }, options), options.name);
}

}  // namespace fathom::validation
