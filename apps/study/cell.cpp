#include "apps/study/cell.h"

#include <fmt/format.h>

namespace fathom::studies {
namespace {

struct Writer {
  std::string format;

  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(bool flag) const { return flag ? "true" : "false"; }
  std::string operator()(std::int64_t number) const { return std::to_string(number); }
  std::string operator()(std::uint64_t number) const { return std::to_string(number); }
  std::string operator()(double number) const { return fmt::format(fmt::runtime(format), number); }
  std::string operator()(const std::string& text) const { return text; }
  std::string operator()(const std::vector<double>& numbers) const {
    std::string list;
    for (const double number : numbers) list += (list.empty() ? "" : " ") + (*this)(number);
    return list;
  }
};

}  // namespace

std::string text_of(const Cell& cell, const char* format) {
  return std::visit(Writer{std::string("{:") + format + "}"}, cell.value);
}

}  // namespace fathom::studies
