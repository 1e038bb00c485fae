#include "docs/ready.hpp"

namespace facetmill::docs {

const ReadyPipeline* ready_pipeline(std::string_view name) {
    for (const auto& ready : ready_pipelines())
        if (ready.name == name) return &ready;
    return nullptr;
}

} // namespace facetmill::docs
