#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "apps/study/table.h"

namespace fathom::studies {

/// Text between tags.
std::string escaped_html(const std::string& text);

/// In paragraphs and captions, text between two ` is code.
std::string html_heading(int level, const std::string& text);
std::string html_paragraph(const std::string& text);
/// The plot NAME.png, linked to NAME.svg, with the command that draws it.
std::string html_plot(const std::string& name, const std::string& caption);
/// The picture NAME.png, `width` wide in the page; 0: its width in pixels.
struct ShownPicture {
  std::string name;
  std::uint32_t width = 0;
};
/// Pictures with a common caption, their pixels kept sharp. Single pictures, and texts, are placed
/// side by side if there is room; several pictures with a common caption have a separate row.
std::string html_pictures(const std::vector<ShownPicture>& pictures, const std::string& caption);
/// Text unchanged, in a font of fixed width.
std::string html_text(const std::string& text, const std::string& caption);

/// A page with this body.
std::string html_document(const std::string& title, const std::string& body);

/// The page of a study: a subset of Markdown, and the contents of its placeholders.
///
///   # Title                     the first block; blocks are separated by empty lines
///   ## Heading
///   A paragraph.
///   {{name}}                    in any text: a value
///   {{plot:name}} Caption       NAME.png, linked to NAME.svg, and its command; left out where
///                               nothing was drawn
///   {{picture:name}} Caption    NAME.png, its pixels kept sharp; the caption names the command
///                               that draws it
///   {{pictures:a,b,c}} Caption  several in a row
///   `text`                      in paragraphs and captions: code
///   {{text:name}} Caption       text in letters of one width
///   {{table:name}}              left out where it has no row
///   {{if:plot:name}}            also of a table or a value: what follows, up to {{else}} or
///                               {{end}}, is there if that is; blocks of their own, not nested
class Page {
 public:
  explicit Page(std::string_view markdown) : markdown_(markdown) {}

  void add_value(const std::string& name, const std::string& text) { values_[name] = text; }
  /// Every plot, table and text that is added must have a placeholder.
  void add_plot(const std::string& name, bool is_drawn);
  void add_table(const std::string& name, const Table& table);
  void add_text(const std::string& name, const std::string& text);
  /// A picture needs no placeholder. `width`: in the page; 0: its width in pixels.
  void add_picture(const std::string& name, std::uint32_t width = 0) {
    parts_["picture:" + name] = name;
    widths_[name] = width;
  }

  /// The page as HTML; at its end, if given, a section with this heading and paragraph.
  /// Fails    std::logic_error if placeholders and parts do not match.
  [[nodiscard]] std::string html(const std::string& last_heading = "",
                                 const std::string& last_paragraph = "") const;

 private:
  void add_part(const std::string& placeholder, const std::string& content);
  [[nodiscard]] std::string block(const std::string& block) const;
  [[nodiscard]] std::string with_values(const std::string& text) const;
  [[nodiscard]] const std::string& part(const std::string& placeholder) const;
  /// The pictures in a list of names with commas.
  [[nodiscard]] std::vector<ShownPicture> pictures(const std::string& names) const;
  [[nodiscard]] bool has(const std::string& placeholder) const;

  std::string markdown_;
  std::map<std::string, std::string> values_;
  /// Placeholder without braces → content: HTML of a table, text, or the name of files. Empty where
  /// there is nothing to show.
  std::map<std::string, std::string> parts_;
  std::map<std::string, std::uint32_t> widths_;
};

}  // namespace fathom::studies

/// The pages' Markdown, from the .md files next to the studies (CMakeLists.txt).
namespace fathom::studies::page_texts {

extern const std::string_view antialiasing, blending, clipping, course, depth_resolution,
    hidden_surface, indistinguishable, lens, lines, mitigation, scene_fights, scene_hidden_surface,
    subpixel, z_fighting;

}  // namespace fathom::studies::page_texts
