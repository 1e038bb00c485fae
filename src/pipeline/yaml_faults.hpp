#pragma once
// What is wrong with a YAML text that could not be read, in words for people who did not mean to write YAML
// that way: quotes and braces that are not closed, tabs, texts that begin with a character of YAML's own.

#include "pipeline/yaml_text.hpp"

#include <optional>
#include <string>

namespace facetmill::pipeline {

/// Bytes [begin, end) of a text.
struct Extent {
    std::size_t begin = 0, end = 0;
};

/// What the parser had read when it gave up.
struct ReadSoFar {
    std::optional<Extent> quoted; ///< the last text in quotes
    std::optional<Mark> open;     ///< of the innermost { or [ that was not closed
};

/// Behind the quote that closes the text in quotes that begins at `at`; none when it is never closed.
std::optional<std::size_t> end_of_quoted(const std::string& all, std::size_t at);

/// E-YAML where the parser gave up, at byte `at`: what yaml-cpp says, in words for people where its own are
/// opaque, and what to do.
Diagnostic yaml_fault(const SourceIndex& source, std::size_t at, const std::string& said,
                      const ReadSoFar& read);

/// What to do about a tag that has no meaning: it was meant to be a text (only: !name).
std::string tag_hint(const std::string& tag);

} // namespace facetmill::pipeline
