#pragma once
// Parse -> plan: a document becomes steps whose options are parsed, checked and ready to run. All that can be
// known without opening a mesh is known here, and all errors are reported at once.

#include "stage/contract.hpp"
#include "stage/stage.hpp"

#include <map>

namespace facetmill::pipeline {

struct Step;

/// Steps that run one after the other on a scene.
using Steps = std::vector<Step>;

/// The common key `when`: a truth known at plan time, or predicates on the scene.
struct Condition {
    std::optional<bool> known;
    Assertions predicates;
    Mark where;
};

struct Arm {
    std::string name;                                     ///< of a branch; of a foreach: "lod=50%"
    std::vector<std::pair<std::string, Value>> variables; ///< of a foreach
    std::optional<std::size_t> part; ///< of a foreach over parts: which of the parts it was given
    std::shared_ptr<Steps> steps;
};

/// What a foreach over parts does for the parts with these names, once they are known.
using ArmsOfParts = std::function<std::vector<Arm>(const std::vector<std::string>& parts, Problems&)>;

/// A stage with its options, or a branch or foreach with its arms.
struct Step {
    enum class Kind { stage, branch, foreach };
    Kind kind = Kind::stage;
    const StageInfo* info = nullptr; ///< of the stage
    std::shared_ptr<Stage> stage;    ///< with its options
    Value given;                     ///< what was written, expressions resolved
    std::string name;                ///< unique in the plan
    std::string path;                ///< "stages[3]", "stages[5].branch.far[0]"
    std::optional<Condition> when;
    PartFilter only;
    std::optional<Contract> ensure;
    std::vector<Arm> arms; ///< of a branch, or of a foreach (over parts: as planned for a part yet unknown)
    ArmsOfParts arms_of_parts; ///< of a foreach over parts, else empty
    PartFilter parts;          ///< ... and the parts it runs over
    bool join = false;
    Mark where;
};

/// Calls visit for each step, and for those of its arms after it.
void for_each_step(const Steps& steps, const std::function<void(const Step&)>& visit);

/// A file that a plan reads or writes.
struct PlannedFile {
    std::filesystem::path path;
    Mark where;
    bool written = false;
    std::vector<std::pair<std::string, Value>>
        variables{};     ///< of each foreach that it stands in, the outer first
    bool shapes = false; ///< a file that the pipeline takes stages or params from: an include, a preset
    std::filesystem::path pattern{}; ///< an input that a pattern with wildcards names: that pattern
};

struct PlanSettings {
    std::string name;    ///< of the pipeline, for messages and the report
    std::string command; ///< that runs it again, for a shell; empty: unknown
    std::vector<std::pair<std::string, std::string>> defines; ///< -D
    /// Where values of defines stand that are not of -D: in a table, in a preset.
    std::map<std::string, Mark> defined_at;
    /// Values of defines that are lists of a preset or a table; in defines they are as -D would spell them.
    std::map<std::string, Value> defined_lists;
    /// The folders that their paths start from, where that is not the working directory.
    std::map<std::string, std::filesystem::path> defined_in;
    std::vector<std::pair<std::string, std::string>> sets; ///< --set stage.option=value
    bool update_baselines = false; ///< --update-baseline: stages with a baseline write it
    Folders places;
    std::filesystem::path working_directory; ///< what -D paths are relative to
    std::vector<std::string> extra_reports;  ///< --report
    std::vector<std::string> allowed;        ///< --allow: ids of warnings
    std::vector<PlannedFile> others; ///< what is read and written besides: the pipeline itself, --save ...
    /// Gets each file that is included before it is opened, whether it is there or not.
    std::function<void(const std::filesystem::path&)> on_include;
    bool parameters_needed = true; ///< false (check without -D): params without a value stand for any value
};

struct Plan {
    std::string name, about;
    std::string text;    ///< as it was written, for pages
    std::string command; ///< of PlanSettings
    Json params = Json::object();
    Steps steps;
    std::vector<std::string> reports;
    std::vector<PlannedFile> others; ///< what is read and written besides by steps: reports, the pipeline ...
    Folders places;
    bool files_collide = false; ///< a file would be read and written, or used twice (check_collisions)
    std::vector<Diagnostic> warnings;
    std::vector<std::string> allowed; ///< ids of warnings that are neither told nor made to fail
};

/// Adds the values of a preset, a YAML file with a map of params to values. What is defined already stays.
/// Throws missing.
void add_preset(const std::filesystem::path& file, PlanSettings& settings, Problems& problems);

/// Plans a parsed document. All problems (E-FORMAT-VERSION, E-REQUIRES, E-STAGE, E-KEY, E-PARAM, ...) are
/// added; the plan is to be run only when there are no errors among them.
Plan make_plan(const Value& document, const PlanSettings& settings, Problems& problems);
/// Parses and plans a pipeline; settings.name is what its text is called in messages.
Plan plan_text(std::string text, const PlanSettings& settings, Problems& problems);
/// A pipeline as text, to be planned once or for many assets.
struct PipelineSource {
    std::string text;
    std::filesystem::path file; ///< "-": standard input; empty: none
};
/// Reads a pipeline file ("-": standard input). An unreadable file throws missing.
PipelineSource read_pipeline(const std::filesystem::path& file);
/// Plans it: what the file reads is relative to it, and it is an input itself.
Plan plan_source(const PipelineSource& source, PlanSettings settings, Problems& problems);
/// Both.
Plan load_plan(const std::filesystem::path& file, PlanSettings settings, Problems& problems);

/// The files of these steps in their order, as far as they are known (globs expanded); without those of a
/// step that will be skipped.
std::vector<PlannedFile> planned_files(const Steps& steps, const Folders& places);
/// The folders below which what these steps load may name files, besides its own.
std::vector<std::filesystem::path> asset_roots_of(const Steps& steps, const Folders& places);
/// Adds E-DUPLICATE-OUTPUT and E-OVERWRITE: two writes to one path (also by case), an output
/// that is an input, and E-DUPLICATE-INPUT: two readings of standard input.
/// Whether there is none.
bool check_collisions(const std::vector<PlannedFile>& files, Problems& problems);
/// The same, with the files of a foreach over parts, now that the parts have names.
void check_new_files(const Plan& plan, const std::vector<Arm>& arms, Problems& problems);
/// An E-FILE for every input that does not exist, at its place; exit code 3. run_plan begins with it.
std::vector<Diagnostic> missing_inputs(const Plan& plan);

/// An input and what its header says.
struct InputHeader {
    std::filesystem::path path;
    io::FileHeader header;
};

struct Headers {
    std::vector<InputHeader> inputs; ///< in the order of the plan, each file once
    /// Files beside inputs that are read, too (.bin, .mtl, images), there or not; and files beside outputs
    /// that are written, too (images, a .mtl).
    std::vector<std::filesystem::path> more_inputs, more_outputs;
    /// A stage before a write that puts images into files changes them: more_outputs are those that there
    /// would be without it (see pipeline/rehearsal.hpp).
    bool images_change = false;
    std::vector<Error> errors; ///< in the order of the plan
    struct Lengths {
        Unit unit = Unit::unknown; ///< the scene's
        std::vector<report::ResolvedLength> all;
    };
    /// By the path of a step, its lengths with a physical unit where the scene's is known.
    std::map<std::string, Lengths> lengths;
};

/// Reads the headers of those inputs that exist: files that no stage could load (as their load would throw),
/// and units (E-UNIT, usage) of lengths and of a stage's option `unit` where what was loaded first has none.
/// Streams and compressed files wait for the run, since they would have to be read whole. Which images are
/// written where a stage changes them is not known (images_change).
Headers read_headers(const Plan& plan);
/// What is wrong with the inputs before anything runs: an E-FILE for every pattern that matches nothing,
/// since what it stands for is not known before it is there, and the errors of the headers.
std::vector<Error> input_errors(const Plan& plan, const Headers& headers);

/// Files that the plan reads and writes, as far as they are known before it runs (globs expanded, and what
/// the headers tell); includes and presets among the inputs, at their end, and reports among the outputs.
std::vector<std::filesystem::path> planned_inputs(const Plan& plan, const Headers& headers = {});
/// Those that stages name: no textures, includes and presets.
std::vector<std::filesystem::path> inputs_of_steps(const Plan& plan);
std::vector<std::filesystem::path> planned_outputs(const Plan& plan, const Headers& headers = {});
/// The patterns that name inputs.
std::vector<std::filesystem::path> planned_patterns(const Plan& plan);
/// W-NOTHING, at the last stage, when nothing would be left of a run: no file, no check that can fail, no
/// report.
std::optional<Diagnostic> without_effect(const Plan& plan);
/// The diagnostic with the first of a plan's inputs in its message ("scan.ply: ..."), unless it, or its
/// place, names one already: in a log of many runs it says which asset it is about.
Diagnostic about_input(const std::vector<std::filesystem::path>& inputs, Diagnostic diagnostic);
/// What would run, everything resolved, with what the headers of inputs say: for `facetmill plan`, as text
/// and as JSON.
std::string describe(const Plan& plan, const Headers& headers = {});
/// Of the options that a stage was not given, by name, the defaults as they would be written.
std::map<std::string, std::string> default_texts(const Step& step);
/// The options of a stage as they will be: given, else the default.
Json options_json(const Step& step);
Json describe_json(const Plan& plan, const Headers& headers = {});

} // namespace facetmill::pipeline
