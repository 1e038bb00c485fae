#pragma once
// Prepares the parts of a scene for a canvas: triangles with canvas positions, and interpolated attributes.

#include "geometry/render/painter.hpp"
#include "geometry/render/view.hpp"

#include <memory>

namespace facetmill {

/// The edges of polygons; edges between triangles of the same polygon are not drawn.
class RealEdges {
  public:
    explicit RealEdges(const Mesh& mesh);
    bool has(Index a, Index b) const;

  private:
    std::vector<std::uint64_t> edges_; ///< sorted; empty: all edges are real
};

/// A part with its points on the canvas.
class PartDrawing {
  public:
    /// first: the number of its first triangle or, without faces, its first vertex. lines: draw its edges.
    PartDrawing(const Part& part, const Scene& scene, const PictureSettings& settings, const View& view,
                std::size_t number, const ValueRange& range, std::uint32_t first, bool lines);

    std::uint32_t first() const { return first_; }
    /// The number of triangles, or of vertices without faces.
    std::size_t count() const { return has_faces_ ? mesh_->face_count() : points_.size(); }
    bool has_faces() const { return has_faces_; }
    const Mesh& mesh() const { return *mesh_; }
    const Painter& painter() const { return *painter_; }

    const Vec3& point(Index vertex) const { return points_[vertex]; }
    CanvasTriangle triangle(Index face) const { return CanvasTriangle(corners(face)); }
    std::array<Vec3, 3> corners(Index face) const {
        return {corner(face, 0), corner(face, 1), corner(face, 2)};
    }
    const Vec3& corner(Index face, Index k) const { return points_[mesh_->vertex(3 * face + k)]; }
    /// Whether the outer side of the triangle is visible.
    bool front(const std::array<Vec3, 3>& corners) const { return (twice_area(corners) > 0) != mirrored_; }
    /// The position on the face for a position on the canvas, correct in perspective too.
    FacePlace place(const View& view, const CanvasTriangle& t, Index face, double x, double y) const;
    FacePlace vertex_place(Index vertex) const;

    /// The mesh's own unit normal along the canvas' axes, or none.
    std::optional<Vec3> normal(const View& view, const FacePlace& place) const;
    /// The texture coordinates of this set, or null.
    const Attribute* coordinates(Index face, int set) const;
    /// The mesh's own tangent along the canvas' axes and its sign, or none.
    std::optional<std::pair<Vec3, double>> tangent(const View& view, const FacePlace& place) const;
    /// Whether to draw the edge opposite to each corner.
    std::array<bool, 3> lines(Index face) const;
    bool has_normals() const { return normals_ != nullptr; }
    bool has_lines() const { return lines_ != nullptr; }

  private:
    bool has(Index face, const Attribute& a) const;

    std::shared_ptr<const Mesh>
        own_; ///< owns the mesh that mesh_ points to, if it differs from the part's mesh
    const Mesh* mesh_;
    bool has_faces_, mirrored_;
    std::uint32_t first_;
    Transform to_world_;
    std::vector<Vec3> points_;
    std::unique_ptr<Painter> painter_;
    std::unique_ptr<RealEdges> lines_;
    const Attribute *normals_ = nullptr, *tangents_ = nullptr;
    std::vector<const Attribute*> coordinates_; ///< texture coordinates by set
    const std::vector<std::uint32_t>* primitive_of_face_ = nullptr;
};

/// All drawn parts, with consecutive numbers for triangles and single vertices.
class SceneDrawing {
  public:
    SceneDrawing(const Scene& scene, const PictureSettings& settings, const View& view,
                 const ValueRange& range);

    const std::vector<PartDrawing>& parts() const { return parts_; }
    /// The part that has a number.
    const PartDrawing& part_of(std::uint32_t number) const;
    std::size_t faces() const { return faces_; } ///< the number of faces of all parts; a polygon counts once

  private:
    std::vector<PartDrawing> parts_;
    std::size_t faces_ = 0;
};

} // namespace facetmill
