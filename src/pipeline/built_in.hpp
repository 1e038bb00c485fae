#pragma once
// The pipelines that the program contains, which other pipelines can include by name.

#include <string_view>

namespace facetmill::pipeline {

/// Finds the text of a built-in pipeline by its name; empty for unknown names.
using BuiltInPipelines = std::string_view (*)(std::string_view name);

/// Registers the built-in pipelines through a static object, because they belong to a higher layer.
struct RegisterBuiltInPipelines {
    explicit RegisterBuiltInPipelines(BuiltInPipelines find);
};

[[nodiscard]] std::string_view built_in_pipeline(std::string_view name);

} // namespace facetmill::pipeline
