#include "docs/ready.hpp"

namespace facetmill::docs {

const ReadyPipeline* ready_pipeline(std::string_view name) {
    for (const auto& ready : ready_pipelines())
        if (ready.name == name) return &ready;
    return nullptr;
}

std::vector<std::string> ready_names() {
    std::vector<std::string> names;
    names.reserve(ready_pipelines().size());
    for (const auto& ready : ready_pipelines()) names.emplace_back(ready.name);
    return names;
}

} // namespace facetmill::docs
