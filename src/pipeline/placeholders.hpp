#pragma once
// File names with placeholders of other programs, such as "{input.stem}.glb" or "$lod.glb", which this
// program would write literally.

#include "pipeline/expressions.hpp"

#include <optional>
#include <string>

namespace facetmill::pipeline {

struct Placeholder {
    std::string text;       ///< "{input.stem}"
    std::string expression; ///< "${input.stem}"
    bool known = false;     ///< a variable of that name exists
};

/// The first probable placeholder in the text: it names a variable, a property of a file name (.stem), or a
/// common placeholder of other programs (name, stem, index ...). Ignores texts inside expressions.
[[nodiscard]] std::optional<Placeholder> placeholder_in(const std::string& text, const Scope& scope);

/// Warns (W-PLACEHOLDER) if an output path of the stage has a placeholder. given: the stage's options with
/// unresolved expressions.
void warn_of_placeholders(const Value& given, const std::vector<std::string>& outputs, const Scope& scope,
                          Problems& problems);

} // namespace facetmill::pipeline
