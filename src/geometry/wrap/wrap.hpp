#pragma once
// A closed surface around anything.

#include "mesh/mesh.hpp"

namespace facetmill {

struct WrapSettings {
    double alpha = 0;  ///< the smallest gap that the wrap enters, in mesh units
    double offset = 0; ///< the distance of its vertices from the input, in mesh units
    std::size_t max_faces = 5000000;
    bool nearest_attributes = false; ///< takes attributes from the nearest point of the input
};

struct WrapResult {
    Mesh mesh; ///< triangles
    AttributeChanges changes;
    std::size_t components = 0;
};

/// Wraps the faces of a mesh in a surface at about the distance `offset`, which enters no gap narrower than
/// alpha; without faces, its lines or its points. Any input is allowed: soup, open sheets, crossing and
/// duplicate faces, faces without area. See geometry/cgal/alpha_wrap.hpp for the method.
///
/// Guarantees, each tested with exact predicates before it returns: the surface is closed, oriented, edge-
/// and vertex-manifold; no two of its faces intersect; no face meets a face of the input, and every vertex of
/// the input is inside. So it encloses the input strictly. Throws a usage error (E-RANGE) if alpha or offset
/// is not above 0, a limit error (E-WRAP-LARGE) for more than max_faces, and a stage error (E-WRAP) if there
/// is nothing to wrap or if a test fails.
///
/// Attributes: dropped, or with nearest_attributes: colours, weights and other numbers are mixed at the
/// nearest point of the input, and faces copy the attributes (and so the material) of the face nearest to
/// their middle. Texture coordinates, normals, tangents and morph targets are dropped.
[[nodiscard]] WrapResult wrap(const Mesh& mesh, const WrapSettings& settings);

/// A rough number of faces of a wrap of this mesh, from the cells of the size alpha that the input touches. A
/// real number, because it may exceed any integer.
[[nodiscard]] double wrap_face_estimate(const Mesh& mesh, double alpha);

} // namespace facetmill
