#pragma once
// Cuts faces along the segments of an outline, one after the other. Only crop uses it.

#include "geometry/crop/segment_planes.hpp"
#include "geometry/cut/cut.hpp"

namespace facetmill {

/// The faces of a mesh that each segment enters.
struct EnteredFaces {
    std::vector<Index> segments;   ///< segments that enter faces, ascending
    std::vector<Index> offsets{0}; ///< [segments + 1] into faces
    std::vector<Index> faces;      ///< the faces of each segment, ascending

    std::span<const Index> of(std::size_t i) const {
        return {faces.data() + offsets[i], faces.data() + offsets[i + 1]};
    }
    /// Call it in ascending order of segments and faces.
    void add(Index segment, Index face) {
        if (segments.empty() || segments.back() != segment) {
            segments.push_back(segment);
            offsets.push_back(offsets.back());
        }
        faces.push_back(face);
        ++offsets.back();
    }
};

/// The result of the cuts. New vertices and wedges follow the mesh's own. They are numbered by the segments
/// that made them, then by their edges (low vertex first).
struct CutFaces {
    Pieces pieces;            ///< pieces of all faces, in order
    std::vector<Vec3> points; ///< [new vertices] positions
    std::vector<Provenance::Edge> vertices,
        wedges;                      ///< edges of new vertices and wedges; wedges is empty without seams
    std::vector<Index> wedge_vertex; ///< [new wedges] vertices
    std::vector<Index> vertex_segments,
        wedge_segments; ///< [new vertices, new wedges] the segment that made each
    std::vector<std::pair<Index, Index>>
        on;                 ///< pairs of a new vertex (ascending) and a plane that contains it
    std::vector<Index> met; ///< planes whose segments entered a piece
    std::size_t cut_faces = 0;
};

/// Each segment cuts every face that it enters by more than rounding, along its line across the whole piece.
/// Neighbours get the new points. on: the known planes of the vertices.
[[nodiscard]] CutFaces cut_along_segments(const Mesh& mesh, const EnteredFaces& entered, const CropView& view,
                                          const SegmentPlanes& segments, OnPlanes on);

} // namespace facetmill
