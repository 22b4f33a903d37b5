#include "tests/validation/study/study_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace fathom::checks {
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

std::vector<std::string> texts_between(const std::string& page, const std::string& begin,
                                       const std::string& end) {
  std::vector<std::string> texts;
  for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, at)) {
    at += begin.size();
    texts.push_back(page.substr(at, page.find(end, at) - at));
  }
  return texts;
}

std::size_t expect_pictures(const std::string& page,
                            const std::function<bool(const std::string& name)>& is_file) {
  for (const std::string& figure : texts_between(page, "<figure", "</figure>"))
    if (figure.find("<img src=") != std::string::npos) expect_command(figure);
  const std::vector<std::string> pictures = texts_between(page, "<img src=\"", "\"");
  for (const std::string& name : pictures) EXPECT_TRUE(is_file(name)) << name;
  return pictures.size();
}

}  // namespace fathom::checks
