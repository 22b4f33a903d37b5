#include "tests/validation/study/study_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace fathom::testing {
namespace {

void expect_command(const std::string& figure) {
  const std::size_t caption = figure.find("<figcaption>");
  ASSERT_NE(caption, std::string::npos) << figure;
  const std::string words = figure.substr(caption);
  const std::size_t code = words.find("<code>");
  const bool named = std::ranges::any_of(
      std::array{"fathom ", "fathom-pipeline ", "gnuplot "},
      [&](const char* program) { return words.find(program, code) != std::string::npos; });
  EXPECT_TRUE(code != std::string::npos && named) << figure;
}

}  // namespace

std::size_t expect_pictures(const std::string& page,
                            const std::function<bool(const std::string& name)>& is_file) {
  for (std::size_t at = page.find("<figure"); at != std::string::npos;
       at = page.find("<figure", at + 1)) {
    const std::string figure = page.substr(at, page.find("</figure>", at) - at);
    if (figure.find("<img src=") != std::string::npos) expect_command(figure);
  }
  const std::string mark = "<img src=\"";
  std::size_t pictures = 0;
  for (std::size_t at = page.find(mark); at != std::string::npos; at = page.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    const std::string name = page.substr(begin, page.find('"', begin) - begin);
    EXPECT_TRUE(is_file(name)) << name;
    ++pictures;
  }
  return pictures;
}

}  // namespace fathom::testing
