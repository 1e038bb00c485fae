#pragma once
// Shapes from numbers: the start of pipelines and figures without an input file.

#include "mesh/mesh.hpp"

namespace facetmill {

enum class Shape {
    sphere,    ///< latitude and longitude, poles on the z axis, where faces crowd
    icosphere, ///< an icosahedron refined on the sphere: faces of nearly one size
    cube,      ///< gridded faces
    grid,      ///< a square in the plane z = 0
    torus,     ///< around the z axis
    cylinder,  ///< around the z axis, with or without caps
    cone,      ///< around the z axis, apex up, with or without its base
    gaussian,  ///< the height field h exp(-r^2 / 2 s^2) over a square
    menger,    ///< the outer surface of a Menger sponge
};

/// Lengths in scene units, all above zero and at most 1e37, so that files of float32 can hold them. Each
/// shape is centred on the origin (the base of grid and gaussian is z = 0) and uses the members documented
/// for it.
struct GenerateSettings {
    Shape shape = Shape::sphere;
    double radius = 1; ///< sphere, icosphere, cylinder, cone; torus: of the circle that the tube follows
    double minor_radius = 0.4;  ///< torus: of the tube, below radius
    double size = 2;            ///< side of cube, grid, gaussian, menger
    double height = 2;          ///< cylinder, cone; gaussian: of the peak
    double spread = 0.3;        ///< gaussian: its standard deviation s
    std::int64_t segments = 48; ///< sphere, torus, cylinder, cone: pieces around the axis, at least 3
    std::int64_t rings = 24; ///< sphere: bands from pole to pole, at least 2; torus: pieces around the tube,
                             ///< at least 3; cylinder, cone: rows, at least 1
    std::int64_t cells = 10; ///< cube, grid, gaussian: cells along a side, at least 1
    std::int64_t subdivisions = 3; ///< icosphere 0 to 12: refinements; menger 1 to 4
    bool caps = true;              ///< cylinder, cone: closed by fans
    bool quads = false;            ///< quads where the shape has them, rather than triangles
    double noise = 0;       ///< standard deviation of Gaussian noise on x, y and z of each vertex; at least 0
    std::uint64_t seed = 0; ///< of the noise
};

/// A mesh without attributes, every face seen anticlockwise from outside (grid and gaussian: from above).
/// Sphere, icosphere, cube, torus, menger, and cylinder and cone with caps are closed and manifold. Quads are
/// cut along the shorter diagonal. Noise is crumple's: the same for coincident vertices. Throws before
/// building: usage (E-RANGE) for a setting out of range, limit (E-LIMIT) for more than 2^31 corners,
/// (E-MEMORY) if memory is short.
[[nodiscard]] Mesh generate(const GenerateSettings& settings);

/// How many faces generate would make, as a real number because it may be beyond any integer.
[[nodiscard]] double generate_face_estimate(const GenerateSettings& settings);

/// The shape with noise on x, y and z of each vertex, of that standard deviation: crumple's.
[[nodiscard]] Mesh with_noise(Mesh mesh, double deviation, std::uint64_t seed);

/// The segments and rings of a latitude-longitude sphere of about that many triangles, which is 2 segments
/// (rings - 1). Candidates have at least 3 segments and 2 rings, and facets at the equator at most twice as
/// wide as high and vice versa (rings <= segments <= 4 rings). The choice is by the nearest number (ties:
/// fewer), then the squarest facets (segments = 2 rings), then fewer segments. 4000 gives 80 x 26.
struct SphereBands {
    std::int64_t segments = 0, rings = 0;
};
[[nodiscard]] SphereBands sphere_bands(std::int64_t faces);

/// Throws usage (E-RANGE) when a setting is out of range; generate does it first of all.
void check_generate_settings(const GenerateSettings& settings);

} // namespace facetmill
