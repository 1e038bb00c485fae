// facetmill migrate: converts pipelines of older formats. Format 1 is the only format so far, so it changes
// nothing; unknown formats are reported.

#include "cli/pipeline_options.hpp"

namespace facetmill::cli {

namespace {

constexpr const char* migrate_examples =
    R"(Format 1 (facetmill: 1) is the only format so far, so no file is changed. Files that are not in format 1 are
listed, each with the position and a hint. Exit code 0: nothing needs to be changed. 1, with --check: something does.
2: a pipeline is in a format that this release does not know, or has another error that `facetmill check` finds.
3: a file does not exist.

Examples
  facetmill migrate --check pipelines/*.yaml
)";

int migrate(const std::vector<std::string>& pipelines, bool check, const CommandLine& line,
            const Console& console) {
    plan_each(
        pipelines, PipelineOptions(), line, console, [&](const std::string& name, const pipeline::Plan&) {
            console.say(name + (check ? ": format 1, nothing to change" : ": format 1, nothing changed"));
        });
    return 0;
}

} // namespace

Command migrate_command() {
    return {"migrate",
            "Says what must be changed in pipelines for the current format.",
            migrate_examples,
            {},
            [](Arguments& arguments, Console& console) {
                auto pipelines = std::make_shared<std::vector<std::string>>();
                auto check = std::make_shared<bool>(false);
                arguments.add("PIPELINE", pipelines.get(), "YAML files, - or ready pipelines.").required();
                arguments.add("--check", check.get(), "Changes nothing, and says what would be changed.");
                add_message_options(arguments, console);
                return [=, &console](const Invocation& invocation) {
                    return migrate(*pipelines, *check, invocation.line, console);
                };
            }};
}

} // namespace facetmill::cli
