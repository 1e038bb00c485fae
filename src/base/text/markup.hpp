#pragma once
// Texts inside HTML, XML, Markdown, terminals and command lines.

#include <string>
#include <string_view>

namespace facetmill {

/// The text with &, <, > and both quotes as entities. Control characters and invalid UTF-8 bytes, which XML
/// forbids, each become U+FFFD.
[[nodiscard]] std::string escaped(std::string_view text);

/// An escaped name or path. It allows line breaks after slashes and underscores, because browsers would
/// otherwise break words.
[[nodiscard]] std::string escaped_path(std::string_view path);

/// Escapes the text for a paragraph or a cell of Markdown (GitHub's), so that none of it is markup: on one
/// line, with a backslash before Markdown characters, and HTML characters as in escaped().
[[nodiscard]] std::string markdown_escaped(std::string_view text);

/// Makes the text safe for a terminal, which would interpret control characters (in a mesh's names, or a
/// source line). Each becomes '?', except line ends and tabs; so do C1 controls and invalid UTF-8.
[[nodiscard]] std::string for_terminal(std::string_view text);

/// A text for a terminal: everything added is escaped as by for_terminal(), and parts may be coloured.
class Painted {
  public:
    explicit Painted(bool colour) : colour_(colour) {}

    Painted& operator+=(std::string_view text);
    /// Adds text in a colour, "1;31" in terminal codes; without colour if colours are off.
    Painted& paint(std::string_view code, std::string_view text);
    const std::string& text() const { return text_; }

  private:
    bool colour_;
    std::string text_;
};

/// The text as one word for sh: unchanged if it has no special characters, otherwise in single quotes.
[[nodiscard]] std::string for_shell(std::string_view text);

} // namespace facetmill
