#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <string_view>

#include "apps/companions.h"
#include "apps/formats/tasks.h"
#include "apps/shell/failures.h"
#include "apps/shell/program.h"
#include "apps/shell/standard_streams.h"
#include "fathom/mesh_files/foreign_formats.h"
#include "fathom/mesh_files/formats_program/messages.h"

namespace fathom::app {
namespace {

using namespace mesh_files::formats_program;

bool reply(bool refused, std::span<const std::byte> bytes) {
  const ReplyHead head{refused ? 1U : 0U, bytes.size()};
  return send_all(STDIN_FILENO, std::as_bytes(std::span(&head, 1))) &&
         send_all(STDIN_FILENO, bytes);
}

bool refuse(const std::string& why) {
  return reply(true, std::as_bytes(std::span(why)));
}

void limit([[maybe_unused]] int resource, [[maybe_unused]] rlim_t value) {
  rlimit bounds{};
  ::getrlimit(resource, &bounds);
  bounds.rlim_cur = std::min(value, bounds.rlim_max);
  ::setrlimit(resource, &bounds);
}

/// Where memory runs out, an allocation fails; where time does, SIGXCPU ends the program, or
/// SIGALRM if it waits for what never comes.
void set_limits(const RequestHead& request) {
#ifndef FATHOM_SANITIZED  // their shadow memory takes all addresses
  limit(RLIMIT_AS, request.memory);
#endif
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto so_far = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + 1;
  limit(RLIMIT_CPU, so_far + request.seconds);
  ::alarm(10 * request.seconds);
}

std::vector<std::byte> carry_out(const RequestHead& request, std::span<const std::byte> parameters,
                                 std::span<const std::byte> bytes) {
  switch (request.task) {
    case Task::assimp:
      return read_by_assimp(parameters, bytes);
    case Task::draco:
      return decode_by_draco(parameters, bytes);
    case Task::meshopt:
      return decode_by_meshoptimizer(parameters, bytes);
  }
  throw BadMessage();
}

/// Returns false where the socket is closed.
bool answer(const RequestHead& request) {
  set_limits(request);
  const std::string too_large =
      "it takes more than " + std::to_string(request.memory >> 20U) + " MiB";
  try {
    std::vector<std::byte> parameters(request.parameter_bytes);
    const auto bytes = std::make_unique_for_overwrite<std::byte[]>(request.bytes);
    const std::span<std::byte> content(bytes.get(), request.bytes);
    if (!receive_all(STDIN_FILENO, parameters) || !receive_all(STDIN_FILENO, content)) return false;
    return reply(false, carry_out(request, parameters, content));
  } catch (const std::bad_alloc&) {
    return refuse(too_large);
  } catch (const std::length_error&) {
    return refuse(too_large);
  } catch (const std::exception& error) {
    return refuse(error.what());
  }
}

}  // namespace

int serve_requests() {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody waits for the answer any more
  limit(RLIMIT_CORE, 0);
  RequestHead request;
  while (receive_all(STDIN_FILENO, std::as_writable_bytes(std::span(&request, 1)))) {
    if (!answer(request)) break;
    ::alarm(0);
  }
  return done;
}

// fathom-formats: what is read by others' libraries. The library starts it with --serve and talks
// to it over a socket; `fathom formats` says what it is built from.

namespace {

int show_formats(const Console&) {
  print(
      fmt::format("{}: {}\n{}: glTF with KHR_draco_mesh_compression\n"
                  "{}: glTF with EXT_meshopt_compression or KHR_meshopt_compression\n",
                  assimp_version(), fmt::join(mesh_files::foreign_suffixes, " "), draco_version(),
                  meshoptimizer_version()));
  return done;
}

/// `fathom formats`: the libraries that read foreign formats, and the suffixes of their files.
void add_formats(Command& program) {
  Command& command = program.command("formats", description_of_companion("formats"),
                                     "  fathom formats\n"
                                     "  fathom info model.fbx");
  command.runs(show_formats);
}

}  // namespace
}  // namespace fathom::app

int main(int argc, char** argv) {
  using namespace fathom::mesh_files::formats_program;
  if (argc == 3 && argv[1] == serve) {
    if (argv[2] != message_version) return other_version;
    return fathom::app::serve_requests();
  }
  return fathom::app::companion_main(argc, argv, "formats", fathom::app::add_formats);
}
