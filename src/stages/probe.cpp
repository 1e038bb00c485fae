#include "geometry/probe.hpp"

#include "geometry/links.hpp"
#include "mesh/placement.hpp"
#include "report/probe_json.hpp"
#include "report/summary.hpp"
#include "stage/probe_option.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

enum class Hits { first, all };

struct ProbeOptions {
    std::optional<Rows<3>> points;
    std::optional<Rows<6>> segments, rays;
    std::vector<std::string> points_of;
    std::string along;
    bool reverse = false;
    Hits hits = Hits::all;
    std::optional<std::int64_t> face;
    Length on = Length::scene(0);
    std::int64_t list = 1000;
    std::vector<PathText> to;
};

void declare(Declare<ProbeOptions>& d) {
    d.option("points", &ProbeOptions::points,
             "Points to ask about: rows of x, y, z in world space, or a CSV file with such rows.")
        .primary();
    d.option("points_of", &ProbeOptions::points_of,
             "Parts, by name or glob, whose vertices are the points; the other parts are the surface.");
    d.option("segments", &ProbeOptions::segments,
             "Rows of six numbers, from x, y, z to x, y, z; or a CSV file.");
    d.option("rays", &ProbeOptions::rays,
             "Rows of six numbers, a start x, y, z and a direction x, y, z; or a CSV file.");
    d.option("along", &ProbeOptions::along,
             "An attribute of three numbers, NORMAL for one: a ray from every vertex along it. The faces at "
             "the vertex "
             "do not count.");
    d.option("reverse", &ProbeOptions::reverse,
             "Rays of along run the other way; along NORMAL that is inward, and measures the wall.");
    d.choice<Hits>("hits", &ProbeOptions::hits,
                   {{"all", Hits::all, "every face that a segment or ray meets, in order"},
                    {"first", Hits::first, "the first one"}},
                   "What is asked of segments and rays; along always takes the first.");
    d.option("face", &ProbeOptions::face,
             "Segments and rays are held against this face alone (a number, parts counted through), and each "
             "is told as "
             "hit, parallel, in plane, outside segment or outside facet.")
        .at_least(0);
    d.option("on", &ProbeOptions::on,
             "Up to this distance a point lies on the surface (a length). 0: exactly on it.")
        .at_least(0);
    d.option("list", &ProbeOptions::list, "How many answers the report lists (a count); files hold all.")
        .between(0, 1e6);
    d.option("to", &ProbeOptions::to,
             "Writes all answers there: .csv or .json; - is JSON on standard output.");
    d.exactly_one({"points", "points_of", "segments", "rays", "along"});
}

/// The surface that is asked, and the points or rays that parts bring with them.
struct Questions {
    std::vector<const Part*> surface, sources;
};

Questions sort_parts(const Scene& scene, const ProbeOptions& o, const Context& context) {
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
    return q;
}

std::vector<Vec3> points_of(const ProbeOptions& o, const Questions& q, Context& context) {
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

std::vector<Line> lines_of(const Rows<6>& given, bool rays, Context& context) {
    auto rows = given.rows;
    if (!given.file.empty()) rows = rows_of<6>(rows::read(given.file, 6, context));
    std::vector<Line> lines;
    for (const auto& r : rows) {
        const Vec3 from{r[0], r[1], r[2]}, to{r[3], r[4], r[5]};
        lines.push_back({from, rays ? from + to : to, rays});
    }
    return lines;
}

Json answer_points(const FaceTree& tree, const Scene& scene, const ProbeOptions& o, const Questions& q,
                   std::string* csv, std::size_t limit, Context& context) {
    PointSettings settings;
    settings.tolerance = context.resolve(o.on, scene, "on");
    for (const Part* part : q.surface)
        settings.closed = settings.closed && count_links(part->mesh).uncancelled_edges == 0;
    if (!settings.closed)
        context.warn("W-PROBE-OPEN", "the surface is open: nothing is inside or outside it",
                     "close it (clean), or choose closed parts (only)");
    const auto points = points_of(o, q, context);
    const auto answers = probe_points(tree, points, settings);
    const report::FaceNames names(q.surface);
    if (csv) *csv = report::points_csv(points, answers, names);
    return report::points_json(points, answers, names, limit);
}

/// The corners of a face, parts counted through, in world space.
std::vector<Vec3> facet_of(const Questions& q, std::int64_t number) {
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
                fmt::format("there is no face {}: the last is {}", number, number - left - 1),
                "faces are numbered from 0");
}

report::LineAnswers answer_lines(const FaceTree& tree, std::vector<Line> lines, const ProbeOptions& o,
                                 const Questions& q) {
    report::LineAnswers answers;
    answers.lines = std::move(lines);
    if (o.face) {
        const auto facet = facet_of(q, *o.face);
        for (const auto& line : answers.lines) answers.meetings.push_back(meet(line, facet));
        answers.hits.offsets.assign(answers.lines.size() + 1, 0);
    } else {
        answers.hits = hits_of(tree, answers.lines, o.hits == Hits::all);
    }
    return answers;
}

/// Rays from the vertices of all parts of the surface along an attribute; hits on faces at the vertex go.
report::LineAnswers answer_along(const FaceTree& tree, const ProbeOptions& o, const Questions& q) {
    report::LineAnswers answers;
    for (const Part* part : q.surface) {
        const Mesh& mesh = part->mesh;
        const Attribute* a = mesh.find(o.along, Domain::vertex);
        const bool wedges = !a;
        if (!a) a = mesh.find(o.along, Domain::wedge);
        if (!a || a->components < 3)
            throw Error(ErrorKind::stage, "E-ATTRIBUTE",
                        fmt::format("part '{}' has no attribute '{}' of three numbers at vertices",
                                    part->name, o.along),
                        "facetmill info lists the attributes of a file");
        std::vector<Vec3> directions(mesh.vertex_count());
        for (std::size_t i = 0; i < a->size(); ++i)
            directions[wedges ? mesh.vertex_of_wedge(static_cast<Index>(i)) : i] +=
                {a->value(i, 0), a->value(i, 1), a->value(i, 2)};
        const Transform world = effective(*part);
        for (std::size_t v = 0; v < directions.size(); ++v) {
            const Vec3 from = world.point(mesh.positions[v]);
            const Vec3 d = normalised(world.vector(directions[v])) * (o.reverse ? -1.0 : 1.0);
            answers.lines.push_back({from, from + d, true});
        }
    }
    const HitLists all = hits_of(tree, answers.lines, true);
    answers.hits.offsets.push_back(0);
    for (std::size_t i = 0; i < answers.lines.size(); ++i) {
        for (const auto& hit : all.of(i)) {
            const auto& t = tree.triangles[hit.triangle];
            const Vec3& from = answers.lines[i].from;
            if (t.a == from || t.b == from || t.c == from) continue;
            answers.hits.hits.push_back(hit);
            break;
        }
        answers.hits.offsets.push_back(answers.hits.hits.size());
    }
    return answers;
}

bool is_csv(const PathText& path) { return path.text.ends_with(".csv"); }

Scene run(Scene scene, const ProbeOptions& o, Context& context) {
    const Questions q = sort_parts(scene, o, context);
    const FaceTree tree(surface_of(q.surface));
    const bool wants_csv = std::any_of(o.to.begin(), o.to.end(), is_csv);
    const bool wants_json = o.to.size() > (wants_csv ? 1 : 0) || (!o.to.empty() && !wants_csv);
    constexpr std::size_t no_limit = std::size_t(-1);
    const std::size_t limit = wants_json ? no_limit : static_cast<std::size_t>(o.list);
    std::string csv;
    Json result;
    if (o.points || !o.points_of.empty()) {
        result = answer_points(tree, scene, o, q, wants_csv ? &csv : nullptr, limit, context);
    } else {
        const auto answers =
            !o.along.empty()
                ? answer_along(tree, o, q)
                : answer_lines(tree, lines_of(o.rays ? *o.rays : *o.segments, o.rays.has_value(), context), o,
                               q);
        const report::FaceNames names(q.surface);
        result = report::lines_json(answers, names, limit);
        if (wants_csv) csv = report::lines_csv(answers, names);
    }
    for (const auto& path : o.to) {
        const std::string text = is_csv(path) ? csv : result.dump(2) + "\n";
        context.run().outputs.add(context.places().output(path.text), std::as_bytes(std::span(text)));
    }
    Json& list = result["answers"];
    while (list.size() > static_cast<std::size_t>(o.list)) list.erase(list.size() - 1);
    context.say(report::probe_summary(result));
    context.result() = std::move(result);
    return scene;
}

StageFiles files(const ProbeOptions& o) {
    StageFiles files{{}, o.to};
    if (o.points && !o.points->file.empty()) files.inputs.push_back({o.points->file});
    for (const auto* lines : {&o.segments, &o.rays})
        if (*lines && !(*lines)->file.empty()) files.inputs.push_back({(*lines)->file});
    return files;
}

void verify(const ProbeOptions& o, const Value& given, Problems& problems) {
    for (const auto& path : o.to)
        if (path.text != "-" && !is_csv(path) && !path.text.ends_with(".json"))
            problems.add(given.mark, "E-FORMAT", fmt::format("probe cannot write '{}'", path.text),
                         "a name that ends in .csv or .json");
    if (o.face && !o.segments && !o.rays)
        problems.add(given.mark, "E-FACE", "'face' goes with segments or rays");
}

const RegisterStage registered{make_stage<ProbeOptions>(
    {.name = "probe",
     .about = "Asks points, segments and rays about the surface: inside or outside, closest face, hits.",
     .details = "A point is inside, outside or on the surface, and has a winding number (how often the "
                "surface goes around it), "
                "its distance, and the closest point with its part and face. Inside is where the winding "
                "number is not zero; it "
                "is decided exactly, by the crossings of a ray with the faces. An open surface has no inside "
                "(W-PROBE-OPEN); "
                "distances are measured all the same.\n\n"
                "Segments and rays have hits: t (0 to 1 along a segment, the distance along a ray), the "
                "point, part and face, and "
                "whether the line enters there. Whether a line meets a face is decided by exact signs. A "
                "line through an edge "
                "or a corner counts as the line beside it, always to the same side, so a surface that is "
                "crossed is crossed once; "
                "a line within a face's plane does not meet that face. An end on the surface is a hit.\n\n"
                "The scene passes on unchanged. World space, scene units. Sources: the notes 'Intersection "
                "of a line segment and a "
                "facet' (1999) and 'Determining if a point lies on the interior of a polygon' (1987).",
     .examples = {"probe: [0, 0, 1]", "probe: {points: probes.csv, to: answers.csv}",
                  "probe: {rays: [0, 0, 9, 0, 0, -1], hits: first}",
                  "probe: {along: NORMAL, reverse: true, to: walls.csv}"}},
    declare, run, StageHooks<ProbeOptions>{.files = files, .verify = verify})};

} // namespace

} // namespace facetmill
