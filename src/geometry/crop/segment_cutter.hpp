#pragma once
// Cuts faces along the segments of an outline, one after the other. For crop only.

#include "geometry/crop/segment_planes.hpp"
#include "geometry/cut/cut.hpp"

namespace facetmill {

/// Which faces of a mesh segments enter.
struct EnteredFaces {
    std::vector<Index> segments;   ///< those that enter any, ascending
    std::vector<Index> offsets{0}; ///< [segments + 1] into faces
    std::vector<Index> faces;      ///< of each, ascending

    std::span<const Index> of(std::size_t i) const {
        return {faces.data() + offsets[i], faces.data() + offsets[i + 1]};
    }
    /// Segments and the faces of each come in order.
    void add(Index segment, Index face) {
        if (segments.empty() || segments.back() != segment) {
            segments.push_back(segment);
            offsets.push_back(offsets.back());
        }
        faces.push_back(face);
        ++offsets.back();
    }
};

/// What becomes of the faces. New vertices and wedges are numbered behind those of the mesh, by the segments
/// that made them, and those of a segment by the edges that they are on (low vertex first).
struct CutFaces {
    Pieces pieces;                                      ///< of all faces, in order
    std::vector<Vec3> points;                           ///< [new vertices]
    std::vector<Provenance::Edge> vertices, wedges;     ///< the new ones; without seams wedges is empty
    std::vector<Index> wedge_vertex;                    ///< [new wedges]
    std::vector<Index> vertex_segments, wedge_segments; ///< [new ones]
    std::vector<std::pair<Index, Index>> on; ///< a new vertex, ascending, and a plane that it is on
    std::vector<Index> met;                  ///< planes whose segments entered a piece
    std::size_t cut_faces = 0;
};

/// Every face that a segment enters, by more than rounding, is cut along the segment's line, all across the
/// piece; its neighbours get the points. on: what is known of the vertices.
CutFaces cut_along_segments(const Mesh& mesh, const EnteredFaces& entered, const CropView& view,
                            const SegmentPlanes& segments, OnPlanes on);

} // namespace facetmill
