#include "validation/studies/html.h"

namespace fathom::studies {
namespace {

std::string element(const std::string& tag, const std::string& text) {
  return "<" + tag + ">" + escaped_html(text) + "</" + tag + ">";
}

std::string image(const std::string& name, const std::string& caption) {
  return "<img src=\"" + name + ".png\" alt=\"" + escaped_html(caption) + "\">";
}

std::string small_figure(const std::string& content, const std::string& caption) {
  return "<figure class=\"small\">" + content + element("figcaption", caption) + "</figure>\n";
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
  return element("p", text) + "\n";
}

std::string html_plot(const std::string& name, const std::string& caption) {
  return "<figure><a href=\"" + name + ".svg\">" + image(name, caption) + "</a>" +
         element("figcaption", caption) + "</figure>\n";
}

std::string html_picture(const std::string& name, const std::string& caption) {
  return small_figure(image(name, caption), caption);
}

std::string html_text(const std::string& text, const std::string& caption) {
  return small_figure(element("pre", text), caption);
}

std::string html_document(const std::string& title, const std::string& body) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
         "<meta name=\"viewport\" content=\"width=device-width\">" +
         element("title", title) +
         "\n<style>body{font-family:sans-serif;max-width:70em;margin:2em "
         "auto;padding:0 1em}"
         ".wide{overflow-x:auto}pre{overflow-x:auto;margin:0}figure{margin:1em 0}"
         ".small{display:inline-block;vertical-align:top;margin-right:1.5em;max-width:100%}"
         ".small img{image-rendering:pixelated}.small figcaption{max-width:24em}"
         "figcaption{color:#444;font-size:90%;padding-top:0.3em}"
         "table{border-collapse:collapse}td,th{border:1px solid #888;padding:0.2em 0.6em;"
         "text-align:right}td:first-child,th:first-child{text-align:left}"
         "img{max-width:100%}</style></head>\n<body>\n" +
         body + "</body></html>\n";
}

}  // namespace fathom::studies
