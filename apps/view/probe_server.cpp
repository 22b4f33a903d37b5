#include "apps/view/probe_server.h"

#include <fmt/core.h>
#include <httplib.h>
#include <sys/random.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <mutex>
#include <optional>

#include "fathom/failures/errors.h"

namespace fathom::app {
namespace {

/// 128 bits from the system's generator, as hexadecimal digits.
std::string random_token() {
  std::array<unsigned char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw OutputError(fmt::format("no random numbers for an address: {}", std::strerror(errno)));
  }
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

/// Takes the same time wherever the texts differ, so that an attacker cannot find the token letter
/// by letter.
bool are_equal(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    difference |= static_cast<unsigned char>(a[k]) ^ static_cast<unsigned char>(b[k]);
  }
  return difference == 0;
}

/// The only parameter of this name, as a number.
std::optional<std::uint32_t> number_of(const httplib::Request& request, const char* name) {
  if (request.get_param_value_count(name) != 1) return std::nullopt;
  const std::string text = request.get_param_value(name);
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The permissions of the page: running its own script and querying this server.
constexpr const char* policy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

void refuse(httplib::Response& response) {
  response.status = 404;
}

}  // namespace

class ProbeServer::Routes {
 public:
  Routes(std::string page, AnswerProbe answer)
      : page_(std::move(page)), answer_(std::move(answer)), token_(random_token()) {
    constexpr time_t seconds = 5;
    server_.set_read_timeout(seconds);
    server_.set_keep_alive_timeout(seconds);
    server_.set_payload_max_length(0);
    server_.set_socket_options([](socket_t) {});  // otherwise another process could share the port
    server_.new_task_queue = [] { return new httplib::ThreadPool(4); };
    server_.set_pre_routing_handler([this](const auto& request, auto& response) {
      route(request, response);
      return httplib::Server::HandlerResponse::Handled;
    });
    port_ = server_.bind_to_any_port("127.0.0.1");
    if (port_ <= 0) throw OutputError("127.0.0.1: the system gives no port to listen at");
  }

  [[nodiscard]] std::string address() const {
    return fmt::format("http://127.0.0.1:{}/{}/", port_, token_);
  }
  void run() {
    if (!server_.listen_after_bind()) throw OutputError(address() + ": cannot listen any more");
  }

 private:
  void route(const httplib::Request& request, httplib::Response& response) {
    const std::string below = path_below_token(request);
    response.set_header("Cache-Control", "no-store");
    response.set_header("Content-Security-Policy", policy);
    response.set_header("Cross-Origin-Resource-Policy", "same-origin");
    response.set_header("Referrer-Policy", "no-referrer");
    response.set_header("X-Content-Type-Options", "nosniff");
    if (below == "/") {
      // Content that is passed at once would be compressed again, which takes seconds.
      response.set_content_provider(
          page_.size(), "text/html; charset=utf-8",
          [this](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
            return sink.write(page_.data() + offset, length);
          });
    } else if (below == "/probe") {
      answer_probe(request, response);
    } else {
      refuse(response);
    }
  }

  /// The part after the token in the path of a request that may be answered; else empty.
  [[nodiscard]] std::string path_below_token(const httplib::Request& request) const {
    const std::string here = fmt::format(":{}", port_), host = request.get_header_value("Host");
    const bool is_ours = request.get_header_value_count("Host") == 1 &&
                         (host == "127.0.0.1" + here || host == "localhost" + here);
    const std::size_t end = 1 + token_.size();
    if (!is_ours || request.method != "GET" || request.path.size() <= end ||
        !are_equal(request.path.substr(0, end), "/" + token_)) {
      return {};
    }
    return request.path.substr(end);
  }

  void answer_probe(const httplib::Request& request, httplib::Response& response) {
    const auto map = number_of(request, "map"), x = number_of(request, "x"),
               y = number_of(request, "y");
    if (!map || !x || !y) return refuse(response);
    const std::lock_guard lock(one_at_a_time_);
    const std::string answer = answer_(*map, *x, *y);
    if (answer.empty()) return refuse(response);
    response.set_content(answer, "text/plain; charset=utf-8");
  }

  std::string page_;
  AnswerProbe answer_;
  std::string token_;
  httplib::Server server_;
  int port_ = 0;
  std::mutex one_at_a_time_;
};

ProbeServer::ProbeServer(std::string page, AnswerProbe answer)
    : routes_(std::make_unique<Routes>(std::move(page), std::move(answer))),
      address_(routes_->address()) {}

ProbeServer::~ProbeServer() = default;

void ProbeServer::run() {
  routes_->run();
}

}  // namespace fathom::app
