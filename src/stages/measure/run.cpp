#include "geometry/measure/measure.hpp"

#include "mesh/bare.hpp"
#include "stages/measure/csv.hpp"
#include "stages/measure/report.hpp"
#include "report/summary.hpp"
#include "stages/measure/options.hpp"

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
    all.parts.push_back({{"part", part.name},
                         {"shell", report::shell_json(mass.shell)},
                         {"solid", report::solid_json(mass.solid, o.density)},
                         {"faces", report::faces_json(faces)},
                         {"edges", report::edges_json(measure_edges(mesh, {.sharp = o.sharp.radians}))},
                         {"curvature", report::curvature_json(curvature)}});
    all.shell = joined(all.shell, mass.shell);
    all.solid = all.solid && mass.solid ? std::optional(joined(*all.solid, *mass.solid)) : std::nullopt;
    if (list_faces) all.csv += report::face_rows(part.name, mesh);
    if (mass.solid && mass.solid->volume < 0)
        context.warn("W-INSIDE-OUT",
                     fmt::format("part '{}' is inside out: its volume and inertia are negative", part.name),
                     "orient turns it outward");
    if (o.areas) set_attribute(part.mesh, "area", Domain::face, std::move(faces.areas));
    if (!o.curvature) return;
    set_attribute(part.mesh, "gaussian_curvature", Domain::vertex, std::move(curvature.gaussian));
    set_attribute(part.mesh, "mean_curvature", Domain::vertex, std::move(curvature.mean));
}

Scene run(Scene scene, const MeasureOptions& o, Context& context) {
    const bool list_faces = std::any_of(o.to.begin(), o.to.end(), lists_faces);
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
    for (const auto& path : o.to) {
        const std::string text = lists_faces(path) ? all.csv : context.result().dump(2) + "\n";
        context.output(path.text, std::as_bytes(std::span(text)));
    }
    return scene;
}

const RegisterStage registered = make_stage<MeasureOptions>(
    {.name = "measure",
     .about = "Measures areas, volume, centroids, inertia, edges, angles and curvature.",
     .details =
         "The results stand in the report, for every part and in all, in world space and scene units; angles "
         "are in degrees. The area of a polygon in space is half the length of the sum of cross products "
         "around it, right for concave faces, and for faces that are not planar the area of their projection "
         "along the mean normal. shell is the surface without thickness: its centroid is weighted by area. "
         "solid is the inside of a closed surface, filled with the density: volume, mass, centroid, inertia "
         "about the centroid, principal moments (ascending) with their axes, radii of gyration. It is null "
         "for open surfaces, and in all when one part is open.\n\n"
         "Edges turn by the angle between the normals of their two faces, negative where concave. aspect is "
         "1 for an equilateral triangle: longest edge over the height on it. kinds are the note's types of "
         "polygon. The mean curvature at a vertex comes from the turns of its edges, the Gaussian one from "
         "what its angles lack of a full turn, both over a third of the area around; their statistics leave "
         "out borders. total_in_turns is Euler's number of a manifold, whatever its shape.\n\n"
         "The mesh passes on as it is, but for attributes asked for. Sources: the notes on the area of a 3D "
         "polygon and the centroid of a surface; D. Eberly, 'Polyhedral mass properties' (2002); M. Meyer et "
         "al., 'Discrete differential-geometry operators' (2003).",
     .examples = {"measure", "measure: {density: 7.85, to: part.json}",
                  "measure: {curvature: true, to: [all.json, faces.csv]}"}},
    declare_measure, run, {.files = files_of_measure, .verify = verify_measure});

} // namespace

} // namespace facetmill
