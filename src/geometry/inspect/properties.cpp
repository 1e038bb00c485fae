// The table of properties. To add a property, add a row here (with its function, here or in
// geometry/inspect/measures.hpp), and a row in tests/stages/validate_table_test.cpp.
#include "geometry/inspect/measures.hpp"
#include "geometry/measure/measure.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

using namespace inspect_room;
using P = Properties;
using Kind = PropertyKind;

std::optional<double> count_of(const Pairs& pairs) { return static_cast<double>(pairs.size()); }

/// The front of a cavity faces into the cavity, but its mesh does not show that it is a cavity.
std::optional<double> is_outward_oriented(const Measured& m) {
    if (m.settings.part_of_solid && m.properties.volume.value_or(0) < 0) return 1;
    return inward_faces(m.local).empty() ? 1 : 0;
}

std::optional<double> max_extent(const Measured& m) { return m.world.bounds().longest_side(); }

std::optional<double> solid_volume(const Measured& m) {
    const auto sum = m.properties.volume;
    const auto shells = sum ? overlapping_shells(m.world, *sum) : std::nullopt;
    if (!shells) return sum;
    return shells->solid ? std::optional(shells->solid->volume) : std::nullopt;
}

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

/// Edges of two faces that meet at a right angle or a sharper one. Rounded coordinates may turn a face by a
/// millionth.
std::optional<double> hard_edges(const Measured& m) {
    const Mesh& mesh = m.world;
    const auto normal = [&](Index f) { return normalised(area_vector(mesh, f)); };
    const EdgeTable edges = build_edges(mesh);
    const std::vector<Index> faces = corner_faces(mesh);
    double count = 0;
    for (Index e = 0; e < edges.size(); ++e) {
        const auto corners = edges.corners_of(e);
        if (corners.size() != 2) continue;
        const Vec3 a = normal(faces[corners[0]]), b = normal(faces[corners[1]]);
        if (dot(a, a) > 0 && dot(b, b) > 0 && dot(a, b) <= 1e-6) ++count;
    }
    return count;
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

constexpr const char* fewer_or_more = "use simplify to reduce their number, or split to increase it";
constexpr const char* fills_holes =
    "use clean: {weld: near, tolerance: 0.0001%} to join corners that differ by rounding, clean: {holes: "
    "minimal} to fill holes, or orient to make faces consistent";
constexpr const char* non_manifold_hint = "use clean to separate them (non_manifold)";
constexpr const char* clean_removes = "use clean to remove them";
constexpr const char* untangles =
    "use clean: {self_intersections: all} to unite or replace intersecting faces";
constexpr const char* cuts_to_size = "use transform to move and scale, or clip and crop to cut";
constexpr const char* makes_uvs = "use unwrap to make new texture coordinates";
constexpr const char* no_stage = "no stage changes this, so correct it in the program that made the mesh";

// Constant, so that stages can be declared from the table before main.
constexpr Property table[] = {
    {.name = "vertices",
     .also_called = "points verts vertex_count num_vertices target_vertices",
     .help = "Vertices of the surface, including isolated ones.",
     .hint = fewer_or_more,
     .member = &P::vertices,
     .is_size = true},
    {.name = "wedges",
     .help = "Sets of attribute values at vertices. glTF calls them vertices.",
     .hint = fewer_or_more,
     .member = &P::wedges,
     .is_size = true},
    {.name = "edges",
     .help = "Pairs of vertices joined by the side of a face.",
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
     .hint = "use triangulate to cut polygons into triangles, or simplify to reduce their number",
     .member = &P::triangles,
     .is_size = true},
    {.name = "lines",
     .help = "Straight lines between two vertices, in parts without faces.",
     .hint = "use load: {lines: 1%} to turn them into tubes",
     .member = &P::lines,
     .is_size = true,
     .where_any = true},
    {.name = "components",
     .also_called = "shells bodies islands body_count connected_components",
     .help = "Sets of faces connected through vertices.",
     .hint =
         "use clean: {components: {keep: 1}} to keep only the largest, or separate to turn them into parts",
     .member = &P::components,
     .locations = components},
    {.name = "euler",
     .also_called = "euler_number euler_characteristic",
     .help =
         "V - E + F, without isolated vertices. It is 2 for a closed surface of genus 0 with one component.",
     .hint = "use clean: {holes: minimal} to fill holes; simplify: {topology: allow} may close handles",
     .member = &P::euler,
     .locations = non_manifold_locations, // these are neither openings nor handles
     .evidence = by_boundary,
     .lowest = -HUGE_VAL},
    {.name = "genus",
     .join = Join::sum_if_all,
     .help = "The number of handles, added up over components. Applies only to closed, oriented manifolds.",
     .hint = "use clean: {holes: minimal} to fill holes; simplify: {topology: allow} may close handles",
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
     .help = "Edges with a face on only one side.",
     .hint = fills_holes,
     .mend = "clean --holes minimal ! orient",
     .member = &P::boundary_edges,
     .locations = uncancelled_edges,
     .evidence = by_boundary},
    {.name = "closed",
     .also_called = "watertight is_watertight water_tight airtight solid is_closed",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "At every edge, the directions of its faces cancel, so the surface has no boundary.",
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
     .help = "At most two faces meet at every edge.",
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
     .hint = "use orient to make them consistent",
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
     .help = "Pairs of faces that intersect. The test is exact and takes time.",
     .hint = untangles,
     .mend = "clean --self_intersections all",
     .member = &P::self_intersections,
     .costly = true,
     .locations = intersecting_pairs},
    {.name = "touching",
     .join = Join::sum_if_all,
     .help = "Pairs of faces that touch at edges or corners they do not share, without intersecting. The "
             "test is exact and takes time.",
     .hint = no_stage,
     .member = &P::touching,
     .costly = true,
     .locations = touching_pairs},
    {.name = "area",
     .kind = Kind::area,
     .help = "The surface area. Non-planar faces count as their projection along their normal; triangulated "
             "faces have a larger area.",
     .hint = cuts_to_size,
     .member = &P::area},
    {.name = "volume",
     .kind = Kind::volume,
     .join = Join::sum_if_all,
     .help = "The sum of the signed volumes of closed shells: negative if the surface is inside out. Space "
             "inside several outward shells counts several times (see solid_volume). Does not apply to open "
             "surfaces.",
     .hint = "use clean: {holes: minimal} to close open surfaces, or orient to turn them outward",
     .mend = "clean --holes minimal ! orient",
     .member = &P::volume,
     .locations = uncancelled_edges,
     .evidence = by_boundary,
     .lowest = -HUGE_VAL},
    {.name = "bounds",
     .also_called = "bbox bounding_box aabb extents",
     .kind = Kind::box,
     .join = Join::around,
     .help = "The bounding box of all vertices, with skinned parts in their bind pose and animated nodes at "
             "rest. Its lowest corner is at least {min: [x, y, z]}, its highest corner at most "
             "{max: [x, y, z]}.",
     .hint = cuts_to_size,
     .member = &P::bounds,
     .evidence = by_box_corners},
    {.name = "unit",
     .also_called = "units scale_unit convert_to to_unit",
     .kind = Kind::word,
     .join = Join::of_scene,
     .help = "The unit of positions.",
     .hint = "use load: {unit: mm} to set it, or transform: {unit: mm} to convert it",
     .member = &P::unit,
     .evidence = no_evidence,
     .words = unit_words},
    {.name = "up",
     .also_called = "up_axis upaxis y_up z_up",
     .kind = Kind::word,
     .join = Join::of_scene,
     .help = "The up axis.",
     .hint = "use load: {up: z} to set it, or transform: {up: z} to rotate the scene",
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
     .hint = "use merge to join them, or separate to make more",
     .member = &P::parts,
     .evidence = by_part_names},

    // The following properties are measured on request.
    {.name = "solid_volume",
     .kind = Kind::volume,
     .join = Join::sum_if_all,
     .help = "The volume of the solid: like volume, but space inside several shells of a part counts once. "
             "Shells inside others count as cavities, and crossing shells are united. Takes time.",
     .hint = "use clean: {holes: minimal} to close open surfaces, or orient to turn them outward",
     .mend = "clean --holes minimal ! orient",
     .measure = solid_volume,
     .locations = uncancelled_edges,
     .evidence = by_boundary,
     .lowest = -HUGE_VAL},
    {.name = "min_angle",
     .kind = Kind::angle,
     .join = Join::least,
     .help = "The smallest angle of a face.",
     .hint = "use relax to make faces more regular",
     .mend = "relax 3",
     .of_faces = smallest_angles,
     .counts_locations = true,
     .highest = 180},
    {.name = "max_angle",
     .kind = Kind::angle,
     .join = Join::most,
     .help = "The largest angle of a face.",
     .hint = "use relax to make faces more regular",
     .mend = "relax 3",
     .of_faces = largest_angles,
     .counts_locations = true,
     .highest = 180},
    {.name = "aspect_ratio",
     .kind = Kind::number,
     .join = Join::most,
     .help = "The largest aspect ratio: the longest edge over the inradius, scaled to 1 for equal sides.",
     .hint = "use relax to make faces more regular",
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
     .hint = "use split: {method: bisect, max_edge: 1%} to split long edges",
     .mend = "split --method bisect --max_edge 1%",
     .of_faces = longest_edges,
     .counts_locations = true},
    {.name = "nonplanarity",
     .kind = Kind::length,
     .join = Join::most,
     .help = "The largest distance of a corner from the mean plane of its polygon.",
     .hint = "use triangulate to make faces planar",
     .mend = "triangulate",
     .of_faces = nonplanarities,
     .counts_locations = true},
    {.name = "folded_faces",
     .help = "Pairs of neighbouring faces folded flat onto each other. The test is exact.",
     .hint = untangles,
     .mend = "clean --self_intersections all",
     .measure = [](const Measured& m) { return count_of(folded_faces(m.world)); },
     .locations = [](const Mesh& m,
                     const LocationQuery& q) { return locations_of_pairs(m, folded_faces(m), q.limit); }},
    {.name = "hard_edges",
     .also_called = "unbeveled_edges unbevelled_edges beveled",
     .help = "Edges whose two faces meet at a right angle or a sharper one, without a bevel.",
     .hint = "no stage does: bevel these edges in the program that made the mesh",
     .measure = hard_edges},
    {.name = "t_junctions",
     .help = "Vertices exactly on a boundary edge of another face.",
     .hint = "use clean to insert them into the edge (t_junctions)",
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
     .help = "The front of every component faces outward, or towards the hollow for a cavity, as orient "
             "would turn it.",
     .hint = "use orient to turn the front outward",
     .mend = "orient",
     .measure = is_outward_oriented,
     .locations = inward_components,
     .counts_locations = true},
    {.name = "coplanar_overlaps",
     .help = "Pairs of coplanar faces that overlap. The test is exact.",
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
     .help = "The smallest distance through the solid, along the inward normals of faces. It is measured "
             "from all points of faces to surfaces that face them (within 45 degrees) and to the bottoms of "
             "grooves and pits. From centroids of faces, it is measured to any surface. It is 0 at edges and "
             "tips sharper than 45 degrees; blunter edges are corners.",
     .hint = "no stage thickens the walls of a solid, but transform can scale all of it",
     .measure = thinnest_wall,
     .of_faces = wall_thicknesses,
     .counts_locations = true},
    {.name = "gap",
     .also_called = "smallest_gap min_gap clearance gap_width",
     .kind = Kind::length,
     .join = Join::least,
     .help = "The smallest distance through the air between surfaces of a part that face each other. It is "
             "measured like wall_thickness, along the outward normals. It is 0 at grooves sharper than 45 "
             "degrees. Use merge first to measure between parts.",
     .hint = "use clean: {self_intersections: union} to join parts that touch, or transform to scale the "
             "solid: no stage widens gaps",
     .measure = smallest_gap,
     .of_faces = gaps,
     .counts_locations = true},
    {.name = "detail",
     .also_called = "smallest_detail min_feature feature_size smallest_feature",
     .kind = Kind::length,
     .join = Join::least,
     .help = "The width of the narrowest rib or groove, also of raised or engraved letters: the smaller of "
             "wall_thickness and gap. The height of a step does not count.",
     .hint = "use transform to scale the solid, or make narrow features wider where the model was made",
     .measure = smallest_detail,
     .of_faces = details,
     .counts_locations = true},
    {.name = "component_size",
     .also_called = "smallest_component speck min_size",
     .kind = Kind::length,
     .join = Join::least,
     .help = "The size of the smallest component: the diagonal of its bounding box, as for clean: "
             "{components: {min_size}}.",
     .hint = "use clean: {components: {min_size: 1mm}} to remove small components",
     .of_faces = component_sizes,
     .counts_locations = true},
    {.name = "uvs_in_range",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "All texture coordinates are between 0 and 1.",
     .hint = no_stage,
     .measure = has_uvs_in_range,
     .locations = uvs_out_of_range,
     .counts_locations = true},
    {.name = "uv_overlaps",
     .help = "Pairs of faces with the same material that overlap in the first set of texture coordinates. "
             "Overlaps within the rounding to 32 bits (2^-22 of the texture) do not count.",
     .hint = makes_uvs,
     .mend = "unwrap",
     .measure =
         [](const Measured& m) {
             const auto overlaps = uv_overlaps(m.local);
             return overlaps ? count_of(*overlaps) : std::nullopt;
         },
     .locations =
         [](const Mesh& m, const LocationQuery& q) {
             return locations_of_pairs(m, uv_overlaps(m).value_or(Pairs{}), q.limit);
         }},
    {.name = "mirrored_uvs",
     .also_called = "inverted_uvs flipped_uvs",
     .help = "Faces that show the image of the first set of texture coordinates mirrored. The test is exact.",
     .hint = makes_uvs,
     .mend = "unwrap",
     .measure = count_mirrored_faces,
     .locations =
         [](const Mesh& m, const LocationQuery& q) {
             auto faces = mirrored_faces(m);
             faces.resize(std::min(faces.size(), q.limit));
             return locations_of_faces(m, faces);
         }},
    {.name = "texel_density_ratio",
     .also_called = "texel_density pixel_density",
     .kind = Kind::number,
     .join = Join::most,
     .help = "The highest texel density over the lowest, in the first set of texture coordinates. The "
             "hundredth of the surface with the highest and with the lowest density does not count.",
     .hint = makes_uvs,
     .mend = "unwrap",
     .measure = texel_density_ratio,
     .lowest = 1},
    {.name = "uv_gap",
     .also_called = "uv_gutter gutter padding uv_margin",
     .kind = Kind::number,
     .join = Join::least,
     .help = "The smallest distance between two charts of the first set of texture coordinates, as a share "
             "of the texture: 4 texels of 1024 are 0.0039.",
     .hint = "use unwrap: {gutter: 8} to make new texture coordinates with larger gaps",
     .mend = "unwrap",
     .measure = smallest_uv_gap},
    {.name = "finite_attributes",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "All numbers of attributes are finite.",
     .hint = "use measure: {missing: 0} to replace missing values, or optimize: {drop_own: true} to remove "
             "attributes unknown to glTF; write stores 0 instead of nan in glTF (W-NAN)",
     .measure = has_finite_attributes,
     .locations = numbers_not_finite,
     .counts_locations = true},
    {.name = "unit_normals",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "All normals and tangents have length 1, within 1/127.",
     .hint = "clean: {unit_vectors: true} scales them to length 1",
     .measure = has_unit_normals,
     .locations = normals_not_unit,
     .counts_locations = true},
    {.name = "weights_normalized",
     .kind = Kind::truth,
     .join = Join::all,
     .help = "The joint weights of every wedge sum to 1, within 1/255.",
     .hint = "clean: {unit_vectors: true} scales them to the sum 1",
     .measure = has_normalized_weights,
     .locations = weights_not_normalized,
     .counts_locations = true},
    {.name = "joint_count",
     .join = Join::most,
     .help = "The number of joints that weights refer to: the highest index plus one.",
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
                       fmt::format("({}: true), which means the opposite", property.name)});
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
