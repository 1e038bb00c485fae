#pragma once
// One pass of uniting solids: what lies on the outside of all is kept, what lies within goes.

#include "geometry/boolean/combine.hpp"
#include "geometry/boolean/solids.hpp"
#include "geometry/boolean/united_mesh.hpp"

namespace facetmill::clean_steps {

struct United {
    Mesh mesh;
    AttributeChanges changes;
    std::size_t uncut_faces = 0;   ///< of the result; the pieces of cut faces come after them
    std::size_t cut_faces = 0;     ///< replaced by their pieces on the outside
    std::size_t covered_faces = 0; ///< uncut faces that went
    std::size_t pairs = 0;         ///< of triangles, that were cut along each other
    /// [vertices] 1 for rings (see Solids) all of whose faces stay, uncut; empty where no rings are known.
    std::vector<std::uint8_t> settled;
    struct Refused {
        Index cluster;
        std::string why;
    };
    std::vector<Refused> refused; ///< when there are any, the rest is not filled
    bool short_of_memory = false; ///< they are refused for the memory that is free
};

/// How much is tried.
struct PassBudget {
    std::optional<std::uint64_t> memory; ///< bytes that may be taken; none: nobody knows
    /// Of triangles that intersect, and how often lines could cross in their planes.
    std::size_t pairs = 1'000'000, crossings = 2'000'000;
    const char* too_many = "more than a million pairs of triangles intersect, or their intersection lines "
                           "could cross more than two million times: that is more than can be united in "
                           "reasonable time";
};

/// What two solids are combined to. The second is inside out where it is taken away from the first.
struct Operands {
    CombineOperation operation = CombineOperation::unite;
    std::vector<std::uint8_t> second;    ///< [components] those of the second
    std::vector<std::uint8_t> lost = {}; ///< [faces] of lost_faces: not all pairs with these are known
};

/// Cuts the faces of the clusters that intersect along each other, asks for the winding number on both sides
/// of every patch between cuts (Q. Zhou et al., "Mesh arrangements for solid geometry", 2016), and keeps what
/// has at most 0 on one side and at least 1 on the other, facing out. Faces that are not cut stay polygons
/// and keep their order; the pieces of cut ones are triangles and come last, without vertices that only the
/// cutting needed (redrawn). Vertices at one place where faces are cut become one. Attributes of new corners
/// are mixed within the face that they are part of, those on an edge between its ends only, so that seams
/// stay seams. Coordinates are rounded, and new vertices within the tolerance of others become them: the
/// result may intersect again. With operands there is one cluster, of all components; solids are as before
/// the second was turned inside out. What would be more than the effort allows is refused.
///
/// The mesh is as it was but for the vertices that became one.
United unite(Mesh& mesh, const Solids& solids, const SelfIntersections& found, const SnapTolerance& rounding,
             const Operands* operands = nullptr, const PassBudget& effort = {});

/// Takes triangles of exactly no area out of a closed surface without opening it: the vertex between the two
/// others is put on the edge of the face across. Those for which there is none are left.
void take_out_flat(Work& work);

} // namespace facetmill::clean_steps
