// facetmill migrate: pipelines of an older format to the present one. Format 1 is the only one so far, so
// that there is nothing to change; what is of no known format is named.

#include "cli/pipeline_options.hpp"

namespace facetmill::cli {

namespace {

constexpr const char* migrate_examples =
    R"(Format 1 (facetmill: 1) is the only format so far, so no file is changed. What is not of format 1 is named, each with its
place and a hint. Exit code 0: nothing is to be changed. 1, with --check: something would be. 2: a pipeline is wrong: of no
format that this release knows, or with any other error that `facetmill check` finds in it. 3: there is no such file.

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
    return {"migrate", "Says what pipelines need to be of the present format.", migrate_examples, false,
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
