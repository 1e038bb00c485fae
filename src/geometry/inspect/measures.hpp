#pragma once
// The functions that the rows of geometry/inspect/properties.cpp name. They measure properties on request,
// and find locations where properties fail. They run in parallel if that is faster.

#include "geometry/inspect/evidence.hpp"

namespace facetmill::inspect_room {

using Pairs = std::vector<std::pair<Index, Index>>;

/// The value of a property measured on request.
[[nodiscard]] std::optional<double> value_of(const Property& property, const Measured& mesh);

// In face_shape.cpp: [faces] values of polygons, over their corners, edges or triangle fans.
[[nodiscard]] std::vector<double> smallest_angles(const Mesh& mesh);
[[nodiscard]] std::vector<double> largest_angles(const Mesh& mesh);
[[nodiscard]] std::vector<double> aspect_ratios(const Mesh& mesh);
[[nodiscard]] std::vector<double> shortest_edges(const Mesh& mesh);
[[nodiscard]] std::vector<double> longest_edges(const Mesh& mesh);
/// The distance of the farthest corner from the mean plane.
[[nodiscard]] std::vector<double> nonplanarities(const Mesh& mesh);
/// wall_thickness.cpp: [faces] infinity where there is no wall. Along the inward normal, as seen from all
/// points of the face: the least distance to a surface within 45 degrees of facing it, to a reflex edge with
/// a normal within 45 degrees between those of its faces, or to a vertex from which all its faces rise. The
/// minimum over two triangles is at a corner of the polygon where they overlap, so it is exact up to
/// rounding. A ray from the centroid counts at any angle.
[[nodiscard]] std::vector<double> wall_thicknesses(const Mesh& mesh);
/// The least of wall_thicknesses, found faster because each face is searched only below the least so far.
[[nodiscard]] std::optional<double> thinnest_wall(const Measured& mesh);

// In gap.cpp:
/// [faces] Like wall_thicknesses, through the air in front of the faces.
[[nodiscard]] std::vector<double> gaps(const Mesh& mesh);
/// By face: the smaller of the wall thickness and the gap.
[[nodiscard]] std::vector<double> details(const Mesh& mesh);
/// The least of details.
[[nodiscard]] std::optional<double> smallest_detail(const Measured& mesh);
/// The least of gaps.
[[nodiscard]] std::optional<double> smallest_gap(const Measured& mesh);
/// [faces] The longest side of the box around the component of the face.
[[nodiscard]] std::vector<double> component_sizes(const Mesh& mesh);

// In face_pairs.cpp:
/// Neighbours folded onto each other; the lower face first, ascending. Exact.
[[nodiscard]] Pairs folded_faces(const Mesh& mesh);
/// Coplanar faces that intersect. Exact.
[[nodiscard]] Pairs coplanar_overlaps(const Mesh& mesh);
/// Pairs of faces of one material whose interiors overlap in TEXCOORD_0 by more than rounding; the lower face
/// first, ascending. None without this attribute. Faces without area in the texture do not count.
[[nodiscard]] std::optional<Pairs> uv_overlaps(const Mesh& mesh);

// In uv_charts.cpp, for TEXCOORD_0:
/// The faces on which the image is mirrored, ascending. Exact.
[[nodiscard]] std::vector<Index> mirrored_faces(const Mesh& mesh);
[[nodiscard]] std::optional<double> count_mirrored_faces(const Measured& mesh);
[[nodiscard]] std::optional<double> texel_density_ratio(const Measured& mesh);
/// The smallest distance between the borders of two charts; none with fewer than two charts.
[[nodiscard]] std::optional<double> smallest_uv_gap(const Measured& mesh);

// In locations.cpp, see Property::locations:
[[nodiscard]] std::vector<Location> uncancelled_edges(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> crowded_edges(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> disagreeing_edges(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> vertices_of_several_fans(const Mesh& mesh, const LocationQuery& query);
/// Edges with more than two faces, then vertices with several fans.
[[nodiscard]] std::vector<Location> non_manifold_locations(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> isolated_vertices(const Mesh& mesh, const LocationQuery& query);
/// In a mesh with lines: the vertices that no line uses, ascending.
[[nodiscard]] std::vector<Index> vertices_without_lines(const Mesh& mesh);
[[nodiscard]] std::vector<Location> faces_without_area(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> repeated_faces(const Mesh& mesh, const LocationQuery& query);
/// The first face of each component.
[[nodiscard]] std::vector<Location> components(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> intersecting_pairs(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> touching_pairs(const Mesh& mesh, const LocationQuery& query);
/// A face of each component whose front is inside.
[[nodiscard]] std::vector<Location> inward_components(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::optional<double> count_t_junctions(const Measured& mesh);
/// The vertices, each with the face whose edge contains it.
[[nodiscard]] std::vector<Location> t_junctions(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::uint64_t key_of_point(const Vec3& p);
/// [vertices] The lowest face at each vertex; none for isolated vertices. O(corners).
[[nodiscard]] std::vector<Index> faces_at_vertices(const Mesh& mesh);
/// The location of the vertex, with its face from faces_at_vertices.
[[nodiscard]] Location location_of_vertex(const Mesh& mesh, Index v, const std::vector<Index>& faces);
/// The locations of the first faces, at their middles; for pairs, at the middle of the first face.
[[nodiscard]] std::vector<Location> locations_of_faces(const Mesh& mesh, const std::vector<Index>& faces);
[[nodiscard]] std::vector<Location> locations_of_pairs(const Mesh& mesh, const Pairs& pairs,
                                                       std::size_t limit);
/// The first face of each component whose front is not outside.
[[nodiscard]] std::vector<Index> inward_faces(const Mesh& mesh);

// In evidence.cpp, see Property::evidence:
/// The chains of the boundary; for surfaces without chains, the same as by_locations.
[[nodiscard]] std::vector<Evidence> by_boundary(const Scene& scene, const EvidenceQuery& query);
/// The locations; without locations, the contributions of the parts, the most influential first.
[[nodiscard]] std::vector<Evidence> by_locations(const Scene& scene, const EvidenceQuery& query);
/// The corners of parts' boxes that are outside the required box.
[[nodiscard]] std::vector<Evidence> by_box_corners(const Scene& scene, const EvidenceQuery& query);
[[nodiscard]] std::vector<Evidence> by_part_names(const Scene& scene, const EvidenceQuery& query);
[[nodiscard]] std::vector<Evidence> by_material_names(const Scene& scene, const EvidenceQuery& query);
[[nodiscard]] std::vector<Evidence> no_evidence(const Scene& scene, const EvidenceQuery& query);

// In attribute_checks.cpp, see Property::measure and Property::locations. Elements are examined attribute by
// attribute. A location is the element's vertex with its lowest face, or the middle of its face. The key
// depends on the position and on the attribute's name.
[[nodiscard]] std::optional<double> has_uvs_in_range(const Measured& mesh);
[[nodiscard]] std::optional<double> has_finite_attributes(const Measured& mesh);
[[nodiscard]] std::optional<double> has_unit_normals(const Measured& mesh);
[[nodiscard]] std::optional<double> has_normalized_weights(const Measured& mesh);
[[nodiscard]] std::optional<double> joint_count(const Measured& mesh);
[[nodiscard]] std::vector<Location> uvs_out_of_range(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> numbers_not_finite(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> normals_not_unit(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> weights_not_normalized(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> too_high_joints(const Mesh& mesh, const LocationQuery& query);

} // namespace facetmill::inspect_room
