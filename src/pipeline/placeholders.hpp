#pragma once
// Names of files with what other programs replace, "{input.stem}.glb", "$lod.glb": here they are written as
// they are.

#include "pipeline/expressions.hpp"

#include <optional>
#include <string>

namespace facetmill::pipeline {

struct Placeholder {
    std::string text;       ///< "{input.stem}"
    std::string expression; ///< "${input.stem}"
    bool known = false;     ///< whether there is a variable of that name
};

/// The first in the text that is very likely meant as one: it names a variable, a property of a file's name
/// (.stem), or what other programs put there (name, stem, index ...). None in the texts of expressions.
std::optional<Placeholder> placeholder_in(const std::string& text, const Scope& scope);

/// Warns (W-PLACEHOLDER) where a path that the stage writes has one. given: of the stage, before its
/// expressions are resolved.
void warn_of_placeholders(const Value& given, const std::vector<std::string>& outputs, const Scope& scope,
                          Problems& problems);

} // namespace facetmill::pipeline
