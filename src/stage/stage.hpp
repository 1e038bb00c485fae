#pragma once
// The interface of a stage: a declaration and a function. A stage file is
//
//   struct RelaxOptions { ... };
//   void declare(Declare<RelaxOptions>& d) { ... }
//   Scene run(Scene scene, const RelaxOptions& o, Context& context) { ... }
//   const RegisterStage registered = make_stage<StageOf<run>>(
//       {.name = "relax", .about = "Smooths a surface ...", .examples = {"relax: 3"}}, declare);
//
// A stage that reports something also fills a struct of its own, whose fields are declared the same way:
//
//   struct RelaxReport { ... };
//   void declare_report(DeclareFields<RelaxReport>& d) { ... }
//   Scene run(Scene scene, const RelaxOptions& o, Context& context, RelaxReport& report) { ... }
//   const RegisterStage registered = make_stage<StageOf<run>>({...}, declare, declare_report);
//
// A stage that reads files, works on cells or checks its options further derives from StageOf<run> and
// overrides what Stage says by default; `o` are its options.

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

class Stage;

/// What is true of a stage, whatever its options.
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
    Lazy<Fields> result = {};            ///< of the report; empty: the stage has none
    bool names_files = false;            ///< it has files() of its own
    bool reads_headers = false;          ///< ... header()
    bool chooses_crossing_faces = false; ///< ... crossing_faces()
    bool works_on_cells = false;         ///< ... on_cells()
    std::shared_ptr<Stage> (*make)() = nullptr;

    /// A use of this stage, with default options; it must not outlive this.
    std::shared_ptr<Stage> made() const;
};

/// One use of a stage: its options, and what it does with them.
class Stage {
  public:
    Stage() = default;
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    virtual ~Stage() = default;

    /// Where its declaration (info->options) puts the options that it parses.
    virtual void* target() = 0;
    virtual Scene run(Scene scene, Context& context) const = 0;
    virtual StageFiles files() const { return {}; }
    /// What the header of a file says that this stage would add to the scene. Throws as run.
    virtual io::FileHeader header(const std::filesystem::path&, const Folders&) const { return {}; }
    /// Adds problems that a declaration cannot find, at the marks of the values.
    virtual void verify(const Value& /*given*/, Problems&) const {}
    /// What these options ask the stage to take of the surface.
    virtual MayLose may_lose() const { return info->may_lose; }
    /// What these options need of faces that cross themselves.
    virtual CrossingFacePolicy crossing_faces() const { return info->crossing_faces; }
    /// Whether these options compare with the scene as loaded.
    virtual bool compares_with_load() const { return false; }
    /// As run, of a mesh that is larger than memory; only where info->works_on_cells.
    virtual void on_cells(CellFlow&, Context&) const {}
    /// Why these options need the mesh in memory, in words.
    virtual std::optional<std::string> why_not_on_cells() const { return {}; }
    /// How many triangles these options make of one, where they can work on cells.
    virtual double triangles_of_one() const { return 1; }

    const StageInfo* info = nullptr; ///< which stage it is
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
Scene perform(const Stage& stage, Scene scene, Context& context);

template <class OptionsOfStage>
class StageWith : public Stage {
  public:
    using Options = OptionsOfStage;
    void* target() override { return &o; }

  protected:
    Options o;
};

/// A stage that runs this function, with or without a report.
template <auto function>
class StageOf;

template <class Options, Scene (*function)(Scene, const Options&, Context&)>
class StageOf<function> : public StageWith<Options> {
  public:
    Scene run(Scene scene, Context& context) const override {
        return function(std::move(scene), this->o, context);
    }
};

template <class Options, class ReportOfStage,
          Scene (*function)(Scene, const Options&, Context&, ReportOfStage&)>
class StageOf<function> : public StageWith<Options> {
  public:
    using Report = ReportOfStage;
    /// The report is recorded and said when the stage is done.
    Scene run(Scene scene, Context& context) const override {
        Report report;
        Scene out = function(std::move(scene), this->o, context, report);
        context.report(*this->info->result, &report);
        return out;
    }
};

/// Whether a stage overrides what Stage does: else both pointers are to the same member.
template <class Own, class Default>
constexpr bool is_own(Own, Default) {
    return !std::is_same_v<Own, Default>;
}

template <class S>
StageInfo make_stage(StageInfo info, void (*declare)(Declare<typename S::Options>&)) {
    info.options = Lazy<Declaration>([declare] {
        Declare<typename S::Options> d;
        declare(d);
        return std::move(d.declaration);
    });
    info.names_files = is_own(&S::files, &Stage::files);
    info.reads_headers = is_own(&S::header, &Stage::header);
    info.chooses_crossing_faces = is_own(&S::crossing_faces, &Stage::crossing_faces);
    info.works_on_cells = is_own(&S::on_cells, &Stage::on_cells);
    info.make = []() -> std::shared_ptr<Stage> { return std::make_shared<S>(); };
    return info;
}

template <class S>
StageInfo make_stage(StageInfo info, void (*declare)(Declare<typename S::Options>&),
                     void (*declare_report)(DeclareFields<typename S::Report>&)) {
    info.result = Lazy<Fields>([declare_report] { return fields_of<typename S::Report>(declare_report); });
    return make_stage<S>(std::move(info), declare);
}

} // namespace facetmill
