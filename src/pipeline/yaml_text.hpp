#pragma once
// Positions in the text of a pipeline: marks for byte offsets, forbidden characters, and the text at the YAML
// parser's positions.

#include "base/error.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace facetmill::pipeline {

/// Converts byte offsets of a text into marks.
class SourceIndex {
  public:
    explicit SourceIndex(std::shared_ptr<const SourceText> source);

    const std::string& text() const { return source_->text; }
    const std::string& name() const { return source_->name; }
    /// The mark of the byte at offset (clamped to the text), with `length` characters underlined.
    Mark mark(std::size_t offset, int length = 1) const;
    /// The number of characters (UTF-8) in the bytes [begin, end).
    int characters(std::size_t begin, std::size_t end) const;

  private:
    std::shared_ptr<const SourceText> source_;
    std::vector<std::size_t> line_begins_;
};

/// A hint if the name of an invalid pipeline file is the name of a mesh; otherwise empty.
[[nodiscard]] std::string hint_for_no_pipeline(const std::string& name);

/// Checks that the text is UTF-8, without control characters and not too large; adds E-YAML at the first
/// error. YAML forbids control characters, and some parsers silently stop at a NUL or EOT.
bool check_text(const SourceIndex& source, Problems& problems);

/// The start of a node's content, after its anchor and tag.
[[nodiscard]] std::size_t content_at(const std::string& text, std::size_t at);

/// The dash of an empty list item before `at`.
[[nodiscard]] Mark empty_item_mark(const SourceIndex& source, std::size_t at);
/// The alias at `at`.
[[nodiscard]] Mark alias_mark(const SourceIndex& source, std::size_t at);
/// The scalar at `at`, up to the end of its line; quoted unless plain.
[[nodiscard]] Mark scalar_mark(const SourceIndex& source, std::size_t at, const std::string& text,
                               bool plain);

/// The end of an unquoted expression that the parser read as the scalar `text`, ending with "$"; none if it
/// is not an expression.
[[nodiscard]] std::optional<std::size_t> end_of_unquoted(const std::string& all, std::size_t at,
                                                         const std::string& text);

} // namespace facetmill::pipeline
