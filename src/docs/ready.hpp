#pragma once
// The built-in pipelines: the files of pipelines/, embedded at build time (cmake/Embed.cmake).

#include <string>
#include <string_view>
#include <vector>

namespace facetmill::docs {

struct ReadyPipeline {
    std::string_view name; ///< the file's stem: "quickstart"
    std::string_view text;
};

/// Sorted by name.
const std::vector<ReadyPipeline>& ready_pipelines();
[[nodiscard]] const ReadyPipeline* ready_pipeline(std::string_view name);
[[nodiscard]] std::vector<std::string> ready_names();

} // namespace facetmill::docs
