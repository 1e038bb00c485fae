#include "geometry/measure/measure.hpp"

#include "mesh/placement.hpp"
#include "stages/measure/cells.hpp"
#include "stages/measure/face_table.hpp"
#include "stages/measure/help.hpp"
#include "stages/measure/options.hpp"
#include "stages/measure/report.hpp"

namespace facetmill::measure_stage {

namespace {

void set_attribute(Mesh& mesh, const char* name, Domain domain, std::vector<double> values) {
    mesh.drop(name, domain);
    for (double& x : values)
        if (!std::isfinite(x)) x = 0;
    mesh.attributes.push_back({name, domain, Role::generic, 1, false, std::move(values)});
}

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
    const MassResult mass = measure_mass(mesh);
    FaceResult faces = measure_faces(mesh);
    CurvatureResult curvature = measure_curvature(mesh);
    all.shell = joined(all.shell, mass.shell);
    all.solid = all.solid && mass.solid ? std::optional(joined(*all.solid, *mass.solid)) : std::nullopt;
    if (list_faces) all.csv += face_table_rows(part.name, mesh);
    warn_of_inside_out(part.name, mass, context);
    if (o.areas) set_attribute(part.mesh, "area", Domain::face, std::move(faces.areas));
    if (o.curvature) {
        set_attribute(part.mesh, "gaussian_curvature", Domain::vertex, std::move(curvature.gaussian));
        set_attribute(part.mesh, "mean_curvature", Domain::vertex, std::move(curvature.mean));
    }
    faces.areas.clear();
    curvature.gaussian.clear();
    curvature.mean.clear();
    all.parts.push_back({part.name, mass.shell, measured(mass.solid, o.density), std::move(faces),
                         measure_edges(mesh, {.feature_angle = o.feature_angle.radians}),
                         std::move(curvature)});
}

Scene run(Scene scene, const MeasureOptions& o, Context& context, MeasureReport& report) {
    const bool list_faces = std::any_of(o.path.begin(), o.path.end(), lists_faces);
    Measures all;
    for (auto& part : scene.parts) {
        if (!context.selects(part, scene)) continue;
        measure_part(part, o, list_faces, all, context);
        part.changed = part.changed || o.areas || o.curvature;
    }
    if (all.parts.empty()) all.solid.reset();
    report = {
        to_string(scene.unit), o.density, {all.shell, measured(all.solid, o.density)}, std::move(all.parts)};
    write_results(o, report, all.csv, context);
    return scene;
}

const RegisterStage registered =
    make_stage<MeasureOptions>({.name = "measure",
                                .about = help::measure::about,
                                .details = help::measure::details,
                                .examples = {"measure", "measure: {density: 7.85, path: part.json}",
                                             "measure: {curvature: true, path: [all.json, faces.csv]}"},
                                .tells = true,
                                .crossing_faces = CrossingFacePolicy::name},
                               declare_measure, declare_measure_report, run,
                               {.files = files_of_measure,
                                .verify = verify_measure,
                                .on_cells = measure_on_cells,
                                .why_not_on_cells = why_not_on_cells});

} // namespace

} // namespace facetmill::measure_stage
