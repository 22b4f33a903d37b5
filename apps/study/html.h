#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fathom::studies {

/// Text between tags.
std::string escaped_html(const std::string& text);

/// In paragraphs and captions what stands between a pair of ` is code.
std::string html_heading(int level, const std::string& text);
std::string html_paragraph(const std::string& text);
/// The plot NAME.png, linked to NAME.svg, with the command that draws it.
std::string html_plot(const std::string& name, const std::string& caption);
/// The picture NAME.png, `width` wide in the page; 0: as wide as it has pixels.
struct ShownPicture {
  std::string name;
  std::uint32_t width = 0;
};
/// Pictures of one caption, their pixels kept sharp. Single ones, and texts, stand side by side
/// where there is room; several of one caption have a row of their own.
std::string html_pictures(const std::vector<ShownPicture>& pictures, const std::string& caption);
/// Text as it is, every character of the same width.
std::string html_text(const std::string& text, const std::string& caption);

/// A page of these.
std::string html_document(const std::string& title, const std::string& body);

}  // namespace fathom::studies
