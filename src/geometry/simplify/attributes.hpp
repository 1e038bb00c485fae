#pragma once
// Attributes: their error, and their values in the result.

#include "geometry/simplify/state.hpp"

namespace facetmill::simplification {

/// The attributes' part of the error; empty if no attribute has a weight. normals: false if the mesh's
/// normals contain no information.
[[nodiscard]] std::optional<AttributeError> attribute_error(const State& s, const Mesh& mesh,
                                                            const AttributeWeights& weights, bool normals);
/// The attribute error of merging elements a and b at p, as a quadric of p. Its weight does not include the
/// weight of the planes.
[[nodiscard]] Quadric residual(const AttributeError& error, Index a, Index b);
/// Adds the error sums of b to a.
void join(AttributeError& error, Index a, Index b);

/// True if the mesh has attributes besides positions and faces.
bool carries_attributes(const Mesh& mesh);

struct Finished {
    Mesh mesh;
    AttributeChanges changes;
    std::vector<Index> wedges; ///< surviving wedges of the input, in the mesh's order; empty without seams
};
/// Builds the mesh of a shape, with its attributes. log: the collapses that led to the shape; null when
/// `from` has no attributes.
///
/// A moved vertex gets the attributes of the input surface, at the nearest point of the faces around all
/// vertices merged into it. On a feature line it uses the nearest point of that line. So a texture cannot
/// slide farther than the surface moves, both sides of a seam are sampled at the same point, and the values
/// are not blurred. (Mixing the two ends at every collapse drifted.)
[[nodiscard]] Finished finish(const Shape& shape, const Mesh& from, const Log* log);

} // namespace facetmill::simplification
