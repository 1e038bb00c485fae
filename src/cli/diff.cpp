// facetmill diff: two mesh files side by side.

#include "base/parallel.hpp"
#include "cli/command.hpp"
#include "cli/confine.hpp"
#include "diff/comparison.hpp"
#include "io/codec.hpp"
#include "io/convert.hpp"
#include "io/outputs.hpp"
#include "options/types.hpp"
#include "stage/options/convention.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

constexpr const char* diff_examples =
    R"(Compares counts, topology, geometry, attributes, materials, parts, and the other contents of glTF (document).
The distance between the surfaces is measured in both directions, from samples of the area and from every vertex; if a
file has no faces, from and to each of its points. Limits are in units of A (0.2, 2mm) or in percent of A's
diagonal (0.5%); the default, 0.0001%, allows for the rounding of float32 coordinates. If both files have a unit or an
up axis (their own, or that of --unit and --up), B is first converted to A's. Attributes are compared element by
element, in the order of the files.
Exit code 0: the files agree. 1: they differ in a section that is not ignored. 3 or 6: a file cannot be read.
What cannot be compared (lines, attributes of different sizes) is listed, and makes "complete" false in JSON.

Examples
  facetmill diff scan.ply scan.glb
  facetmill diff scan.ply web.glb --unit mm --max 0.5% --rms 0.05% --ignore counts,attributes
  facetmill diff old.glb new.glb --report changes.html
  facetmill diff a.stl b.stl --json | jq .deviation.maximum
  facetmill diff part.obj part.glb --max 0.01mm --certify --all
  facetmill diff cloud.ply scan.ply --max 1mm --ignore counts,topology,attributes
)";

struct DiffOptions {
    std::string a, b, maximum, rms, mean;
    std::vector<std::string> ignored;
    report::ComparisonSettings settings;
    std::string unit, up;             ///< of files that state none
    std::vector<std::string> reports; ///< pages and Markdown files to write
    bool json = false, all = false;
    int threads = 0;
    SandboxOptions sandbox;
};

/// A length on the command line, in A's units or in percent.
std::optional<report::ComparisonSettings::Limit> limit_of(const std::string& text, const std::string& option,
                                                          Unit unit, const CommandLine& line) {
    if (text.empty()) return {};
    Length length;
    Problems problems;
    const Mark mark = line.find(option);
    if (OptionType<Length>::parse(Value::scalar(text, mark), length, problems) && !(length.amount >= 0))
        problems.add(mark, "E-RANGE", fmt::format("{} is a distance, found {}", option, text), "at least 0");
    problems.throw_if_any(ErrorKind::usage);
    if (length.kind == Length::Kind::percent) return report::ComparisonSettings::Limit{length.amount, true};
    if (length.kind == Length::Kind::scene) return report::ComparisonSettings::Limit{length.amount, false};
    if (!(metres(unit) > 0))
        throw Error(ErrorKind::usage, "E-UNIT",
                    fmt::format("{} is {}, but the first file has no unit", option, text),
                    "give a bare number or a percentage", mark);
    return report::ComparisonSettings::Limit{length.amount / metres(unit), false};
}

/// Reads a file; what its reader could not keep is noted, so that it is not taken for the same.
Scene read(const std::string& name, bool is_a, std::vector<report::LeftOut>& left_out,
           const Console& console) {
    io::ReadLog log;
    Scene scene = io::read_scene(io::Input::open(name), {}, log);
    for (const auto& warning : log.warnings) {
        console.diagnostic(warning);
        if (warning.is_loss) left_out.push_back({is_a, warning.message});
    }
    return scene;
}

std::vector<std::string> stated_units() {
    std::vector<std::string> names;
    for (const auto& unit : unit_choices("", ""))
        if (unit.value != Unit::unknown) names.push_back(unit.name);
    return names;
}

/// What a file does not state is as the command line says.
void state(Scene& scene, const DiffOptions& options) {
    if (scene.unit == Unit::unknown) scene.unit = unit_named(options.unit).value_or(Unit::unknown);
    if (scene.up == UpAxis::unknown && !options.up.empty())
        scene.up = options.up == "y" ? UpAxis::y : UpAxis::z;
}

/// Refuses, before anything is read, what is no report of a comparison.
void check_reports(const DiffOptions& options, const CommandLine& line) {
    for (const auto& path : options.reports) {
        std::error_code none_there;
        for (const auto& file : {options.a, options.b})
            if (std::filesystem::equivalent(path, file, none_there))
                throw Error(ErrorKind::usage, "E-OVERWRITE",
                            fmt::format("the report '{}' would replace what it is about", path),
                            "give it another name", line.value(path));
        if (!path.ends_with(".html") && !path.ends_with(".md"))
            throw Error(ErrorKind::usage, "E-REPORT",
                        fmt::format("a report of diff is .html or .md, found '{}'", path),
                        "--json prints a comparison for programs", line.value(path));
    }
}

void write_reports(const DiffOptions& options, const report::Comparison& comparison, const Scene& a,
                   const Scene& b) {
    for (const auto& path : options.reports) {
        const std::string text =
            path.ends_with(".md") ? report::to_markdown(comparison, options.a, options.b)
                                  : report::to_html(comparison, options.a, options.b,
                                                    report::comparison_pictures(a, b, options.a, options.b));
        io::write_now(path, std::as_bytes(std::span(text)));
    }
}

/// Whether the scene is one part that is called like its file: a format without names.
bool is_named_by_file(const Scene& scene, const std::string& file) {
    const std::string own = file == "-" ? "standard input" : std::filesystem::path(file).stem().string();
    return scene.parts.size() == 1 && scene.parts[0].name == own;
}

int diff(DiffOptions& options, const CommandLine& line, const Console& console) {
    AllowedFiles allowed;
    for (const auto& file : {options.a, options.b}) allow_input(allowed, file);
    check_reports(options, line);
    for (const auto& report : options.reports) allow_output(allowed, report);
    confine(allowed, options.sandbox, console);
    set_threads(options.threads);
    std::vector<report::LeftOut> left_out;
    Scene a = read(options.a, true, left_out, console), b = read(options.b, false, left_out, console);
    state(a, options);
    state(b, options);
    io::convert(b, {b.unit == Unit::unknown ? Unit::unknown : a.unit,
                    b.up == UpAxis::unknown ? UpAxis::unknown : a.up});
    if (is_named_by_file(a, options.a) && is_named_by_file(b, options.b)) b.parts[0].name = a.parts[0].name;
    auto& settings = options.settings;
    settings.maximum = limit_of(options.maximum, "--max", a.unit, line);
    settings.rms = limit_of(options.rms, "--rms", a.unit, line);
    settings.mean = limit_of(options.mean, "--mean", a.unit, line);
    settings.ignored = {options.ignored.begin(), options.ignored.end()};
    auto comparison = report::compare(a, b, settings);
    comparison.left_out = std::move(left_out);
    print(options.json ? report::to_json(comparison, options.a, options.b)
                                 .dump(2, ' ', false, Json::error_handler_t::replace) +
                             "\n"
                       : report::to_text(comparison, options.a, options.b, options.all));
    write_reports(options, comparison, a, b);
    return comparison.differs() ? static_cast<int>(ErrorKind::check) : 0;
}

} // namespace

Command diff_command() {
    return {
        "diff", "Compares two mesh files; the exit code is 1 when they differ.", diff_examples, false,
        [](Arguments& arguments, Console& console) {
            auto options = std::make_shared<DiffOptions>();
            auto& settings = options->settings;
            arguments.add("A", &options->a, "The mesh file to compare with, or - for standard input.")
                .required();
            arguments.add("B", &options->b, "The other mesh file.").required();
            arguments.add("--max", &options->maximum, "The largest distance allowed (0.2, 2mm, 0.5%).");
            arguments.add("--rms", &options->rms,
                          "The largest root mean square distance over the area allowed.");
            arguments.add("--mean", &options->mean, "The largest mean distance over the area allowed.");
            arguments
                .add("--values", &settings.attribute_limit,
                     "The largest allowed difference of attribute values. Default: 1e-6.")
                .not_negative();
            arguments
                .add("--ignore", &options->ignored,
                     "Sections that do not decide:\ncounts, topology, geometry, attributes, materials, "
                     "parts, document.")
                .separated_by_commas()
                .one_of({std::begin(report::comparison_sections), std::end(report::comparison_sections)});
            arguments
                .add("--samples", &settings.deviation.samples,
                     "Points measured on the area, each way. Default: 100000.")
                .between(0, 1000000000);
            arguments.add("--seed", &settings.deviation.seed, "The seed of their positions. Default: 1.")
                .not_negative();
            arguments.add("--certify", &settings.deviation.certify,
                          "Also computes a guaranteed bound of the distance, and compares --max with it.");
            arguments.add("--unit", &options->unit, "The unit of a file that states none.")
                .one_of(stated_units());
            arguments.add("--up", &options->up, "The up axis of a file that states none.").one_of({"y", "z"});
            arguments.add(
                "--report", &options->reports,
                "Also writes F.html, a page with pictures of both files and of the distances, or F.md.");
            arguments.add("--all", &options->all, "Also shows what is equal.");
            arguments.add("--json", &options->json, "As JSON (facetmill schema diff).");
            arguments.add("-j,--threads", &options->threads, "The number of threads. Default: all cores.")
                .between(1, 4096);
            add_sandbox_option(arguments, options->sandbox);
            add_message_options(arguments, console);
            return [=, &console](const Invocation& i) { return diff(*options, i.line, console); };
        }};
}

} // namespace facetmill::cli
