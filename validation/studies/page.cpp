#include "validation/studies/page.h"

namespace fathom::studies {
namespace {

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return result;
}

std::string row_of(const std::vector<std::string>& cells, const char* tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) {
    row += std::string("<") + tag + ">" + escaped(cell) + "</" + tag + ">";
  }
  return row + "</tr>\n";
}

}  // namespace

Page::Page(const std::string& title) : title_(title) {
  body_ = "<h1>" + escaped(title) + "</h1>\n";
}

Page& Page::heading(const std::string& text) {
  body_ += "<h2>" + escaped(text) + "</h2>\n";
  return *this;
}

Page& Page::paragraph(const std::string& text) {
  body_ += "<p>" + escaped(text) + "</p>\n";
  return *this;
}

Page& Page::plot(const std::string& name, const std::string& caption) {
  body_ += "<figure><a href=\"" + name + ".svg\"><img src=\"" + name + ".png\" alt=\"" +
           escaped(caption) + "\"></a><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
  return *this;
}

Page& Page::picture(const std::string& name, const std::string& caption) {
  body_ += "<figure class=\"small\"><img src=\"" + name + ".png\" alt=\"" + escaped(caption) +
           "\"><figcaption>" + escaped(caption) + "</figcaption></figure>\n";
  return *this;
}

Page& Page::preformatted(const std::string& text, const std::string& caption) {
  body_ += "<figure class=\"small\"><pre>" + escaped(text) + "</pre><figcaption>" +
           escaped(caption) + "</figcaption></figure>\n";
  return *this;
}

Page& Page::table(const std::vector<std::string>& head,
                  const std::vector<std::vector<std::string>>& rows) {
  body_ += "<div class=\"wide\"><table>\n" + row_of(head, "th");
  for (const std::vector<std::string>& row : rows) body_ += row_of(row, "td");
  body_ += "</table></div>\n";
  return *this;
}

StudyFile Page::file() const {
  return {"index.html",
          "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
          "<meta name=\"viewport\" content=\"width=device-width\"><title>" +
              escaped(title_) +
              "</title>\n<style>body{font-family:sans-serif;max-width:70em;margin:2em "
              "auto;padding:0 1em}"
              ".wide{overflow-x:auto}pre{overflow-x:auto;margin:0}figure{margin:1em 0}"
              ".small{display:inline-block;vertical-align:top;margin-right:1.5em;max-width:100%}"
              ".small img{image-rendering:pixelated}.small figcaption{max-width:24em}"
              "figcaption{color:#444;font-size:90%;padding-top:0.3em}"
              "table{border-collapse:collapse}td,th{border:1px solid #888;padding:0.2em 0.6em;"
              "text-align:right}td:first-child,th:first-child{text-align:left}"
              "img{max-width:100%}</style></head>\n<body>\n" +
              body_ + "</body></html>\n"};
}

}  // namespace fathom::studies
