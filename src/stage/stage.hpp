#pragma once
// The interface of a stage: a declaration and a function. A stage file is
//
//   struct RelaxOptions { ... };
//   void declare(Declare<RelaxOptions>& d) { ... }
//   Scene run(Scene scene, const RelaxOptions& o, Context& context) { ... }
//   const RegisterStage relax = make_stage<RelaxOptions>(
//       {.name = "relax", .about = "Smooths a surface ...", .examples = {"relax: 3"}}, declare, run);
//
// One that has something to report fills a struct of its own as well, whose fields are declared the same way:
//
//   struct RelaxReport { ... };
//   void declare_report(DeclareFields<RelaxReport>& d) { ... }
//   Scene run(Scene scene, const RelaxOptions& o, Context& context, RelaxReport& report) { ... }
//   const RegisterStage relax = make_stage<RelaxOptions>({...}, declare, declare_report, run);

#include "base/lazy.hpp"
#include "io/codec.hpp"
#include "options/declaration.hpp"
#include "options/fields.hpp"
#include "stage/cell_flow.hpp"
#include "stage/context.hpp"
#include "stage/crossing_faces.hpp"
#include "stage/surface_loss.hpp"

namespace facetmill {

/// What a stage reads and writes, as far as its options tell; for plan, depfiles and collisions.
struct StageFiles {
    std::vector<PathText> inputs, outputs;
    std::vector<PathText> asset_roots{}; ///< folders below which the inputs may name files
    std::optional<PathText> materials{}; ///< also written when the scene has materials
    std::optional<PathText> images{};    ///< the output that images of the scene are copied beside
    std::function<bool(const io::NamedImage&)> copies{}; ///< which of them; empty: all
    std::optional<PathText> evidence{}; ///< written at once where a check fails; no output of a plan
};

/// Options of a stage that the pipeline has to know of, by their names; empty: it has none such.
struct OptionRoles {
    std::string sets_unit = {};        ///< says what the numbers of the scene mean afterwards
    std::string writes_in_unit = {};   ///< the unit of the numbers in the file that it writes
    std::string baseline = {};         ///< the file of what is known and may go on
    std::string updates_baseline = {}; ///< writes that file anew: --update-baseline gives it
};

/// What a stage does with parts of lines.
enum class LinesPolicy {
    leave, ///< it works on faces and leaves them as they are, with a warning (W-LINES)
    pass,  ///< they have nothing that it works on: they are left without a warning
    work   ///< it works on them
};

struct StageInfo {
    std::string name; ///< the verb users write
    /// What other programs call it, separated by blanks. For hints only: a stage has one name.
    const char* also_called = "";
    /// An operation of other programs that this stage does together with other stages.
    struct Chain {
        const char *words = "", *stages = ""; ///< separated by blanks; a hint with the stages
    } chain = {};
    std::string about; ///< one line
    /// Paragraphs of short lines: what it guarantees, what it does to attributes, its source.
    const char* details = "";
    std::vector<std::string> examples; ///< as list items of a pipeline, without the dash: "relax: 3"
    bool checks = false; ///< it only judges: several in a row all run before a failure ends the branch
    bool tells = false;  ///< something is left of it beside the scene: a file, or lines on the terminal
    bool moves = false;  ///< it may move the scene as a whole: distances from before it tell nothing
    bool changes_images = false;     ///< it makes, drops or renames images that a write may put into files
    bool measures_deviation = false; ///< it tells how far it moved the surface
    LinesPolicy lines = LinesPolicy::leave;
    bool leaves_points = false;        ///< it works on faces and leaves clouds as they are; told (W-POINTS)
    bool loads = false;                ///< it adds to the scene rather than working on it (may come first)
    MayLose may_lose = MayLose::tenth; ///< of the surface, unless its options say otherwise
    /// What is done about faces that cross themselves before it runs, unless its options say otherwise: the
    /// most that any of them ask for.
    CrossingFacePolicy crossing_faces = CrossingFacePolicy::keep;
    OptionRoles roles = {};
    bool ends_cells = false; ///< what on_cells makes is a scene in memory; else cells go on

    // Filled by make_stage. Declarations are made when they are first asked for.
    Lazy<Declaration> options = {};
    Lazy<Fields> result = {};                            ///< of what the stage reports; empty: nothing
    Function<std::shared_ptr<void>()> make_options = {}; ///< a default options struct
    Function<Scene(Scene, const void* options, Context&)> run = {};
    Function<StageFiles(const void* options)> files = {}; ///< may be empty
    /// What the header of a file says that this stage would add to the scene; throws as its run. May be
    /// empty.
    Function<io::FileHeader(const void* options, const std::filesystem::path&, const Folders&)> header = {};
    /// Legality that a declaration cannot say; adds problems at the value's marks. May be empty.
    Function<void(const void* options, const Value& given, Problems&)> verify = {};
    /// What these options ask the stage to take of the surface. May be empty.
    Function<MayLose(const void* options)> may_lose_with = {};
    /// What these options need of faces that cross themselves. May be empty.
    Function<CrossingFacePolicy(const void* options)> crossing_faces_with = {};
    /// Whether these options compare with the scene as loaded (RunState::loaded). May be empty.
    Function<bool(const void* options)> compares_with_load = {};
    /// As run, of a mesh that is larger than memory. Empty: the stage cannot do that.
    Function<void(const void* options, CellFlow&, Context&)> on_cells = {};
    /// Why these options need the mesh in memory, in words. May be empty.
    Function<std::optional<std::string>(const void* options)> why_not_on_cells = {};
    /// How many triangles these options make of one, where they can work on cells. Empty: no more than one.
    Function<double(const void* options)> triangles_of_one = {};
};

struct RegisterStage {
    RegisterStage(StageInfo info);
};

/// All stages, sorted by name.
const std::vector<StageInfo>& stages();
const StageInfo* stage_named(std::string_view name);
std::vector<std::string> stage_names();

/// The stage that other programs call by this name, or null.
const StageInfo* stage_called(std::string_view other_name);
/// A hint for an operation of other programs that takes several stages (remesh); empty for other words.
std::string_view chain_called(std::string_view other_name);
/// A hint for a word that names no stage: the stage of this meaning, or the nearest of the names.
std::string hint_for_stage(std::string_view word, const std::vector<std::string>& names);

/// Runs the stage on faces as it needs them (crossing_faces), and warns of the surface that it loses.
Scene perform(const StageInfo& stage, Scene scene, const void* options, Context& context);

template <class Options>
struct StageHooks {
    StageFiles (*files)(const Options&) = nullptr;
    void (*verify)(const Options&, const Value&, Problems&) = nullptr;
    io::FileHeader (*header)(const Options&, const std::filesystem::path&, const Folders&) = nullptr;
    MayLose (*may_lose)(const Options&) = nullptr;
    CrossingFacePolicy (*crossing_faces)(const Options&) = nullptr;
    bool (*compares_with_load)(const Options&) = nullptr;
    void (*on_cells)(const Options&, CellFlow&, Context&) = nullptr;
    std::optional<std::string> (*why_not_on_cells)(const Options&) = nullptr;
    double (*triangles_of_one)(const Options&) = nullptr;
};

/// The hook, of any options; none where there is none.
template <class Options, class Result, class... Arguments>
Function<Result(const void*, Arguments...)> of_any_options(Result (*hook)(const Options&, Arguments...)) {
    if (!hook) return {};
    return [hook](const void* options, Arguments... arguments) -> Result {
        return hook(*static_cast<const Options*>(options), arguments...);
    };
}

/// Options that are owned by whoever has the pointer.
std::shared_ptr<void> owned_options(void* options, void (*drop)(void*));

template <class Options, class DeclareFunction>
void add_options(StageInfo& info, DeclareFunction declare, const StageHooks<Options>& hooks) {
    info.options = Lazy<Declaration>([declare] {
        Declare<Options> d;
        declare(d);
        return std::move(d.declaration);
    });
    info.make_options = [] {
        return owned_options(new Options, [](void* options) { delete static_cast<Options*>(options); });
    };
    info.files = of_any_options(hooks.files);
    info.header = of_any_options(hooks.header);
    info.may_lose_with = of_any_options(hooks.may_lose);
    info.crossing_faces_with = of_any_options(hooks.crossing_faces);
    info.verify = of_any_options(hooks.verify);
    info.compares_with_load = of_any_options(hooks.compares_with_load);
    info.on_cells = of_any_options(hooks.on_cells);
    info.why_not_on_cells = of_any_options(hooks.why_not_on_cells);
    info.triangles_of_one = of_any_options(hooks.triangles_of_one);
}

/// Of a stage that has nothing to report.
template <class Options, class DeclareFunction>
StageInfo make_stage(StageInfo info, DeclareFunction declare, Scene (*run)(Scene, const Options&, Context&),
                     const StageHooks<Options>& hooks = {}) {
    add_options(info, declare, hooks);
    info.run = [run](Scene scene, const void* options, Context& context) {
        return run(std::move(scene), *static_cast<const Options*>(options), context);
    };
    return info;
}

/// Of a stage that fills a report: it is recorded and said when the stage is done.
template <class Options, class Report, class DeclareFunction>
StageInfo make_stage(StageInfo info, DeclareFunction declare, void (*declare_report)(DeclareFields<Report>&),
                     Scene (*run)(Scene, const Options&, Context&, Report&),
                     const StageHooks<Options>& hooks = {}) {
    add_options(info, declare, hooks);
    info.result = Lazy<Fields>([declare_report] { return fields_of<Report>(declare_report); });
    info.run = [run, fields = info.result](Scene scene, const void* options, Context& context) {
        Report report;
        Scene out = run(std::move(scene), *static_cast<const Options*>(options), context, report);
        context.report(*fields, &report);
        return out;
    };
    return info;
}

} // namespace facetmill
