#include "geometry/inspect/connectivity.hpp"
#include "stages/probe/report.hpp"
#include "report/summary.hpp"
#include "stages/probe/questions.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

Json answer_points(const FaceTree& tree, const Scene& scene, const ProbeOptions& o, const Questions& q,
                   std::string* csv, std::size_t limit, Context& context) {
    PointSettings settings;
    settings.tolerance = context.resolve(o.on, scene, "on");
    std::vector<std::string> open;
    for (const Part* part : q.surface)
        if (count_links(part->mesh).uncancelled_edges != 0) open.push_back(part->name);
    settings.closed = open.empty();
    if (!settings.closed)
        context.warn(
            "W-PROBE-OPEN",
            fmt::format("the surface is open: nothing is inside or outside it ({} of {} parts, first '{}')",
                        open.size(), q.surface.size(), open.front()),
            "close it (clean), or choose closed parts (only)");
    const auto points = points_asked(o, q, context);
    const auto answers = probe_points(tree, points, settings);
    const report::FaceNames names(q.surface);
    if (csv) *csv = report::points_csv(points, answers, names);
    return report::points_json(points, answers, names, limit);
}

report::LineAnswers answer_lines(const FaceTree& tree, const ProbeOptions& o, const Questions& q,
                                 Context& context) {
    report::LineAnswers answers;
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

Scene run(Scene scene, const ProbeOptions& o, Context& context) {
    const Questions q = questions_of(scene, o, context);
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
        const auto answers = answer_lines(tree, o, q, context);
        const report::FaceNames names(q.surface);
        result = report::lines_json(answers, names, limit);
        if (wants_csv) csv = report::lines_csv(answers, names);
    }
    for (const auto& path : o.to) {
        const std::string text = is_csv(path) ? csv : result.dump(2) + "\n";
        context.output(path.text, std::as_bytes(std::span(text)));
    }
    Json& list = result["answers"];
    while (list.size() > static_cast<std::size_t>(o.list)) list.erase(list.size() - 1);
    context.say(report::probe_summary(result));
    context.result() = std::move(result);
    return scene;
}

const RegisterStage registered = make_stage<ProbeOptions>(
    {.name = "probe",
     .about = "Asks points, segments and rays about the surface: inside or outside, closest face, hits.",
     .details =
         "A point is inside, outside or on the surface, and has a winding number (how often the surface goes "
         "around it), its distance, and the closest point with its part and face. Inside is where the "
         "winding number is not zero; it is decided exactly, by the crossings of a ray with the faces. An "
         "open surface has no inside (W-PROBE-OPEN); distances are measured all the same.\n\n"
         "Segments and rays have hits: t (0 to 1 along a segment, the distance along a ray), the point, part "
         "and face, and whether the line enters there. Whether a line meets a face is decided by exact "
         "signs. A line through an edge or a corner counts as the line beside it, always to the same side, "
         "so a surface that is crossed is crossed once; a line within a face's plane does not meet that "
         "face. An end on the surface is a hit.\n\n"
         "The scene passes on unchanged. World space, scene units. Sources: the notes 'Intersection of a "
         "line segment and a facet' (1999) and 'Determining if a point lies on the interior of a polygon' "
         "(1987).",
     .examples = {"probe: [0, 0, 1]", "probe: {points: probes.csv, to: answers.csv}",
                  "probe: {rays: [0, 0, 9, 0, 0, -1], hits: first}",
                  "probe: {along: NORMAL, reverse: true, to: walls.csv}"}},
    declare_probe, run, {.files = probe_files, .verify = verify_probe});

} // namespace

} // namespace facetmill
