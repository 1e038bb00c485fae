#include "geometry/clean.hpp"

#include "geometry/stretch.hpp"
#include "mesh/placement.hpp"
#include "report/clean_json.hpp"
#include "report/summary.hpp"
#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

struct HoleOptions {
    HoleFill method = HoleFill::minimal;
    std::int64_t edges = 0;
    std::optional<Length> length;
};

struct ComponentOptions {
    std::int64_t faces = 0;
    std::optional<Length> size;
    std::optional<Ratio> area;
    std::int64_t keep = 0;
};

struct CleanOptions {
    Nearness weld = Nearness::exact, stitch = Nearness::off, t_vertices = Nearness::exact;
    bool degenerate = true, duplicates = true, non_manifold = true, isolated = true, shells = false,
         self_intersections = false;
    std::optional<Length> within;
    std::optional<HoleOptions> holes;
    std::optional<ComponentOptions> components;
};

std::vector<NamedChoice<Nearness>> nearness(const char* exact, const char* near) {
    return {{"off", Nearness::off, "not at all"},
            {"exact", Nearness::exact, exact},
            {"near", Nearness::near, near}};
}

void declare_holes(Declare<HoleOptions>& d) {
    d.choice<HoleFill>(
         "method", &HoleOptions::method,
         {{"minimal", HoleFill::minimal,
           "triangles between the vertices of the outline, of least bend and area"},
          {"planar", HoleFill::planar, "the outline as a polygon; only where it lies in a plane"},
          {"smooth", HoleFill::smooth, "with new vertices, as dense as around the hole and curved as it"}},
         "What a hole is filled with.")
        .primary();
    d.option("edges", &HoleOptions::edges, "Holes with more edges stay (a count); 0: no limit.").at_least(0);
    d.option("length", &HoleOptions::length, "Holes with a longer outline stay.").above(0);
}

void declare_components(Declare<ComponentOptions>& d) {
    d.option("faces", &ComponentOptions::faces, "Pieces of fewer faces go (a count).").at_least(0).primary();
    d.option("size", &ComponentOptions::size, "Pieces whose box has a shorter diagonal go.").above(0);
    d.option("area", &ComponentOptions::area, "Pieces with a smaller share of the part's area go.");
    d.option("keep", &ComponentOptions::keep,
             "Only so many pieces stay, those of largest area (a count); 0: all.")
        .at_least(0);
}

void declare(Declare<CleanOptions>& d) {
    d.choice<Nearness>("weld", &CleanOptions::weld,
                       nearness("vertices at exactly the same place become one",
                                "and ends of open edges within `within`, but for corners of one face"),
                       "Merges vertices; attributes stay apart, so seams stay seams.");
    d.option("degenerate", &CleanOptions::degenerate,
             "Removes faces of exactly zero area and repeated corners, and closes what that opens.");
    d.option("duplicates", &CleanOptions::duplicates,
             "Keeps one of the faces with the same vertices; inner walls of two opposite faces go.");
    d.choice<Nearness>(
        "t_vertices", &CleanOptions::t_vertices,
        nearness("a vertex exactly on an open edge is put on it", "and one within `within` of it"),
        "Closes cracks where an open edge faces several shorter ones.");
    d.choice<Nearness>(
        "stitch", &CleanOptions::stitch,
        nearness("open edges at exactly the same place", "open edges whose ends are within `within`"),
        "Joins open edges that run against each other.");
    d.option("non_manifold", &CleanOptions::non_manifold,
             "Takes edges of more than two faces and vertices of several fans apart.");
    d.option("self_intersections", &CleanOptions::self_intersections,
             "Replaces faces that intersect, where that ends the intersection.");
    d.group("holes", &CleanOptions::holes, "Fills holes; without it they stay.", declare_holes);
    d.group("components", &CleanOptions::components, "Removes small pieces; without it they stay.",
            declare_components);
    d.option("shells", &CleanOptions::shells, "Removes closed pieces that lie inside others.");
    d.option("isolated", &CleanOptions::isolated, "Removes vertices that no face uses.");
    d.option("within", &CleanOptions::within, "How near `near` is.").above(0);
}

CleanSettings settings_for(const CleanOptions& o, const Scene& scene, const Part& part, Context& context) {
    // Lengths are in the world, meshes in their own space: a transform that stretches does so by its mean.
    const double stretch = part.skinned ? 1 : mean_stretch(part.transform);
    const auto local = [&](const std::optional<Length>& l, const char* option) {
        return l ? context.resolve(*l, scene, option, &part) / stretch : 0;
    };
    CleanSettings s;
    s.weld = o.weld, s.stitch = o.stitch, s.t_vertices = o.t_vertices;
    s.degenerate = o.degenerate, s.duplicates = o.duplicates, s.non_manifold = o.non_manifold;
    s.isolated = o.isolated, s.shells = o.shells, s.self_intersections = o.self_intersections;
    s.within = local(o.within, "within");
    if (o.holes)
        s.holes = HoleSettings{o.holes->method, static_cast<std::size_t>(o.holes->edges),
                               local(o.holes->length, "holes.length")};
    if (o.components)
        s.components = ComponentSettings{
            static_cast<std::size_t>(o.components->faces), local(o.components->size, "components.size"),
            o.components->area ? o.components->area->value : 0, static_cast<std::size_t>(o.components->keep)};
    return s;
}

void warn(const Part& part, const std::vector<NotDone>& all, Context& context) {
    if (all.empty()) return;
    context.warn("W-CLEAN",
                 fmt::format("clean: {} repairs of part '{}' were not done, the first in step '{}': {}",
                             all.size(), part.name, all[0].step, all[0].why),
                 "the report lists the first of them with their places");
}

Scene run(Scene scene, const CleanOptions& o, Context& context) {
    Json parts = Json::array();
    context.for_each_part(scene, [&](Part& part) {
        CleanResult r = clean(std::move(part.mesh), settings_for(o, scene, part, context));
        part.mesh = std::move(r.mesh);
        context.ledger(part, r.fates);
        warn(part, r.not_done, context);
        Json entry = {{"part", part.name}, {"changed", r.counts.total() > 0}};
        entry.update(report::counts_json(r.counts));
        entry["not_done"] = report::not_done_json(r.not_done, effective(part));
        parts.push_back(std::move(entry));
    });
    context.result()["parts"] = std::move(parts);
    context.say(report::counts_summary(context.result(), "nothing to mend"));
    return scene;
}

void verify(const CleanOptions& o, const Value& given, Problems& problems) {
    const bool near =
        o.weld == Nearness::near || o.stitch == Nearness::near || o.t_vertices == Nearness::near;
    if (near && !o.within)
        problems.add(given.mark, "E-MISSING", "clean: near needs a length", "within: 0.01% (or 0.1mm)");
    if (!near && o.within)
        problems.add(given.mark, "E-CLEAN", "clean: within has no effect on exact steps",
                     "weld: near, stitch: near or t_vertices: near");
    const auto& c = o.components;
    if (c && c->faces == 0 && !c->size && !c->area && c->keep == 0)
        problems.add(given.mark, "E-MISSING", "clean: components needs to know which are small",
                     "components: {faces: 100}, {size: 1%}, {area: 1%} or {keep: 1}");
}

const RegisterStage registered = make_stage<CleanOptions>(
    {.name = "clean",
     .about = "Repairs a mesh step by step, and leaves alone what is sound.",
     .details = "The steps, each on or off: weld, degenerate, duplicates, t_vertices, stitch, "
                "non_manifold, self_intersections, holes, components, shells, isolated; in this order, "
                "and again until nothing changes, so that cleaning twice changes nothing the second time. "
                "Those that need no judgement are on by default. What decides is exact: places, lines and "
                "planes are compared without a tolerance, unless a step is near.\n\n"
                "Faces that no step concerns keep their corners, attributes and order. Removing faces "
                "without area puts the vertices on their line onto the edges around, so that what was "
                "closed stays closed. Duplicate faces that look both ways go when they are a wall inside "
                "or a fin on other faces, and one of each stays when they are a sheet of their own (both, "
                "beside other pieces of a closed surface: it stays closed). Where more than two faces "
                "meet at an edge, those stay together that have the inside between them. Faces that "
                "intersect are replaced place by place, if need be with up to four rings around them: "
                "where that would open the surface, change its topology, take half of a piece or leave an "
                "intersection, the place is left as it was. Holes that touch at a vertex are filled each "
                "for itself. A hole whose patch would not fit, or whose neighbours disagree about the "
                "outside (orient first), is left. What is left is named in the report (W-CLEAN).\n\n"
                "Attributes of what stays are kept; at new vertices they are interpolated, and patches "
                "copy the face attributes from across their edge. The report counts what each step did.",
     .examples = {"clean", "clean: {holes: minimal, components: {faces: 10}}",
                  "clean: {weld: near, stitch: near, within: 0.01%}",
                  "clean: {holes: {method: smooth, edges: 50}, shells: true}"}},
    declare, run, StageHooks<CleanOptions>{.files = {}, .verify = verify});

} // namespace

} // namespace facetmill
