#pragma once
// The help and manual texts of generate.

namespace facetmill::help::generate {

inline constexpr const char* about =
    R"(Generates a shape and adds it to the scene: sphere, cube, torus, Menger sponge and others.)";

inline constexpr const char* details =
    R"(The shape becomes a new part. It is centred on the origin with its axis along z (grid and gaussian
stand on z = 0), and every face is anticlockwise when seen from outside. Sphere, icosphere, cube,
torus, menger, and cylinder and cone with caps are closed and manifold; grid and gaussian are open.
In a scene that already has parts, the shape is converted to the scene's unit and up axis.

Faces are triangles, quads cut along their shorter diagonal, or, with quads: true, quads. Noise
moves each vertex by independent normally distributed amounts along x, y and z, truncated at three
standard deviations; it depends only on the seed and the position of the vertex. Each option applies
to the shapes that its help names and is refused for others. A shape that does not fit into memory
is refused before it is built (E-MEMORY).)";

} // namespace facetmill::help::generate
