#pragma once
// Generates shapes from numbers, for pipelines and figures without an input file.

#include "mesh/mesh.hpp"

namespace facetmill {

enum class Shape {
    sphere,    ///< latitude and longitude, poles on the z axis, where faces crowd
    icosphere, ///< an icosahedron refined on the sphere: faces have nearly the same size
    cube,      ///< a cube with gridded faces
    grid,      ///< a square in the plane z = 0
    torus,     ///< a torus around the z axis
    cylinder,  ///< a cylinder around the z axis, with or without caps
    cone,      ///< a cone around the z axis, apex up, with or without its base
    gaussian,  ///< the height field h exp(-r^2 / 2 s^2) over a square
    menger,    ///< the outer surface of a Menger sponge
};

/// The settings. Lengths are in scene units, above zero and at most 1e37, so that float32 files can store
/// them. Each shape is centred on the origin (the base of grid and gaussian is z = 0) and uses the members
/// documented for it.
struct GenerateSettings {
    Shape shape = Shape::sphere;
    double radius =
        1; ///< sphere, icosphere, cylinder, cone; torus: radius of the circle that the tube follows
    double minor_radius = 0.4;  ///< torus: radius of the tube, below `radius`
    double size = 2;            ///< side of cube, grid, gaussian, menger
    double height = 2;          ///< cylinder, cone; gaussian: height of the peak
    double spread = 0.3;        ///< gaussian: its standard deviation s
    std::int64_t segments = 48; ///< sphere, torus, cylinder, cone: pieces around the axis, at least 3
    std::int64_t rings = 24; ///< sphere: bands from pole to pole, at least 2; torus: pieces around the tube,
                             ///< at least 3; cylinder, cone: rows, at least 1
    std::int64_t cells = 10; ///< cube, grid, gaussian: cells along a side, at least 1
    std::int64_t subdivisions = 3; ///< icosphere 0 to 12: refinements; menger 1 to 4
    bool caps = true;              ///< cylinder, cone: closed by fans
    bool quads = false;            ///< quads instead of triangles, if the shape has them
    double noise = 0;       ///< standard deviation of Gaussian noise on x, y and z of each vertex; at least 0
    std::uint64_t seed = 0; ///< seed of the noise
};

/// Makes a mesh without attributes. Every face is anticlockwise seen from outside (grid and gaussian: from
/// above). Sphere, icosphere, cube, torus, menger, and cylinder and cone with caps are closed and manifold.
/// Quads are cut along the shorter diagonal. Noise is the noise of crumple, so it is equal for coincident
/// vertices. Before building, throws a usage error (E-RANGE) for a setting out of range, and a limit error
/// for more than 2^31 corners (E-LIMIT) or a lack of memory (E-MEMORY).
[[nodiscard]] Mesh generate(const GenerateSettings& settings);

/// The number of faces that generate would make. A real number, because it may exceed any integer.
[[nodiscard]] double generate_face_estimate(const GenerateSettings& settings);

/// Adds crumple's noise with this standard deviation to x, y and z of each vertex.
[[nodiscard]] Mesh with_noise(Mesh mesh, double deviation, std::uint64_t seed);

/// The segments and rings of a latitude-longitude sphere with about this many triangles, which are 2
/// segments (rings - 1). Candidates have at least 3 segments and 2 rings. Facets at the equator are at most
/// twice as wide as high, and vice versa (rings <= segments <= 4 rings). The nearest number is chosen (ties:
/// fewer), then the squarest facets (segments = 2 rings), then fewer segments. 4000 gives 80 x 26.
struct SphereBands {
    std::int64_t segments = 0, rings = 0;
};
[[nodiscard]] SphereBands sphere_bands(std::int64_t faces);

/// Throws a usage error (E-RANGE) if a setting is out of range. generate calls it first.
void check_generate_settings(const GenerateSettings& settings);

} // namespace facetmill
