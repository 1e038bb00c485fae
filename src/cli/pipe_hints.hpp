#pragma once
// Rewrites hints for facetmill pipe, because hints name stages and options in YAML.

#include <string>
#include <string_view>

namespace facetmill::cli {

/// Rewrites "load: {path: a.stl, unit: mm}" as "load a.stl --unit mm", "when: {faces: {min: 1}}" as
/// "--when.faces.min 1", and "(faces: 10)" as "(--faces 10)". "keep: back" becomes "--keep back" if an
/// option has this value, and ${x} becomes @{x}. The rest of the hint stays unchanged.
[[nodiscard]] std::string in_pipe_syntax(std::string_view hint);

} // namespace facetmill::cli
