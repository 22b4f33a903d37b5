#include "apps/study/page.h"

#include <sstream>
#include <stdexcept>
#include <vector>

namespace fathom::studies {
namespace {

std::string element(const std::string& tag, const std::string& text) {
  return "<" + tag + ">" + escaped_html(text) + "</" + tag + ">";
}

/// Words of code are not broken at their hyphens.
std::string code(const std::string& escaped) {
  std::istringstream words(escaped);
  std::string result;
  for (std::string word; words >> word;) {
    result += result.empty() ? "" : " ";
    result += word.find('-') == std::string::npos ? word : "<span>" + word + "</span>";
  }
  return "<code>" + result + "</code>";
}

/// What is between a pair of ` becomes code.
std::string with_code(const std::string& escaped) {
  std::istringstream parts(escaped);
  std::string result;
  bool is_code = false;
  for (std::string part; std::getline(parts, part, '`'); is_code = !is_code)
    result += is_code ? code(part) : part;
  return result;
}

std::string text_element(const std::string& tag, const std::string& text) {
  return "<" + tag + ">" + with_code(escaped_html(text)) + "</" + tag + ">";
}

/// What a picture shows: its caption without the command behind it.
std::string alternative(const std::string& caption) {
  const std::string words = caption.substr(0, caption.find('`'));
  const std::size_t end = words.find_last_not_of(" :");
  std::string result;
  for (const char c : escaped_html(words.substr(0, end == std::string::npos ? 0 : end + 1)))
    result += c == '"' ? "&quot;" : std::string(1, c);
  return result;
}

std::string image(const std::string& name, const std::string& caption, std::uint32_t width = 0) {
  return "<img src=\"" + name + ".png\" alt=\"" + alternative(caption) + "\"" +
         (width == 0 ? "" : " width=\"" + std::to_string(width) + "\"") + ">";
}

std::string small_figure(const std::string& content, const std::string& caption) {
  return "<figure class=\"small\">" + content + text_element("figcaption", caption) + "</figure>\n";
}

}  // namespace

std::string escaped_html(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return result;
}

std::string html_heading(int level, const std::string& text) {
  return element("h" + std::to_string(level), text) + "\n";
}

std::string html_paragraph(const std::string& text) {
  return text_element("p", text) + "\n";
}

std::string html_plot(const std::string& name, const std::string& caption) {
  const std::string before_command = caption.ends_with('.') ? " " : ": ";
  return "<figure class=\"plot\"><a href=\"" + name + ".svg\">" + image(name, caption) + "</a>" +
         text_element("figcaption", caption + before_command + "`gnuplot " + name + ".gp`") +
         "</figure>\n";
}

std::string html_pictures(const std::vector<ShownPicture>& pictures, const std::string& caption) {
  std::string images;
  for (const ShownPicture& picture : pictures)
    images += (images.empty() ? "" : " ") + image(picture.name, caption, picture.width);
  if (pictures.size() == 1) return small_figure(images, caption);
  return "<figure class=\"row\">" + images + text_element("figcaption", caption) + "</figure>\n";
}

std::string html_text(const std::string& text, const std::string& caption) {
  return small_figure(element("pre", text), caption);
}

std::string html_document(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta name=\"viewport\" content=\"width=device-width\">" +
         element("title", title) +
         "\n<style>:root{color-scheme:light dark;--paper:#fff;--ink:#111;"
         "--soft:#f3f3f3;--dim:#444;--line:#888}"
         "@media(prefers-color-scheme:dark){:root{--paper:#171b21;--ink:#e4e8ee;--soft:#26292e;"
         "--dim:#b4bac3;--line:#6a7078}}"
         "body{font-family:sans-serif;max-width:70em;margin:2em auto;padding:0 1em;"
         "background:var(--paper);color:var(--ink)}"
         ".wide{overflow-x:auto;width:max-content;min-width:100%;max-width:calc(100vw - 4em);"
         "position:relative;left:50%;transform:translateX(-50%)}th{vertical-align:bottom}pre{"
         "overflow-x:auto;margin:0}figure{margin:1em 0}"
         ".small{display:inline-block;vertical-align:top;margin-right:1.5em;max-width:100%}"
         ".small img,.row img{image-rendering:pixelated;outline:1px solid #ccc}.small "
         "figcaption{width:0;min-width:max(100%,min(24em,100vw - 4em))}"
         ".row{clear:both}.row figcaption{max-width:56em}"
         "code{font-size:95%;background:var(--soft)}code span{white-space:nowrap}"
         "figcaption{color:var(--dim);font-size:90%;padding-top:0.3em}"
         "table{border-collapse:collapse}td,th{border:1px solid var(--line);padding:0.2em 0.6em;"
         "text-align:right}td:not(:first-child){white-space:nowrap}td:first-child,th:first-child{"
         "text-align:left}"
         "img{max-width:100%;background:#fff}@media(max-width:30em){td,th{padding:0.2em "
         "0.3em}}"
         // Plots keep a readable size on narrow screens, and get dark paper with each hue kept.
         ".plot{overflow-x:auto}.plot img{min-width:50rem}@media(prefers-color-scheme:dark){"
         ".plot img{filter:invert(.88) hue-rotate(180deg)}}</style></head>\n<body>\n" +
         body + "</body></html>\n";
}

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
