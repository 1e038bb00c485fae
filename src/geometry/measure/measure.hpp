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

/// All members are zero without numbers.
struct Statistics {
    std::size_t count = 0;
    double minimum = 0, maximum = 0, mean = 0,
           deviation = 0; ///< deviation: the population standard deviation
    double median = 0;    ///< for an even count, the larger of the middle two
    double sum = 0;
};

/// Ignores numbers that are not finite. Parallel; the result does not depend on the number of threads.
[[nodiscard]] Statistics statistics(std::vector<double> numbers);

/// A symmetric 3 x 3 matrix.
struct Symmetric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    /// Adds the product of v with itself.
    void add_square(const Vec3& v, double weight = 1) {
        xx += weight * v.x * v.x;
        xy += weight * v.x * v.y;
        xz += weight * v.x * v.z;
        yy += weight * v.y * v.y;
        yz += weight * v.y * v.z;
        zz += weight * v.z * v.z;
    }
    Vec3 operator*(const Vec3& v) const {
        return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
                xz * v.x + yz * v.y + zz * v.z};
    }
};

/// Eigenvalues, ascending, and their unit eigenvectors. These form a right-handed frame; the largest
/// components of the first two are not negative.
struct Eigen3 {
    std::array<double, 3> values{};
    std::array<Vec3, 3> vectors{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};
/// Uses rotations after C. G. J. Jacobi, "Ueber ein leichtes Verfahren, die in der Theorie der
/// Saecularstoerungen vorkommenden Gleichungen numerisch aufzuloesen" (1846).
[[nodiscard]] Eigen3 eigen(const Symmetric& m);

/// The inertia tensor of mass with this spread: the integral of |r|^2 I - r r^T.
[[nodiscard]] Symmetric inertia_of(const Symmetric& spread);

/// A surface without thickness.
struct ShellMass {
    double area = 0;
    Vec3 centroid; ///< the centroid of the area; the origin if the area is 0
    /// The integral of (p - centroid) (p - centroid)^T over the surface.
    Symmetric spread;
};

/// The inside of a closed surface, filled with density 1. All values are negative for an inside-out surface.
struct SolidMass {
    double volume = 0;
    Vec3 centroid;
    /// The integral of (p - centroid) (p - centroid)^T over the inside.
    Symmetric spread;
};

/// The shell mass of both together.
[[nodiscard]] ShellMass joined(const ShellMass& a, const ShellMass& b);
[[nodiscard]] SolidMass joined(const SolidMass& a, const SolidMass& b);

struct MassResult {
    ShellMass shell;
    /// Present if every edge's faces cancel (closed). All zero if the volume is only rounding, for example of
    /// a doubled surface: at most 1e-12 of the volume of a ball with the same area.
    std::optional<SolidMass> solid;
};
/// Sums over faces in parallel. The area of a face is the length of polygon::area_vector. Its centroid and
/// volume come from the fan of its first corner, which is exact for planar faces, even concave ones. If a
/// planar face crosses itself, its area and centroid count each enclosed point once (covering_triangles).
/// Its volume counts each point as often as the face winds around it.
[[nodiscard]] MassResult measure_mass(const Mesh& mesh);

// In shells.cpp:
/// unites: some shells pass through each other. solid: the inside, in which each point counts once; none if
/// the shells could not be united to a closed surface.
struct OverlappingShells {
    bool unites = false;
    std::optional<SolidMass> solid;
};
/// The solid of a closed mesh with this volume after orient (a shell inside another is its cavity) and, for
/// shells that pass through each other, after clean: {self_intersections: union}. None if the mesh is inside
/// out, if no two shells overlap, or if the solid has the given volume up to rounding.
[[nodiscard]] std::optional<OverlappingShells> overlapping_shells(const Mesh& mesh, double volume);

/// Angles in radians.
struct EdgeResult {
    Statistics length; ///< lengths of all edges
    Statistics turn;   ///< for edges with two consistently oriented faces: the angle between the normals,
                       ///< negative at concave edges
    std::size_t convex = 0, concave = 0,
                flat = 0;    ///< the number of such edges; flat: within EdgeSettings::flat
    std::size_t feature = 0; ///< edges whose turn, in either direction, exceeds EdgeSettings::feature_angle
    std::size_t boundary = 0, non_manifold = 0; ///< edges with one face, and with three or more
};
struct EdgeSettings {
    double feature_angle = 0.5235987755982988; ///< 30 degrees
    double flat = 1e-6;
};
[[nodiscard]] EdgeResult measure_edges(const Mesh& mesh, const EdgeSettings& settings = {});

/// A polygon in space, measured in its plane after P. Bourke, "Calculating the area and centroid of a
/// polygon" (1988). Its frame is the frame of its plane (frame_of), with the normal's longest component
/// positive. For example, a polygon in a plane z = constant has the axes x and y, seen from above. If a
/// planar polygon crosses itself, its area, centroid and moments count each enclosed point once, as for
/// contours of sections. The signed area has the sign of the larger part.
struct PolygonResult {
    polygon::Kind kind = polygon::Kind::degenerate;
    bool planar = true;
    double off_plane = 0; ///< the largest distance of a corner from the plane
    double area =
        0; ///< the length of polygon::area_vector, except for polygons that cross themselves (see above)
    double signed_area = 0; ///< positive if the corners run anticlockwise in the frame, or equally in both
                            ///< directions (to 1e-12 of the area)
    Vec3 centroid;          ///< the first corner if the area is 0
    Vec3 normal; ///< unit vector by the order of the corners; the frame's normal if both directions are
                 ///< equal; zero if the area is 0
    SectionFrame frame;
    /// Second moments of area in the frame. If the polygon is not planar, they belong to its projection
    /// along the normal. None for a degenerate polygon, or if it crosses itself and is not planar.
    std::optional<polygon::Moments> moments;
};
/// Requires at least three corners.
[[nodiscard]] PolygonResult measure_polygon(std::span<const Vec3> corners);

/// Inner angles at the corners of faces, and areas.
struct FaceResult {
    Statistics area, angle;  ///< angle: 0 to 2 pi, above pi at concave corners
    Statistics aspect_ratio; ///< for triangles with an area above 0 (mesh/aspect_ratio.hpp)
    FaceKinds kinds;
    /// The sum of the area vectors: the signed areas of the projections along x, y and z. Zero for closed
    /// surfaces.
    Vec3 signed_area;
    std::vector<double> areas; ///< [faces]
};
[[nodiscard]] FaceResult measure_faces(const Mesh& mesh);

/// Discrete curvature at vertices, after M. Meyer et al., "Discrete differential-geometry operators for
/// triangulated 2-manifolds" (2003). Gaussian curvature is the angle defect, and mean curvature the turn of
/// the edges, divided by a third of the surrounding triangles' area. Both are NaN on a boundary and at
/// non-manifold vertices.
struct CurvatureResult {
    std::vector<double> gaussian, mean; ///< [vertices] mean is positive where the surface bulges outward
    Statistics of_gaussian, of_mean;
    /// The sum of angle defects over all vertices (on a boundary: relative to half a turn). For a manifold,
    /// it is 2 pi times the Euler characteristic.
    double total = 0;
};
[[nodiscard]] CurvatureResult measure_curvature(const Mesh& mesh);

/// Both results. If all faces are triangles, the turns at the edges are computed once.
struct EdgesAndCurvature {
    EdgeResult edges;
    CurvatureResult curvature;
};
[[nodiscard]] EdgesAndCurvature measure_edges_and_curvature(const Mesh& mesh,
                                                            const EdgeSettings& settings = {});

} // namespace facetmill
