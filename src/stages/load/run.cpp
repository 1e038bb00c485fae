#include "base/hash.hpp"
#include "base/math/portable_math.hpp"
#include "base/progress.hpp"
#include "base/text/glob.hpp"
#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "cells/partition/kept_partition.hpp"
#include "geometry/inspect/inspect.hpp"
#include "io/convert.hpp"
#include "io/stated.hpp"
#include "mesh/power_scale.hpp"
#include "stage/options/convention.hpp"
#include "stage/options/synonyms.hpp"
#include "stage/read_recorded.hpp"
#include "stage/stage.hpp"
#include "stages/load/help.hpp"
#include "stages/load/lines.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::load_stage {

namespace {

struct LoadOptions {
    std::vector<PathText> path;
    Unit unit = Unit::unknown;
    UpAxis up = UpAxis::unknown;
    std::string format;
    io::Weld weld = io::Weld::automatic;
    std::optional<Length> lines;
    std::int64_t line_sides = 8;
    std::optional<Length> max_deviation;
    std::optional<Angle> max_angle;
    bool expand_instances = false, drop_not_finite = false;
    std::vector<PathText> asset_root;
};

void declare(Declare<LoadOptions>& d) {
    d.option("path", &LoadOptions::path,
             "The mesh file, a glob (scan_*.ply), or a list of these. - reads standard input.")
        .also_called(path_synonyms)
        .primary()
        .required();
    d.choice<Unit>("unit", &LoadOptions::unit,
                   unit_choices("auto", "the unit that the file or its format states, otherwise unknown"),
                   "The unit of the numbers in the file.")
        .also_called(property_named("unit")->also_called);
    d.choice<UpAxis>("up", &LoadOptions::up,
                     up_choices("auto", "the axis that the file or its format states, otherwise unknown"),
                     "The up axis of the file.")
        .also_called(property_named("up")->also_called);
    d.option("format", &LoadOptions::format,
             "The name of the format, if neither content nor suffix shows it.")
        .also_called(format_synonyms);
    d.choice<io::Weld>("weld", &LoadOptions::weld,
                       {{"auto", io::Weld::automatic,
                         "only for formats without indices (STL) or with split vertices (glTF)"},
                        {"none", io::Weld::off, "never"},
                        {"exact", io::Weld::exact, "always"}},
                       "Merges vertices at exactly the same position.")
        .also_called(weld_synonyms);
    d.choice<bool>("instances", &LoadOptions::expand_instances,
                   {{"keep", false,
                     "one part, so stages see the mesh once (W-INSTANCING); glTF output keeps all instances"},
                    {"expand", true, "each instance becomes a part"}},
                   "How to handle instances of a glTF node (EXT_mesh_gpu_instancing).");
    d.choice<bool>("not_finite", &LoadOptions::drop_not_finite,
                   {{"refuse", false, "refuse the file (E-NAN)"},
                    {"drop", true, "remove these vertices, with their faces and lines (W-NOT-FINITE)"}},
                   "How to handle vertices whose coordinates are not finite numbers (nan, inf).");
    d.option("asset_root", &LoadOptions::asset_root,
             "A folder or a list of folders. By default, a file may only use images, buffers and materials "
             "in its own folder and below. With asset_root, it may use files anywhere below these folders "
             "(../textures/wood.png).");
    d.option("lines", &LoadOptions::lines,
             "Turns the lines of a PLY, OBJ or glTF file into tubes with this diameter, as separate parts. A "
             "percentage refers to the diagonal of the file. By default, lines stay lines.")
        .above(0);
    d.option("max_deviation", &LoadOptions::max_deviation,
             "The greatest distance of triangles from the faces of a solid (STEP, IGES, BREP). A number "
             "without a unit is in millimetres. A percentage refers to the diagonal of the file. By default "
             "0.1 %.")
        .above(0);
    d.option("max_angle", &LoadOptions::max_angle,
             "The greatest angle between neighbouring triangles of a face of a solid. By default 15deg.")
        .above(0);
    d.option("line_sides", &LoadOptions::line_sides, "The number of sides of the tubes.").between(3, 360);
}

io::CurveSettings curve_settings(const LoadOptions& o) {
    constexpr double percent = 100, degrees = 180, per_mm = 0.001, most_degrees = 90, least_degrees = 0.5;
    io::CurveSettings curves;
    if (o.max_angle)
        curves.degrees = std::clamp(o.max_angle->radians / pi * degrees, least_degrees, most_degrees);
    if (!o.max_deviation) return curves;
    const double amount = o.max_deviation->amount;
    if (o.max_deviation->kind == Length::Kind::percent)
        curves.ratio = amount / percent;
    else
        curves.deviation = o.max_deviation->kind == Length::Kind::physical ? amount : amount * per_mm;
    return curves;
}

io::ReadSettings read_settings(const LoadOptions& o, const Folders& places) {
    io::ReadSettings settings;
    settings.weld = o.weld;
    if (o.unit != Unit::unknown) settings.unit = o.unit;
    if (o.up != UpAxis::unknown) settings.up = o.up;
    settings.lines = o.lines.has_value();
    settings.expand_instances = o.expand_instances;
    settings.drop_not_finite = o.drop_not_finite;
    settings.curves = curve_settings(o);
    settings.asset_roots = places.asset_roots;
    for (const PathText& folder : o.asset_root) settings.asset_roots.push_back(places.input(folder.text));
    return settings;
}

void warn_of_guess(const std::string& what_has, Unit unit, Context& context) {
    context.warn("W-UNITS",
                 fmt::format("{} no unit, so the numbers are read as {}", what_has, to_string(unit)),
                 "give the unit: load: {path: ..., unit: mm}");
}

void load_file(Scene& scene, const std::filesystem::path& path, const LoadOptions& o, Context& context) {
    ProgressSteps steps({11, 1});
    auto [more, log] =
        read_recorded(path, read_settings(o, context.places()), io::codec_named(o.format), context);
    steps.next();
    for (const char* option : {o.max_deviation ? "max_deviation" : "", o.max_angle ? "max_angle" : ""})
        if (*option && !log.has_solids)
            context.warn(
                "W-IMPORT",
                fmt::format("'{}' has no effect, because '{}' has no solids", option, path.generic_string()),
                "remove it; simplify: {deviation: ...} reduces meshes");
    if (o.lines) add_tubes(more, log.lines, *o.lines, static_cast<int>(o.line_sides), context);
    const bool first = scene.parts.empty(), had_unit = scene.unit != Unit::unknown;
    const io::Conversion done = io::add_scene(scene, std::move(more));
    if (!first && done.unit_guessed)
        warn_of_guess(fmt::format("'{}' has", path.generic_string()), scene.unit, context);
    if (!first && !had_unit && scene.unit != Unit::unknown)
        warn_of_guess("the unit of the scene", scene.unit, context);
}

Scene run(Scene scene, const LoadOptions& o, Context& context) {
    for (std::size_t at = 0; at < o.path.size(); ++at) {
        const PathText& text = o.path[at];
        const std::filesystem::path path = context.places().input(text.text);
        const auto files = text.text == "-" ? std::vector{path} : expand_glob(path);
        if (files.empty())
            throw Error(ErrorKind::missing, "E-FILE", fmt::format("no file matches '{}'", text.text));
        for (std::size_t i = 0; i < files.size(); ++i) {
            const double all = static_cast<double>(files.size() * o.path.size()),
                         before = static_cast<double>(files.size() * at + i);
            const ProgressScope share(before / all, (before + 1) / all);
            load_file(scene, files[i], o, context);
        }
    }
    return scene;
}

/// Warns of files whose own unit or up axis differs from the given value. Also warns if some files state a
/// unit and others do not.
void warn_of_conventions(const std::vector<std::filesystem::path>& paths, const io::ReadSettings& settings,
                         Unit unit, Context& context) {
    if (paths.size() < 2 && !settings.unit && !settings.up) return; // a single file defines the convention
    for (const auto& path : paths) {
        const io::Input input = cells::open_mapped(path);
        const io::FileHeader stated = io::file_header(input, {});
        for (const auto& w : io::overridden(input.name(), {stated.unit, stated.up}, settings))
            context.warn(w.id, fmt::format("{}: {}", input.name(), w.message), w.hint);
        if (unit != Unit::unknown && !settings.unit && stated.unit == Unit::unknown)
            warn_of_guess(fmt::format("'{}' has", path.generic_string()), unit, context);
    }
}

struct LoadStage : StageOf<run> {
    StageFiles files() const override { return {o.path, {}, o.asset_root}; }
    void verify(const Value& given, Problems& problems) const override {
        if (o.format.empty() || io::codec_named(o.format)) return;
        const Value* value = given.is_map() ? given.find("format") : nullptr;
        if (value && value->deferred) return;
        problems.add(value ? value->mark : given.mark, "E-FORMAT",
                     fmt::format("there is no format '{}'", o.format),
                     suggestion(o.format, io::names_of_readers()));
    }
    io::FileHeader header(const std::filesystem::path& path, const Folders& places) const override {
        return io::file_header(io::Input::open(path), read_settings(o, places), io::codec_named(o.format));
    }
    /// Loads files that do not fit into memory as cells.
    void on_cells(CellFlow& flow, Context& context) const override;
    std::optional<std::string> why_not_on_cells() const override {
        if (o.lines) return "lines need the whole file";
        if (!o.format.empty()) return "cells support only formats that are recognised by their contents";
        if (o.expand_instances) return "instances need the whole file";
        if (o.drop_not_finite) return "not_finite: drop needs the whole file";
        return {};
    }
};

void LoadStage::on_cells(CellFlow& flow, Context& context) const {
    std::vector<std::filesystem::path> paths;
    for (const PathText& text : o.path)
        for (auto& path : expand_glob(context.places().input(text.text))) paths.push_back(std::move(path));
    if (paths.empty())
        throw Error(ErrorKind::missing, "E-FILE", fmt::format("no file matches '{}'", o.path.front().text));
    std::shared_ptr<cells::FaceSource> source =
        cells::open_faces(paths, read_settings(o, context.places()), flow.means.scratch,
                          static_cast<std::size_t>(flow.means.memory / 4), flow.means.kept != nullptr);
    const cells::FaceSource::Contents& contents = source->contents();
    const auto record_inputs = [&] {
        source->finish_digests();
        for (const auto& file : contents.files)
            record_input(context, file.input.name(), file.input.bytes().size(), file.sha256);
    };
    try {
        flow.partition = cells::kept_partition(source, flow.means);
    } catch (const Error&) { // reports of failed runs also list the inputs
        try {
            record_inputs();
        } catch (const Error&) { // unreadable files have their own error, so skip this warning
        }
        throw;
    }
    record_inputs();
    warn_of_conventions(paths, read_settings(o, context.places()), contents.unit, context);
    flow.part = contents.name;
    flow.unit = contents.unit;
    flow.up = contents.up;
    flow.box = contents.bounds;
    if (contents.vertices > flow.partition->vertices())
        context.warn(
            "W-CELLS",
            fmt::format("{}: cells lose {} that no face uses", source->name(),
                        counted(contents.vertices - flow.partition->vertices(), "vertex", "vertices")),
            "give more memory if you need them");
    if (contents.skipped_faces > 0)
        context.warn("W-FACES", fmt::format("{}: {} of fewer than three corners skipped", source->name(),
                                            counted(contents.skipped_faces, "face")));
    for (const std::string& what : contents.dropped)
        context.warn("W-CELLS", fmt::format("{}: cells lose {}", source->name(), what),
                     "give more memory if you need this data");
    cells::require_as_opened(contents.files);
}

const RegisterStage registered = make_stage<LoadStage>(
    {.name = "load",
     .also_called = "read open import input",
     .about = help::load::about,
     .details = help::load::details,
     .examples = {"load: scan.ply", "load: {path: part.stl, unit: mm, up: z}",
                  "load: [body.obj, \"wheel_*.obj\"]", "load: {path: wires.obj, lines: 1%}",
                  "load: {path: models/lamp.gltf, asset_root: .}",
                  "load: {path: depth.ply, not_finite: drop}",
                  "load: {path: part.step, max_deviation: 0.1mm, max_angle: 15deg}"},
     .loads = true},
    declare);

} // namespace

} // namespace facetmill::load_stage
