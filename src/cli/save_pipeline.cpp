#include "cli/save_pipeline.hpp"

#include "io/outputs/outputs.hpp"
#include "pipeline/document.hpp"
#include "pipeline/rebase.hpp"

namespace facetmill::cli {

void save_pipeline(Value document, const std::vector<std::string>& reports, const std::string& target) {
    const auto here = std::filesystem::current_path();
    // A path that begins with a param is known, because the default of the param is rebased.
    const auto run_time =
        document.find("params") ? pipeline::RunTimePaths::kept : pipeline::RunTimePaths::refused;
    if (target != "-")
        pipeline::rebase_inputs(document, here, std::filesystem::absolute(target).parent_path(), run_time);
    for (const auto& report : reports) {
        Value& all =
            document.find("report") ? *document.find("report") : document.set("report", Value::list({}));
        all.items.push_back(Value::scalar(report));
    }
    const std::string text = pipeline::emit_yaml(document);
    Problems unreadable; // a path need not be UTF-8, but a pipeline must be
    pipeline::parse_yaml(std::make_shared<const SourceText>(SourceText{target, text}), unreadable);
    unreadable.throw_if_any(ErrorKind::usage);
    io::write_now(target, std::as_bytes(std::span(text)));
}

} // namespace facetmill::cli
