#pragma once
// What stands in the text of a YAML file where its parser points.

#include "pipeline/source.hpp"

#include <optional>
#include <string>
#include <utility>

namespace facetmill::pipeline {

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

/// What yaml-cpp says, in words for people where its own are opaque, and a hint.
std::pair<std::string, std::string> explained(const std::string& message);

/// "- relax" and then "when: ..." below it: the name needs a colon to have keys beside it.
std::optional<std::string> bare_item_hint(const SourceIndex& source, std::size_t at);

} // namespace facetmill::pipeline
