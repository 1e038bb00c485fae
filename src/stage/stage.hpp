#pragma once
// The interface of a stage: a declaration and a function. A stage file is
//
//   struct RelaxOptions { ... }; void declare(Declare<RelaxOptions>& d) { ... } Scene run(Scene scene, const
//   RelaxOptions& o, Context& context) { ... } const RegisterStage registered = make_stage<StageOf<run>>(
//   {.name = "relax", .about = "Smooths a surface ...", .examples = {"relax: 3"}}, declare);
//
// A stage with a report also fills a struct, whose fields are declared in the same way:
//
//   struct RelaxReport { ... }; void declare_report(DeclareFields<RelaxReport>& d) { ... } Scene run(Scene
//   scene, const RelaxOptions& o, Context& context, RelaxReport& report) { ... } const RegisterStage
//   registered = make_stage<StageOf<run>>({...}, declare, declare_report);
//
// A stage that reads files, works on cells or has more checks of its options derives from StageOf<run> and
// overrides functions of Stage. `o` contains its options.

#include "base/lazy.hpp"
#include "io/codec.hpp"
#include "options/declaration.hpp"
#include "options/fields.hpp"
#include "stage/cell_flow.hpp"
#include "stage/context.hpp"
#include "stage/crossing_faces.hpp"
#include "stage/surface_loss.hpp"

namespace facetmill {

/// The files that a stage reads and writes, as far as its options determine them; for plan, depfiles and
/// collisions.
struct StageFiles {
    std::vector<PathText> inputs, outputs;
    std::vector<PathText> asset_roots{}; ///< folders in which the inputs may refer to files
    std::optional<PathText> materials{}; ///< also written when the scene has materials
    std::optional<PathText> images{};    ///< the scene's images are copied next to this output
    std::function<bool(const io::NamedImage&)> copies{}; ///< selects these images; empty: all
    std::optional<PathText> evidence{}; ///< written immediately when a check fails; not an output of a plan
};

/// Names of options with a meaning for the pipeline; empty: no such option.
struct OptionRoles {
    std::string sets_unit = {};        ///< the unit of the scene's numbers after the stage
    std::string writes_in_unit = {};   ///< the unit of the numbers in the file that it writes
    std::string baseline = {};         ///< the file of known, accepted failures
    std::string updates_baseline = {}; ///< rewrites the baseline file: --update-baseline sets it
};

/// How a stage handles parts of lines.
enum class LinesPolicy {
    leave, ///< works on faces and skips them with a warning (W-LINES)
    pass,  ///< skips them without a warning, because they have no data for it
    work   ///< processes them
};

class Stage;

/// The properties of a stage, independent of its options.
struct StageInfo {
    std::string name; ///< the verb users write
    /// Names in other programs, separated by blanks. Only for hints, because a stage has a single name.
    const char* also_called = "";
    std::string about; ///< a single line
    /// Paragraphs of short lines: its guarantees, its effect on attributes, its source.
    const char* details = "";
    std::vector<std::string> examples; ///< as list items of a pipeline, without the dash: "relax: 3"
    bool checks = false;      ///< it only checks: consecutive checks all run before a failure ends the branch
    bool tells = false;       ///< it has an effect besides the scene: a file, or lines on the terminal
    bool keeps_scene = false; ///< the scene leaves it as it entered
    bool writes_scene = false;       ///< it writes the scene to a file, which later checks judge
    bool moves = false;              ///< it may move the whole scene: distances from before are meaningless
    bool changes_images = false;     ///< it creates, drops or renames images that a write may export
    bool measures_deviation = false; ///< it reports how far it moved the surface
    LinesPolicy lines = LinesPolicy::leave;
    bool leaves_points = false;        ///< it skips point clouds, with a warning (W-POINTS)
    bool loads = false;                ///< it adds to the scene instead of changing it (may come first)
    MayLose may_lose = MayLose::tenth; ///< the intended loss of surface, unless its options change that
    /// The handling of self-intersecting faces before it runs, unless its options change that: the strictest
    /// policy of any option.
    CrossingFacePolicy crossing_faces = CrossingFacePolicy::keep;
    OptionRoles roles = {};
    bool ends_cells = false; ///< on_cells produces a scene in memory, otherwise cells

    // Filled by make_stage. Declarations are created on first use.
    Lazy<Declaration> options = {};
    Lazy<Fields> result = {};            ///< fields of the report; empty: no report
    bool names_files = false;            ///< it overrides files()
    bool reads_headers = false;          ///< it overrides header()
    bool chooses_crossing_faces = false; ///< it overrides crossing_faces()
    bool works_on_cells = false;         ///< it overrides on_cells()
    std::shared_ptr<Stage> (*make)() = nullptr;

    /// Makes a use of this stage with default options. It must not outlive this object.
    std::shared_ptr<Stage> made() const;
};

/// A use of a stage: its options and its functions.
class Stage {
  public:
    Stage() = default;
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    virtual ~Stage() = default;

    /// The address where its declaration (info->options) stores the parsed options.
    virtual void* target() = 0;
    virtual Scene run(Scene scene, Context& context) const = 0;
    virtual StageFiles files() const { return {}; }
    /// The header data of a file that this stage would add to the scene. Throws the errors of run.
    virtual io::FileHeader header(const std::filesystem::path&, const Folders&) const { return {}; }
    /// Adds problems that the declaration cannot detect, at the marks of the values.
    virtual void verify(const Value& /*given*/, Problems&) const {}
    /// The loss of surface that these options intend.
    virtual MayLose may_lose() const { return info->may_lose; }
    /// How self-intersecting faces must be handled with these options.
    virtual CrossingFacePolicy crossing_faces() const { return info->crossing_faces; }
    /// The given option that judges written files, so that a `write` must come before; empty: none.
    virtual std::string judges_written() const { return {}; }
    /// True if these options compare with the scene as loaded.
    virtual bool compares_with_load() const { return false; }
    /// True if these options take materials and attributes from the scene as loaded.
    virtual bool takes_from_load() const { return false; }
    /// Like run, for a mesh larger than memory; only if info->works_on_cells.
    virtual void on_cells(CellFlow&, Context&) const {}
    /// The reason, in words, why these options need the mesh in memory.
    virtual std::optional<std::string> why_not_on_cells() const { return {}; }
    /// The number of triangles that these options make from a triangle, if they work on cells.
    virtual double triangles_of_one() const { return 1; }

    const StageInfo* info = nullptr; ///< the stage
};

struct RegisterStage {
    RegisterStage(StageInfo info);
};

/// All stages, sorted by name.
const std::vector<StageInfo>& stages();
[[nodiscard]] const StageInfo* stage_named(std::string_view name);
[[nodiscard]] std::vector<std::string> stage_names();

/// The stage with this name in other programs, or null.
[[nodiscard]] const StageInfo* stage_called(std::string_view other_name);
/// A hint for an unknown stage name: the stage with this meaning, or the most similar name.
[[nodiscard]] std::string hint_for_stage(std::string_view word, const std::vector<std::string>& names);

/// Prepares faces for the stage (crossing_faces), runs it, and warns about lost surface.
[[nodiscard]] Scene perform(const Stage& stage, Scene scene, Context& context);

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
    /// Records and prints the report when the stage is done.
    Scene run(Scene scene, Context& context) const override {
        Report report;
        Scene out = function(std::move(scene), this->o, context, report);
        context.report(*this->info->result, &report);
        return out;
    }
};

/// True if a stage overrides a function of Stage. Otherwise both pointers refer to the same member.
template <class Own, class Default>
constexpr bool is_own(Own, Default) {
    return !std::is_same_v<Own, Default>;
}

template <class S>
[[nodiscard]] StageInfo make_stage(StageInfo info, void (*declare)(Declare<typename S::Options>&)) {
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
[[nodiscard]] StageInfo make_stage(StageInfo info, void (*declare)(Declare<typename S::Options>&),
                                   void (*declare_report)(DeclareFields<typename S::Report>&)) {
    info.result = Lazy<Fields>([declare_report] { return fields_of<typename S::Report>(declare_report); });
    return make_stage<S>(std::move(info), declare);
}

} // namespace facetmill
