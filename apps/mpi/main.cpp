// fathom-mpi: renders a scene by several processes, on one machine or on many, that MPI starts:
//   mpirun -n 8 fathom-mpi render SCENE… -o map.exr

#include <fcntl.h>
#include <unistd.h>

#include <memory>

#include "apps/mpi/mpi_arguments.h"
#include "apps/mpi/ranks.h"
#include "apps/mpi/render_together.h"
#include "apps/mpi/together.h"
#include "apps/shell/failures.h"
#include "apps/shell/last_resort.h"
#include "apps/shell/program.h"
#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

/// Whether this rank has come as far as others wait for it.
bool work_has_begun = false;

void add_render_together(Command& program) {
  const auto arguments = std::make_shared<MpiArguments>();
  Command& command = program.command(
      "render", "Render an exact depth map of a scene on the ranks of an MPI run",
      "  mpirun -n 8 fathom-mpi render city.stl --camera camera.json -o city.exr\n"
      "  mpirun -n 2 fathom-mpi render room.json --channels Z,A,id,N --partition rows -o room.exr\n"
      "\nThe map has the same bytes as the map of 'fathom render', for any number of ranks.");
  arguments->add_to(command);
  command.runs([arguments](const Console& console) {
    const Ranks ranks;
    work_has_begun = true;
    together(ranks, [] {});
    report_only(Reports::everything);
    return render_together(*arguments, console);
  });
}

/// Refuses ranks whose arguments differ from the first rank's, because their work would not fit
/// together.
std::vector<AddCommand> commands(const std::vector<std::string>& arguments) {
  std::string text;
  for (const std::string& argument : arguments) text += argument + '\0';
  require_same<UsageError>(Ranks(), text, "the ranks were started with different arguments");
  return {add_render_together};
}

/// Answers come from the first rank.
void close_standard_output() {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) ::dup2(nowhere, STDOUT_FILENO);
}

/// A rank that ends before the work begins notifies the ranks that wait for it. If all ranks end,
/// as with wrong arguments or --help, the first rank has printed the reason.
void leave_before_work(const Ranks& ranks, int status) {
  try {
    together(ranks, [&] {
      if (status != done) throw UsageError("a rank cannot use these arguments");
    });
  } catch (const UsageError& error) {
    if (!ranks.is_first() && may_report()) Console::error(error.what());
  }
}

int run(int argc, char** argv) {
  const Ranks ranks;
  if (ranks.count() == 1) say_when_interrupted("");
  // All would say the same of arguments.
  report_only(ranks.is_first() ? Reports::everything : Reports::interruptions);
  if (!ranks.is_first()) close_standard_output();
  const int status = program_main(argc, argv, commands);
  if (!work_has_begun) {
    leave_before_work(ranks, status);
  } else if (status != done && !failed_together()) {
    ranks.abort(status);
  }
  return status;
}

}  // namespace
}  // namespace fathom::app

// Also while MPI starts, which takes longer than some maps, a rank can be killed.
int main(int argc, char** argv) {
  fathom::app::prepare_last_resort();
  if (fathom::app::share_last_word_of_run()) {
    fathom::app::say_when_interrupted(
        "fathom: error: a rank of the run has ended, or all were told to: nothing is written\n");
  }
  fathom::app::handle_signals();
  const fathom::app::MpiSession session(argc, argv);
  return fathom::app::run(argc, argv);
}
