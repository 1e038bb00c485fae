#include "geometry/inspect/connectivity.hpp"
#include "stages/probe/help.hpp"
#include "stages/probe/questions.hpp"
#include "stages/probe/report.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

ProbeReport answer_points(const FaceTree& tree, const Scene& scene, const ProbeOptions& o, const Questions& q,
                          std::string* csv, std::size_t limit, Context& context) {
    PointSettings settings;
    settings.tolerance = context.resolve(o.tolerance, scene, "tolerance");
    std::vector<std::string> open;
    for (const Part* part : q.surface)
        if (count_links(part->mesh).uncancelled_edges != 0) open.push_back(part->name);
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
    const Questions q = questions_of(scene, o, context);
    const FaceTree tree(surface_of(q.surface));
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
    const Fields fields = fields_of<ProbeReport>(declare_probe_report);
    for (const auto& path : o.path) {
        const std::string text = is_csv(path) ? csv : fields.json(&report).dump(2) + "\n";
        context.output(path.text, std::as_bytes(std::span(text)));
    }
    if (report.answers.size() > static_cast<std::size_t>(o.max_answers))
        report.answers.resize(static_cast<std::size_t>(o.max_answers));
    return scene;
}

const RegisterStage registered = make_stage<ProbeOptions>(
    {.name = "probe",
     .about = help::probe::about,
     .details = help::probe::details,
     .examples = {"probe: [0, 0, 1]", "probe: {points: probes.csv, path: answers.csv}",
                  "probe: {rays: [0, 0, 9, 0, 0, -1], hits: first}",
                  "probe: {along: NORMAL, reverse: true, path: walls.csv}"}},
    declare_probe, declare_probe_report, run, {.files = probe_files, .verify = verify_probe});

} // namespace

} // namespace facetmill
