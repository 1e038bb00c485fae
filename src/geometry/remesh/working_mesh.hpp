#pragma once
// The mesh that remeshing changes: triangles with the half edge across each edge, as flat arrays.

#include "mesh/mesh.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace facetmill::remeshing {

/// Flags of a half edge; both sides of an edge have the same.
enum EdgeFlag : std::uint8_t {
    feature = 1, ///< a border, a sharp edge, a seam, or a border of materials
    locked = 2,  ///< not manifold: without a twin; only split
    seam = 4,    ///< wedges differ across it
};

enum class VertexKind : std::uint8_t {
    free,  ///< moves on the surface
    line,  ///< moves along its two feature edges
    fixed, ///< stays
    many,  ///< stays, and has several fans of faces, so it cannot be walked around
};

/// Half edge h = 3 f + k runs from corner k of face f to the next. A face whose first corner is `none` is
/// removed.
class WorkingMesh {
  public:
    std::vector<Vec3> points;
    std::vector<double> sizes;     ///< [vertices] intended edge lengths
    std::vector<VertexKind> kinds; ///< [vertices]
    std::vector<Index> hints;      ///< [vertices] triangle of the input's tree near the vertex
    std::vector<Index> out;        ///< [vertices] a half edge that leaves it; none: removed
    std::vector<Index> degrees;    ///< [vertices] edges
    std::vector<Index> corners;    ///< [half edges] vertices
    std::vector<Index> twins;      ///< [half edges] the other side; none at borders
    std::vector<Index> rings; ///< [half edges] the next half edge of the same locked edge; none for others
    std::vector<std::uint8_t> flags; ///< [half edges] EdgeFlag
    std::vector<Index> regions;      ///< [faces] faces connected without a feature

    std::size_t face_slots() const { return corners.size() / 3; }
    bool is_face(Index f) const { return corners[3 * std::size_t{f}] != none; }
    static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
    static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
    Index from(Index h) const { return corners[h]; }
    Index to(Index h) const { return corners[next(h)]; }
    Index opposite(Index h) const { return corners[previous(h)]; }
    /// Whether h is the half edge that represents its edge.
    bool stands(Index h) const { return corners[h - h % 3] != none && (twins[h] == none || h < twins[h]); }
    double edge_length(Index h) const { return length(points[to(h)] - points[from(h)]); }
    /// The intended length of an edge.
    double size_of(Index h) const { return std::min(sizes[from(h)], sizes[to(h)]); }

    Vec3 normal(Index a, Index b, Index c) const {
        return cross(points[b] - points[a], points[c] - points[a]);
    }
    Vec3 face_normal(Index f) const { return normal(corners[3 * f], corners[3 * f + 1], corners[3 * f + 2]); }

    /// Calls visit(h) for the half edges that leave v, which must not be `many`. Stops if visit returns
    /// false. visit may change corners. Returns whether all were visited.
    template <class Visit>
    bool around(Index v, Visit&& visit) const {
        Index h = out[v];
        do {
            if (!visit(h)) return false;
            h = twins[previous(h)];
        } while (h != none && h != out[v]);
        if (h != none) return true;
        for (h = twins[out[v]]; h != none; h = twins[h]) {
            h = next(h);
            if (!visit(h)) return false;
        }
        return true;
    }
    /// Calls visit(w) for the vertices joined to v by an edge.
    template <class Visit>
    void neighbours(Index v, Visit&& visit) const {
        around(v, [&](Index h) {
            visit(to(h));
            if (twins[previous(h)] == none) visit(opposite(h));
            return true;
        });
    }
    /// The neighbours of v along its feature line, or none at an end of the line.
    [[nodiscard]] std::optional<std::array<Index, 2>> line_ends(Index v) const {
        std::array<Index, 2> ends{none, none};
        std::size_t count = 0;
        around(v, [&](Index h) {
            if (flags[h] & feature && count < 2) ends[count++] = to(h);
            if (twins[previous(h)] == none && count < 2) ends[count++] = opposite(h);
            return true;
        });
        return count < 2 ? std::nullopt : std::optional(ends);
    }
    [[nodiscard]] bool is_border(Index v) const {
        return !around(v, [&](Index h) { return twins[h] != none && twins[previous(h)] != none; });
    }
    /// Whether v and w, of which one is not `many`, have an edge.
    [[nodiscard]] bool are_joined(Index v, Index w) const;

    /// Puts a new vertex on the edge. Returns the vertex.
    Index split(Index h, const Vec3& point, double size, Index hint);
    /// The same for a locked edge, at all its sides.
    void split_locked(Index h, const Vec3& point, double size, Index hint);
    /// Whether h is the first of the sides of its locked edge.
    [[nodiscard]] bool leads_ring(Index h) const;
    /// Moves the first vertex of h into the second. The caller has checked that this keeps the surface.
    void collapse(Index h);
    /// Replaces the edge of two triangles by the other diagonal.
    void flip(Index h);
    /// Renumbers vertices and faces without the removed ones, in their order.
    void compact();

  private:
    void join(Index h, Index twin) {
        twins[h] = twin;
        if (twin != none) twins[twin] = h;
    }
    Index add_vertex(const Vec3& point, double size, Index hint, VertexKind kind);
    /// Puts vertex m on a side of an edge. Returns the half edge from m to the end of the side.
    Index halve(Index side, Index m);
    Index add_face(const std::array<Index, 3>& vertices, Index region);
    void close_gap(Index f, Index a, Index b);
};

} // namespace facetmill::remeshing
