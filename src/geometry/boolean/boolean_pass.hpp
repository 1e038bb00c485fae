#pragma once
// A pass of uniting solids. It keeps the outer surface of the union, and removes faces inside.

#include "geometry/boolean/combine.hpp"
#include "geometry/boolean/solids.hpp"
#include "geometry/boolean/united_mesh.hpp"

namespace facetmill::clean_steps {

struct United {
    Mesh mesh;
    AttributeChanges changes;
    std::size_t uncut_faces = 0;   ///< uncut faces of the result; the pieces of cut faces follow them
    std::size_t cut_faces = 0;     ///< faces replaced by their outer pieces
    std::size_t covered_faces = 0; ///< removed uncut faces
    std::size_t pairs = 0;         ///< pairs of triangles that were cut along each other
    /// [vertices] 1 for rings (see Solids) whose faces all stay uncut; empty if no rings are known.
    std::vector<std::uint8_t> settled;
    struct Refused {
        Index cluster;
        std::string why;
    };
    std::vector<Refused> refused; ///< if not empty, the other members are not set
    bool short_of_memory = false; ///< the refusal is due to a lack of memory
};

/// Limits on the work of a pass.
struct PassBudget {
    std::optional<std::uint64_t> memory; ///< bytes available; empty: unknown
    /// Limits on the pairs of intersecting triangles, and on possible crossings of lines within the planes of
    /// triangles.
    std::size_t pairs = 1'000'000, crossings = 2'000'000;
    const char* too_many = "more than a million pairs of triangles intersect, or their intersection lines "
                           "could cross more than two million times: that is more than can be united in "
                           "reasonable time";
};

/// The operands of a boolean operation. The second is reversed when it is subtracted.
struct Operands {
    CombineOperation operation = CombineOperation::unite;
    std::vector<std::uint8_t> second;    ///< [components] 1 for components of the second operand
    std::vector<std::uint8_t> lost = {}; ///< [faces] 1 if lost (lost_faces): its pairs are incomplete
};

/// Cuts the intersecting faces of the clusters along each other. Then it computes the winding numbers on both
/// sides of every patch between cuts (Q. Zhou et al., "Mesh arrangements for solid geometry", 2016). It keeps
/// patches with at most 0 on one side and at least 1 on the other, and faces them outward.
///
/// Uncut faces stay polygons and keep their order. The pieces of cut faces are triangles and come last,
/// without vertices that only the cutting needed (redrawn). Vertices of cut faces at the same position are
/// merged. Attributes of new corners are interpolated within their face, and on an edge only between its
/// ends, so that seams stay seams.
///
/// Coordinates are rounded, and new vertices within the tolerance of others are merged with them, so the
/// result may intersect again. With operands, a single cluster contains all components; solids describes the
/// state before the second operand was reversed. Work beyond the budget is refused.
///
/// Changes `mesh` only by merging vertices.
United unite(Mesh& mesh, const Solids& solids, const SelfIntersections& found, const SnapTolerance& rounding,
             const Operands* operands = nullptr, const PassBudget& effort = {});

/// Removes triangles of exactly zero area from a closed surface without opening it. The middle vertex splits
/// the edge of the face on the other side. Triangles without such a face stay.
void take_out_flat(Work& work);

} // namespace facetmill::clean_steps
