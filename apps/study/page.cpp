#include "apps/study/page.h"

#include <sstream>
#include <stdexcept>
#include <vector>

namespace fathom::studies {
namespace {

/// The lines between empty lines, joined.
std::vector<std::string> blocks_of(const std::string& markdown) {
  std::vector<std::string> blocks(1);
  std::istringstream lines(markdown);
  for (std::string line; std::getline(lines, line);) {
    std::string& block = blocks.back();
    if (!line.empty()) {
      block += (block.empty() ? "" : " ") + line;
    } else if (!block.empty()) {
      blocks.emplace_back();
    }
  }
  if (blocks.back().empty()) blocks.pop_back();
  return blocks;
}

/// What a block begins with, without braces, and what comes after it.
struct Placeholder {
  std::string name, rest;
};

Placeholder first_placeholder(const std::string& block) {
  const std::size_t end = block.find("}}");
  if (!block.starts_with("{{") || end == std::string::npos) return {"", block};
  const std::size_t rest = block.find_first_not_of(' ', end + 2);
  return {block.substr(2, end - 2), rest == std::string::npos ? "" : block.substr(rest)};
}

}  // namespace

void Page::add_plot(const std::string& name, bool is_drawn) {
  add_part("plot:" + name, is_drawn ? name : "");
}

void Page::add_table(const std::string& name, const Table& table) {
  add_part("table:" + name, table.rows().empty() ? "" : html_of(table));
}

void Page::add_text(const std::string& name, const std::string& text) {
  add_part("text:" + name, text);
}

void Page::add_part(const std::string& placeholder, const std::string& content) {
  if (markdown_.find("{{" + placeholder + "}}") == std::string::npos) {
    throw std::logic_error("the page has no place for " + placeholder);
  }
  parts_[placeholder] = content;
}

std::vector<ShownPicture> Page::pictures(const std::string& names) const {
  std::vector<ShownPicture> result;
  std::istringstream list(names);
  for (std::string name; std::getline(list, name, ',');)
    result.push_back({part("picture:" + name), widths_.at(name)});
  return result;
}

bool Page::has(const std::string& placeholder) const {
  const auto found = parts_.find(placeholder);
  return found != parts_.end() ? !found->second.empty() : values_.contains(placeholder);
}

const std::string& Page::part(const std::string& placeholder) const {
  const auto found = parts_.find(placeholder);
  if (found == parts_.end()) throw std::logic_error("there is no " + placeholder + " for the page");
  return found->second;
}

std::string Page::with_values(const std::string& text) const {
  std::string result;
  std::size_t at = 0;
  for (;;) {
    const std::size_t begin = text.find("{{", at);
    result += text.substr(at, begin - at);
    if (begin == std::string::npos) return result;
    const Placeholder value = first_placeholder(text.substr(begin));
    const auto found = values_.find(value.name);
    if (found == values_.end()) throw std::logic_error("there is no value " + value.name);
    result += found->second;
    at = begin + value.name.size() + 4;
  }
}

std::string Page::block(const std::string& block) const {
  if (block.starts_with("# ")) return html_heading(1, with_values(block.substr(2)));
  if (block.starts_with("## ")) return html_heading(2, with_values(block.substr(3)));
  const auto [name, rest] = first_placeholder(block);
  const std::string kind = name.substr(0, name.find(':'));
  if (kind == name) return html_paragraph(with_values(block));
  const std::string caption = with_values(rest);
  if (kind.starts_with("picture")) {
    if (caption.find('`') == std::string::npos)
      throw std::logic_error("no command under the picture " + name);
    return html_pictures(pictures(name.substr(kind.size() + 1)), caption);
  }
  const std::string& content = part(name);
  if (content.empty()) return "";
  if (kind == "plot") return html_plot(content, caption);
  if (kind == "text") return html_text(content, caption);
  return content;
}

std::string Page::html(const std::string& last_heading, const std::string& last_paragraph) const {
  const std::vector<std::string> blocks = blocks_of(markdown_);
  std::string body;
  bool is_shown = true;
  for (const std::string& text : blocks) {
    const std::string name = first_placeholder(text).name;
    if (name.starts_with("if:")) {
      is_shown = has(name.substr(3));
    } else if (name == "else") {
      is_shown = !is_shown;
    } else if (name == "end") {
      is_shown = true;
    } else if (is_shown) {
      body += block(text);
    }
  }
  if (!last_heading.empty()) body += html_heading(2, last_heading) + html_paragraph(last_paragraph);
  return html_document(with_values(blocks.front().substr(2)), body);
}

}  // namespace fathom::studies
