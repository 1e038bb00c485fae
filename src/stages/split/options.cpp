#include "stages/split/options.hpp"

#include "options/mark_at.hpp"

#include <fmt/format.h>

namespace facetmill::split_stage {

namespace {

using Cut = SplitSettings::Cut;
using Method = std::optional<SplitMethod>;

const std::vector<NamedChoice<Method>> methods = {
    {to_string(SplitMethod::midpoint), SplitMethod::midpoint,
     "at the midpoints of edges: a triangle becomes 4 triangles, a quad 4 quads, an n-gon n quads; angles of "
     "triangles do not become smaller"},
    {to_string(SplitMethod::bisect), SplitMethod::bisect,
     "triangles into 2 at their longest edge, or into 3 or 4 if neighbours cut the other edges; see cut"},
    {to_string(SplitMethod::notch), SplitMethod::notch,
     "triangles between the midpoints of their two longest edges, into a triangle and a quad; into 4 "
     "triangles if the third edge is cut as well"},
    {to_string(SplitMethod::centroid), SplitMethod::centroid,
     "into triangles from every edge to the centroid: a triangle becomes 3, a quad 4"},
    {to_string(SplitMethod::core), SplitMethod::core,
     "into the same shape at half size and a quad along every edge: a triangle becomes 4 faces"},
    {to_string(SplitMethod::quads), SplitMethod::quads,
     "into quads around the centroid: a triangle becomes 3, a quad 4"},
    {to_string(SplitMethod::halve), SplitMethod::halve,
     "quads into 2 between the midpoints of their longer opposite edges; neighbours at those edges are cut "
     "as well"},
    {to_string(SplitMethod::varignon), SplitMethod::varignon,
     "into the polygon of edge midpoints and a triangle at every corner: a quad becomes 5 faces"},
    {to_string(SplitMethod::diagonal), SplitMethod::diagonal,
     "quads into 2 triangles along their shorter diagonal, concave quads along the inner diagonal"},
    {to_string(SplitMethod::fan), SplitMethod::fan,
     "quads and larger faces into triangles to the centroid: a quad becomes 4"},
    {to_string(SplitMethod::grid), SplitMethod::grid,
     "triangles into n * n triangles, quads into n x n quads; see grid"},
    {to_string(SplitMethod::loop), SplitMethod::loop,
     "smooth: triangles into 4; the surface approaches a box spline"},
    {to_string(SplitMethod::sqrt3), SplitMethod::sqrt3,
     "smooth: triangles into 3, with edges flipped; two passes make nine times as many"},
    {to_string(SplitMethod::butterfly), SplitMethod::butterfly,
     "smooth, interpolating the existing vertices: triangles into 4"},
    {to_string(SplitMethod::catmull_clark), SplitMethod::catmull_clark,
     "smooth: every face into quads; a quad becomes 4"}};

} // namespace

void declare_split(Declare<SplitOptions>& d) {
    d.choice<Method>("method", &SplitOptions::method, methods,
                     "The method of splitting. Default: midpoint, or bisect with a target.")
        .primary();
    d.option("grid", &SplitOptions::grid,
             "The number of segments for each edge. Every face becomes n x n faces. Implies the method grid.")
        .between(1, 10000);
    d.option("passes", &SplitOptions::passes,
             "The number of passes. Default: 1. With max_edge or max_faces, the maximum number, by default "
             "100. A warning appears if max_edge was not reached.")
        .also_called("iterations levels level depth")
        .between(0, 100);
    d.choice<Cut>("cut", &SplitOptions::cut,
                  {{"longest-edge", Cut::longest_edge, "in the middle of the longest edge"},
                   {"widest-angle", Cut::widest_angle,
                    "where the bisector of the widest angle meets the opposite edge; not with a target, "
                    "because such cuts may never reach it"}},
                  "Where bisect cuts a triangle.");
    d.option("max_edge", &SplitOptions::max_edge,
             "Splits until no edge is longer than this. bisect splits only where needed. midpoint, quads, "
             "loop, butterfly and catmull-clark split everywhere.")
        .also_called("edge_length target_length target_edge_length max_edge_length")
        .above(0);
    d.option("min_angle", &SplitOptions::min_angle,
             "Splits only triangles with a smaller angle than this, by bisect or notch, and neighbours that "
             "must follow. This makes such triangles smaller, not fewer. Another pass runs only if it does "
             "not increase their number, and a warning gives the number that remains. With bisect, no angle "
             "becomes smaller than half of the smallest original angle.")
        .above(0)
        .at_most(60);
    d.option("max_faces", &SplitOptions::max_faces,
             "The maximum number of faces of all parts together. bisect cuts the longest edges first. Other "
             "methods stop before the pass that would exceed it.")
        .at_least(1);
    d.option("feature_angle", &SplitOptions::feature_angle,
             "For smooth methods: edges stay sharp if the normals of their two faces differ by more than "
             "this angle. By default, only boundaries stay sharp.")
        .between(0, 180);
}

void verify_split(const SplitOptions& o, const Value& given, Problems& problems) {
    const SplitMethod method = o.chosen();
    const auto refuse = [&](const std::optional<Refusal>& refusal) {
        add_refusal(refusal, "split", given, problems);
    };
    if (o.grid && o.method && o.method != SplitMethod::grid)
        refuse(Refusal{"grid", "'grid' needs the method grid", "remove either method or grid"});
    if (o.method == SplitMethod::grid && !o.grid)
        problems.add(given.mark, "E-MISSING",
                     "split: the method grid needs 'grid', the number of segments per edge",
                     "for example split: {grid: 3}");
    if (o.cut != Cut::longest_edge && method != SplitMethod::bisect)
        refuse(Refusal{"cut", fmt::format("'cut' needs the method bisect, not {}", to_string(method))});
    if (o.feature_angle && (!is_smooth(method) || method == SplitMethod::sqrt3))
        refuse(
            Refusal{"feature_angle",
                    fmt::format("'feature_angle' needs the method loop, butterfly or catmull-clark, not {}",
                                to_string(method))});
    SplitSettings s;
    s.method = method;
    // Only marks that a target is set, because its length is known only with the scene.
    s.cut = o.cut;
    s.max_edge = o.max_edge ? 1 : 0;
    s.min_angle = o.min_angle ? 1 : 0;
    s.max_faces = o.max_faces ? 1 : 0;
    refuse(check_split_targets(s));
}

SplitSettings split_settings(const SplitOptions& o) {
    SplitSettings settings;
    settings.method = o.chosen();
    settings.passes = static_cast<int>(o.passes.value_or(o.max_edge || o.max_faces ? 100 : 1));
    settings.grid = static_cast<int>(o.grid.value_or(2));
    settings.cut = o.cut;
    if (o.min_angle) settings.min_angle = o.min_angle->radians;
    if (o.feature_angle) settings.feature_angle = o.feature_angle->radians;
    return settings;
}

} // namespace facetmill::split_stage
