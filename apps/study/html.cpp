#include "apps/study/html.h"

#include <sstream>

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
  return "<figure><a href=\"" + name + ".svg\">" + image(name, caption) + "</a>" +
         text_element("figcaption", caption + ": `gnuplot " + name + ".gp`") + "</figure>\n";
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
         "figcaption{max-width:24em}"
         ".row{clear:both}.row figcaption{max-width:56em}"
         "code{font-size:95%;background:var(--soft)}code span{white-space:nowrap}"
         "figcaption{color:var(--dim);font-size:90%;padding-top:0.3em}"
         "table{border-collapse:collapse}td,th{border:1px solid var(--line);padding:0.2em 0.6em;"
         "text-align:right}td:not(:first-child){white-space:nowrap}td:first-child,th:first-child{"
         "text-align:left}"
         "img{max-width:100%;background:#fff}@media(max-width:30em){td,th{padding:0.2em "
         "0.3em}}</style></head>\n<body>\n" +
         body + "</body></html>\n";
}

}  // namespace fathom::studies
