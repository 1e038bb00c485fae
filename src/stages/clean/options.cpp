#include "stages/clean/options.hpp"

#include "mesh/stretch.hpp"

namespace facetmill {

namespace {

std::vector<NamedChoice<Nearness>> nearness(const char* exact, const char* near) {
    return {{"off", Nearness::off, "not at all"},
            {"exact", Nearness::exact, exact},
            {"near", Nearness::near, near}};
}

void declare_holes(Declare<CleanHoleOptions>& d) {
    d.choice<HoleFill>(
         "method", &CleanHoleOptions::method,
         {{"minimal", HoleFill::minimal,
           "triangles between the vertices of the outline, of least bend and area"},
          {"planar", HoleFill::planar, "the outline as a polygon; only where it lies in a plane"},
          {"smooth", HoleFill::smooth, "with new vertices, as dense as around the hole and curved as it"}},
         "What a hole is filled with.")
        .primary();
    d.option("edges", &CleanHoleOptions::edges, "Holes with more edges stay (a count); 0: no limit.")
        .at_least(0);
    d.option("length", &CleanHoleOptions::length, "Holes with a longer outline stay.").above(0);
}

void declare_components(Declare<CleanComponentOptions>& d) {
    d.option("faces", &CleanComponentOptions::faces, "Pieces of fewer faces go (a count).")
        .at_least(0)
        .primary();
    d.option("size", &CleanComponentOptions::size, "Pieces whose box has a shorter diagonal go.").above(0);
    d.option("area", &CleanComponentOptions::area, "Pieces with a smaller share of the part's area go.")
        .at_most(1);
    d.option("keep", &CleanComponentOptions::keep,
             "Only so many pieces stay, those of largest area (a count); 0: all.")
        .at_least(0);
}

/// A choice for which true and false are spellings, too.
void declare_self_intersections(Declare<CleanOptions>& d) {
    Option& o = d.choice<Untangle>("self_intersections", &CleanOptions::self_intersections,
                                   {{"off", Untangle::off, "not at all (also: false)"},
                                    {"local", Untangle::local,
                                     "faces that intersect are replaced place by place, where that ends it"},
                                    {"union", Untangle::unite,
                                     "closed pieces that pass through each other or themselves become one "
                                     "solid, exactly"},
                                    {"all", Untangle::all, "union, then local for the rest (also: true)"}},
                                   "What becomes of faces that intersect.")
                    .option();
    o.parse = [plain = o.parse](const Option& self, const Value& v, void* target, Problems& problems) {
        const auto yes = v.is_scalar() && !v.deferred ? v.as_bool() : std::nullopt;
        if (!yes) return plain(self, v, target, problems);
        static_cast<CleanOptions*>(target)->self_intersections = *yes ? Untangle::all : Untangle::off;
        return true;
    };
    o.schema = {{"anyOf", Json::array({o.schema, {{"type", "boolean"}}})}};
}

} // namespace

void declare_clean(Declare<CleanOptions>& d) {
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
    declare_self_intersections(d);
    d.group("holes", &CleanOptions::holes, "Fills holes; without it they stay.", declare_holes);
    d.group("components", &CleanOptions::components, "Removes small pieces; without it they stay.",
            declare_components);
    d.option("shells", &CleanOptions::shells, "Removes closed pieces that lie inside others.");
    d.option("isolated", &CleanOptions::isolated, "Removes vertices that no face uses.");
    d.option("within", &CleanOptions::within, "How near `near` is.").above(0);
}

CleanSettings clean_settings(const CleanOptions& o, const Scene& scene, const Part& part, Context& context) {
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

void verify_clean(const CleanOptions& o, const Value& given, Problems& problems) {
    const bool near =
        o.weld == Nearness::near || o.stitch == Nearness::near || o.t_vertices == Nearness::near;
    if (near && !o.within)
        problems.add(given.mark, "E-MISSING", "clean: near needs a length", "within: 0.01% (or 0.1mm)");
    if (!near && o.within)
        problems.add(given.mark, "E-CONFLICT", "clean: within has no effect on exact steps",
                     "weld: near, stitch: near or t_vertices: near");
    const auto& c = o.components;
    if (c && c->faces == 0 && !c->size && !c->area && c->keep == 0)
        problems.add(given.mark, "E-MISSING", "clean: components needs to know which are small",
                     "components: {faces: 100}, {size: 1%}, {area: 1%} or {keep: 1}");
}

} // namespace facetmill
