#pragma once
// Texts inside HTML, XML, Markdown, terminals and command lines.

#include <string>
#include <string_view>

namespace facetmill {

/// The text with & < > and both quotes as entities; control characters and bytes that are no UTF-8, which XML
/// cannot hold, become U+FFFD, each.
std::string escaped(std::string_view text);

/// A name or a path as escaped() has it, which may be broken behind slashes and underscores, where browsers
/// would rather break a word.
std::string escaped_path(std::string_view path);

/// The text in a paragraph or a cell of Markdown (GitHub's), where nothing of it is markup: in one line,
/// characters of Markdown behind a backslash, those of HTML as escaped() has them.
std::string markdown_escaped(std::string_view text);

/// The text for a terminal, which would take control characters (of a mesh's names, of a source's line) for
/// commands: each becomes '?', but for line ends and tabs; those of UTF-8 (C1) and bytes that are none, too.
std::string for_terminal(std::string_view text);

/// A text for a terminal: all that is added is as for_terminal() has it, and some may have a colour.
class Painted {
  public:
    explicit Painted(bool colour) : colour_(colour) {}

    Painted& operator+=(std::string_view text);
    /// Adds it in a colour, "1;31" as terminals number them; as it is where colours are off.
    Painted& paint(std::string_view code, std::string_view text);
    const std::string& text() const { return text_; }

  private:
    bool colour_;
    std::string text_;
};

/// The text as one word for sh: as it is when nothing in it has a meaning, else in single quotes.
std::string for_shell(std::string_view text);

} // namespace facetmill
