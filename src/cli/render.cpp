// facetmill render: renders a picture of a mesh file with the stage of that name.

#include "cli/pipe_syntax.hpp"
#include "cli/pipeline_options.hpp"
#include "docs/stages.hpp"
#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* render_examples =
    R"(You can add all options of the stage render, as in facetmill pipe: --view front, --no-occlusion, --range 0,1.

Examples
  facetmill render duck.glb -o duck.png
  facetmill render part.stl -o part.png --view front --edges all --background white
  facetmill render scan.ply -o around.png --views turntable --width 400 --height 400
  facetmill render before.glb after.glb -o both.png --width 800 --height 800
  facetmill render part.stl -o walls.png --attribute wall_thickness
  facetmill render low.glb high.glb -o deviation.png --attribute deviation

)";

struct RenderCommandOptions {
    std::string output;
    PipelineOptions run;
};

/// "-j2", "--log=x" -> "-j", "--log".
std::string name_of(const std::string& word) {
    return word.starts_with("--") ? word.substr(0, word.find('=')) : word.substr(0, 2);
}

/// Moves the command's own options out of the words after the mesh; the remaining words belong to the stage.
std::vector<std::string> take_own(const Arguments& arguments, std::vector<std::string>& words) {
    std::vector<std::string> own, rest;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        const Argument* argument =
            word.size() > 1 && word.starts_with("-") ? arguments.find(name_of(word)) : nullptr;
        if (!argument) {
            rest.push_back(word);
            continue;
        }
        own.push_back(word);
        const bool attached = word.size() > name_of(word).size();
        if (!argument->is_flag() && !attached && i + 1 < words.size()) own.push_back(words[++i]);
    }
    words = std::move(rest);
    return own;
}

void parse_own(const Arguments& arguments, std::vector<std::string> words) {
    try {
        arguments.parse("render", "", std::move(words));
    } catch (const std::invalid_argument& e) {
        throw Error(ErrorKind::usage, "E-ARGUMENT", fmt::format("render: {}", e.what()),
                    "see facetmill render --help");
    }
}

/// Refuses a comparison with the loaded scene, because no stage between load and render changes it.
void require_other_mesh(const pipeline::Plan& plan) {
    const auto& step = plan.steps.back();
    if (step.stage->compares_with_load())
        throw Error(ErrorKind::usage, "E-ARGUMENT", "render: deviation needs another mesh",
                    "facetmill render low.glb high.glb -o deviation.png --attribute deviation", step.where);
}

int render(RenderCommandOptions& options, const Arguments& arguments, const Invocation& invocation,
           const Console& console) {
    const auto& all = invocation.line.arguments();
    std::vector<std::string> words(all.begin() + static_cast<std::ptrdiff_t>(invocation.rest), all.end());
    if (std::find(words.begin(), words.end(), "--help") != words.end()) {
        print(docs::stage_page(*stage_named("render")));
        return 0;
    }
    const auto own = take_own(arguments, words);
    if (!own.empty()) parse_own(arguments, own);
    if (words.empty() || words.front().starts_with("--") || options.output.empty())
        throw Error(ErrorKind::usage, "E-ARGUMENT",
                    words.empty() || words.front().starts_with("--")
                        ? "render needs a mesh file before its options"
                        : "render needs -o FILE.png",
                    "for example facetmill render part.stl -o part.png", invocation.line.mark(0));
    // The equivalent one-liner, which messages show.
    std::vector<std::string> words_of_pipe{"pipe",   "load",   words.front(), "!",
                                           "render", "--path", options.output};
    auto rest = words.begin() + 1;
    if (rest != words.end() && !rest->starts_with("-")) {
        words_of_pipe.insert(words_of_pipe.end(), {"--with", *rest});
        ++rest;
    }
    words_of_pipe.insert(words_of_pipe.end(), rest, words.end());
    const CommandLine line(std::move(words_of_pipe));
    Problems problems;
    auto settings = plan_settings(options.run, line, problems);
    settings.name = "render";
    const Value document = parse_pipe(line, 1, problems);
    problems.throw_if_any(ErrorKind::usage);
    const auto plan = pipeline::make_plan(document, settings, problems);
    if (refused({plan}, problems, console)) return static_cast<int>(ErrorKind::usage);
    require_other_mesh(plan);
    confine_to({plan}, options.run, console);
    return run_with_messages(plan, options.run, console, "");
}

} // namespace

Command render_command() {
    return {
        "render",
        "Renders a PNG image of a mesh file, or of two next to each other.",
        render_examples,
        "MESH [MESH] [OPTIONS OF THE STAGE]",
        [](Arguments& arguments, Console& console) {
            auto options = std::make_shared<RenderCommandOptions>();
            arguments
                .add("-o,--output", &options->output, "The PNG file to write. - writes to standard output.")
                .followed_by("FILE.png");
            add_threads_option(arguments, options->run.threads, "The number of threads. Default: all cores.");
            add_asset_root_option(arguments, options->run.asset_roots);
            add_sandbox_option(arguments, options->run.sandbox);
            add_message_options(arguments, console);
            return [=, &arguments, &console](const Invocation& invocation) {
                return render(*options, arguments, invocation, console);
            };
        },
        false,
        "render"};
}

} // namespace facetmill::cli
