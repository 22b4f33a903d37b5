#pragma once

#include <string>

namespace fathom::studies {

/// Text between tags.
std::string escaped_html(const std::string& text);

std::string html_heading(int level, const std::string& text);
std::string html_paragraph(const std::string& text);
/// The plot NAME.png, linked to NAME.svg.
std::string html_plot(const std::string& name, const std::string& caption);
/// The picture NAME.png, its pixels kept sharp. Pictures and texts stand side by side where there
/// is room.
std::string html_picture(const std::string& name, const std::string& caption);
/// Text as it is, every character of the same width.
std::string html_text(const std::string& text, const std::string& caption);

/// A page of these.
std::string html_document(const std::string& title, const std::string& body);

}  // namespace fathom::studies
