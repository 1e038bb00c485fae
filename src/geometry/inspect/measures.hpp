#pragma once
// How the properties that are measured on request are measured, and where they and the others fail: the
// functions that the rows of geometry/inspect/properties.cpp name. All are parallel where it pays.

#include "geometry/inspect/evidence.hpp"

namespace facetmill::inspect_room {

using Pairs = std::vector<std::pair<Index, Index>>;

/// The value of a property that is measured on request.
[[nodiscard]] std::optional<double> value_of(const Property& property, const Measured& mesh);

// face_shape.cpp: [faces] of polygons, over their corners, edges or fan of triangles.
[[nodiscard]] std::vector<double> smallest_angles(const Mesh& mesh);
[[nodiscard]] std::vector<double> largest_angles(const Mesh& mesh);
[[nodiscard]] std::vector<double> aspect_ratios(const Mesh& mesh);
[[nodiscard]] std::vector<double> shortest_edges(const Mesh& mesh);
[[nodiscard]] std::vector<double> longest_edges(const Mesh& mesh);
/// How far the farthest corner is from the mean plane.
[[nodiscard]] std::vector<double> nonplanarities(const Mesh& mesh);
/// wall_thickness.cpp: [faces] infinity where there is no wall. Along the inward normal, as seen from all
/// points of the face: the least distance to a surface within 45 degrees of facing it, to a reflex edge with
/// a normal within 45 degrees between those of its faces, or to a vertex from which all its faces rise. The
/// minimum over two triangles is at a corner of the polygon where they overlap, so it is exact up to
/// rounding. A ray from the centroid counts at any angle.
[[nodiscard]] std::vector<double> wall_thicknesses(const Mesh& mesh);

// face_pairs.cpp
/// Neighbours that lie on each other, exactly; the lower face first, ascending.
[[nodiscard]] Pairs folded_faces(const Mesh& mesh);
/// Faces that intersect and lie in one plane, exactly.
[[nodiscard]] Pairs coplanar_overlaps(const Mesh& mesh);
/// Faces, the lower first, whose insides overlap in TEXCOORD_0, ascending; none without such an attribute.
/// Decided exactly; faces that only touch, and those without area in the texture, do not count.
[[nodiscard]] std::optional<Pairs> uv_overlaps(const Mesh& mesh);

// locations.cpp: as Property::locations.
[[nodiscard]] std::vector<Location> uncancelled_edges(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> crowded_edges(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> disagreeing_edges(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> vertices_of_several_fans(const Mesh& mesh, const LocationQuery& query);
/// Edges of more than two faces, then vertices of several fans.
[[nodiscard]] std::vector<Location> non_manifold_locations(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::vector<Location> isolated_vertices(const Mesh& mesh, const LocationQuery& query);
/// Of a mesh with lines: those that none of them uses, ascending.
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
/// The vertices, with the face on whose edge each lies.
[[nodiscard]] std::vector<Location> t_junctions(const Mesh& mesh, const LocationQuery& query);
[[nodiscard]] std::uint64_t key_of_point(const Vec3& p);
/// [vertices] The lowest face at each; none at isolated ones. O(corners).
[[nodiscard]] std::vector<Index> faces_at_vertices(const Mesh& mesh);
/// The vertex, with the face of it that faces_at_vertices tells.
[[nodiscard]] Location location_of_vertex(const Mesh& mesh, Index v, const std::vector<Index>& faces);
/// The first faces, in their middles; the first pairs, in the middle of the first of each.
[[nodiscard]] std::vector<Location> locations_of_faces(const Mesh& mesh, const std::vector<Index>& faces);
[[nodiscard]] std::vector<Location> locations_of_pairs(const Mesh& mesh, const Pairs& pairs,
                                                       std::size_t limit);
/// The first face of each component whose front is not outside.
[[nodiscard]] std::vector<Index> inward_faces(const Mesh& mesh);

// evidence.cpp: as Property::evidence.
/// The chains of the boundary; of surfaces without any as by_locations.
[[nodiscard]] std::vector<Evidence> by_boundary(const Scene& scene, const EvidenceQuery& query);
/// The locations; where there are none what the parts have, those first that take the value farthest.
[[nodiscard]] std::vector<Evidence> by_locations(const Scene& scene, const EvidenceQuery& query);
/// The corners of parts' boxes that are out of the box.
[[nodiscard]] std::vector<Evidence> by_box_corners(const Scene& scene, const EvidenceQuery& query);
[[nodiscard]] std::vector<Evidence> by_part_names(const Scene& scene, const EvidenceQuery& query);
[[nodiscard]] std::vector<Evidence> by_material_names(const Scene& scene, const EvidenceQuery& query);
[[nodiscard]] std::vector<Evidence> no_evidence(const Scene& scene, const EvidenceQuery& query);

// attribute_checks.cpp: as Property::measure and Property::locations. Elements are looked at attribute by
// attribute; a location is where their vertex is, with the lowest face at it, or in the middle of their face,
// and its key depends on the position and on the attribute's name.
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
