#pragma once
// Small named meshes built in code, for tests and the stage generate.

#include "mesh/mesh.hpp"

namespace facetmill::shapes {

[[nodiscard]] Mesh tetrahedron(); ///< closed, 4 vertices
[[nodiscard]] Mesh cube();        ///< closed, side 1 from the origin, 12 triangles
[[nodiscard]] Mesh quad_cube();   ///< closed, side 1 from the origin, 6 quads
[[nodiscard]] Mesh
uv_cube(); ///< quad_cube triangulated, with TEXCOORD_0 and NORMAL per face: 24 wedges on 8 vertices
[[nodiscard]] Mesh octahedron();          ///< closed, radius 1
[[nodiscard]] Mesh icosphere(int levels); ///< closed, radius 1, 20 * 4^levels faces
[[nodiscard]] Mesh torus(int segments, int rings, double major = 1,
                         double minor = 0.4); ///< closed, genus 1, triangles
[[nodiscard]] Mesh grid(int columns,
                        int rows);          ///< open, in the xy plane, unit squares cut into two triangles
[[nodiscard]] Mesh open_cone(int segments); ///< a fan without its base
[[nodiscard]] Mesh bowtie();                ///< two triangles that share only a vertex
[[nodiscard]] Mesh fan3();                  ///< three triangles at an edge: non-manifold edge
[[nodiscard]] Mesh hourglass();           ///< two tetrahedra that share a vertex: closed, non-manifold vertex
[[nodiscard]] Mesh moebius(int segments); ///< non-orientable strip of quads
[[nodiscard]] Mesh crossing();            ///< two triangles that cross each other
[[nodiscard]] Mesh folded_quad();         ///< a flat quad whose two triangles overlap

} // namespace facetmill::shapes
