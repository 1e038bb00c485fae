#pragma once
// The help and manual texts of generate.

namespace facetmill::help::generate {

inline constexpr const char* about =
    R"(Generates a shape and adds it to the scene: sphere, cube, torus, Menger sponge and others.)";

inline constexpr const char* details =
    R"(The shape becomes a new part.
It is centred on the origin, with its axis along z.
The shapes grid and gaussian have their base at z = 0.
Every face is anticlockwise when seen from outside.
Sphere, icosphere, cube, torus and menger are closed and manifold, and so are cylinder and cone with
caps.
The shapes grid and gaussian are open.
If the scene already has parts, the shape is converted to the scene's unit and up axis.

Faces are triangles, made from quads cut along their shorter diagonal.
The option quads: true keeps the quads.
Noise moves each vertex by independent, normally distributed amounts along x, y and z, cut off at
three standard deviations.
It depends only on the seed and the position of the vertex.
Each option works only with the shapes named in its help.
A shape that does not fit into memory is refused before it is built (E-MEMORY).)";

} // namespace facetmill::help::generate
