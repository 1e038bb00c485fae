#pragma once
// Hints as facetmill pipe takes them: stages and options are named in YAML, as pipelines have them.

#include <string>
#include <string_view>

namespace facetmill::cli {

/// "load: {path: a.stl, unit: mm}" as "load a.stl --unit mm", "when: {faces: {min: 1}}" as "--when.faces.min
/// 1", "(faces: 10)" as "(--faces 10)", "keep: back" as "--keep back" where an option has this word as a
/// value, and ${x} as @{x}; all else of the hint as it is.
std::string in_pipe_syntax(std::string_view hint);

} // namespace facetmill::cli
