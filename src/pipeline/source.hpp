#pragma once
// A pipeline's text as a person sees it: offsets to places, and what no text may hold.

#include "base/error.hpp"

#include <memory>
#include <vector>

namespace facetmill::pipeline {

/// Turns byte offsets of a text into marks.
class SourceIndex {
  public:
    explicit SourceIndex(std::shared_ptr<const SourceText> source);

    const std::string& text() const { return source_->text; }
    /// The place of the byte at offset (clamped to the text), underlining so many characters.
    Mark mark(std::size_t offset, int length = 1) const;
    /// Characters (UTF-8) in the bytes [begin, end).
    int characters(std::size_t begin, std::size_t end) const;

  private:
    std::shared_ptr<const SourceText> source_;
    std::vector<std::size_t> line_begins_;
};

/// Whether the text is UTF-8 without control characters and of bearable size; adds E-YAML at the first place
/// that is not. YAML allows no control characters, and a NUL or EOT would end some parsers early without a
/// word.
bool check_text(const SourceIndex& source, Problems& problems);

} // namespace facetmill::pipeline
