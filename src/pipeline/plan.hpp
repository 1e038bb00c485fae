#pragma once
// From parsing to a plan: a document becomes steps with parsed and checked options, ready to run. Planning
// finds all errors that do not require opening a mesh, and reports them at once.

#include "stage/contract.hpp"
#include "stage/stage.hpp"

#include <map>

namespace facetmill::pipeline {

struct Step;

/// Steps that run in sequence on a scene.
using Steps = std::vector<Step>;

/// The common key `when`: a truth value known when planning, or predicates on the scene.
struct Condition {
    std::optional<bool> known;
    Assertions predicates;
    Mark where;
};

struct Arm {
    std::string name;                                     ///< name in a branch; in a foreach: "lod=50%"
    std::vector<std::pair<std::string, Value>> variables; ///< variables of a foreach
    std::optional<std::size_t> part;                      ///< in a foreach over parts: the index of its part
    std::shared_ptr<Steps> steps;
};

/// The arms of a foreach over parts, once the names of the parts are known.
using ArmsOfParts = std::function<std::vector<Arm>(const std::vector<std::string>& parts, Problems&)>;

/// A stage with its options, or a branch or foreach with its arms.
struct Step {
    enum class Kind { stage, branch, foreach };
    Kind kind = Kind::stage;
    const StageInfo* info = nullptr; ///< the stage's properties
    std::shared_ptr<Stage> stage;    ///< the stage with its options
    Value given;                     ///< as written, with resolved expressions
    std::string name;                ///< unique in the plan
    std::string path;                ///< "stages[3]", "stages[5].branch.far[0]"
    std::optional<Condition> when;
    PartFilter only;
    std::optional<Contract> ensure;
    std::vector<Arm> arms;     ///< arms of a branch or foreach (over parts: planned for an unknown part)
    ArmsOfParts arms_of_parts; ///< set for a foreach over parts
    PartFilter parts;          ///< the parts of this foreach
    bool join = false;
    Mark where;
};

/// Calls visit for each step, and then for the steps of its arms.
void for_each_step(const Steps& steps, const std::function<void(const Step&)>& visit);

/// A file that a plan reads or writes.
struct PlannedFile {
    std::filesystem::path path;
    Mark where;
    bool written = false;
    std::vector<std::pair<std::string, Value>>
        variables{};                 ///< variables of each enclosing foreach, the outermost first
    bool shapes = false;             ///< a file with stages or params of the pipeline: an include, a preset
    std::filesystem::path pattern{}; ///< for an input found by wildcards: the pattern
};

struct PlanSettings {
    std::string name;    ///< name of the pipeline, for messages and the report
    std::string command; ///< the shell command that runs it again; empty: unknown
    std::vector<std::pair<std::string, std::string>> defines; ///< -D
    /// The marks of values in defines that do not come from -D: in a table, in a preset.
    std::map<std::string, Mark> defined_at;
    /// List values in defines that come from a preset or a table; defines has them in -D's syntax.
    std::map<std::string, Value> defined_lists;
    /// The base folders of paths in defines, if different from the working directory.
    std::map<std::string, std::filesystem::path> defined_in;
    std::vector<std::pair<std::string, std::string>> sets; ///< --set stage.option=value
    bool update_baselines = false; ///< --update-baseline: stages write their baselines
    Folders places;
    std::filesystem::path working_directory; ///< base of -D paths
    std::vector<std::string> extra_reports;  ///< --report
    std::vector<std::string> allowed;        ///< --allow: ids of warnings
    std::vector<PlannedFile> others; ///< other files read and written: the pipeline itself, --save ...
    /// Called for each included file before it is opened, even if it does not exist.
    std::function<void(const std::filesystem::path&)> on_include;
    bool parameters_needed = true; ///< false (check without -D): params without a value accept any value
};

struct Plan {
    std::string name, about;
    std::string text;    ///< as written, for pages
    std::string command; ///< see PlanSettings
    Json params = Json::object();
    Steps steps;
    std::vector<std::string> reports;
    std::vector<PlannedFile> others; ///< other files read and written: reports, the pipeline ...
    Folders places;
    bool files_collide = false; ///< a file is both read and written, or used twice (check_collisions)
    std::vector<Diagnostic> warnings;
    std::vector<std::string> allowed; ///< ids of warnings that are neither reported nor failures
};

/// Adds the values of a preset, a YAML file with a map of params. Existing values stay. Throws a
/// missing-file error.
void add_preset(const std::filesystem::path& file, PlanSettings& settings, Problems& problems);

/// Plans a parsed document. Adds all problems (E-FORMAT-VERSION, E-REQUIRES, E-STAGE, E-KEY, E-PARAM, ...).
/// Run the plan only if there are no errors among them.
[[nodiscard]] Plan make_plan(const Value& document, const PlanSettings& settings, Problems& problems);
/// Parses and plans a pipeline; messages use settings.name for its text.
[[nodiscard]] Plan plan_text(std::string text, const PlanSettings& settings, Problems& problems);
/// A pipeline as text, to plan once or for many assets.
struct PipelineSource {
    std::string text;
    std::filesystem::path file; ///< "-": standard input; empty: none
};
/// Reads a pipeline file ("-": standard input). An unreadable file throws a missing-file error.
[[nodiscard]] PipelineSource read_pipeline(const std::filesystem::path& file);
/// Plans a pipeline; its inputs are relative to its file, which is an input itself.
[[nodiscard]] Plan plan_source(const PipelineSource& source, PlanSettings settings, Problems& problems);

/// The known files of these steps in order (globs expanded), without files of steps that will be skipped.
[[nodiscard]] std::vector<PlannedFile> planned_files(const Steps& steps, const Folders& places);
/// The folders, besides a file's own, in which loaded files may refer to files.
[[nodiscard]] std::vector<std::filesystem::path> asset_roots_of(const Steps& steps, const Folders& places);
/// Checks for conflicts between files. Adds E-DUPLICATE-OUTPUT for two writes to the same path (ignoring
/// case), and E-OVERWRITE for an output that is also an input. Adds E-DUPLICATE-INPUT for reading standard
/// input twice. Returns true if there is no conflict.
bool check_collisions(const std::vector<PlannedFile>& files, Problems& problems);
/// Checks all files of the plan as in check_collisions, with the files of a foreach over parts, once the
/// names of the parts are known.
void check_new_files(const Plan& plan, const Step& step, const std::vector<Arm>& arms, Problems& problems);
/// An E-FILE for every missing input, at its mark; exit code 3. run_plan calls it first.
[[nodiscard]] std::vector<Diagnostic> missing_inputs(const Plan& plan);

/// An input and its header.
struct InputHeader {
    std::filesystem::path path;
    io::FileHeader header;
};

struct Headers {
    std::vector<InputHeader> inputs; ///< in plan order, each file once
    /// Additional input files (.bin, .mtl, images), even if missing, and additional output files (images, a
    /// .mtl).
    std::vector<std::filesystem::path> more_inputs, more_outputs;
    /// A stage changes images that a later write exports; more_outputs then lists the files without that
    /// change (see pipeline/rehearsal.hpp).
    bool images_change = false;
    std::vector<Error> errors; ///< in plan order
    struct Lengths {
        Unit unit = Unit::unknown; ///< unit of the scene
        std::vector<report::ResolvedLength> all;
    };
    /// By step path, the lengths with a physical unit if the scene's unit is known.
    std::map<std::string, Lengths> lengths;
};

/// Reads the headers of existing inputs. Reports files that no stage could load, with the errors of loading.
/// Reports unit errors (E-UNIT, usage) of lengths and of a stage's option `unit`, if the first input has no
/// unit. Skips streams and compressed files, because they would have to be read completely. Images that a
/// stage changes are unknown here (images_change).
[[nodiscard]] Headers read_headers(const Plan& plan);
/// Errors of the inputs before the run: an E-FILE for every pattern without matches, because its files are
/// unknown, and the errors of the headers.
[[nodiscard]] std::vector<Error> input_errors(const Plan& plan, const Headers& headers);

/// The files that the plan reads and writes, as far as known before it runs (with expanded globs and the
/// headers' data). Includes and presets are the last inputs; reports are outputs.
[[nodiscard]] std::vector<std::filesystem::path> planned_inputs(const Plan& plan,
                                                                const Headers& headers = {});
/// The inputs that stages name: without textures, includes and presets.
[[nodiscard]] std::vector<std::filesystem::path> inputs_of_steps(const Plan& plan);
[[nodiscard]] std::vector<std::filesystem::path> planned_outputs(const Plan& plan,
                                                                 const Headers& headers = {});
/// The wildcard patterns of inputs.
[[nodiscard]] std::vector<std::filesystem::path> planned_patterns(const Plan& plan);
/// W-NOTHING, at the last stage, if a run would have no effect: no file, no check that can fail, no report.
[[nodiscard]] std::optional<Diagnostic> without_effect(const Plan& plan);
/// The diagnostic with the plan's first input in its message ("scan.ply: ..."), unless its text or mark
/// already names one. In a log of many runs this identifies the asset.
[[nodiscard]] Diagnostic about_input(const std::vector<std::filesystem::path>& inputs, Diagnostic diagnostic);
/// Describes the resolved plan with the data of input headers: for `facetmill plan`, as text and as JSON.
[[nodiscard]] std::string describe(const Plan& plan, const Headers& headers = {});
/// The defaults, in pipeline syntax, of the options that a stage was not given.
[[nodiscard]] std::map<std::string, std::string> default_texts(const Step& step);
/// The effective options of a stage: the given value, otherwise the default.
[[nodiscard]] Json options_json(const Step& step);
[[nodiscard]] Json describe_json(const Plan& plan, const Headers& headers = {});

} // namespace facetmill::pipeline
