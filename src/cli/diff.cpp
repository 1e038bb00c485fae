// facetmill diff: compares two mesh files, or two folders of mesh files.

#include "base/text/markup.hpp"
#include "cli/command.hpp"
#include "cli/command_steps.hpp"
#include "cli/diff_files.hpp"
#include "io/outputs/outputs.hpp"
#include "parallel/parallel.hpp"
#include "stage/options/convention.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <optional>

namespace facetmill::cli {

namespace {

constexpr const char* diff_examples =
    R"(Compares counts, topology, geometry, attributes, materials, parts, and the other contents of glTF (document). The
distance between the surfaces is measured in both directions, from samples of the area and from every vertex. If a
file has no faces, distances are measured from and to its points.

Limits are in units of A (0.2, 2mm) or in percent of A's diagonal (0.5%). The default, 0.0001%, allows for the
rounding of float32 coordinates. If the units and up axes of both files are known (from the files, --unit or
--up), B is first converted to the unit and axis of A. Attributes are compared element by element, in the order
of the files.

Exit codes: 0 if the files agree, 1 if they differ in a section that is not ignored, 3 or 6 if a file cannot be
read.

For two folders, mesh files with the same relative path are compared. The remaining files are compared if they
differ only in their suffix (a.ply and a.glb), and each folder has only one such file. A file that exists in
only one folder counts as a difference. The largest differences are listed first. --html F.html writes an index,
with a page for each pair in the folder F next to it. Contents that cannot be compared (lines, attributes of
different sizes) are listed, and set "complete" to false in JSON.

Examples
  facetmill diff scan.ply scan.glb
  facetmill diff scan.ply web.glb --unit mm --max 0.5% --rms 0.05% --ignore counts,attributes
  facetmill diff old.glb new.glb --html changes.html
  facetmill diff a.stl b.stl --json | jq .deviation.maximum
  facetmill diff part.obj part.glb --max 0.01mm --certify --all
  facetmill diff cloud.ply scan.ply --max 1mm --ignore counts,topology,attributes
  facetmill diff assets.before/ assets/ --html changes.html --markdown changes.md
)";

std::vector<std::string> stated_units() {
    std::vector<std::string> names;
    for (const auto& unit : unit_choices("", ""))
        if (unit.value != Unit::unknown) names.push_back(unit.name);
    return names;
}

/// Adds the file of --html or --markdown to the reports.
Argument::Target report_named(const std::shared_ptr<DiffOptions>& options, const std::string& option,
                              const std::string& ending) {
    return written_file(option, ending, "E-REPORT",
                        fmt::format("facetmill diff A B {} changes{}", option, ending),
                        [=](const std::string& path) { options->reports.push_back(path); });
}

/// Refuses invalid comparison reports before reading any file.
void check_reports(const DiffOptions& options, const CommandLine& line) {
    for (const auto& path : options.reports) {
        std::error_code none_there;
        for (const auto& file : {options.a, options.b})
            if (std::filesystem::equivalent(path, file, none_there))
                throw Error(ErrorKind::usage, "E-OVERWRITE",
                            fmt::format("the report '{}' would overwrite one of its inputs", path),
                            "give it another name", line.value(path));
        if (!path.ends_with(".html") && !path.ends_with(".md"))
            throw Error(ErrorKind::usage, "E-REPORT",
                        fmt::format("a report of diff is .html or .md, found '{}'", path),
                        "use --json to print a comparison for programs", line.value(path));
    }
}

void write_reports(const DiffOptions& options, const ComparedFiles& files, const Console& console) {
    CommandSteps steps(console, options.reports.size());
    std::optional<report::ComparisonPictures> pictures;
    for (const auto& path : options.reports) {
        steps.next(path);
        const bool is_page = path.ends_with(".html");
        if (is_page && !pictures) {
            pictures = report::comparison_pictures(files.a, files.b, options.a, options.b);
            tell_not_drawn(pictures->not_drawn, console);
        }
        const std::string text = is_page ? report::to_html(files.comparison, options.a, options.b, *pictures)
                                         : report::to_markdown(files.comparison, options.a, options.b);
        io::write_now(path, std::as_bytes(std::span(text)));
    }
}

/// The comparison of two files.
int diff_of_files(const DiffOptions& options, const CommandLine& line, const Console& console) {
    CommandSteps steps(console, 1);
    steps.next("compare");
    const ComparedFiles files = compared_files(options, options.a, options.b, line, console);
    steps.done();
    if (options.json)
        print(report::to_json(files.comparison, options.a, options.b)
                  .dump(2, ' ', false, Json::error_handler_t::replace) +
              "\n");
    else
        show(report::to_text(files.comparison, options.a, options.b, options.all));
    write_reports(options, files, console);
    return files.comparison.differs() ? static_cast<int>(ErrorKind::check) : 0;
}

bool is_folder(const std::string& path) {
    std::error_code none_there;
    return std::filesystem::is_directory(path, none_there);
}

int diff(DiffOptions& options, const CommandLine& line, const Console& console) {
    options.reports.insert(options.reports.end(), options.others.begin(), options.others.end());
    if (options.a == "-" && options.b == "-")
        throw Error(ErrorKind::usage, "E-DUPLICATE-INPUT", "standard input can be read only once",
                    "give a file for A or for B", line.value("-"));
    const bool folders = is_folder(options.a);
    if (folders != is_folder(options.b) && options.a != "-" && options.b != "-")
        throw Error(ErrorKind::usage, "E-ARGUMENT", "one of the two is a folder, but the other is not",
                    "give two files, or two folders", line.value(folders ? options.b : options.a));
    AllowedFiles allowed;
    if (folders)
        allowed.read = {options.a, options.b};
    else
        for (const auto& file : {options.a, options.b}) allow_input(allowed, file);
    allowed.read.insert(allowed.read.end(), options.asset_roots.begin(), options.asset_roots.end());
    for (const auto& [option, said] : {std::pair{"--unit", options.units}, std::pair{"--up", options.ups}})
        if (said.size() > 2)
            throw Error(ErrorKind::usage, "E-ARGUMENT",
                        fmt::format("{} has {} values for two files", option, said.size()),
                        "give one value for both files, or one each", line.find(option));
    check_reports(options, line);
    for (const auto& report : options.reports) {
        allow_output(allowed, report);
        if (folders && report.ends_with(".html")) allow_output(allowed, folder_of_pages(report) / "page");
    }
    confine(allowed, options.sandbox, console);
    set_threads(options.threads);
    if (options.samples != SIZE_MAX) {
        options.settings.deviation.samples = options.samples;
        options.settings.deviation.mean_error = 0;
    }
    options.settings.ignored = {options.ignored.begin(), options.ignored.end()};
    return folders ? diff_of_folders(options, line, console) : diff_of_files(options, line, console);
}

} // namespace

Command diff_command() {
    return {
        "diff",
        "Compares two mesh files or two folders. The exit code is 1 if they differ.",
        diff_examples,
        {},
        [](Arguments& arguments, Console& console) {
            auto options = std::make_shared<DiffOptions>();
            auto& settings = options->settings;
            arguments
                .add("A", &options->a,
                     "The first mesh file, a folder of mesh files, or - for standard input.")
                .required();
            arguments.add("B", &options->b, "The second mesh file or folder.").required();
            arguments.add("--max", &options->maximum, "The largest allowed distance (0.2, 2mm, 0.5%).");
            arguments.add("--rms", &options->rms,
                          "The largest allowed root mean square distance, weighted by area.");
            arguments.add("--mean", &options->mean, "The largest allowed mean distance, weighted by area.");
            arguments
                .add("--values", &settings.attribute_limit,
                     "The largest allowed difference of attribute values. Default: 1e-6.")
                .not_negative();
            arguments
                .add("--ignore", &options->ignored,
                     "Sections whose differences do not matter:\ncounts, topology, geometry, attributes, "
                     "materials, parts, document.")
                .separated_by_commas()
                .one_of({std::begin(report::comparison_sections), std::end(report::comparison_sections)});
            arguments
                .add("--samples", &options->samples,
                     "The number of sample points in each direction. All of them are measured.\nDefault: "
                     "100000, and then rms and mean use only the samples that they need.")
                .between(0, 1000000000);
            arguments.add("--seed", &settings.deviation.seed, "The seed of the sample positions. Default: 1.")
                .not_negative();
            arguments.add("--certify", &settings.deviation.certify,
                          "Also computes a guaranteed bound of the distance, and compares it with --max.");
            arguments
                .add("--unit", &options->units,
                     "The unit of files without a unit. mm,m gives different units for A and B.")
                .separated_by_commas_alone()
                .one_of(stated_units());
            arguments
                .add("--up", &options->ups,
                     "The up axis of files without an axis. z,y gives different axes for A and B.")
                .separated_by_commas_alone()
                .one_of({"y", "z"});
            arguments
                .add("--html", report_named(options, "--html", ".html"),
                     "Also writes F.html, a page with pictures of both files and of the distances.")
                .followed_by("F.html");
            arguments
                .add("--markdown", report_named(options, "--markdown", ".md"),
                     "Also writes F.md, for a pull request.")
                .followed_by("F.md");
            arguments.add("--report", &options->others, "Also writes a report: F.html or F.md.");
            arguments.add("--all", &options->all, "Also shows equal values.");
            arguments.add("--json", &options->json, "Prints JSON (facetmill schema diff).");
            add_threads_option(arguments, options->threads, "The number of threads. Default: all cores.");
            add_asset_root_option(arguments, options->asset_roots);
            add_sandbox_option(arguments, options->sandbox);
            add_message_options(arguments, console);
            return [=, &console](const Invocation& i) { return diff(*options, i.line, console); };
        }};
}

} // namespace facetmill::cli
