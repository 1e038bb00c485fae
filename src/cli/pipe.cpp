// facetmill pipe: a pipeline as a one-liner.

#include "base/text/markup.hpp"
#include "cli/pipe_syntax.hpp"
#include "cli/pipeline_options.hpp"
#include "cli/save_pipeline.hpp"
#include "docs/stages.hpp"
#include "pipeline/document.hpp"
#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* pipe_examples =
    R"(Stages and options are the same as in a pipeline file. Give options of facetmill pipe first, then stages separated
by ! or +. Write the name of a stage, a bare value for its primary option, and --key value, --key=value or --flag
for other options.

Join nested keys with dots (--plane.normal=0,0,1, --ensure.closed, --when.closed). Use --name and --only as in a
file. Write lists with commas, or repeat the option. Paths may contain commas, so always repeat the option for
lists of paths. If an option has a plural form, you can repeat the singular (--plane z=0 --plane x=0 for
--planes). @{x} means ${x}, and 50pct means 50%.

  foreach VARIABLE=VALUE,VALUE... [ STAGE ! STAGE ]
  branch NAME [ STAGE ! STAGE ] NAME [ STAGE ]
  include FILE --with.PARAM=VALUE

Examples
  facetmill pipe load scan.ply ! simplify 25% ! write web.glb
  facetmill pipe load a.stl --unit mm ! clip --plane z=0 --cap ! relax 3 ! write a.glb --draco
  facetmill pipe load a.ply ! foreach lod=50%,10% [ simplify @{lod} ! write a.@{lod.index}.glb ]
  facetmill pipe load - + validate --closed < part.stl
  facetmill pipe --save part.yaml load part.stl ! write part.glb       (then: facetmill run part.yaml)
)";

/// Whether a stage's own help is requested: facetmill pipe clip --help.
bool help_wanted(const Invocation& invocation) {
    const auto& all = invocation.line.arguments();
    for (std::size_t i = invocation.rest + 1; i < all.size(); ++i)
        if (all[i] == "--help")
            for (std::size_t j = i; j-- > invocation.rest;)
                if (const auto* stage = stage_named(all[j])) {
                    print(docs::stage_page(*stage));
                    return true;
                }
    return false;
}

int pipe(const PipelineOptions& options, const std::string& save_to, const Arguments& own,
         const Invocation& invocation, const Console& console) {
    if (help_wanted(invocation)) return 0;
    Problems problems;
    auto settings = plan_settings(options, invocation.line, problems);
    settings.name = "pipe";
    if (!save_to.empty()) settings.others.push_back({save_to, invocation.line.find("--save"), true});
    const Value document = parse_pipe(invocation.line, invocation.rest, problems, &own);
    if (problems.any_errors()) { // a report needs a pipeline; syntax errors have none
        Problems others;
        refused({pipeline::make_plan({}, settings, others)}, problems, console);
        return static_cast<int>(ErrorKind::usage);
    }
    settings.command = "facetmill pipe";
    for (std::size_t i = invocation.rest; i < invocation.line.arguments().size(); ++i) {
        const auto& argument = invocation.line.arguments()[i];
        settings.command += " " + (argument == "!" ? argument : for_shell(argument));
    }
    auto plan = pipeline::make_plan(document, settings, problems);
    plan.text = pipeline::emit_yaml(document);
    if (refused({plan}, problems, console)) return static_cast<int>(ErrorKind::usage);
    if (!save_to.empty()) save_pipeline(document, options.reports, save_to);
    confine_to({plan}, options, console);
    return run_with_messages(plan, options, console, "");
}

} // namespace

Command pipe_command() {
    return {"pipe",
            "Runs a pipeline written on the command line.",
            pipe_examples,
            "STAGE ... ! STAGE ...",
            [](Arguments& arguments, Console& console) {
                auto options = std::make_shared<PipelineOptions>();
                auto save_to = std::make_shared<std::string>();
                arguments.add("--save", save_to.get(), "Also saves the pipeline as a file for run.");
                add_asset_root_option(arguments, options->asset_roots);
                add_run_options(arguments, *options);
                add_message_options(arguments, console);
                return [=, &arguments, &console](const Invocation& invocation) {
                    console.pipe = true;
                    options->cells = cell_settings(*options, invocation.line);
                    return pipe(*options, *save_to, arguments, invocation, console);
                };
            },
            true};
}

} // namespace facetmill::cli
