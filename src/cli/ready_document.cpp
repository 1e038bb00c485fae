#include "cli/ready_document.hpp"

#include "pipeline/document.hpp"

namespace facetmill::cli {

Value document_of(const docs::ReadyPipeline& ready) {
    Problems none;
    return pipeline::parse_yaml(
        std::make_shared<const SourceText>(SourceText{std::string(ready.name), std::string(ready.text)}),
        none);
}

std::vector<std::string> choices_of(const Value& param) {
    std::vector<std::string> choices;
    if (const Value* all = param.find("choices"))
        for (const Value& one : all->items) choices.push_back(one.text);
    return choices;
}

} // namespace facetmill::cli
