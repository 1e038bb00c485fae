#pragma once
// The text of a pipeline as a person sees it: offsets to places, what no text may hold, and what stands where
// the parser of YAML points.

#include "base/error.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace facetmill::pipeline {

/// Turns byte offsets of a text into marks.
class SourceIndex {
  public:
    explicit SourceIndex(std::shared_ptr<const SourceText> source);

    const std::string& text() const { return source_->text; }
    const std::string& name() const { return source_->name; }
    /// The place of the byte at offset (clamped to the text), underlining so many characters.
    Mark mark(std::size_t offset, int length = 1) const;
    /// Characters (UTF-8) in the bytes [begin, end).
    int characters(std::size_t begin, std::size_t end) const;

  private:
    std::shared_ptr<const SourceText> source_;
    std::vector<std::size_t> line_begins_;
};

/// Where the name of what is no pipeline is that of a mesh, what to do with one; else empty.
std::string hint_for_no_pipeline(const std::string& name);

/// Whether the text is UTF-8 without control characters and of bearable size; adds E-YAML at the first place
/// that is not. YAML allows no control characters, and a NUL or EOT would end some parsers early without a
/// word.
bool check_text(const SourceIndex& source, Problems& problems);

/// Where the content of a node begins, behind its anchor and tag.
std::size_t content_at(const std::string& text, std::size_t at);

/// The dash of an item that has nothing behind it, before `at`.
Mark empty_item_mark(const SourceIndex& source, std::size_t at);
/// The alias that begins at `at`.
Mark alias_mark(const SourceIndex& source, std::size_t at);
/// The scalar that begins at `at`, as far as its line goes; in quotes unless it is plain.
Mark scalar_mark(const SourceIndex& source, std::size_t at, const std::string& text, bool plain);

/// Where an expression without quotes ends, of which the parser took `text`, "$" at its end, for a scalar;
/// none when it is no expression.
std::optional<std::size_t> end_of_unquoted(const std::string& all, std::size_t at, const std::string& text);

} // namespace facetmill::pipeline
