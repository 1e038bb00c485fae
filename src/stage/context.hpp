#pragma once
// What a stage gets besides its options and the scene: lengths resolved, warnings, attribute changes, files.

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

/// The parts a stage works on (the common key `only`): names or globs of parts or materials, "!glob"
/// excludes.
struct PartFilter {
    std::vector<std::string> patterns; ///< empty: all parts
    bool selects(const Part& part, const Scene& scene) const;
};

/// Where files are looked for and put.
struct Folders {
    std::filesystem::path input_base;  ///< what a pipeline file reads is relative to it
    std::filesystem::path output_base; ///< --output-dir
    /// --asset-root: folders below which what is loaded may name files, besides its own.
    std::vector<std::filesystem::path> asset_roots = {};
    /// The file a stage reads: absolute, or relative to input_base; "-" stays.
    std::filesystem::path input(const std::string& text) const;
    std::filesystem::path output(const std::string& text) const;
};

/// State of a run that outlives its stages.
struct RunState {
    Folders places;
    io::Outputs outputs;
    report::RunRecord record;
    double load_diagonal = 0; ///< world diagonal of the scene after the last load, for "% of load"
    std::shared_ptr<const Surface>
        loaded;            ///< the scene after the last load, when a contract compares with it
    bool read_back = true; ///< decode written files again and compare
    /// How many results depended on more than scene, options and recorded inputs: on the memory that was
    /// free, on a file that was refused.
    std::size_t unrepeatable = 0;
};

/// One stage's view of the run. All the stage says goes into its StageRecord.
class Context {
  public:
    Context(RunState& run, report::StageRecord& record, const PartFilter& only, Box entering,
            const Mark& where);

    /// The parts to work on, selected by `only`, in order. Marks them changed, unless reading.
    void for_each_part(Scene& scene, const std::function<void(Part&)>& body);
    bool selects(const Part& part, const Scene& scene) const {
        return !(leaves_lines_ && part.mesh.line_count() > 0) && only_.selects(part, scene);
    }
    /// Parts of lines are selected no longer. Returns how many would have been.
    std::size_t leave_lines(const Scene& scene);

    /// The length in world scene units. Records what it was resolved to under the option's name. Throws usage
    /// (E-UNIT) for a physical unit when the scene has none.
    double resolve(const Length& length, const Scene& scene, std::string_view option,
                   const Part* part = nullptr);

    /// Of a part as the stage found it, in world space: as the stage before measured it, or anew.
    SurfaceSize size_before(const Scene& scene, std::size_t part) const;
    /// Of a part as the stage leaves it, so that it need not be measured again.
    void keep_size(std::size_t part, const SurfaceSize& size);
    /// Those that were kept, [parts]; empty when there are none or the scene has other parts.
    std::vector<std::optional<SurfaceSize>> kept_sizes(const Scene& scene) const;
    /// [parts] of the scene that the stage is to find.
    void know_surfaces(const std::vector<PartSurface>& surfaces);

    void warn(std::string id, std::string message, std::string hint = {});
    void attribute_changes(const Part& part, const AttributeChanges& changes);
    /// What the stage wants in the report under "result".
    Json& result() { return record_.result; }
    /// Records the result that a stage has filled, and says its lines on the terminal.
    void report(const Fields& fields, const void* result);
    void check(report::Check check);
    /// A line for people on the terminal: the main numbers of the result.
    void say(std::string line) { record_.said.push_back(std::move(line)); }
    void say(const std::vector<std::string>& lines) {
        for (const auto& line : lines) say(line);
    }

    /// Stages a file that the stage writes, its path as in the options, and records it among the outputs.
    /// Throws as io::Outputs::add.
    void output(const std::string& path, io::Span bytes);

    /// The result may be another the next time, from the same scene, options and inputs: it is not stored.
    void mark_uncacheable() { ++run_.unrepeatable; }

    const Folders& places() const { return run_.places; }
    /// The files of the run, and what is recorded of them.
    io::Outputs& outputs() { return run_.outputs; }
    std::vector<report::FileRecord>& output_records() { return run_.record.outputs; }
    /// Written files are decoded again and compared.
    bool reads_back() const { return run_.read_back; }
    /// An input with its SHA-256: only the same bytes may be written there.
    void record_input(report::FileRecord file);
    /// A file that an input names and that is missing.
    void record_absent(std::string path) { run_.record.absent.push_back(std::move(path)); }
    /// The surface of the scene after the last load, when a contract compares with it; or null.
    const Surface* loaded() const { return run_.loaded.get(); }
    const Mark& where() const { return where_; }
    const std::string& name() const { return record_.name; }

  private:
    RunState& run_;
    report::StageRecord& record_;
    const PartFilter& only_;
    Box entering_;
    Mark where_;
    bool leaves_lines_ = false;
    std::vector<std::optional<SurfaceSize>> sizes_before_, sizes_after_; ///< [parts]
};

} // namespace facetmill
