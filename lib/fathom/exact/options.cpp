#include "fathom/exact/options.h"

#include <array>
#include <utility>

namespace fathom {

std::optional<Channel> channel_named(const std::string& name) {
  static constexpr std::array<std::pair<const char*, Channel>, 10> names{
      {{"Z", Channel::Z},
       {"A", Channel::A},
       {"Zlow", Channel::Zlow},
       {"distance", Channel::distance},
       {"id", Channel::id},
       {"face", Channel::face},
       {"object", Channel::object},
       {"N", Channel::N},
       {"P", Channel::P},
       {"bary", Channel::bary}}};
  for (const auto& [known, channel] : names) {
    if (name == known) return channel;
  }
  return std::nullopt;
}

}  // namespace fathom
