// facetmill stages: the stages and their options, from the registry.

#include "docs/stages.hpp"
#include "base/text/spelling.hpp"
#include "cli/command.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* stages_examples = R"(Examples
  facetmill stages
  facetmill stages simplify
  facetmill stages --markdown > stages.md
)";

struct StagesOptions {
    std::string name;
    bool markdown = false, man = false, json = false;
};

int list_stages(const StagesOptions& options, const CommandLine& line) {
    if (!options.name.empty()) {
        const auto* stage = stage_named(options.name);
        if (!stage)
            throw Error(ErrorKind::usage, "E-STAGE", fmt::format("stage '{}' does not exist", options.name),
                        hint_for_stage(options.name, stage_names()), line.find(options.name));
        print(docs::stage_page(*stage));
    } else if (options.json)
        print(docs::stages_json().dump(2) + "\n");
    else if (options.markdown)
        print(docs::stages_markdown());
    else if (options.man)
        print(docs::stages_man());
    else
        print(docs::stage_list());
    return 0;
}

} // namespace

Command stages_command() {
    return {"stages",
            "Lists all stages, or describes one stage.",
            stages_examples,
            {},
            [](Arguments& arguments, Console&) {
                auto options = std::make_shared<StagesOptions>();
                arguments.add("NAME", &options->name, "A stage.");
                arguments.add("--json", &options->json, "Prints all stages as JSON.");
                arguments.add("--markdown", &options->markdown, "Prints all stages as a Markdown page.");
                arguments.add("--man", &options->man,
                              "Prints all stages as the manual page facetmill-stages(7).");
                return [=](const Invocation& invocation) { return list_stages(*options, invocation.line); };
            }};
}

} // namespace facetmill::cli
