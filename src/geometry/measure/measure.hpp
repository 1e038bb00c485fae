#pragma once
// Areas, centroids, volume and inertia; edges, angles and curvature. Sources: P. Bourke, "Calculating the
// area of a 3D polygon" (2000) and "Centroid of a 3D shell described by 3 vertex facets" (weighted by area).
// Solids follow D. Eberly, "Polyhedral mass properties (revisited)" (2002), by tetrahedra from the middle of
// the box.

#include "geometry/section/section.hpp"
#include "geometry/triangulate/triangulate.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace facetmill {

/// All zero for no numbers.
struct Statistics {
    std::size_t count = 0;
    double minimum = 0, maximum = 0, mean = 0,
           deviation = 0; ///< deviation: the standard deviation of all of them
    double median = 0;    ///< of an even count the upper of the middle two
    double sum = 0;
};

/// Numbers that are not finite are left out. Parallel, and the same for any number of threads.
[[nodiscard]] Statistics statistics(std::vector<double> numbers);

/// A symmetric 3 x 3 matrix.
struct Symmetric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    Vec3 operator*(const Vec3& v) const {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
                xz * v.x + yz * v.y + zz * v.z};
    }
};

/// Eigenvalues ascending, and their unit eigenvectors: a right-handed frame, the largest component of the
/// first two not negative.
struct Eigen3 {
    std::array<double, 3> values{};
    std::array<Vec3, 3> vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};
/// By rotations: C. G. J. Jacobi, "Ueber ein leichtes Verfahren, die in der Theorie der Saecularstoerungen
/// vorkommenden Gleichungen numerisch aufzuloesen" (1846).
[[nodiscard]] Eigen3 eigen(const Symmetric& m);

/// The inertia tensor of mass that is spread like that: the integral of |r|^2 I - r r^T.
[[nodiscard]] Symmetric inertia_of(const Symmetric& spread);

/// A surface without thickness.
struct ShellMass {
    double area = 0;
    Vec3 centroid; ///< of the area; the origin when there is none
    /// The integral of (p - centroid) (p - centroid)^T over the surface.
    Symmetric spread;
};

/// The inside of a closed surface, filled with density 1. All values are negative for a surface that is
/// inside out.
struct SolidMass {
    double volume = 0;
    Vec3 centroid;
    /// The integral of (p - centroid) (p - centroid)^T over the inside.
    Symmetric spread;
};

/// Of several together.
[[nodiscard]] ShellMass joined(const ShellMass& a, const ShellMass& b);
[[nodiscard]] SolidMass joined(const SolidMass& a, const SolidMass& b);

struct MassResult {
    ShellMass shell;
    /// Present if every edge's faces cancel (closed). All zero if the volume is only rounding, for example of
    /// a doubled surface: at most 1e-12 of the volume of a ball with the same area.
    std::optional<SolidMass> solid;
};
/// Sums over faces in parallel. The area of a face is the length of polygon::area_vector, its centroid and
/// its volume those of the fan from its first corner, exact for planar faces, concave ones too. The area and
/// the centroid of a planar face that crosses itself are those of what it winds around, each point counted
/// once (covering_triangles); its volume is that of the fan, where it counts as often as it is wound around.
[[nodiscard]] MassResult measure_mass(const Mesh& mesh);

/// Angles in radians.
struct EdgeResult {
    Statistics length; ///< of all edges
    Statistics
        turn; ///< of edges with two faces that agree: the angle between normals, negative where concave
    std::size_t convex = 0, concave = 0,
                flat = 0;                       ///< among them; flat: within the angle of EdgeSettings::flat
    std::size_t feature = 0;                    ///< turn beyond EdgeSettings::feature_angle either way
    std::size_t boundary = 0, non_manifold = 0; ///< edges with one face; with three or more
};
struct EdgeSettings {
    double feature_angle = 0.5235987755982988; ///< 30 degrees
    double flat = 1e-6;
};
[[nodiscard]] EdgeResult measure_edges(const Mesh& mesh, const EdgeSettings& settings = {});

/// One polygon in space, measured as P. Bourke, "Calculating the area and centroid of a polygon" (1988),
/// measures polygons in the plane. Its frame is the frame of its plane (frame_of), with the normal's longest
/// component positive. Thus a polygon in a plane z = constant has the axes x and y, and is seen from above. A
/// planar polygon that crosses itself is measured as a section measures such a contour. Its area, centroid
/// and moments count each point that it winds around once. The signed area has the sign of the larger part.
struct PolygonResult {
    polygon::Kind kind = polygon::Kind::degenerate;
    bool planar = true;
    double off_plane = 0;   ///< the largest distance of a corner from the plane
    double area = 0;        ///< the length of polygon::area_vector; of one that crosses itself see above
    double signed_area = 0; ///< positive when the corners run anticlockwise, seen in the frame, or as much
                            ///< either way (to 1e-12 of the area)
    Vec3 centroid;          ///< the first corner when there is no area
    Vec3 normal; ///< unit, by the order of the corners; the frame's if both directions are equal; zero if
                 ///< there is no area
    SectionFrame frame;
    /// Second moments of area in the frame, of the projection along the normal when the polygon is not
    /// planar. None for a polygon that is degenerate, or crosses itself and is not planar.
    std::optional<polygon::Moments> moments;
};
/// At least three corners.
[[nodiscard]] PolygonResult measure_polygon(std::span<const Vec3> corners);

/// Inner angles at the corners of faces, and areas.
struct FaceResult {
    Statistics area, angle;  ///< angle: 0 to 2 pi, beyond pi at concave corners
    Statistics aspect_ratio; ///< of triangles with an area (mesh/aspect_ratio.hpp)
    FaceKinds kinds;
    /// The sum of the area vectors: the signed areas of the projections along x, y and z. Zero for closed
    /// surfaces.
    Vec3 signed_area;
    std::vector<double> areas; ///< per face
};
[[nodiscard]] FaceResult measure_faces(const Mesh& mesh);

/// Discrete curvature at vertices, after M. Meyer et al., "Discrete differential-geometry operators for
/// triangulated 2-manifolds" (2003). It is the angle defect, and the turn of the edges, over a third of the
/// area of the triangles around. It is nan on a boundary and at non-manifold vertices.
struct CurvatureResult {
    std::vector<double> gaussian, mean; ///< per vertex; mean is positive where the surface bulges outward
    Statistics of_gaussian, of_mean;
    /// The sum of angle defects over all vertices (on a boundary: relative to half a turn). It is 2 pi times
    /// Euler's number of a manifold, whatever its shape.
    double total = 0;
};
[[nodiscard]] CurvatureResult measure_curvature(const Mesh& mesh);

/// Both, with one look at how the surface turns at the edges where all faces are triangles.
struct EdgesAndCurvature {
    EdgeResult edges;
    CurvatureResult curvature;
};
[[nodiscard]] EdgesAndCurvature measure_edges_and_curvature(const Mesh& mesh,
                                                            const EdgeSettings& settings = {});

} // namespace facetmill
