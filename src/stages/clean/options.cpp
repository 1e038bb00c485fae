#include "stages/clean/options.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/transform.hpp"
#include "options/mark_at.hpp"
#include "stage/options/synonyms.hpp"

namespace facetmill::clean_stage {

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
           "triangles between the vertices of the hole, with the smallest dihedral angles and then the "
           "smallest area"},
          {"planar", HoleFill::planar, "a single polygon; only for planar holes"},
          {"smooth", HoleFill::smooth,
           "a patch with new vertices that continues the density and the curvature around the hole"}},
         "The method for filling a hole.")
        .primary();
    d.option("max_edges", &CleanHoleOptions::max_edges, "Holes with more edges stay open. 0 means no limit.")
        .at_least(0);
    d.option("max_length", &CleanHoleOptions::max_length, "Holes with a longer boundary loop stay open.")
        .above(0);
}

void declare_components(Declare<CleanComponentOptions>& d) {
    d.option("min_faces", &CleanComponentOptions::min_faces, "Components with fewer faces are removed.")
        .at_least(0)
        .primary();
    d.option("min_size", &CleanComponentOptions::min_size,
             "Components whose bounding box has a shorter diagonal are removed.")
        .above(0);
    d.option("min_area", &CleanComponentOptions::min_area,
             "Components with a smaller share of the part's area are removed.")
        .at_most(1);
    d.option("keep", &CleanComponentOptions::keep,
             "At most this many components are kept, the largest by area. 0 keeps all.")
        .at_least(0);
}

/// The options that remove whole components, or faces that nobody sees.
void declare_removal(Declare<CleanOptions>& d) {
    d.group("components", &CleanOptions::components, "Removes small components. By default, all are kept.",
            declare_components)
        .also_called(property_named("components")->also_called)
        .also_called("keep_largest largest largest_component", "components: {keep: 1}")
        .also_called("smaller_than min_size small tiny remove_small", "components: {min_size: 2mm}");
    d.option("hidden", &CleanOptions::hidden,
             "Removes faces that no ray from outside reaches, because parts of the scene hide them.")
        .also_called("remove_hidden invisible remove_invisible interior remove_interior occluded");
    d.option("gap", &CleanOptions::gap,
             "With hidden: openings wider than this count as open. Default: 1% of the scene's diagonal.")
        .above(0);
    d.option("open_components", &CleanOptions::open_components,
             "Removes components that stay open, such as sheets and fins on a solid, if closed components "
             "remain.");
    d.option("inner_components", &CleanOptions::inner_components,
             "Removes closed components inside other components.");
}

/// A choice that also accepts true and false.
void declare_self_intersections(Declare<CleanOptions>& d) {
    Option& o =
        d.choice<Untangle>(
             "self_intersections", &CleanOptions::self_intersections,
             {{"off", Untangle::off, "keep intersecting faces (also: false)"},
              {"local", Untangle::local,
               "replace intersecting faces region by region, if that resolves the intersection"},
              {"union", Untangle::unite,
               "combine closed components that pass through each other or themselves into a single solid, "
               "exactly"},
              {"all", Untangle::all, "union, then local for the remaining intersections (also: true)"}},
             "How to handle intersecting faces.")
            .also_called(property_named("self_intersections")->also_called)
            .option();
    o.parse = [plain = o.parse](const Option& self, const Value& v, void* target, Problems& problems) {
        const auto yes = v.is_scalar() && !v.deferred ? v.as_bool() : std::nullopt;
        if (!yes) return plain(self, v, target, problems);
        static_cast<CleanOptions*>(target)->self_intersections = *yes ? Untangle::all : Untangle::off;
        return true;
    };
    o.schema = {{"anyOf", Json::array({o.schema, {{"type", "boolean"}}})}};
    o.may_be_true = true;
}

} // namespace

void declare_clean(Declare<CleanOptions>& d) {
    d.choice<Nearness>(
         "weld", &CleanOptions::weld,
         nearness(
             "vertices at exactly the same position",
             "also the ends of boundary edges within `tolerance` of each other, except corners of one face"),
         "Merges vertices. Seams are preserved because the attributes stay separate.")
        .also_called(weld_synonyms);
    d.option("degenerate", &CleanOptions::degenerate,
             "Removes repeated corners and faces of exactly zero area, and closes the resulting gaps.");
    d.option(
         "duplicates", &CleanOptions::duplicates,
         "Keeps one of several faces with the same vertices. Removes inner walls made of two opposite faces.")
        .also_called("remove_duplicates remove_doubles dedup");
    d.option("walls", &CleanOptions::walls,
             "Removes one or both faces of each pair with the same vertices and opposite orientation, such "
             "as an inner wall. false keeps both, for example on leaves, cloth and panels.");
    d.choice<Nearness>("t_junctions", &CleanOptions::t_junctions,
                       nearness("if a vertex is exactly on a boundary edge",
                                "also if a vertex is within `tolerance` of a boundary edge"),
                       "Closes cracks between a long boundary edge and several shorter ones, by inserting "
                       "their vertices into the long edge.");
    d.choice<Nearness>("stitch", &CleanOptions::stitch,
                       nearness("boundary edges at exactly the same position",
                                "boundary edges whose ends are within `tolerance` of each other"),
                       "Joins boundary edges that run in opposite directions.");
    d.option("non_manifold", &CleanOptions::non_manifold,
             "Separates edges with more than two faces, and vertices that connect several fans of faces.");
    declare_self_intersections(d);
    d.group("holes", &CleanOptions::holes,
            "Fills holes: true, or a map of options. By default, holes stay open.", declare_holes)
        .also_called("fill_holes close_holes fill fill_hole", "holes: {method: smooth}")
        .option()
        .may_be_true = true;
    declare_removal(d);
    d.option("isolated", &CleanOptions::isolated,
             "Removes vertices that no face uses. The points of point clouds are kept.")
        .also_called("remove_unreferenced remove_isolated unreferenced");
    d.option("tolerance", &CleanOptions::tolerance, "The distance for all steps that are set to near.")
        .above(0);
    d.option("unit_vectors", &CleanOptions::unit_vectors,
             "Scales normals and tangents to length 1, and the joint weights of each wedge to the sum 1, as "
             "normals: keep does.")
        .also_called("normalize normalise normalize_weights renormalize");
    d.choice<bool>("precision", &CleanOptions::single,
                   {{"full", false, "64-bit floats"},
                    {"single", true,
                     "32-bit floats, as in glTF, STL and most PLY files, so that the result stays correct in "
                     "such files. If rounding causes intersections in a mesh without any, they are resolved "
                     "as by self_intersections: all"}},
                   "The precision of vertex coordinates.");
    d.option("apart", &CleanOptions::apart,
             "With precision: single, moves separated vertices at the same position by a few steps of 32-bit "
             "floats, so that they differ. Formats and programs that merge equal positions, such as STL and "
             "slicers, then keep them separate.");
}

CleanSettings clean_steps_of(const CleanOptions& o) {
    CleanSettings s;
    s.weld = o.weld;
    s.stitch = o.stitch;
    s.t_junctions = o.t_junctions;
    s.degenerate = o.degenerate;
    s.duplicates = o.duplicates;
    s.walls = o.walls;
    s.non_manifold = o.non_manifold;
    s.isolated = o.isolated;
    s.open_components = o.open_components;
    s.inner_components = o.inner_components;
    s.self_intersections = o.self_intersections;
    s.single = o.single;
    s.apart = o.apart;
    if (o.holes) s.holes = HoleSettings{o.holes->method, static_cast<std::size_t>(o.holes->max_edges)};
    if (o.components)
        s.components =
            ComponentSettings{.min_faces = static_cast<std::size_t>(o.components->min_faces),
                              .min_area = o.components->min_area ? o.components->min_area->value : 0,
                              .keep = static_cast<std::size_t>(o.components->keep)};
    return s;
}

CleanSettings clean_settings(const CleanOptions& o, const Scene& scene, const Part& part, Context& context) {
    const double stretch = mean_stretch(part.transform);
    const auto local = [&](const std::optional<Length>& l, const char* option) {
        return l ? context.resolve(*l, scene, option, &part) / stretch : 0;
    };
    CleanSettings s = clean_steps_of(o);
    s.tolerance = local(o.tolerance, "tolerance");
    if (o.holes) s.holes->max_length = local(o.holes->max_length, "holes.max_length");
    if (o.components) s.components->min_size = local(o.components->min_size, "components.min_size");
    return s;
}

void verify_clean(const CleanOptions& o, const Value& given, Problems& problems) {
    const bool near =
        o.weld == Nearness::near || o.stitch == Nearness::near || o.t_junctions == Nearness::near;
    if (near && !o.tolerance)
        problems.add(given.mark, "E-MISSING", "clean: near needs a tolerance", "give it: tolerance: 0.01%");
    if (!near && o.tolerance)
        add_refusal(Refusal{"tolerance", "'tolerance' has no effect, because no step is set to near",
                            "weld: near, stitch: near or t_junctions: near"},
                    "clean", given, problems);
    const bool may_move = o.single && o.non_manifold && o.weld != Nearness::off;
    if (o.apart && !may_move && given.find("apart"))
        add_refusal(
            Refusal{"apart",
                    "'apart' has no effect, because it needs precision: single, weld and non_manifold",
                    "use precision: single, with weld and non_manifold on"},
            "clean", given, problems);
    if (o.gap && !o.hidden)
        add_refusal(Refusal{"gap", "'gap' needs hidden: true", "add hidden: true"}, "clean", given, problems);
    const auto& c = o.components;
    if (c && c->min_faces == 0 && !c->min_size && !c->min_area && c->keep == 0)
        problems.add(given.mark, "E-MISSING", "clean: components needs a limit for small components",
                     "components: {min_faces: 100}, {min_size: 1%}, {min_area: 1%} or {keep: 1}");
}

} // namespace facetmill::clean_stage
