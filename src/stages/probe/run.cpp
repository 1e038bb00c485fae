#include "base/progress.hpp"
#include "geometry/inspect/connectivity.hpp"
#include "geometry/probe/probe.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/face.hpp"
#include "mesh/placement.hpp"
#include "stage/bind_pose.hpp"
#include "stages/probe/help.hpp"
#include "stages/probe/options.hpp"
#include "stages/probe/report.hpp"

#include <fmt/format.h>

namespace facetmill::probe_stage {

namespace {

/// The queried surface, and the parts whose vertices are the query points.
struct Questions {
    std::vector<const Part*> surface, sources;
};

/// Throws a usage error (E-PART) if points_of matches no part.
Questions questions_of(const Scene& scene, const ProbeOptions& o, const Context& context) {
    Questions q;
    const PartFilter sources{o.points_of};
    for (const auto& part : scene.parts)
        if (!o.points_of.empty() && sources.selects(part, scene))
            q.sources.push_back(&part);
        else if (context.selects(part, scene))
            q.surface.push_back(&part);
    if (!o.points_of.empty() && q.sources.empty())
        throw Error(ErrorKind::usage, "E-PART", "'points_of' selects no part of the scene",
                    "facetmill info lists them");
    if (q.surface.empty() && !q.sources.empty())
        throw Error(ErrorKind::usage, "E-PART",
                    "'points_of' selects all parts, so no part is left as the surface",
                    "load another part as the surface, or select fewer parts");
    return q;
}

/// The points of the option or its file, or the vertices of the sources, in world space.
std::vector<Vec3> points_asked(const ProbeOptions& o, const Questions& q, Context& context) {
    std::vector<Vec3> points;
    if (!o.points) {
        for (const Part* part : q.sources)
            for (const Vec3& p : part->mesh.positions) points.push_back(part->transform.point(p));
        return points;
    }
    auto rows = o.points->rows;
    if (!o.points->file.empty()) rows = rows_of<3>(rows::read(o.points->file, 3, context));
    for (const auto& r : rows) points.push_back({r[0], r[1], r[2]});
    return points;
}

/// The segments or rays of the option or its file.
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
                        "give the ray an origin and a direction; use segments to go from point to point");
        lines.push_back({from, rays ? from + to : to, rays});
    }
    return lines;
}

/// Vertex normals in world space, weighted by the area of the adjacent faces. Faces of a mirrored part keep
/// their front.
std::vector<Vec3> normals_of_faces(const Part& part) {
    const Mesh world = in_world(part);
    std::vector<Vec3> sums(world.vertex_count());
    for (Index f = 0; f < world.face_count(); ++f) {
        const Vec3 normal = area_vector(world, f);
        for (Index c = world.face_begin(f); c < world.face_end(f); ++c) sums[world.vertex(c)] += normal;
    }
    return sums;
}

/// The attribute's directions at the vertices, in world space, summed over the wedges of a vertex.
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
    Mesh alone; // transformed like the part
    alone.attributes.push_back(*found);
    apply(alone, part.transform);
    const Attribute& a = alone.attributes.front();
    const bool is_turned = a.role == Role::normal || a.role == Role::tangent || a.role == Role::morph_vector;
    std::vector<Vec3> directions(mesh.vertex_count());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Vec3 d{a.value(i, 0), a.value(i, 1), a.value(i, 2)};
        directions[wedges ? mesh.vertex_of_wedge(static_cast<Index>(i)) : i] +=
            is_turned ? d : part.transform.vector(d);
    }
    return directions;
}

/// Rays of length 1 from the vertices of all parts of the surface along the attribute `along`. Throws a
/// stage error (E-ATTRIBUTE) if a part lacks the attribute.
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

/// The corners of a face in world space. Faces are numbered through all parts. Throws a usage error (E-FACE)
/// if the face does not exist.
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
            corners.push_back(part->transform.point(part->mesh.point(c)));
        return corners;
    }
    throw Error(ErrorKind::usage, "E-FACE",
                fmt::format("face {} does not exist; the last face is {}", number, number - left - 1),
                fmt::format("give a number from 0 to {}", number - left - 1));
}

ProbeReport answer_points(const FaceTree& tree, const Scene& scene, const ProbeOptions& o, const Questions& q,
                          std::string* csv, std::size_t limit, Context& context) {
    PointSettings settings;
    settings.tolerance = context.resolve(o.tolerance, scene, "tolerance");
    std::vector<std::string> open;
    for (const Part* part : q.surface)
        if (connectivity_of(part->mesh).uncancelled_edges != 0) open.push_back(part->name);
    settings.closed = open.empty();
    if (!settings.closed)
        context.warn(
            "W-PROBE-OPEN",
            fmt::format("the surface is open: nothing is inside or outside it ({} of {} parts, first '{}')",
                        open.size(), q.surface.size(), open.front()),
            "close it (clean: {holes: minimal}), or select closed parts (only)");
    const auto points = points_asked(o, q, context);
    const auto answers = probe_points(tree, points, settings);
    const FaceNames names(q.surface);
    if (csv) *csv = points_csv(points, answers, names);
    return report_of(points, answers, names, limit);
}

LineAnswers answer_lines(const FaceTree& tree, const ProbeOptions& o, const Questions& q, Context& context) {
    LineAnswers answers;
    answers.lines = o.along.empty() ? lines_asked(o, context) : lines_along(o, q);
    if (o.face) {
        const auto facet = facet_asked(q, *o.face);
        for (const auto& line : answers.lines) answers.meetings.push_back(meet(line, facet));
        answers.hits.offsets.assign(answers.lines.size() + 1, 0);
    } else if (o.along.empty()) {
        answers.hits = hits_of(tree, answers.lines, o.hits == ProbeOptions::Hits::all);
    } else {
        answers.hits = hits_away(tree, answers.lines);
    }
    return answers;
}

Scene run(Scene scene, const ProbeOptions& o, Context& context, ProbeReport& report) {
    warn_of_bind_pose(scene, context);
    ProgressSteps steps({1, 2, 2});
    const Questions q = questions_of(scene, o, context);
    const FaceTree tree(surface_of(q.surface, filled_surface));
    steps.next();
    const bool wants_csv = std::any_of(o.path.begin(), o.path.end(), is_csv);
    const bool wants_json = o.path.size() > (wants_csv ? 1 : 0) || (!o.path.empty() && !wants_csv);
    constexpr std::size_t no_limit = std::size_t(-1);
    const std::size_t limit = wants_json ? no_limit : static_cast<std::size_t>(o.max_answers);
    std::string csv;
    if (o.points || !o.points_of.empty()) {
        report = answer_points(tree, scene, o, q, wants_csv ? &csv : nullptr, limit, context);
    } else {
        const auto answers = answer_lines(tree, o, q, context);
        const FaceNames names(q.surface);
        report = report_of(answers, names, limit);
        if (wants_csv) csv = lines_csv(answers, names);
    }
    steps.next();
    const Fields fields = fields_of<ProbeReport>(declare_probe_report);
    for (const auto& path : o.path) {
        const std::string text = is_csv(path) ? csv : fields.json(&report).dump(2) + "\n";
        context.output(path.text, std::as_bytes(std::span(text)));
    }
    if (report.answers.size() > static_cast<std::size_t>(o.max_answers))
        report.answers.resize(static_cast<std::size_t>(o.max_answers));
    return scene;
}

struct ProbeStage : StageOf<run> {
    StageFiles files() const override { return probe_files(o); }
    void verify(const Value& given, Problems& problems) const override { verify_probe(o, given, problems); }
};

const RegisterStage registered =
    make_stage<ProbeStage>({.name = "probe",
                            .about = help::probe::about,
                            .details = help::probe::details,
                            .examples = {"probe: [0, 0, 1]", "probe: {points: probes.csv, path: answers.csv}",
                                         "probe: {rays: [0, 0, 9, 0, 0, -1], hits: first}",
                                         "probe: {along: NORMAL, reverse: true, path: walls.csv}"},
                            .tells = true,
                            .keeps_scene = true,
                            .leaves_points = true,
                            .crossing_faces = CrossingFacePolicy::name},
                           declare_probe, declare_probe_report);

} // namespace

} // namespace facetmill::probe_stage
