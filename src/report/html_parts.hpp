#pragma once
// The elements of report pages. Pass plain text through escaped() or code().

#include "base/error.hpp"

#include <initializer_list>
#include <string>
#include <vector>

namespace facetmill::report {

/// From the doctype to the title; title and about are plain text. whole: the full path if title is
/// shortened, otherwise empty.
[[nodiscard]] std::string html_begin(const std::string& title, const std::string& about,
                                     const std::string& whole = {});
/// The version, and the end of the page.
[[nodiscard]] std::string html_end();

[[nodiscard]] std::string code(const std::string& text);
/// A path in code style.
[[nodiscard]] std::string path_code(const std::string& path);
[[nodiscard]] std::string cell(const std::string& html);
[[nodiscard]] std::string number_cell(const std::string& html);
/// An image (a PNG in base64); the id must be unique in the page.
[[nodiscard]] std::string picture(const std::string& id, const std::string& alt, const std::string& png);
/// A picture above its caption; wide: full page width.
[[nodiscard]] std::string figure(const std::string& picture, const std::string& caption, bool wide = false);
/// A figure with a slider between the picture and an earlier picture with that id and the same camera, which
/// is shown on the left. name: the name of the later picture.
[[nodiscard]] std::string compared_figure(const std::string& picture, const std::string& before_id,
                                          const std::string& name, const std::string& caption);
/// A paragraph for each omitted part of pictures, with the reason; empty for an empty list.
[[nodiscard]] std::string not_drawn_html(const std::vector<Diagnostic>& not_drawn);
/// A row of headings; a leading # marks a column of numbers.
[[nodiscard]] std::string heads(std::initializer_list<const char*> titles);
/// A table under a smaller heading; empty without rows.
[[nodiscard]] std::string subtable(const std::string& title, const std::string& header,
                                   const std::string& rows, const char* level = "h4");
/// A section with a table; empty without rows.
[[nodiscard]] std::string table(const std::string& title, const std::string& header, const std::string& rows);

} // namespace facetmill::report
