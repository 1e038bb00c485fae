// The table of properties. To add one: a row here (with its function, here or among
// geometry/inspect/measures.hpp), and a row in tests/stages/validate_table_test.cpp.
#include "geometry/inspect/measures.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

using namespace inspect_room;
using P = Properties;
using Kind = PropertyKind;

std::optional<double> count_of(const Pairs& pairs) { return static_cast<double>(pairs.size()); }

/// A cavity's front looks into it, which it does not show by itself.
std::optional<double> is_outward_oriented(const Measured& m) {
    if (m.settings.part_of_solid && m.properties.volume.value_or(0) < 0) return 1;
    return inward_faces(m.local).empty() ? 1 : 0;
}

std::optional<double> max_extent(const Measured& m) { return m.world.bounds().longest_side(); }

double boundary_length(const Mesh& mesh) {
    double sum = 0;
    for (const BoundaryChain& c : boundary_chains(mesh)) sum += c.length;
    return sum;
}

double longest_boundary(const Mesh& mesh) {
    double most = 0;
    for (const BoundaryChain& c : boundary_chains(mesh)) most = std::max(most, c.length);
    return most;
}

std::vector<std::string_view> unit_words() {
    std::vector<std::string_view> words;
    for (const Unit u :
         {Unit::unknown, Unit::um, Unit::mm, Unit::cm, Unit::m, Unit::km, Unit::inch, Unit::foot})
        words.push_back(to_string(u));
    return words;
}

std::vector<std::string_view> up_words() {
    return {to_string(UpAxis::unknown), to_string(UpAxis::y), to_string(UpAxis::z)};
}

constexpr const char* fewer_or_more = "simplify reduces their number, split increases it";
constexpr const char* fills_holes = "clean: {weld: near, tolerance: 0.0001%} joins corners that differ by "
                                    "rounding, clean: {holes: minimal} fills "
                                    "holes, orient makes faces consistent";
constexpr const char* non_manifold_hint = "clean separates them (non_manifold)";
constexpr const char* clean_removes = "clean removes them";
constexpr const char* untangles = "clean: {self_intersections: all} unites or replaces intersecting faces";
constexpr const char* cuts_to_size = "transform moves and scales, clip and crop cut off";
constexpr const char* no_stage = "no stage changes it: correct it where the mesh was made";

// Constant, so that stages can be declared from it before main.
constexpr Property table[] = {
    {.name = "vertices",
     .also_called = "points verts vertex_count num_vertices target_vertices",
     .help = "Vertices of the surface, including isolated ones.",
     .hint = fewer_or_more,
     .member = &P::vertices,
     .is_size = true},
    {.name = "wedges",
     .help = "Sets of attribute values at vertices, which glTF calls vertices.",
     .hint = fewer_or_more,
     .member = &P::wedges,
     .is_size = true},
    {.name = "edges",
     .help = "Pairs of vertices that some face runs along.",
     .hint = fewer_or_more,
     .member = &P::edges,
     .is_size = true},
    {.name = "faces",
     .also_called = "polygons polys tris triangles face_count num_faces target_faces target_face_count "
                    "targetfacenum count polycount",
     .help = "Polygons of the surface.",
     .hint = fewer_or_more,
     .member = &P::faces,
     .is_size = true},
    {.name = "triangles",
     .help = "Faces with three corners.",
     .hint = "triangulate cuts polygons into triangles, simplify reduces their number",
     .member = &P::triangles,
     .is_size = true},
    {.name = "lines",
     .help = "Straight lines between two vertices, in parts without faces.",
     .hint = "load: {lines: 1%} makes tubes of them",
     .member = &P::lines,
     .is_size = true,
     .where_any = true},
    {.name = "components",
     .also_called = "shells bodies islands body_count connected_components",
     .help = "Sets of faces connected through vertices.",
     .hint = "clean: {components: {keep: 1}} keeps only the largest, separate makes them parts",
     .member = &P::components,
     .locations = components},
    {.name = "euler",
     .also_called = "euler_number euler_characteristic",
     .help = "V - E + F, without isolated vertices; 2 for a closed surface of genus 0 with one component.",
     .hint = "clean: {holes: minimal} fills holes, simplify: {topology: allow} may close handles",
     .member = &P::euler,
     .locations = non_manifold_locations, // neither open nor a handle
     .evidence = by_boundary,
     .lowest = -HUGE_VAL},
    {.name = "genus",
     .join = Join::sum_if_all,
     .help = "The number of handles, summed over components; applies only to closed, oriented manifolds.",
     .hint = "clean: {holes: minimal} fills holes, simplify: {topology: allow} may close handles",
     .member = &P::genus,
     .locations = uncancelled_edges,
     .evidence = by_boundary},
    {.name = "boundary_loops",
     .also_called = "holes hole_count open_boundaries",
     .help = "Closed chains of boundary edges.",
     .hint = fills_holes,
     .mend = "clean --holes minimal ! orient",
     .member = &P::boundary_loops,
     .locations = uncancelled_edges,
     .evidence = by_boundary},
    {.name = "boundary_edges",
     .also_called = "open_edges border_edges naked_edges",
     .help = "Edges with a face on one side only.",
     .hint = fills_holes,
     .mend = "clean --holes minimal ! orient",
     .member = &P::boundary_edges,
     .locations = uncancelled_edges,
     .evidence = by_boundary},
    {.name = "closed",
     .also_called = "watertight is_watertight water_tight airtight solid is_closed",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "At every edge the directions of its faces cancel.",
     .hint = fills_holes,
     .mend = "clean --holes minimal ! orient",
     .member = &P::closed,
     .soundness = Soundness::surface,
     .locations = uncancelled_edges,
     .evidence = by_boundary,
     .counts_locations = true},
    {.name = "edge_manifold",
     .also_called = "manifold is_manifold 2_manifold",
     .opposite = "non_manifold nonmanifold non_manifold_edges",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "At most two faces at every edge.",
     .hint = non_manifold_hint,
     .mend = "clean",
     .member = &P::edge_manifold,
     .soundness = Soundness::surface,
     .locations = crowded_edges,
     .counts_locations = true},
    {.name = "vertex_manifold",
     .also_called = "manifold is_manifold 2_manifold",
     .opposite = "non_manifold_vertices",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "The faces around every vertex form one fan.",
     .hint = non_manifold_hint,
     .mend = "clean",
     .member = &P::vertex_manifold,
     .soundness = Soundness::surface,
     .locations = vertices_of_several_fans,
     .counts_locations = true},
    {.name = "oriented",
     .also_called = "winding consistent_winding is_winding_consistent",
     .opposite = "flipped",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "Neighbouring faces are oriented consistently.",
     .hint = "orient makes them consistent",
     .mend = "orient",
     .member = &P::oriented,
     .soundness = Soundness::surface,
     .locations = disagreeing_edges,
     .counts_locations = true},
    {.name = "degenerate_faces",
     .also_called = "degenerate degenerates zero_area slivers",
     .help = "Faces of exactly zero area.",
     .hint = clean_removes,
     .mend = "clean",
     .member = &P::degenerate_faces,
     .soundness = Soundness::surface,
     .locations = faces_without_area},
    {.name = "duplicate_faces",
     .also_called = "duplicates doubles",
     .help = "Faces beyond the first with the same vertices.",
     .hint = clean_removes,
     .mend = "clean",
     .member = &P::duplicate_faces,
     .soundness = Soundness::file,
     .locations = repeated_faces},
    {.name = "isolated_vertices",
     .also_called = "unreferenced unreferenced_vertices unused_vertices loose_vertices",
     .help = "Vertices that no face and no line uses.",
     .hint = clean_removes,
     .mend = "clean",
     .member = &P::isolated_vertices,
     .locations = isolated_vertices},
    {.name = "self_intersections",
     .also_called = "self_intersecting self_intersection intersections overlapping_faces",
     .join = Join::sum_if_all,
     .help = "Pairs of faces that intersect, decided exactly; this takes time.",
     .hint = untangles,
     .mend = "clean --self_intersections all",
     .member = &P::self_intersections,
     .costly = true,
     .locations = intersecting_pairs},
    {.name = "touching",
     .join = Join::sum_if_all,
     .help = "Pairs of faces that touch at edges or corners that they do not share, without intersecting "
             "there, decided exactly; this takes as much time.",
     .hint = no_stage,
     .member = &P::touching,
     .costly = true,
     .locations = touching_pairs},
    {.name = "area",
     .kind = Kind::area,
     .help =
         "Surface area. A face that is not planar counts as it is seen along its normal; triangulate makes "
         "more of it.",
     .hint = cuts_to_size,
     .member = &P::area},
    {.name = "volume",
     .kind = Kind::volume,
     .join = Join::sum_if_all,
     .help = "Enclosed volume, negative when inside out; does not apply to open surfaces.",
     .hint = "clean: {holes: minimal} closes open surfaces, orient turns them outward",
     .mend = "clean --holes minimal ! orient",
     .member = &P::volume,
     .locations = uncancelled_edges,
     .evidence = by_boundary,
     .lowest = -HUGE_VAL},
    {.name = "bounds",
     .also_called = "bbox bounding_box aabb extents",
     .kind = Kind::box,
     .join = Join::around,
     .help = "The bounding box: its lowest corner is at least {min: [x, y, z]}, its highest at most {max: "
             "[x, y, z]}.",
     .hint = cuts_to_size,
     .member = &P::bounds,
     .evidence = by_box_corners},
    {.name = "unit",
     .also_called = "units scale_unit convert_to to_unit",
     .kind = Kind::word,
     .join = Join::of_scene,
     .help = "The unit of positions.",
     .hint = "load: {unit: mm} sets it, transform: {unit: mm} converts it",
     .member = &P::unit,
     .evidence = no_evidence,
     .words = unit_words},
    {.name = "up",
     .also_called = "up_axis upaxis y_up z_up",
     .kind = Kind::word,
     .join = Join::of_scene,
     .help = "The axis that points up.",
     .hint = "load: {up: z} sets it, transform: {up: z} rotates the scene",
     .member = &P::up,
     .evidence = no_evidence,
     .words = up_words},
    {.name = "materials",
     .join = Join::of_scene,
     .help = "The number of materials.",
     .hint = no_stage,
     .member = &P::materials,
     .evidence = by_material_names},
    {.name = "parts",
     .join = Join::of_scene,
     .help = "The number of parts.",
     .hint = "merge joins them, separate makes more",
     .member = &P::parts,
     .evidence = by_part_names},

    // The following properties are measured on request.
    {.name = "min_angle",
     .kind = Kind::angle,
     .join = Join::least,
     .help = "The smallest angle of a face.",
     .hint = "relax makes faces more regular",
     .mend = "relax 3",
     .of_faces = smallest_angles,
     .counts_locations = true,
     .highest = 180},
    {.name = "max_angle",
     .kind = Kind::angle,
     .join = Join::most,
     .help = "The largest angle of a face.",
     .hint = "relax makes faces more regular",
     .mend = "relax 3",
     .of_faces = largest_angles,
     .counts_locations = true,
     .highest = 180},
    {.name = "aspect_ratio",
     .kind = Kind::number,
     .join = Join::most,
     .help = "The largest ratio of longest edge to inradius, normalised to 1 for equal sides.",
     .hint = "relax makes faces more regular",
     .mend = "relax 3",
     .of_faces = aspect_ratios,
     .counts_locations = true,
     .lowest = 1},
    {.name = "shortest_edge",
     .kind = Kind::length,
     .join = Join::least,
     .help = "The length of the shortest edge.",
     .hint = "simplify: {method: shortest-edge} removes the shortest edges first",
     .of_faces = shortest_edges,
     .counts_locations = true},
    {.name = "longest_edge",
     .kind = Kind::length,
     .join = Join::most,
     .help = "The length of the longest edge.",
     .hint = "split: {method: bisect, max_edge: 1%} splits long edges",
     .mend = "split --method bisect --max_edge 1%",
     .of_faces = longest_edges,
     .counts_locations = true},
    {.name = "nonplanarity",
     .kind = Kind::length,
     .join = Join::most,
     .help = "The largest distance of a corner from the mean plane of its polygon.",
     .hint = "triangulate makes faces planar",
     .mend = "triangulate",
     .of_faces = nonplanarities,
     .counts_locations = true},
    {.name = "folded_faces",
     .help = "Pairs of neighbouring faces folded flat onto each other, decided exactly.",
     .hint = untangles,
     .mend = "clean --self_intersections all",
     .measure = [](const Measured& m) { return count_of(folded_faces(m.world)); },
     .locations = [](const Mesh& m,
                     const LocationQuery& q) { return locations_of_pairs(m, folded_faces(m), q.limit); }},
    {.name = "t_junctions",
     .help = "Vertices exactly on a boundary edge of another face.",
     .hint = "clean inserts them into the edge (t_junctions)",
     .mend = "clean",
     .measure = count_t_junctions,
     .locations = t_junctions},
    {.name = "boundary_length",
     .kind = Kind::length,
     .help = "The length of all boundary edges.",
     .hint = fills_holes,
     .mend = "clean --holes minimal ! orient",
     .measure = [](const Measured& m) { return std::optional(boundary_length(m.world)); },
     .locations = uncancelled_edges,
     .evidence = by_boundary},
    {.name = "longest_boundary",
     .kind = Kind::length,
     .join = Join::most,
     .help = "The length of the longest chain of boundary edges.",
     .hint = fills_holes,
     .mend = "clean --holes minimal ! orient",
     .measure = [](const Measured& m) { return std::optional(longest_boundary(m.world)); },
     .locations = uncancelled_edges,
     .evidence = by_boundary},
    {.name = "outward_oriented",
     .also_called = "normals_outward outward",
     .opposite = "inside_out inverted",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "Every component has its front outside (a cavity: towards the hollow), as orient would turn it.",
     .hint = "orient turns the front outward",
     .mend = "orient",
     .measure = is_outward_oriented,
     .locations = inward_components,
     .counts_locations = true},
    {.name = "coplanar_overlaps",
     .help = "Pairs of coplanar faces that overlap, decided exactly.",
     .hint = untangles,
     .mend = "clean --self_intersections all",
     .measure = [](const Measured& m) { return count_of(coplanar_overlaps(m.world)); },
     .locations =
         [](const Mesh& m, const LocationQuery& q) {
             return locations_of_pairs(m, coplanar_overlaps(m), q.limit);
         }},
    {.name = "wall_thickness",
     .also_called = "thickness min_thickness minimum_thickness",
     .kind = Kind::length,
     .join = Join::least,
     .help = "The smallest distance through the solid, along the inward normals of faces: from all their "
             "points to surfaces that face them (within 45 degrees) and to the bottoms of grooves and pits, "
             "and from their centroids to any surface. It is 0 at edges and tips sharper than 45 degrees; "
             "blunter edges are corners.",
     .hint = "no stage thickens the walls of a solid; transform can scale all of it",
     .of_faces = wall_thicknesses,
     .counts_locations = true},
    {.name = "uvs_in_range",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "All texture coordinates lie within 0 and 1.",
     .hint = no_stage,
     .measure = has_uvs_in_range,
     .locations = uvs_out_of_range,
     .counts_locations = true},
    {.name = "uv_overlaps",
     .help = "Pairs of faces that overlap in the first set of texture coordinates, decided exactly.",
     .hint = no_stage,
     .measure =
         [](const Measured& m) {
             const auto overlaps = uv_overlaps(m.local);
             return overlaps ? count_of(*overlaps) : std::nullopt;
         },
     .locations =
         [](const Mesh& m, const LocationQuery& q) {
             return locations_of_pairs(m, uv_overlaps(m).value_or(Pairs{}), q.limit);
         }},
    {.name = "finite_attributes",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "All attribute values are finite numbers.",
     .hint = "measure: {missing: 0} makes what it measures a number everywhere, optimize: {drop_own: true} "
             "drops attributes that glTF does not know; write gives glTF 0 there (W-NAN)",
     .measure = has_finite_attributes,
     .locations = numbers_not_finite,
     .counts_locations = true},
    {.name = "unit_normals",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "All normals and tangents have length 1, to 1/127.",
     .hint = "write: {normals: smooth} computes new ones",
     .measure = has_unit_normals,
     .locations = normals_not_unit,
     .counts_locations = true},
    {.name = "weights_normalized",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "The joint weights of every wedge sum to 1, to 1/255.",
     .hint = no_stage,
     .measure = has_normalized_weights,
     .locations = weights_not_normalized,
     .counts_locations = true},
    {.name = "joint_count",
     .join = Join::most,
     .help = "The number of joints that the weights refer to: the highest index plus one.",
     .hint = no_stage,
     .measure = joint_count,
     .locations = too_high_joints,
     .counts_locations = true},
    {.name = "max_extent",
     .also_called = "size dimensions",
     .kind = Kind::length,
     .join = Join::most,
     .help = "The longest side of a part's bounding box.",
     .hint = cuts_to_size,
     .measure = max_extent},
};

} // namespace

std::span<const Property> property_table() { return table; }

std::vector<Synonyms> synonyms_of(const Property& property) {
    std::vector<Synonyms> all{{std::string(property.also_called), {}}};
    if (!property.opposite.empty())
        all.push_back({std::string(property.opposite),
                       fmt::format("({}: true), which says the opposite", property.name)});
    return all;
}

std::vector<KnownName> known_properties() {
    std::vector<KnownName> known;
    for (const Property& p : table) known.push_back({std::string(p.name), synonyms_of(p)});
    return known;
}

const Property* property_named(std::string_view name) {
    const auto found =
        std::find_if(std::begin(table), std::end(table), [&](const Property& p) { return p.name == name; });
    return found == std::end(table) ? nullptr : found;
}

std::string_view unit_of(PropertyKind kind) {
    switch (kind) {
    case Kind::angle:
        return "degrees";
    case Kind::length:
    case Kind::box:
        return "scene units";
    case Kind::area:
        return "square scene units";
    case Kind::volume:
        return "cubic scene units";
    case Kind::count:
    case Kind::number:
    case Kind::truth:
    case Kind::word:
        break;
    }
    return {};
}

} // namespace facetmill
