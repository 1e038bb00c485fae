#include "docs/ready.hpp"

#include "pipeline/built_in.hpp"

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

namespace {

const pipeline::RegisterBuiltInPipelines registered([](std::string_view name) {
    const ReadyPipeline* ready = ready_pipeline(name);
    return ready ? ready->text : std::string_view();
});

} // namespace

} // namespace facetmill::docs
