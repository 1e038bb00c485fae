// Stages that exist only in the tests, to try the language and the runner on.

#include "mesh/shapes.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>
#include <new>

namespace facetmill {

namespace {

enum class Sort { works, loads, checks };
StageInfo info(const char* name, const char* about, Sort sort = Sort::works, bool tells = false) {
    StageInfo out;
    out.name = name;
    out.about = about;
    out.loads = sort == Sort::loads;
    out.checks = sort == Sort::checks;
    out.tells = tells;
    return out;
}

// --- test-load: a cube named after the file

struct LoadOptions {
    PathText file;
    bool mm = false;
};
void declare_load(Declare<LoadOptions>& d) {
    d.option("file", &LoadOptions::file, "The file that the cube is named after").required().primary();
    d.option("mm", &LoadOptions::mm, "Whether the scene is in millimetres");
}
Scene run_load(Scene scene, const LoadOptions& o, Context& context) {
    Part part;
    part.name = std::filesystem::path(o.file.text).stem().string();
    part.mesh = shapes::cube();
    scene.parts.push_back(std::move(part));
    if (o.mm) scene.unit = Unit::mm;
    context.record_input({context.places().input(o.file.text).string(), 1, std::string(64, '0'), {}});
    return scene;
}
struct LoadStage : StageOf<run_load> {
    StageFiles files() const override { return {{o.file}, {}}; }
};
const RegisterStage load(make_stage<LoadStage>(info("test-load", "Loads a cube", Sort::loads), declare_load));

// --- test-cut: options of many types; drops faces

enum class Method { fast, exact };
struct Plane {
    Vec3 normal{0, 0, 1};
    Length offset = Length::scene(0);
};
struct CutOptions {
    std::int64_t faces = 6;
    std::optional<Plane> plane;
    std::optional<Ratio> ratio;
    Length depth = Length::percent(1);
    Method method = Method::fast;
    bool cap = false;
};
void declare_cut(Declare<CutOptions>& d) {
    d.option("faces", &CutOptions::faces, "How many faces to keep").between(1, 100).primary();
    d.option("ratio", &CutOptions::ratio, "Which part of the faces to keep").above(0).at_most(1);
    d.option("depth", &CutOptions::depth, "How deep");
    d.option("cap", &CutOptions::cap, "Whether to cap");
    d.choice("method", &CutOptions::method, {{"fast", Method::fast, ""}, {"exact", Method::exact, ""}},
             "How");
    d.group("plane", &CutOptions::plane, "Where", [](Declare<Plane>& p) {
        p.option("normal", &Plane::normal, "The normal");
        p.option("offset", &Plane::offset, "How far from the origin");
    });
    d.at_most_one({"faces", "ratio"});
}
struct CutReport {
    double depth = 0;
};
void declare_cut_report(DeclareFields<CutReport>& d) {
    d.field("depth", &CutReport::depth, "How deep").unit("scene units");
}
Scene run_cut(Scene scene, const CutOptions& o, Context& context, CutReport& report) {
    report.depth = context.resolve(o.depth, scene, "depth");
    context.for_each_part(scene, [&](Part& part) {
        auto keep = static_cast<std::size_t>(o.faces);
        if (o.ratio)
            keep = static_cast<std::size_t>(static_cast<double>(part.mesh.face_count()) * o.ratio->value);
        part.mesh.corners.resize(std::min(part.mesh.corners.size(), 3 * keep));
        context.attribute_changes(part, {{"NORMAL", Domain::wedge, AttributeChange::Kind::kept, ""}});
    });
    return scene;
}
const RegisterStage cut(make_stage<StageOf<run_cut>>(info("test-cut", "Drops faces"), declare_cut,
                                                     declare_cut_report));

// --- test-write: the names and faces of the parts, as text

struct WriteOptions {
    PathText path;
};
void declare_write(Declare<WriteOptions>& d) {
    d.option("path", &WriteOptions::path, "The file to write").required().primary();
}
Scene run_write(Scene scene, const WriteOptions& o, Context& context) {
    std::string text;
    for (const auto& part : scene.parts) text += fmt::format("{} {}\n", part.name, part.mesh.face_count());
    const auto& file =
        context.outputs().add(context.places().output(o.path.text), std::as_bytes(std::span(text)));
    context.output_records().push_back({o.path.text, file.bytes, file.sha256, {}});
    return scene;
}
struct WriteStage : StageOf<run_write> {
    StageFiles files() const override { return {{}, {o.path}}; }
};
const RegisterStage write(
    make_stage<WriteStage>(info("test-write", "Writes a list of parts", Sort::works, true), declare_write));

// --- test-judge, test-warn, test-fail

struct JudgeOptions {
    bool passes = true;
    std::string name = "sound";
};
void declare_judge(Declare<JudgeOptions>& d) {
    d.option("passes", &JudgeOptions::passes, "Whether the check holds").primary();
    d.option("called", &JudgeOptions::name, "The name of the check");
}
Scene run_judge(Scene scene, const JudgeOptions& o, Context& context) {
    report::Check check;
    check.name = o.name;
    check.passed = o.passes;
    check.expected = "true";
    check.found = o.passes;
    context.check(check);
    return scene;
}
const RegisterStage judge(make_stage<StageOf<run_judge>>(info("test-judge", "Passes or not", Sort::checks),
                                                         declare_judge));

struct WarnOptions {
    std::string id = "W-TEST";
};
void declare_warn(Declare<WarnOptions>& d) { d.option("id", &WarnOptions::id, "The warning's id").primary(); }
Scene run_warn(Scene scene, const WarnOptions& o, Context& context) {
    context.warn(o.id, "this is only a test", "carry on");
    return scene;
}
const RegisterStage warn(make_stage<StageOf<run_warn>>(info("test-warn", "Warns"), declare_warn));

// --- test-unrepeatable: its result may differ in each run

struct UnrepeatableOptions {};
void declare_unrepeatable(Declare<UnrepeatableOptions>&) {}
Scene run_unrepeatable(Scene scene, const UnrepeatableOptions&, Context& context) {
    context.mark_uncacheable();
    return scene;
}
const RegisterStage unrepeatable(make_stage<StageOf<run_unrepeatable>>(
    info("test-unrepeatable", "Tells that it may do something else the next time"), declare_unrepeatable));

enum class How { error, memory, bug };
struct FailOptions {
    How how = How::error;
};
void declare_fail(Declare<FailOptions>& d) {
    d.choice("how", &FailOptions::how,
             {{"error", How::error, ""}, {"memory", How::memory, ""}, {"bug", How::bug, ""}}, "How it fails")
        .primary();
}
Scene run_fail(Scene, const FailOptions& o, Context&) {
    if (o.how == How::memory) throw std::bad_alloc();
    if (o.how == How::bug) throw std::runtime_error("index out of range");
    throw Error(ErrorKind::stage, "E-TEST", "this stage never works", "use another");
}
const RegisterStage fail(make_stage<StageOf<run_fail>>(info("test-fail", "Fails"), declare_fail));

} // namespace

} // namespace facetmill
