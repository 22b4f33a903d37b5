#include "apps/shell/pending_files.h"

#include <unistd.h>

#include <cstring>

#include "fathom/numeric/errors.h"

namespace fathom::app {
namespace {

// Global, as a signal handler reaches nothing else.
std::atomic<PendingFile*> first_pending{nullptr};

}  // namespace

PendingFile* note_pending(const std::filesystem::path& path) {
  const std::string& text = path.native();
  if (text.size() >= PATH_MAX) throw OutputError(text + ": the name is too long");
  PendingFile* file = first_pending.load();
  while (file != nullptr && file->active.load()) file = file->next;
  const bool fresh = file == nullptr;
  if (fresh) file = new PendingFile;
  std::memcpy(file->path, text.c_str(), text.size() + 1);
  file->owner = ::getpid();
  file->active.store(true);
  if (fresh) {
    file->next = first_pending.load();
    first_pending.store(file);
  }
  return file;
}

void forget_pending(PendingFile* file) {
  file->active.store(false);
}

void remove_pending(PendingFile* file) {
  ::unlink(file->path);
  forget_pending(file);
}

void remove_all_pending() {
  const pid_t self = ::getpid();
  for (PendingFile* file = first_pending.load(); file != nullptr; file = file->next) {
    if (file->active.load() && file->owner == self) ::unlink(file->path);
  }
}

}  // namespace fathom::app
