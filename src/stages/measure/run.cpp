#include "geometry/measure/measure.hpp"

#include "geometry/model_row/model_row.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/placement.hpp"
#include "stage/as_loaded.hpp"
#include "stage/read_recorded.hpp"
#include "stages/measure/cells.hpp"
#include "stages/measure/face_table.hpp"
#include "stages/measure/help.hpp"
#include "stages/measure/options.hpp"
#include "stages/measure/report.hpp"

#include <algorithm>
#include <iterator>

namespace facetmill::measure_stage {

namespace {

struct Measures {
    std::vector<MeasuredPart> parts;
    ShellMass shell;
    std::optional<SolidMass> solid = SolidMass{};
    std::string csv = face_table_head();
};

std::optional<MeasuredSolid> measured(const std::optional<SolidMass>& solid, double density) {
    return solid ? std::optional(measure_stage::measured(*solid, density)) : std::nullopt;
}

void measure_part(Part& part, const MeasureOptions& o, bool list_faces, Measures& all, Context& context) {
    const Mesh mesh = in_world(part);
    MassResult mass = measure_mass(mesh);
    correct_for_shells(part.name, mesh, mass, context);
    FaceResult faces = measure_faces(mesh);
    EdgesAndCurvature turns = measure_edges_and_curvature(mesh, {.feature_angle = o.feature_angle.radians});
    all.shell = joined(all.shell, mass.shell);
    all.solid = all.solid && mass.solid ? std::optional(joined(*all.solid, *mass.solid)) : std::nullopt;
    if (list_faces) all.csv += face_table_rows(part.name, mesh);
    warn_of_inside_out(part.name, mass, context);
    faces.areas.clear();
    turns.curvature.gaussian.clear();
    turns.curvature.mean.clear();
    all.parts.push_back({part.name, mass.shell, measured(mass.solid, o.density), std::move(faces),
                         turns.edges, std::move(turns.curvature)});
}

/// The surface to compare with for deviation; null if not requested.
std::unique_ptr<FaceTree> other_surface(const MeasureOptions& o, const Scene& scene, Context& context) {
    if (is_from_load(o)) {
        context.mark_uncacheable(); // the cache key does not include the scene as loaded
        return std::make_unique<FaceTree>(surface_as_loaded(context), FaceTree::Use::near);
    }
    if (!o.with) return nullptr;
    const Scene other = read_beside(*o.with, scene, context);
    return std::make_unique<FaceTree>(surface_or_points_of(other, filled_surface), FaceTree::Use::near);
}

std::vector<KeptAttribute> kept(Part& part, Unit unit, const MeasureOptions& o, const FaceTree* other) {
    std::vector<KeptAttribute> all;
    for (const auto& [quantity] : o.attributes) {
        std::vector<double> values = values_of(*quantity, part, other);
        const std::size_t count = values.size();
        Statistics numbers = statistics(values);
        all.push_back({std::string(quantity->name), unit_of(*quantity, unit),
                       quantity->domain == Domain::face ? "faces" : "vertices", count - numbers.count,
                       numbers});
        give_attribute(part, *quantity, std::move(values), o.missing);
    }
    part.changed = true;
    return all;
}

Json flat(const ModelRow& row, const std::string* part) {
    Json json = Json::object();
    if (part) json["part"] = *part;
    const auto columns = model_columns();
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const auto& value = row.values[i];
        Json& cell = json[std::string(columns[i].name)] = nullptr;
        if (value && columns[i].is_count())
            cell = static_cast<std::uint64_t>(*value);
        else if (value)
            cell = *value;
    }
    json["unit"] = row.unit;
    return json;
}

/// The rows of the selected parts, or of a scene of only them.
std::vector<Json> model_rows(const Scene& scene, const MeasureOptions& o, const Context& context) {
    const ModelRowSettings settings{o.overhang_angle.radians, true};
    const auto selected = [&](const Part& part) { return context.selects(part, scene); };
    std::vector<Json> rows;
    if (o.per == Per::part) {
        for (const Part& part : scene.parts)
            if (selected(part)) rows.push_back(flat(model_row(scene, part, settings), &part.name));
        return rows;
    }
    if (std::all_of(scene.parts.begin(), scene.parts.end(), selected))
        return {flat(model_row(scene, settings), nullptr)};
    Scene some;
    some.unit = scene.unit;
    some.up = scene.up;
    std::copy_if(scene.parts.begin(), scene.parts.end(), std::back_inserter(some.parts), selected);
    return {flat(model_row(some, settings), nullptr)};
}

Scene run(Scene scene, const MeasureOptions& o, Context& context, MeasureReport& report) {
    const bool list_faces = lists_faces(o);
    const auto other = other_surface(o, scene, context);
    Measures all;
    for (auto& part : scene.parts) {
        if (!context.selects(part, scene)) continue;
        measure_part(part, o, list_faces, all, context);
        if (!o.attributes.empty()) all.parts.back().attributes = kept(part, scene.unit, o, other.get());
    }
    if (all.parts.empty()) all.solid.reset();
    report = {
        to_string(scene.unit), o.density, {all.shell, measured(all.solid, o.density)}, std::move(all.parts)};
    MeasureTables tables{std::move(all.csv)};
    if (lists_models(o)) tables.models = model_rows(scene, o, context);
    write_results(o, report, tables, context);
    return scene;
}

struct MeasureStage : StageOf<run> {
    StageFiles files() const override { return files_of_measure(o); }
    void verify(const Value& given, Problems& problems) const override { verify_measure(o, given, problems); }
    bool compares_with_load() const override { return is_from_load(o); }
    void on_cells(CellFlow& flow, Context& context) const override { measure_on_cells(o, flow, context); }
    std::optional<std::string> why_not_on_cells() const override {
        return measure_stage::why_not_on_cells(o);
    }
};

const RegisterStage registered = make_stage<MeasureStage>(
    {.name = "measure",
     .also_called = "area mass",
     .about = help::measure::about,
     .details = help::measure::details,
     .examples = {"measure", "measure: {density: 7.85, path: part.json}",
                  "measure: {path: [all.json, faces.csv]}", "measure: {per: part, path: parts.csv}",
                  "measure: {attributes: [mean_curvature, wall_thickness]}"},
     .tells = true,
     .crossing_faces = CrossingFacePolicy::name},
    declare_measure, declare_measure_report);

} // namespace

} // namespace facetmill::measure_stage
