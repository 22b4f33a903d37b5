#pragma once

namespace fathom::app {

/// Answers the requests that come over the socket on standard input, until it is closed. Each is
/// carried out within the limits that it names; where one is passed, the system ends this program.
/// Returns the exit status.
int serve_requests();

}  // namespace fathom::app
