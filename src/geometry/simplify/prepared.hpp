#pragma once
// A mesh made ready to be simplified, and what was done about its normals put right afterwards.

#include "geometry/simplify/simplify.hpp"

namespace facetmill::simplification {

/// What the work is done on: triangles, without the seams that only normals make.
struct Prepared {
    std::optional<Mesh> own; ///< none: the mesh as given will do
    NormalSeams seams;

    Prepared(const Mesh& given, const SimplifySettings& settings);
};

/// Gives a flat-shaded mesh its normals back, and says what became of normals.
void settle_normals(Mesh& mesh, const NormalSeams& seams, Fates& fates);

/// The locks of a mesh whose unused vertices go, if single ones are locked: numbers stay right then.
SimplifyLocks by_used_vertices(SimplifyLocks lock, Mesh& mesh);

} // namespace facetmill::simplification
