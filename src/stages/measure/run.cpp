#include "geometry/measure/measure.hpp"

#include "mesh/bare.hpp"
#include "report/summary.hpp"
#include "stages/measure/csv.hpp"
#include "stages/measure/help.hpp"
#include "stages/measure/options.hpp"
#include "stages/measure/report.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

void set_attribute(Mesh& mesh, const char* name, Domain domain, std::vector<double> values) {
    mesh.drop(name, domain);
    for (double& x : values)
        if (!std::isfinite(x)) x = 0;
    mesh.attributes.push_back({name, domain, Role::generic, 1, false, std::move(values)});
}

struct Measures {
    Json parts = Json::array();
    ShellMass shell;
    std::optional<SolidMass> solid = SolidMass{};
    std::string csv = report::face_rows_head;
};

void measure_part(Part& part, const MeasureOptions& o, bool list_faces, Measures& all, Context& context) {
    const Mesh mesh = in_world(part);
    const MassResult mass = measure_mass(mesh);
    FaceResult faces = measure_faces(mesh);
    CurvatureResult curvature = measure_curvature(mesh);
    all.parts.push_back(
        {{"part", part.name},
         {"shell", report::shell_json(mass.shell)},
         {"solid", report::solid_json(mass.solid, o.density)},
         {"faces", report::faces_json(faces)},
         {"edges", report::edges_json(measure_edges(mesh, {.feature_angle = o.feature_angle.radians}))},
         {"curvature", report::curvature_json(curvature)}});
    all.shell = joined(all.shell, mass.shell);
    all.solid = all.solid && mass.solid ? std::optional(joined(*all.solid, *mass.solid)) : std::nullopt;
    if (list_faces) all.csv += report::face_rows(part.name, mesh);
    if (mass.solid && mass.solid->volume < 0)
        context.warn("W-INSIDE-OUT",
                     fmt::format("part '{}' is inside out: its volume and inertia are negative", part.name),
                     "use orient to turn it outward");
    if (o.areas) set_attribute(part.mesh, "area", Domain::face, std::move(faces.areas));
    if (!o.curvature) return;
    set_attribute(part.mesh, "gaussian_curvature", Domain::vertex, std::move(curvature.gaussian));
    set_attribute(part.mesh, "mean_curvature", Domain::vertex, std::move(curvature.mean));
}

Scene run(Scene scene, const MeasureOptions& o, Context& context) {
    const bool list_faces = std::any_of(o.path.begin(), o.path.end(), lists_faces);
    Measures all;
    for (auto& part : scene.parts) {
        if (!context.selects(part, scene)) continue;
        measure_part(part, o, list_faces, all, context);
        part.changed = part.changed || o.areas || o.curvature;
    }
    if (all.parts.empty()) all.solid.reset();
    context.result() = {
        {"unit", to_string(scene.unit)},
        {"density", o.density},
        {"total",
         {{"shell", report::shell_json(all.shell)}, {"solid", report::solid_json(all.solid, o.density)}}},
        {"parts", std::move(all.parts)}};
    context.say(report::measure_summary(context.result()));
    for (const auto& path : o.path) {
        const std::string text = lists_faces(path) ? all.csv : context.result().dump(2) + "\n";
        context.output(path.text, std::as_bytes(std::span(text)));
    }
    return scene;
}

const RegisterStage registered =
    make_stage<MeasureOptions>({.name = "measure",
                                .about = help::measure::about,
                                .details = help::measure::details,
                                .examples = {"measure", "measure: {density: 7.85, path: part.json}",
                                             "measure: {curvature: true, path: [all.json, faces.csv]}"}},
                               declare_measure, run, {.files = files_of_measure, .verify = verify_measure});

} // namespace

} // namespace facetmill
