#pragma once
// Repairs of broken meshes, step by step. What was sound is left alone.

#include "mesh/provenance.hpp"
#include "mesh/topology.hpp"

#include <optional>
#include <string>
#include <vector>

namespace facetmill {

enum class Nearness { off, exact, near };
enum class HoleFill {
    minimal, ///< triangles between the outline's vertices, of least dihedral angle and area (span_outline)
    planar,  ///< the outline as a polygon, where it lies in a plane to the rounding of 32 bits
    smooth,  ///< as minimal, then refined to the density around it and faired (fair_patch)
};

/// What becomes of faces that intersect.
enum class Untangle {
    off,
    local, ///< they are replaced place by place, where that ends the intersection
    unite, ///< closed components that pass through each other or themselves become one solid
    all    ///< unite, then local for the rest
};

struct HoleSettings {
    HoleFill method = HoleFill::minimal;
    std::size_t max_edges = 0; ///< larger holes stay; 0: no limit
    double max_length = 0;     ///< holes with a longer outline stay, mesh units; 0: no limit
};

struct ComponentSettings {
    std::size_t min_faces = 0; ///< components of fewer faces go
    double min_size = 0;       ///< components whose box has a shorter diagonal go, mesh units
    double min_area = 0;       ///< components with a smaller share of the whole area go
    std::size_t keep = 0;      ///< all but so many of largest area go; 0: no limit
};

/// What may be spent on faces that intersect, and on vertices at one place. Work is counted, not timed, so
/// that the result is the same everywhere; where parts share a budget, each gets what those before it left.
struct UntangleBudget {
    /// Pairs of triangles whose boxes meet, beyond 32 for each face; to count them costs a sixteenth.
    std::size_t box_pairs = std::size_t{1} << 25;
    /// Intersecting pairs of faces that were processed without success. When they are used up, meshes with
    /// more such pairs than faces are left as they are.
    std::size_t vain_pairs = 1'000'000;
    /// Faces that are looked at to move vertices apart, again for each place that is tried.
    std::size_t apart = 2'000'000;
    bool operator==(const UntangleBudget&) const = default;
};

/// Every step on or off. Lengths are in mesh units.
struct CleanSettings {
    Nearness weld = Nearness::exact; ///< vertices at one place become one; near: ends of boundary edges too
    Nearness stitch =
        Nearness::off; ///< boundary edges that run along each other become one, so do their ends
    Nearness t_junctions =
        Nearness::exact;      ///< boundary edges get the vertices of other boundary edges along them
    bool degenerate = true;   ///< faces of exactly zero area, and repeated corners, go
    bool duplicates = true;   ///< one face of each set with the same vertices stays, none of an inner wall
    bool non_manifold = true; ///< edges of more than two faces and vertices of several fans come apart
    /// With single, weld and non_manifold: vertices that are still at one place are moved apart by a few
    /// steps of float32, since formats that hold triangles only join them (move_apart).
    bool apart = false;
    bool isolated = true;          ///< vertices that no face uses go
    bool open_components = false;  ///< components that stay open go, where closed ones are left
    bool inner_components = false; ///< closed components inside others go
    Untangle self_intersections = Untangle::off;
    std::optional<HoleSettings> holes;
    std::optional<ComponentSettings> components;
    double tolerance = 0; ///< how near is near
    bool single = false;  ///< positions are those of 32-bit floats, before the first step and at new vertices
    UntangleBudget budget;
};

/// A repair that was not done, and why.
struct NotDone {
    std::string step; ///< the name of the setting
    std::string why;
    Vec3 at;
    bool operator==(const NotDone&) const = default;
};

/// What was done, counted.
struct CleanCounts {
    std::size_t rounded_vertices = 0, welded_vertices = 0, stitched_edges = 0, t_junctions = 0,
                repeated_corners = 0, degenerate_faces = 0, duplicate_faces = 0, split_vertices = 0,
                split_edges = 0, filled_holes = 0, hole_faces = 0, open_components = 0,
                open_component_faces = 0, components = 0, component_faces = 0, inner_components = 0,
                inner_component_faces = 0, isolated_vertices = 0, intersecting_faces = 0;
    std::size_t united_components = 0; ///< closed components that intersected and are part of a union now
    std::size_t refined_faces = 0;     ///< cut where they intersected, once per pass
    std::size_t covered_faces = 0;     ///< intersected nothing and lay inside another component
    /// Edges of more than two faces that unions made, where solids touch; none if non_manifold takes them
    /// apart.
    std::size_t touching_edges = 0;
    std::size_t moved_apart = 0; ///< vertices that were at the place of another
    double farthest_apart = 0;   ///< how far one of them was moved at most, in mesh units
    std::size_t total() const;
    bool operator==(const CleanCounts&) const = default;
};

struct CleanResult {
    Mesh mesh;
    CleanCounts counts;
    std::vector<NotDone> not_done; ///< of the last round
    AttributeChanges changes;
    int rounds = 0;        ///< the last of them changed nothing, unless there were too many
    UntangleBudget budget; ///< what is left of it
    /// A union was not tried for want of memory: with more, the result would be another.
    bool short_of_memory = false;
};

/// Applies the steps that are on, in rounds, until a round changes nothing; so a mesh that was cleaned is not
/// changed by cleaning it again. Faces that no step concerns keep their corners, attributes and order. In a
/// round: rounding to single, weld, degenerate, duplicates, t_junctions, stitch, non_manifold,
/// self_intersections, holes, open_components, components, inner_components, isolated; and when all that
/// changes nothing, apart. Each step's meaning is told with its setting; see clean_steps.hpp for how each
/// decides. Attributes are copied, and interpolated at new vertices. Never throws for a valid mesh.
CleanResult clean(Mesh mesh, const CleanSettings& settings);

/// The components of a mesh (faces that hang together over edges), a cavity with the solid around it: a
/// closed one that looks inward (its volume is negative) belongs to the innermost closed outward component
/// that it lies in, if there is one. Inside is decided exactly, by a ray from one of its vertices. Numbered
/// by first face. Components that are open, or whose faces disagree, stand for themselves. O(n log n).
Components solid_components(const Mesh& mesh);

} // namespace facetmill
