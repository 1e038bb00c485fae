#include "geometry/split.hpp"

#include "base/functions.hpp"
#include "mesh/placement.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

using Cut = SplitSettings::Cut;
using Method = std::optional<SplitMethod>; ///< none: midpoint, or bisect with a target

struct SplitOptions {
    Method method;
    std::optional<std::int64_t> grid, passes, faces;
    Cut cut = Cut::longest_edge;
    std::optional<Length> max_edge;
    std::optional<Angle> min_angle, creases;

    bool has_target() const { return max_edge || min_angle || faces; }
    SplitMethod chosen() const {
        return grid ? SplitMethod::grid
                    : method.value_or(has_target() ? SplitMethod::bisect : SplitMethod::midpoint);
    }
};

const std::vector<NamedChoice<Method>> methods = {
    {"midpoint", SplitMethod::midpoint,
     "edges halved: a triangle becomes 4 triangles, a quad 4 quads, an n-gon n quads; no finer angles"},
    {"bisect", SplitMethod::bisect,
     "triangles in 2 at their longest edge, in 3 or 4 where neighbours cut the other edges; see cut"},
    {"notch", SplitMethod::notch,
     "triangles between the middles of their two longest edges: a triangle and a quad; four triangles where "
     "the third edge is cut too"},
    {"centroid", SplitMethod::centroid,
     "triangles from every edge to the centroid: a triangle becomes 3, a quad 4"},
    {"core", SplitMethod::core,
     "the same shape at half size and a quad along every edge: a triangle becomes 4 faces"},
    {"quads", SplitMethod::quads, "quads around the centroid: a triangle becomes 3, a quad 4"},
    {"halve", SplitMethod::halve,
     "quads in 2 between the middles of their longer opposite edges; neighbours of those edges are cut too"},
    {"varignon", SplitMethod::varignon,
     "the polygon of the edges' midpoints and a triangle at every corner: a quad becomes 5 faces"},
    {"diagonal", SplitMethod::diagonal,
     "quads in 2 triangles along their shorter diagonal, concave ones along the inner one"},
    {"fan", SplitMethod::fan, "quads and larger in triangles to the centroid: a quad becomes 4"},
    {"grid", SplitMethod::grid, "triangles in n * n triangles, quads in n x n quads; see grid"},
    {"loop", SplitMethod::loop, "smooth: triangles in 4, the surface approaches a box spline"},
    {"sqrt3", SplitMethod::sqrt3, "smooth: triangles in 3 and turned; nine times as many in two passes"},
    {"butterfly", SplitMethod::butterfly, "smooth, through the old vertices: triangles in 4"},
    {"catmull-clark", SplitMethod::catmull_clark, "smooth: every face in quads; a quad becomes 4"}};

void declare(Declare<SplitOptions>& d) {
    d.choice<Method>("method", &SplitOptions::method, methods,
                     "How faces are split; midpoint unless given, bisect with a target.")
        .primary();
    d.option("grid", &SplitOptions::grid,
             "How many pieces each edge is cut into (a count); every face becomes n x n. Implies the method "
             "grid.")
        .between(1, 10000);
    d.option("passes", &SplitOptions::passes,
             "How many times the split is repeated (a count; 1 unless given); with max_edge or faces, how "
             "many times at most (100 unless given). A max_edge that is not reached is warned of.")
        .between(0, 100);
    d.choice<Cut>("cut", &SplitOptions::cut,
                  {{"longest-edge", Cut::longest_edge, "in the middle of the longest edge"},
                   {"widest-angle", Cut::widest_angle,
                    "where the bisector of the widest angle meets the edge opposite to it; not with a "
                    "target, which such cuts may never reach"}},
                  "Where bisect cuts a triangle.");
    d.option("max_edge", &SplitOptions::max_edge,
             "Split until no edge is longer (a length): with bisect only where it is needed, with midpoint, "
             "quads, loop, butterfly and catmull-clark everywhere.")
        .above(0);
    d.option("min_angle", &SplitOptions::min_angle,
             "Split only triangles that have a smaller angle (an angle), by bisect or notch, and neighbours "
             "that must follow, passes times. With bisect no angle becomes smaller than half the smallest "
             "there was.")
        .above(0)
        .at_most(60);
    d.option("faces", &SplitOptions::faces,
             "Never more faces than this (a count, for all parts together): bisect cuts the longest edges "
             "first, other methods stop before the pass that would exceed it.")
        .at_least(1);
    d.option("creases", &SplitOptions::creases,
             "Smooth methods: edges that bend by more than this stay sharp (an angle; only boundaries do "
             "unless given).")
        .between(0, 180);
}

void verify(const SplitOptions& o, const Value& given, Problems& problems) {
    const auto mark = [&](const char* name) {
        const Value* value = given.is_map() ? given.find(name) : &given;
        return value ? value->mark : given.mark;
    };
    const SplitMethod method = o.chosen();
    if (o.grid && o.method && o.method != SplitMethod::grid)
        problems.add(mark("method"), "E-EXCLUSIVE", "split: 'grid' goes with the method grid only",
                     "leave out either method or grid");
    if (o.method == SplitMethod::grid && !o.grid)
        problems.add(given.mark, "E-MISSING",
                     "split: the method grid needs 'grid', the number of pieces per edge",
                     "for example split: {grid: 3}");
    if (o.cut != Cut::longest_edge && method != SplitMethod::bisect)
        problems.add(mark("cut"), "E-EXCLUSIVE",
                     fmt::format("split: 'cut' goes with the method bisect, not with {}", spelled(method)));
    if (o.cut != Cut::longest_edge && o.has_target())
        problems.add(
            mark("cut"), "E-EXCLUSIVE",
            fmt::format("split: 'cut: widest-angle' does not go with the target '{}', which its cuts "
                        "may never reach",
                        o.max_edge    ? "max_edge"
                        : o.min_angle ? "min_angle"
                                      : "faces"),
            "leave out cut, or give passes and no target");
    if (o.creases && (!is_smooth(method) || method == SplitMethod::sqrt3))
        problems.add(mark("creases"), "E-EXCLUSIVE",
                     fmt::format("split: 'creases' goes with loop, butterfly and catmull-clark, not with {}",
                                 spelled(method)));
    if (o.min_angle && (o.max_edge || o.faces))
        problems.add(mark("min_angle"), "E-EXCLUSIVE", "split: 'min_angle' goes with no other target",
                     "use two split stages");
    try {
        SplitSettings s;
        s.method = method;
        s.max_edge = o.max_edge ? 1 : 0, s.min_angle = o.min_angle && !o.max_edge && !o.faces ? 1 : 0;
        check_split_targets(s);
    } catch (const Error& e) {
        const auto& d = e.diagnostics().front();
        problems.add(mark(o.max_edge ? "max_edge" : "min_angle"), d.id, d.message, d.hint);
    }
}

/// The part's share of the faces that all selected parts may have.
std::uint64_t share(const SplitOptions& o, const Part& part, double total) {
    if (!o.faces) return 0;
    const double mine = static_cast<double>(part.mesh.face_count());
    return std::max<std::uint64_t>(
        1, static_cast<std::uint64_t>(static_cast<double>(*o.faces) * (total > 0 ? mine / total : 1)));
}

/// split, whose refusals name the part.
SplitResult split_part(const Part& part, const SplitSettings& settings) {
    try {
        return split(part.mesh, settings);
    } catch (const Error& e) {
        auto diagnostics = e.diagnostics();
        for (auto& d : diagnostics)
            if (e.kind() == ErrorKind::stage) d.message += fmt::format(" (part '{}')", part.name);
        throw Error(e.kind(), std::move(diagnostics));
    }
}

const char* stopped_by(const SplitOptions& o, SplitResult::Stop stop) {
    switch (stop) {
    case SplitResult::Stop::passes:
        return "passes";
    case SplitResult::Stop::target:
        return o.max_edge ? "max_edge" : "min_angle";
    case SplitResult::Stop::budget:
        return "faces";
    case SplitResult::Stop::nothing:
        break;
    }
    return "nothing";
}

/// Says which target was not reached.
void warn_of_targets(const Part& part, const SplitResult& r, const SplitSettings& s, double longest,
                     Context& context) {
    const bool out_of_room = r.stop == SplitResult::Stop::budget;
    if (out_of_room && r.added == 0)
        context.warn(
            "W-SPLIT-NOTHING",
            fmt::format("part '{}' has {} faces, and its share of the target is {}: nothing is split",
                        part.name, part.mesh.face_count(), s.faces),
            "give a larger target; simplify makes fewer faces");
    else if (s.max_edge > 0 && r.stop != SplitResult::Stop::target)
        context.warn(
            "W-SPLIT-STOPPED",
            fmt::format("part '{}' has edges of {:.4g} left, above max_edge {:.4g}: {} ended the split",
                        part.name, longest, s.max_edge,
                        out_of_room ? std::string("faces") : fmt::format("passes ({})", s.passes)),
            out_of_room ? "allow more faces, or a longer max_edge"
                        : "allow more passes, or a longer max_edge");
}

/// Says where faces cannot be split as well as the stage promises.
void warn_of_spots(const Part& part, const SplitResult& r, SplitMethod method, Context& context) {
    if (r.folded > 0)
        context.warn(
            "W-SPLIT-FOLDED",
            fmt::format("in part '{}' {} faces are concave or cross themselves: pieces that {} makes "
                        "of them lie over each other",
                        part.name, r.folded, spelled(method)),
            "triangulate before it, or 'split: diagonal' for quads");
    if (r.shared > 0)
        context.warn("W-SPLIT-SHARED",
                     fmt::format("in part '{}' faces share two edges at {} places: their new edges there "
                                 "coincide and have more than two faces",
                                 part.name, r.shared),
                     "clean removes doubled faces; 'split: centroid' makes no such edges");
}

Json described(const SplitOptions& o, const Part& part, const SplitResult& r, const FacetShape& before,
               const FacetShape& after) {
    const auto degrees = [](double radians) { return radians * (180 / pi); };
    return {{"part", part.name},
            {"added_faces", r.added},
            {"passes", r.passes},
            {"stopped_by", stopped_by(o, r.stop)},
            {"longest_edge", {{"before", before.longest_edge}, {"after", after.longest_edge}}},
            {"smallest_angle",
             {{"before", degrees(before.smallest_angle)}, {"after", degrees(after.smallest_angle)}}}};
}

Scene run(Scene scene, const SplitOptions& o, Context& context) {
    SplitSettings settings;
    settings.method = o.chosen();
    settings.passes = static_cast<int>(o.passes.value_or(o.max_edge || o.faces ? 100 : 1));
    settings.grid = static_cast<int>(o.grid.value_or(2));
    settings.cut = o.cut;
    if (o.min_angle) settings.min_angle = o.min_angle->radians;
    if (o.creases) settings.creases = o.creases->radians;
    double total = 0;
    for (const Part& part : scene.parts)
        if (context.selects(part, scene)) total += static_cast<double>(part.mesh.face_count());
    std::size_t added = 0;
    Json parts = Json::array();
    context.for_each_part(scene, [&](Part& part) {
        if (o.max_edge) settings.max_edge = context.resolve(*o.max_edge, scene, "max_edge", &part);
        if (o.max_edge && settings.max_edge <= 0) settings.passes = 0; // a percentage of a single point
        settings.faces = share(o, part, total);
        settings.to_world = effective(part);
        const FacetShape before = facet_shape(part.mesh, settings.to_world);
        SplitResult result = split_part(part, settings);
        part.mesh = std::move(result.mesh);
        added += result.added;
        const FacetShape after = facet_shape(part.mesh, settings.to_world);
        warn_of_targets(part, result, settings, after.longest_edge, context);
        warn_of_spots(part, result, settings.method, context);
        parts.push_back(described(o, part, result, before, after));
        context.ledger(part, result.fates);
    });
    context.result()["added_faces"] = added;
    context.result()["parts"] = std::move(parts);
    return scene;
}

const RegisterStage split_stage = make_stage<SplitOptions>(
    {.name = "split",
     .about = "Splits faces into smaller ones, without cracks.",
     .details =
         "The surface stays where it is and becomes finer; the smooth methods move it. A point on an edge is "
         "one vertex for all faces at that edge, on open, closed and non-manifold meshes, so there are no "
         "cracks and no T-vertices, and closed stays closed. Euler's number and manifoldness stay too, but "
         "where two faces share two edges: new edges across such a corner are one edge of both and have more "
         "than two faces (W-SPLIT-SHARED has the count). varignon leaves such corners whole, diagonal takes "
         "the other diagonal where it can. Seams stay seams: there is one new wedge per edge and pair of "
         "wedges.\n\n"
         "Concave quads are cut to a point that all of the quad is seen from, but for halve, varignon and "
         "grid; there, and in concave faces of five corners and more, pieces may lie over each other "
         "(W-SPLIT-FOLDED has the count).\n\n"
         "Where a method cuts some edges of a face only, neighbours follow: bisect cuts every triangle with "
         "a "
         "cut edge at its longest edge too (Rivara's rule), into two, three or four; notch and halve cut a "
         "neighbouring triangle to the opposite corner, in a triangle and a quad, or in four, and a "
         "neighbouring quad in up to four. Between passes of notch quads are cut along a diagonal. Methods "
         "for triangles or quads only refuse larger faces by number "
         "(E-POLYGON).\n\n"
         "Smooth methods need a manifold, consistently oriented mesh (E-MANIFOLD says where it is not). "
         "Boundaries and creases become smooth curves; corners of three or more creases stay.\n\n"
         "Vertex and wedge attributes are interpolated, face attributes are copied to the faces that replace "
         "a face; after smooth methods normals are recomputed. Old vertices keep their numbers. A result of "
         "more than 2^31 corners (E-LIMIT) or more than there is memory for (E-MEMORY) is refused before "
         "anything is built. Targets end at passes at the latest; the report says what stopped the "
         "split (passes, max_edge, min_angle or faces), and W-SPLIT-STOPPED and W-SPLIT-NOTHING tell of "
         "targets that were not reached. The report has the longest edge and the smallest angle before and "
         "after, in world units and degrees.\n\n"
         "Sources: the note 'Splitting facets' (1991); M.-C. Rivara (1984), I. Rosenberg and F. Stenger "
         "(1975); C. Loop (1987), L. Kobbelt (2000), D. Zorin, P. Schroeder and W. Sweldens (1996), E. "
         "Catmull and J. Clark (1978), H. Hoppe and others (1994) for creases.",
     .examples = {"split: midpoint", "split: {method: bisect, passes: 3}", "split: {grid: 3}",
                  "split: {max_edge: 2%}", "split: {method: loop, passes: 2, creases: 30deg}"}},
    declare, run, StageHooks<SplitOptions>{.files = {}, .verify = verify});

} // namespace

} // namespace facetmill
