#pragma once
// Repairs of broken meshes, step by step. Sound parts are left unchanged.

#include "mesh/provenance.hpp"
#include "mesh/topology.hpp"

#include <optional>
#include <string>
#include <vector>

namespace facetmill {

enum class Nearness { off, exact, near };
enum class HoleFill {
    minimal, ///< triangles between the outline's vertices, with minimal dihedral angle and area
             ///< (span_outline)
    planar,  ///< the outline as a polygon, if it is planar within 32-bit rounding
    smooth,  ///< like minimal, then refined to the density around it and faired (fair_patch)
};

/// How to repair intersecting faces.
enum class Untangle {
    off,
    local, ///< replaces the faces around each intersection, if this removes it
    unite, ///< merges closed components that intersect each other or themselves into a solid
    all    ///< unite, then local for the rest
};

struct HoleSettings {
    HoleFill method = HoleFill::minimal;
    std::size_t max_edges = 0; ///< larger holes stay; 0: no limit
    double max_length = 0;     ///< holes with a longer outline stay, mesh units; 0: no limit
};

struct ComponentSettings {
    std::size_t min_faces = 0; ///< removes components with fewer faces
    double min_size = 0;       ///< removes components whose box has a shorter diagonal, mesh units
    double min_area = 0;       ///< removes components with a smaller share of the total area
    std::size_t keep = 0;      ///< keeps only this many components of the largest area; 0: no limit
};

/// Limits on the work for intersecting faces and coincident vertices. They count work instead of time, so
/// that the result is the same on every machine. Parts that share a budget use it up in order.
struct UntangleBudget {
    /// Pairs of triangles whose boxes meet, beyond 32 per face. Counting without testing costs a sixteenth.
    std::size_t box_pairs = std::size_t{1} << 25;
    /// Intersecting pairs of faces that were processed without success. Once used up, meshes with more such
    /// pairs than faces are left unchanged.
    std::size_t vain_pairs = 1'000'000;
    /// Faces examined while moving vertices apart, counted again for each position tried.
    std::size_t apart = 2'000'000;
    bool operator==(const UntangleBudget&) const = default;
};

/// Settings that turn each step on or off. Lengths are in mesh units.
struct CleanSettings {
    Nearness weld = Nearness::exact;        ///< merges equal positions; near: also boundary ends
    Nearness stitch = Nearness::off;        ///< merges coincident boundary edges and their ends
    Nearness t_junctions = Nearness::exact; ///< inserts vertices of other boundary edges into boundary edges
    bool degenerate = true;   ///< removes faces with an area of exactly zero, and repeated corners
    bool duplicates = true;   ///< keeps one face per set with the same vertices; no inner walls
    bool walls = true;        ///< duplicates also removes faces whose two sides face each other
    bool non_manifold = true; ///< splits edges of more than two faces and vertices of several fans
    /// Needs single, weld and non_manifold. Moves vertices that still coincide apart by a few float32 steps,
    /// because formats that store only triangles would merge them (move_apart).
    bool apart = false;
    bool isolated = true;          ///< removes vertices that no face uses
    bool open_components = false;  ///< removes open components, if closed ones exist
    bool inner_components = false; ///< removes closed components inside others
    Untangle self_intersections = Untangle::off;
    std::optional<HoleSettings> holes;
    std::optional<ComponentSettings> components;
    double tolerance = 0; ///< for Nearness::near
    /// Rounds positions to 32-bit floats, before the first step and at new vertices. If self_intersections is
    /// off and rounding makes the first faces intersect, they are resolved as by `all`. If others intersected
    /// before, the new ones are reported.
    bool single = false;
    UntangleBudget budget;
};

/// A repair that was skipped, and the reason.
struct NotDone {
    std::string step; ///< the setting's name
    std::string why;
    Vec3 at;
    bool operator==(const NotDone&) const = default;
};

/// Counts of the changes.
struct CleanCounts {
    std::size_t rounded_vertices = 0, welded_vertices = 0, stitched_edges = 0, t_junctions = 0,
                repeated_corners = 0, degenerate_faces = 0, duplicate_faces = 0, split_vertices = 0,
                split_edges = 0, filled_holes = 0, hole_faces = 0, open_components = 0,
                open_component_faces = 0, components = 0, component_faces = 0, inner_components = 0,
                inner_component_faces = 0, isolated_vertices = 0, intersecting_faces = 0;
    double component_area = 0;         ///< of the removed small components, in mesh units
    std::size_t united_components = 0; ///< closed components that intersected and were united
    std::size_t refined_faces = 0;     ///< faces cut along intersections, counted once per pass
    std::size_t covered_faces = 0;     ///< faces without intersections, inside another component
    /// Edges with more than two faces that unions made where solids touch. 0 if non_manifold splits them.
    std::size_t touching_edges = 0;
    std::size_t moved_apart = 0; ///< vertices that shared their position
    double farthest_apart = 0;   ///< the longest such move, in mesh units
    std::size_t total() const;
    bool operator==(const CleanCounts&) const = default;
};

struct CleanResult {
    Mesh mesh;
    CleanCounts counts;
    std::vector<NotDone> not_done; ///< repairs skipped in the last round
    AttributeChanges changes;
    int rounds = 0;        ///< number of rounds; the last changed nothing, unless the limit was reached
    UntangleBudget budget; ///< the remaining budget
    /// A union was skipped because of insufficient memory; with more, the result may differ.
    bool short_of_memory = false;
};

/// Applies the enabled steps in rounds until a round changes nothing, so cleaning the result again does not
/// change it. Faces that no step affects keep their corners, attributes and order.
///
/// A round: rounding to single, weld, degenerate, duplicates, t_junctions, stitch, non_manifold,
/// self_intersections, holes, open_components, components, inner_components, isolated. If none of them
/// changes anything, apart follows. Each setting documents its step; geometry/clean/steps.hpp has the
/// details.
///
/// Attributes are copied, and interpolated at new vertices. Never throws for a valid mesh.
[[nodiscard]] CleanResult clean(Mesh mesh, const CleanSettings& settings);

/// The components of a mesh (faces connected across edges), where a cavity belongs to the solid around it. A
/// cavity is a closed component with a negative volume. It belongs to the innermost closed outward component
/// that contains it, if any. Containment is decided exactly, by a ray from one of its vertices. Components
/// that are open or inconsistently oriented stay separate. Components are numbered by their first face. O(n
/// log n).
[[nodiscard]] Components solid_components(const Mesh& mesh);

} // namespace facetmill
