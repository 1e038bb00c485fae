#pragma once
// Attributes: what they weigh in the error, and what becomes of them.

#include "geometry/simplify/state.hpp"

namespace facetmill::simplification {

/// What the attributes of the mesh add to the error; none when nothing is weighed. normals: whether its
/// normals mean anything.
std::optional<AttributeError> attribute_error(const State& s, const Mesh& mesh,
                                              const AttributeWeights& weights, bool normals);
/// What elements a and b would pay together at p, as a quadric of p. Its weight is not the planes'.
Quadric residual(const AttributeError& error, Index a, Index b);
/// a takes over what b has.
void join(AttributeError& error, Index a, Index b);

/// Whether anything but positions and faces must be followed.
bool carries_attributes(const Mesh& mesh);

struct Finished {
    Mesh mesh;
    AttributeChanges changes;
    std::vector<Index> wedges; ///< of the input that are left, in the mesh's order; empty without seams
};
/// The mesh that a shape stands for, with its attributes. log: how the shape came about; none when `from`
/// carries no attributes.
///
/// The attributes of a vertex that moved are those of the surface that came in at the nearest point of the
/// faces around all the vertices that went into it; of a vertex on a feature line, at the nearest point of
/// that line. So a texture cannot slide farther than the surface moves, both sides of a seam are taken at the
/// same place, and nothing is blurred by mixing mixtures. (Mixing the two ends at every collapse drifted.)
Finished finish(const Shape& shape, const Mesh& from, const Log* log);

} // namespace facetmill::simplification
