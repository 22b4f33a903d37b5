#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace fathom::validation {

/// A folder for the files of another program. It is removed at the end, even if this process is
/// killed: a second process waits for that.
class Workplace {
 public:
  /// Fails    InputError if no folder can be made.
  Workplace();
  ~Workplace();
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
    return path_ / name;
  }
  /// Fails    InputError if the file cannot be written.
  void write(const std::string& name, const std::string& bytes) const;
  template <class T>
  void write(const std::string& name, const std::vector<T>& values) const {
    write(name,
          std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)));
  }

 private:
  std::filesystem::path path_;
  int alive_ = -1;  ///< open as long as this process lives
  pid_t remover_ = -1;
};

}  // namespace fathom::validation
