#pragma once
// Small named meshes, built in code: for tests, and for the generate stage.

#include "mesh/mesh.hpp"

namespace facetmill::shapes {

Mesh tetrahedron(); ///< closed, 4 vertices
Mesh cube();        ///< closed, side 1 from the origin, 12 triangles
Mesh quad_cube();   ///< closed, side 1 from the origin, 6 quads
Mesh uv_cube();     ///< quad_cube triangulated, TEXCOORD_0 and NORMAL per face: 24 wedges on 8 vertices
Mesh octahedron();  ///< closed, radius 1
Mesh icosphere(int levels); ///< closed, radius 1, 20 * 4^levels faces
Mesh torus(int segments, int rings, double major = 1, double minor = 0.4); ///< closed, genus 1, triangles
Mesh grid(int columns, int rows); ///< open, in the xy plane, unit squares cut in two triangles
Mesh open_cone(int segments);     ///< a fan without its base
Mesh bowtie();                    ///< two triangles that share only a vertex
Mesh fan3();                      ///< three triangles at one edge: non-manifold edge
Mesh hourglass();                 ///< two tetrahedra that share one vertex: closed, non-manifold vertex
Mesh moebius(int segments);       ///< non-orientable strip of quads
Mesh crossing();                  ///< two triangles that cross each other
Mesh folded_quad();               ///< a flat quad whose two triangles overlap

} // namespace facetmill::shapes
