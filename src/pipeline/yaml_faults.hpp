#pragma once
// Explains YAML errors to people who do not know YAML: unclosed quotes and braces, tabs, texts that begin
// with a special character.

#include "pipeline/yaml_text.hpp"

#include <optional>
#include <string>

namespace facetmill::pipeline {

/// Bytes [begin, end) of a text.
struct Extent {
    std::size_t begin = 0, end = 0;
};

/// The parser's state when it failed.
struct ReadSoFar {
    std::optional<Extent> quoted; ///< the last text in quotes
    std::optional<Mark> open;     ///< the innermost unclosed { or [
};

/// The position after the closing quote of the quoted text at `at`; none if it is never closed.
[[nodiscard]] std::optional<std::size_t> end_of_quoted(const std::string& all, std::size_t at);

/// E-YAML for a parser failure at byte `at`: yaml-cpp's message, rewritten if it is unclear, and a hint.
[[nodiscard]] Diagnostic yaml_fault(const SourceIndex& source, std::size_t at, const std::string& said,
                                    const ReadSoFar& read);

/// A hint for a tag without meaning, which was intended as text (only: !name).
[[nodiscard]] std::string tag_hint(const std::string& tag);

} // namespace facetmill::pipeline
