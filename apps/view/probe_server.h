#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace fathom::app {

/// Answers about pixel (x, y) of map number `map`; empty where there is no such pixel.
using AnswerProbe = std::function<std::string(std::uint32_t map, std::uint32_t x, std::uint32_t y)>;

/// A server for the browser of this machine's user. It listens at 127.0.0.1 alone, at a port that
/// the system chooses, and knows two addresses, both below a random token of 128 bits:
///   GET /TOKEN/                          the page
///   GET /TOKEN/probe?map=M&x=X&y=Y       the answer, as text
/// All else is "404 Not Found", without a word: another path or method, a wrong token, and a Host
/// that is not this server's, as in a page of another site whose name was made to lead here (DNS
/// rebinding). What is no HTTP gets another 4xx, likewise without a word. It reads no file.
class ProbeServer {
 public:
  /// Fails    OutputError where the system gives no port.
  ProbeServer(std::string page, AnswerProbe answer);
  ~ProbeServer();
  ProbeServer(const ProbeServer&) = delete;
  ProbeServer& operator=(const ProbeServer&) = delete;

  /// "http://127.0.0.1:PORT/TOKEN/"
  [[nodiscard]] const std::string& address() const { return address_; }
  /// Answers until the program ends, which an interruption does (shell/last_resort.h). Probes wait
  /// for each other.
  void run();

 private:
  class Routes;
  std::unique_ptr<Routes> routes_;
  std::string address_;
};

}  // namespace fathom::app
