#include "stages/hull/report.hpp"

#include "base/text/readable_numbers.hpp"
#include "mesh/transform.hpp"

#include <fmt/format.h>

namespace facetmill::hull_stage {

namespace {

void declare_shape(DeclareFields<HullShapeReport>& d) {
    using S = HullShapeReport;
    d.field("part", &S::part,
            "The name of the part inside the shape. With per: scene, the name of the first part.");
    d.field("name", &S::name, "The name of the shape.");
    d.field("vertices", &S::vertices, "The number of vertices.");
    d.field("faces", &S::faces, "The number of faces.");
    d.field("hull_vertices", &S::hull_vertices, "The number of vertices of the exact convex hull.");
    d.field("volume", &S::volume, "The volume of the mesh.").unit("scene units^3");
    d.field("hull_volume", &S::hull_volume, "The volume of the exact convex hull.").unit("scene units^3");
    d.field("concavity", &S::concavity, "The largest distance of a point of the hull from the solid.")
        .unit("scene units")
        .only_when("max_parts is above 1");
    d.field("resolution", &S::resolution, "The size of the grid cells that measure the concavity.")
        .unit("scene units")
        .only_when("max_parts is above 1");
    d.field("centre", &S::centre, "The centre of a box or sphere.").only_when("shape is box or sphere");
    d.field("size", &S::size, "The sides of a box along its axes.")
        .unit("scene units")
        .only_when("shape is box");
    d.field("axes", &S::axes, "The axes of a box, as unit vectors.").only_when("shape is box");
    d.field("ends", &S::ends, "The centres of the round ends of a capsule.").only_when("shape is capsule");
    d.field("radius", &S::radius, "The radius of a sphere or capsule.")
        .unit("scene units")
        .only_when("shape is sphere or capsule");
}

} // namespace

void declare_hull_report(DeclareFields<HullReport>& d) {
    d.list("shapes", &HullReport::shapes, "Each convex shape.", declare_shape);
    d.tell([](const HullReport& report) {
        std::vector<std::string> lines;
        for (const auto& s : report.shapes)
            lines.push_back(
                fmt::format("{}: {} vertices, volume {:.6g}{}", s.name, grouped(s.vertices), s.volume,
                            s.hull_volume > 0 && s.volume > s.hull_volume
                                ? fmt::format(" ({:.3g} times the hull)", s.volume / s.hull_volume)
                                : ""));
        return lines;
    });
}

HullShapeReport report_of(const HullResult& hull, const Transform& to_world) {
    HullShapeReport out;
    out.vertices = hull.mesh.vertex_count();
    out.faces = hull.mesh.face_count();
    out.hull_vertices = hull.hull_vertices;
    const double growth = std::abs(to_world.determinant());
    out.volume = hull.volume * growth;
    out.hull_volume = hull.hull_volume * growth;
    const double stretch = mean_stretch(to_world);
    if (const auto* box = std::get_if<FittedBox>(&hull.fitted)) {
        out.centre = to_world.point(box->centre);
        out.size = box->size * stretch;
        out.axes.emplace();
        for (std::size_t k = 0; k < 3; ++k) (*out.axes)[k] = normalised(to_world.vector(box->axes[k]));
    } else if (const auto* sphere = std::get_if<FittedSphere>(&hull.fitted)) {
        out.centre = to_world.point(sphere->centre);
        out.radius = sphere->radius * stretch;
    } else if (const auto* capsule = std::get_if<FittedCapsule>(&hull.fitted)) {
        out.ends = {to_world.point(capsule->ends[0]), to_world.point(capsule->ends[1])};
        out.radius = capsule->radius * stretch;
    }
    return out;
}

} // namespace facetmill::hull_stage
