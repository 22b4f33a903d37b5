#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace fathom::app {

/// Answers a question about pixel (x, y) of map number `map`; empty if there is no such pixel.
using AnswerProbe = std::function<std::string(std::uint32_t map, std::uint32_t x, std::uint32_t y)>;

/// A server for the browser of this machine's user. It listens only at 127.0.0.1, at a port that
/// the system chooses, and has two addresses, both below a random token of 128 bits:
///   GET /TOKEN/                          the page
///   GET /TOKEN/probe?map=M&x=X&y=Y       the answer, as text
/// Any other request gets "404 Not Found" with an empty body: another path or method, a wrong
/// token, and a Host that is not this server's, such as the name of another site that was made to
/// lead here (DNS rebinding). Requests that are not HTTP get another 4xx, also with an empty body.
/// It reads no file.
class ProbeServer {
 public:
  /// Fails    OutputError where the system gives no port.
  ProbeServer(std::string page, AnswerProbe answer);
  ~ProbeServer();
  ProbeServer(const ProbeServer&) = delete;
  ProbeServer& operator=(const ProbeServer&) = delete;

  /// "http://127.0.0.1:PORT/TOKEN/"
  [[nodiscard]] const std::string& address() const { return address_; }
  /// Answers requests until an interruption ends the program (shell/last_resort.h). Probes are
  /// answered one at a time.
  void run();

 private:
  class Routes;
  std::unique_ptr<Routes> routes_;
  std::string address_;
};

}  // namespace fathom::app
