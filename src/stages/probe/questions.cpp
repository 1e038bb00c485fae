#include "stages/probe/questions.hpp"

#include "mesh/face.hpp"
#include "mesh/placement.hpp"

#include <fmt/format.h>

namespace facetmill {

Questions questions_of(const Scene& scene, const ProbeOptions& o, const Context& context) {
    Questions q;
    const PartFilter sources{o.points_of};
    for (const auto& part : scene.parts)
        if (!o.points_of.empty() && sources.selects(part, scene))
            q.sources.push_back(&part);
        else if (context.selects(part, scene))
            q.surface.push_back(&part);
    if (!o.points_of.empty() && q.sources.empty())
        throw Error(ErrorKind::usage, "E-PART", "'points_of' names no part of the scene",
                    "facetmill info lists them");
    if (q.surface.empty() && !q.sources.empty())
        throw Error(ErrorKind::usage, "E-PART", "'points_of' leaves no part as the surface",
                    "the other parts are the surface: load one, or name fewer");
    return q;
}

std::vector<Vec3> points_asked(const ProbeOptions& o, const Questions& q, Context& context) {
    std::vector<Vec3> points;
    if (!o.points) {
        for (const Part* part : q.sources)
            for (const Vec3& p : part->mesh.positions) points.push_back(effective(*part).point(p));
        return points;
    }
    auto rows = o.points->rows;
    if (!o.points->file.empty()) rows = rows_of<3>(rows::read(o.points->file, 3, context));
    for (const auto& r : rows) points.push_back({r[0], r[1], r[2]});
    return points;
}

std::vector<Line> lines_asked(const ProbeOptions& o, Context& context) {
    const bool rays = o.rays.has_value();
    const Rows<6>& given = rays ? *o.rays : *o.segments;
    auto rows = given.rows;
    if (!given.file.empty()) rows = rows_of<6>(rows::read(given.file, 6, context));
    std::vector<Line> lines;
    for (const auto& r : rows) {
        const Vec3 from{r[0], r[1], r[2]}, to{r[3], r[4], r[5]};
        if (rays && to == Vec3{})
            throw Error(ErrorKind::usage, "E-RAY", fmt::format("ray {} has no direction", lines.size()),
                        "a ray has an origin and a direction; use segments to go from point to point");
        lines.push_back({from, rays ? from + to : to, rays});
    }
    return lines;
}

namespace {

/// Normals of vertices in the world, of the faces there by their area; faces of a mirrored part keep their
/// front.
std::vector<Vec3> normals_of_faces(const Part& part) {
    const Mesh world = in_world(part);
    std::vector<Vec3> sums(world.vertex_count());
    for (Index f = 0; f < world.face_count(); ++f) {
        const Vec3 normal = area_vector(world, f);
        for (Index c = world.face_begin(f); c < world.face_end(f); ++c) sums[world.vertex(c)] += normal;
    }
    return sums;
}

/// The attribute's directions at the vertices, in the world; wedges of a vertex are added up.
std::vector<Vec3> directions_of(const Part& part, const std::string& name) {
    const Mesh& mesh = part.mesh;
    const Attribute* found = mesh.find(name, Domain::vertex);
    const bool wedges = !found;
    if (!found) found = mesh.find(name, Domain::wedge);
    if (!found && name == "NORMAL") return normals_of_faces(part);
    if (!found || found->components < 3)
        throw Error(
            ErrorKind::stage, "E-ATTRIBUTE",
            fmt::format("part '{}' has no attribute '{}' of three numbers at vertices", part.name, name),
            "facetmill info lists the attributes of a file; NORMAL is always available");
    Mesh alone; // turned as the part is
    alone.attributes.push_back(*found);
    apply(alone, effective(part));
    const Attribute& a = alone.attributes.front();
    const bool is_turned = a.role == Role::normal || a.role == Role::tangent || a.role == Role::morph_vector;
    std::vector<Vec3> directions(mesh.vertex_count());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec3 d{a.value(i, 0), a.value(i, 1), a.value(i, 2)};
        directions[wedges ? mesh.vertex_of_wedge(static_cast<Index>(i)) : i] +=
            is_turned ? d : effective(part).vector(d);
    }
    return directions;
}

} // namespace

std::vector<Line> lines_along(const ProbeOptions& o, const Questions& q) {
    std::vector<Line> lines;
    for (const Part* part : q.surface) {
        const std::vector<Vec3> directions = directions_of(*part, o.along);
        for (std::size_t v = 0; v < directions.size(); ++v) {
            const Vec3 from = in_world(*part, part->mesh.positions[v]);
            const Vec3 d = normalised(directions[v]) * (o.reverse ? -1.0 : 1.0);
            lines.push_back({from, from + d, true});
        }
    }
    return lines;
}

std::vector<Vec3> facet_asked(const Questions& q, std::int64_t number) {
    std::int64_t left = number;
    for (const Part* part : q.surface) {
        const auto count = static_cast<std::int64_t>(part->mesh.face_count());
        if (left >= count) {
            left -= count;
            continue;
        }
        std::vector<Vec3> corners;
        const auto f = static_cast<Index>(left);
        for (Index c = part->mesh.face_begin(f); c < part->mesh.face_end(f); ++c)
            corners.push_back(effective(*part).point(part->mesh.point(c)));
        return corners;
    }
    throw Error(ErrorKind::usage, "E-FACE",
                fmt::format("there is no face {}; the last one is {}", number, number - left - 1),
                "faces are numbered from 0");
}

} // namespace facetmill
