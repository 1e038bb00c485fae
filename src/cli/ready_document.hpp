#pragma once
// The built-in pipelines as documents, for commands that show or offer their params.

#include "docs/ready.hpp"
#include "options/value.hpp"

namespace facetmill::cli {

[[nodiscard]] Value document_of(const docs::ReadyPipeline& ready);

/// The choices of a param as text; none unless its type is choice.
[[nodiscard]] std::vector<std::string> choices_of(const Value& param);

} // namespace facetmill::cli
