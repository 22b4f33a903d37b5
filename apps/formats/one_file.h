#pragma once

#include <assimp/IOSystem.hpp>
#include <cstddef>
#include <span>
#include <string>

namespace fathom::app {

/// All that assimp sees of the machine: a file of this name with these bytes. A mesh file may name
/// any other file; what such a one holds would go into the map without a word in its sources, so
/// there is none.
class OneFile final : public Assimp::IOSystem {
 public:
  OneFile(std::string name, std::span<const std::byte> bytes)
      : name_(std::move(name)), bytes_(bytes) {}

  bool Exists(const char* path) const override { return name_ == path; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;

  bool PushDirectory(const std::string&) override { return false; }
  bool PopDirectory() override { return false; }
  bool CreateDirectory(const std::string&) override { return false; }
  bool ChangeDirectory(const std::string&) override { return false; }
  bool DeleteFile(const std::string&) override { return false; }

 private:
  std::string name_;
  std::span<const std::byte> bytes_;
};

}  // namespace fathom::app
