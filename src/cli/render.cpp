// facetmill render: renders a picture of a mesh file with the stage of that name.

#include "base/text/words.hpp"
#include "cli/pipe_syntax.hpp"
#include "cli/pipeline_options.hpp"
#include "docs/stages.hpp"
#include "geometry/quantities/quantities.hpp"
#include "io/codec.hpp"
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
  facetmill render before.stl after.glb -o both.png --unit mm --up z     (if a file has none; mm,m: per file)
  facetmill render part.stl -o walls.png --attribute wall_thickness
  facetmill render low.glb high.glb -o deviation.png --attribute deviation

)";

struct RenderCommandOptions {
    std::string output;
    std::string unit;             ///< of files without a unit (for both, or "mm,m"), or of the attribute
    std::vector<std::string> ups; ///< of files without an up axis: for both, or one for each
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

/// The units of --unit if they are of files; none if it is the unit of an attribute ("K").
std::vector<std::string> units_of_files(const std::string& unit) {
    std::vector<std::string> units;
    for (const auto& one : split_at_commas(unit)) units.emplace_back(one);
    const auto is_unit = [](const std::string& one) {
        const auto known = unit_named(one);
        return known && *known != Unit::unknown;
    };
    return std::all_of(units.begin(), units.end(), is_unit) ? units : std::vector<std::string>{};
}

/// The unit and the up axis from --unit and --up for the first or the second file, if the file states none.
/// Values as words of pipe.
struct GivenConvention {
    std::string unit, up;

    GivenConvention(const std::string& mesh, bool is_first, const std::vector<std::string>& units,
                    const std::vector<std::string>& ups) {
        if (units.empty() && ups.empty()) return;
        io::FileHeader header;
        std::error_code unknown;
        if (mesh != "-" && std::filesystem::is_regular_file(mesh, unknown))
            header = io::file_header(io::Input::open(mesh), {});
        const auto said = [&](const std::vector<std::string>& all) {
            return all.empty() ? std::string() : is_first ? all.front() : all.back();
        };
        if (header.unit == Unit::unknown) unit = said(units);
        if (header.up == UpAxis::unknown) up = said(ups);
    }

    void add_to(std::vector<std::string>& words) const {
        if (!unit.empty()) words.insert(words.end(), {"--unit", unit});
        if (!up.empty()) words.insert(words.end(), {"--up", up});
    }
    bool empty() const { return unit.empty() && up.empty(); }
};

/// The equivalent one-liner, which messages show. words: the files, and options of the stage.
std::vector<std::string> as_one_liner(const RenderCommandOptions& options,
                                      const std::vector<std::string>& words) {
    const auto units = units_of_files(options.unit);
    auto rest = words.begin() + 1;
    const bool two = rest != words.end() && !rest->starts_with("-");
    std::vector<std::string> line{"pipe", "load", words.front()};
    GivenConvention(words.front(), true, units, options.ups).add_to(line);
    // A second file without a unit or up axis is assumed to have the unit and axis of the scene.
    if (const GivenConvention second(two ? *rest : "-", false, units, options.ups); two && !second.empty()) {
        line.insert(line.end(), {"!", "transform"});
        second.add_to(line);
    }
    line.insert(line.end(), {"!", "render", "--path", options.output});
    if (two) line.insert(line.end(), {"--with", *rest++});
    line.insert(line.end(), rest, words.end());
    const auto attribute = std::find(words.begin(), words.end(), "--attribute");
    const bool is_stored = attribute != words.end() && attribute + 1 != words.end() &&
                           quantity_called(*(attribute + 1)) == nullptr;
    if (!options.unit.empty() && (units.empty() || is_stored))
        line.insert(line.end(), {"--unit", units.empty() ? options.unit : units.front()});
    return line;
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
    const bool has_mesh = !words.empty() && !words.front().starts_with("--");
    if (!has_mesh || options.output.empty())
        throw Error(
            ErrorKind::usage, "E-ARGUMENT",
            has_mesh ? "render needs -o FILE.png" : "render needs a mesh file before its options",
            fmt::format("facetmill render {} -o part.png", has_mesh ? for_shell(words.front()) : "part.stl"),
            invocation.line.mark(0));
    const CommandLine line(as_one_liner(options, words));
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
            arguments
                .add("--unit", &options->unit,
                     "The unit of files without a unit. mm,m gives different units for two files.\nAlso the "
                     "unit of a stored "
                     "attribute, for the legend.")
                .followed_by("UNIT");
            arguments
                .add("--up", &options->ups,
                     "The up axis of files without an axis. z,y gives different axes for two files.")
                .separated_by_commas_alone()
                .one_of({"y", "z"});
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
