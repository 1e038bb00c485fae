#include "pipeline/built_in.hpp"

namespace facetmill::pipeline {

namespace {

BuiltInPipelines& registered_pipelines() {
    static BuiltInPipelines find = nullptr;
    return find;
}

} // namespace

RegisterBuiltInPipelines::RegisterBuiltInPipelines(BuiltInPipelines find) { registered_pipelines() = find; }

std::string_view built_in_pipeline(std::string_view name) {
    return registered_pipelines() ? registered_pipelines()(name) : std::string_view();
}

} // namespace facetmill::pipeline
