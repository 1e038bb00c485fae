#pragma once
// The environment of a stage besides its options and the scene: lengths, warnings, attribute changes, files.

#include "io/outputs/outputs.hpp"
#include "mesh/scene.hpp"
#include "mesh/surface.hpp"
#include "options/fields.hpp"
#include "options/quantities.hpp"
#include "report/record.hpp"
#include "stage/surface_loss.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace facetmill {

/// The parts that a stage works on (the common key `only`): names or globs of parts or materials; "!glob"
/// excludes.
struct PartFilter {
    std::vector<std::string> patterns; ///< empty: all parts
    bool selects(const Part& part, const Scene& scene) const;
};

/// Folders for reading and writing files.
struct Folders {
    std::filesystem::path input_base;  ///< base of relative paths that a pipeline file reads
    std::filesystem::path output_base; ///< see --output-dir
    /// --asset-root: folders, besides its own, in which a loaded file may refer to files.
    std::vector<std::filesystem::path> asset_roots = {};
    /// The path of an input file: absolute, or relative to input_base; "-" stays.
    std::filesystem::path input(const std::string& text) const;
    std::filesystem::path output(const std::string& text) const;
};

/// A scene as `write` staged it, for later checks.
struct WrittenScene {
    std::string path;                          ///< as the report names it
    const io::Outputs::File* file = nullptr;   ///< the main file
    std::string format;                        ///< of the codec
    Unit unit = Unit::unknown;                 ///< of the numbers in the file
    UpAxis up = UpAxis::unknown;               ///< the same
    std::size_t first_record = 0, records = 0; ///< its files among the outputs of the run
    bool is_whole = true;                      ///< it has all parts of the scene
    std::size_t scene = 0;                     ///< the number of the scene
};

struct Purpose; // stage/purpose.hpp

/// The files and checks of the steps before the current one, along its branch.
struct SceneTrail {
    std::size_t scene = 0; ///< the number of the current scene
    std::vector<WrittenScene> written;
    std::shared_ptr<const Purpose> purpose; ///< that the current scene was found fit for, or null
};

/// State of a run that outlives its stages.
struct RunState {
    Folders places;
    io::Outputs outputs;
    report::RunRecord record;
    double load_diagonal = 0; ///< world diagonal of the scene after the last load, for "% of load"
    std::shared_ptr<const Surface>
        loaded; ///< the surface of the scene after the last load, when a contract compares with it
    std::shared_ptr<const Scene> loaded_scene; ///< that scene, when a stage takes its materials
    bool read_back = true;                     ///< decodes written files again and compares them
    SceneTrail trail;
    std::size_t scenes = 0; ///< numbers given to scenes
    /// Gives the scene another number. moved: the surface only moved, so it still fits its purpose.
    void number_scene(bool moved) {
        trail.scene = ++scenes;
        if (!moved) trail.purpose.reset();
    }
    /// The number of results that depended on more than scene, options and recorded inputs, such as free
    /// memory or a refused file.
    std::size_t unrepeatable = 0;
};

/// A stage's view of the run. All its output goes into its StageRecord.
class Context {
  public:
    Context(RunState& run, report::StageRecord& record, const PartFilter& only, Box entering,
            const Mark& where);

    /// Calls body for the parts that `only` selects, in order. Marks them changed, unless reading.
    void for_each_part(Scene& scene, const std::function<void(Part&)>& body);
    bool selects(const Part& part, const Scene& scene) const {
        return !(leaves_lines_ && part.mesh.line_count() > 0) && only_.selects(part, scene);
    }
    /// Deselects parts of lines. Returns the number of deselected parts.
    std::size_t leave_lines(const Scene& scene);

    /// The length in world scene units. Records the result under the option's name. Throws a usage error
    /// (E-UNIT) for a physical unit if the scene has no unit.
    double resolve(const Length& length, const Scene& scene, std::string_view option,
                   const Part* part = nullptr);

    /// The size of a part before the stage, in world space; reuses the last stage's measurement if available.
    SurfaceSize size_before(const Scene& scene, std::size_t part) const;
    /// Stores the size of a part after the stage, so that it need not be measured again.
    void keep_size(std::size_t part, const SurfaceSize& size);
    /// [parts] The stored sizes; empty without sizes, or if the scene has other parts.
    std::vector<std::optional<SurfaceSize>> kept_sizes(const Scene& scene) const;
    /// Sets the surfaces of the scene's parts before the stage.
    void know_surfaces(const std::vector<PartSurface>& surfaces);

    void warn(std::string id, std::string message, std::string hint = {});
    void attribute_changes(const Part& part, const AttributeChanges& changes);
    /// The stage's data for the report under "result".
    Json& result() { return record_.result; }
    /// Records a result that a stage has filled, and prints its lines on the terminal.
    void report(const Fields& fields, const void* result);
    void check(report::Check check);
    /// Adds a line for the terminal: the main numbers of the result.
    void say(std::string line) { record_.said.push_back(std::move(line)); }
    void say(const std::vector<std::string>& lines) {
        for (const auto& line : lines) say(line);
    }

    /// Stages a file for writing, with its path as in the options, and records it among the outputs. Throws
    /// the errors of io::Outputs::add.
    void output(const std::string& path, io::Span bytes);

    /// Prevents caching, because the result may differ next time for the same scene, options and inputs.
    void mark_uncacheable() { ++run_.unrepeatable; }

    const Folders& places() const { return run_.places; }
    /// The files of the run, and their records.
    io::Outputs& outputs() { return run_.outputs; }
    std::vector<report::FileRecord>& output_records() { return run_.record.outputs; }
    /// The written scenes and the checked purpose on the way to this stage.
    const SceneTrail& trail() const { return run_.trail; }
    /// Records a written scene; its number is set here.
    void wrote(WrittenScene written);
    void found_fit(std::shared_ptr<const Purpose> purpose) { run_.trail.purpose = std::move(purpose); }
    /// True if written files are decoded again and compared.
    bool reads_back() const { return run_.read_back; }
    /// Records an input with its SHA-256: outputs may replace it only with the same bytes.
    void record_input(report::FileRecord file);
    /// Records a missing file that an input refers to.
    void record_absent(std::string path) { run_.record.absent.push_back(std::move(path)); }
    /// The surface of the scene after the last load if a contract compares with it, otherwise null.
    const Surface* loaded() const { return run_.loaded.get(); }
    /// The scene after the last load if a stage takes its materials, otherwise null.
    const Scene* loaded_scene() const { return run_.loaded_scene.get(); }
    const Mark& where() const { return where_; }
    const std::string& name() const { return record_.name; }

  private:
    RunState& run_;
    report::StageRecord& record_;
    const PartFilter& only_;
    Box entering_;
    Mark where_;
    bool leaves_lines_ = false;
    std::vector<std::optional<SurfaceSize>> sizes_before_, sizes_after_; ///< [parts] sizes
};

} // namespace facetmill
