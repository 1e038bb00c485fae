#pragma once
// Cuts a mesh by a plane before a side is chosen: classifies vertices and faces, and makes the points of the
// cut. Only clip and its neighbours use it.

#include "mesh/cut_memory.hpp"
#include "mesh/provenance.hpp"

#include <cmath>

namespace facetmill {

/// A face's class, as bits.
namespace face_class {
// The lowest three bits record the sides of its vertices.
inline constexpr std::uint8_t above = 1;       ///< has a vertex in front of the plane
inline constexpr std::uint8_t below = 2;       ///< has a vertex on the back of the plane
inline constexpr std::uint8_t touches = 4;     ///< has a vertex exactly on the plane
inline constexpr std::uint8_t flat_above = 8;  ///< is in the plane and stays with the front
inline constexpr std::uint8_t flat_below = 16; ///< is in the plane and stays with the back
inline constexpr std::uint8_t replaced = 32;   ///< stays, but as a polygon with points inserted
} // namespace face_class

/// Numbering continues: the mesh's own wedges and vertices first, followed by the elements of the cut and of
/// a cap. So without seams a wedge's number is its vertex's.
struct PlaneCut {
    const Mesh* mesh = nullptr;
    Plane plane;
    std::vector<std::int8_t> signs;                             ///< [vertices] -1, 0, 1
    std::vector<std::uint8_t> classes;                          ///< [faces]
    std::size_t above_count = 0, below_count = 0, on_count = 0; ///< vertices
    std::size_t snapped_count = 0, remembered_count = 0; ///< among on_count, points not exactly on the plane
    double snapped_by = 0;                               ///< the largest distance of a snapped point
    std::vector<Index> cut_faces;                        ///< faces with vertices on both sides, ascending
    std::vector<Index> touching;         ///< faces with vertices on the plane and on one side, ascending
    std::vector<Index> flat;             ///< faces in the plane, ascending
    std::vector<Index> crossings;        ///< new wedge at each crossed corner's edge, by cut face and corner
    std::vector<Index> crossing_offsets; ///< [cut_faces + passing + 1] offsets into crossings
    /// Excluded faces with an edge at which a neighbour is cut, ascending. Each edge between vertices on
    /// both sides has a crossing, unless no face at it is cut.
    std::vector<Index> passing;
    std::vector<Provenance::Edge> wedges, vertices; ///< new wedges and vertices, as points on edges
    std::vector<Index> wedge_vertex;                ///< [new wedges] vertices; empty without seams
    std::vector<Vec3> points;                       ///< [new vertices] positions

    std::size_t first_extra_vertex() const { return mesh->vertex_count() + vertices.size(); }
    std::size_t first_extra_wedge() const { return mesh->wedge_count() + wedges.size(); }
    Index vertex_of(Index wedge) const {
        if (wedge < mesh->wedge_count()) return mesh->vertex_of_wedge(wedge);
        return wedge_vertex.empty() ? wedge : wedge_vertex[wedge - mesh->wedge_count()];
    }
    const Vec3& point(Index vertex) const {
        return vertex < mesh->vertex_count() ? mesh->positions[vertex]
                                             : points[vertex - mesh->vertex_count()];
    }
    int sign_of(Index wedge) const {
        return wedge < mesh->wedge_count() ? signs[mesh->vertex_of_wedge(wedge)] : 0;
    }
    /// Whether face f stays whole on this side (1 front, -1 back).
    bool stays(Index f, int side) const {
        using namespace face_class;
        const std::uint8_t c = classes[f];
        if (c & replaced) return false;
        return (c & (above | below)) == (side > 0 ? above : below) ||
               (c & (side > 0 ? flat_above : flat_below));
    }
    bool meets() const { return on_count > 0 || (above_count > 0 && below_count > 0); }
};

/// How far positions may be from where they should be, because their coordinates were rounded one by one.
struct CoordinateErrors {
    Vec3 single; ///< by axis: the largest error of 32-bit floats, half their step; 0 if not rounded
    Vec3 twice;  ///< by axis: the error of doubles after a few operations, four units in the last place

    /// The sums of the errors along a direction, times its length.
    double of_single(const Vec3& along) const { return sum(single, along); }
    double of_double(const Vec3& along) const { return sum(twice, along); }

  private:
    static double sum(const Vec3& errors, const Vec3& along) {
        return std::fabs(along.x) * errors.x + std::fabs(along.y) * errors.y + std::fabs(along.z) * errors.z;
    }
};

/// The rounding of a mesh's positions, by the largest coordinate of each axis. `single` is 0 if less than
/// half of the positions are 32-bit floats, and for an axis whose numbers show that they were not rounded.
/// Multiples of more than the step of floats show this, and so do multiples of that step on the other axes,
/// if their floats are finer. The chance of such multiples among rounded numbers must be below one in a
/// thousand. Examples are a terrain and a building of whole metres in UTM, whose floats are half a metre
/// apart, or a metre far in the south.
[[nodiscard]] CoordinateErrors rounding_of(const Mesh& mesh);

/// The points that count as on a plane in addition to points exactly on it.
struct OnPlane {
    /// Positions within this rounding along the plane's normal count as on it. Otherwise a plane through
    /// computed vertices would cut slivers off at these. The default is exact.
    CoordinateErrors snap = {};
    /// Points built on the plane according to this memory count as on it. None: no known points.
    const CutMemory* memory = nullptr;
};

/// Whether all three coordinates are 32-bit floats.
bool is_float32(const Vec3& p);

/// Makes points where a plane crosses edges.
class CrossingPoints {
  public:
    explicit CrossingPoints(const Plane& plane);
    /// The parameter at which the plane crosses an edge, from the side values of its ends, which have
    /// different signs; 0 at a.
    static double parameter(double side_of_a, double side_of_b);
    /// A coordinate that both ends share is preserved, so that rounding does not leave axis-aligned planes.
    Vec3 operator()(const Vec3& a, const Vec3& b, double t) const;

  private:
    int axis_;
    double level_; ///< the plane's coordinate, if it is perpendicular to an axis
};

/// Classifies all elements and makes the points of the cut. Flat faces get no side yet. faces: 1 if the face
/// may be cut; empty: all.
[[nodiscard]] PlaneCut cut_by_plane(const Mesh& mesh, const Plane& plane, const OnPlane& on = {},
                                    std::span<const std::uint8_t> faces = {});

/// The same, with known sides of all vertices.
[[nodiscard]] PlaneCut cut_by_signs(const Mesh& mesh, const Plane& plane, std::vector<std::int8_t> signs,
                                    std::span<const std::uint8_t> faces);

/// At every edge the directions of the faces cancel.
bool is_closed(const Mesh& mesh);

/// Adds the points of a cut to the memory. New points are on the cut's plane and on every known plane that
/// contains both ends of their edge; snapped points are on the cut's plane. more: other points made on the
/// plane.
void remember(CutMemory& memory, const PlaneCut& cut, std::span<const Vec3> more = {});

/// Gives each flat face the side that its normal points away from, and faces without area the back. So the
/// boundaries of the two sides match.
void settle_flat_by_normal(PlaneCut& cut);
/// Gives all flat faces to one side, or none (0).
void settle_flat(PlaneCut& cut, int side);

/// Polygons that replace faces, by ascending face, in the numbering of PlaneCut.
struct Pieces {
    std::vector<Index> source;     ///< the face that each replaces
    std::vector<Index> offsets{0}; ///< [pieces + 1] offsets into wedges
    std::vector<Index> wedges;

    std::size_t size() const { return source.size(); }
    std::span<const Index> of(std::size_t i) const {
        return {wedges.data() + offsets[i], wedges.data() + offsets[i + 1]};
    }
    void add(Index face, std::span<const Index> polygon) {
        source.push_back(face);
        wedges.insert(wedges.end(), polygon.begin(), polygon.end());
        offsets.push_back(static_cast<Index>(wedges.size()));
    }
};

/// The parts of the cut faces on a side.
[[nodiscard]] Pieces pieces_on_side(const PlaneCut& cut, int side);

/// The polygon of the passing face with this number, including the points on its edges.
void passing_with_points(const PlaneCut& cut, std::size_t number, std::vector<Index>& polygon);

/// Calls body(wedge, next wedge) for the edges of a polygon.
template <class Body>
void for_polygon_edges(std::span<const Index> polygon, Body&& body) {
    for (std::size_t i = 0; i < polygon.size(); ++i)
        body(polygon[i], polygon[i + 1 == polygon.size() ? 0 : i + 1]);
}

} // namespace facetmill
