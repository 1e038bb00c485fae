#include "geometry/thicken/extrude.hpp"

#include "geometry/edit/split_non_manifold.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/inspect/connectivity.hpp"
#include "geometry/terrain/terrain.hpp"
#include "geometry/thicken/doubled.hpp"
#include "mesh/face.hpp"
#include "mesh/topology.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <numeric>

namespace facetmill {

namespace {

/// The surface as seen along the axis, and which way it looks.
struct SurfaceToExtrude {
    std::vector<Vec3> world; ///< [vertices]
    int looks = 0;           ///< 1 up, -1 down
};

/// A place where the surface looks the other way than the rest, or lies above itself.
std::optional<Vec3> place_of_overhang(const SeenSurface& seen, const TerrainView& view) {
    for (std::size_t t = 0; t < seen.size() && !seen.doubled; ++t) {
        if (seen.sign[t] >= 0) continue;
        const auto at = [&](std::size_t k) { return seen.points[seen.corners[3 * t + k]]; };
        return view.world((at(0) + at(1) + at(2)) / 3);
    }
    if (!seen.doubled) return {};
    return view.world({seen.doubled->x, seen.doubled->y, -view.origin.z});
}

/// Sets looks, and the reason against a solid in r.
SurfaceToExtrude look_along(const Mesh& mesh, const ExtrudeSettings& s, ExtrudeResult& r) {
    SurfaceToExtrude out;
    Surface surface = surface_of(mesh);
    parallel_for(surface.positions.size(),
                 [&](std::size_t v) { surface.positions[v] = s.to_world.point(surface.positions[v]); });
    const TerrainView view = TerrainView::of(s.axis, surface.bounds());
    const SeenSurface seen = seen_surface(surface, view);
    out.world = std::move(surface.positions);
    Box box;
    for (const Index v : surface.corners) box.add(out.world[v]);
    r.low = box.empty() ? 0 : box.min[s.axis];
    r.high = box.empty() ? 0 : box.max[s.axis];
    const auto up = std::count(seen.turn.begin(), seen.turn.end(), 1),
               down = std::count(seen.turn.begin(), seen.turn.end(), -1);
    if (seen.cover == Cover::overhangs || seen.cover == Cover::several) {
        r.refused = NoSolid::overhangs;
        r.at = place_of_overhang(seen, view);
    } else if (up + down == 0) {
        r.refused = NoSolid::edge_on;
    } else if (seen.cover == Cover::solid) {
        r.refused = NoSolid::closed;
    } else if (up > 0 && down > 0) {
        r.refused = NoSolid::mixed;
    } else if (s.level && *s.level >= r.low && *s.level <= r.high &&
               (r.low == r.high || (*s.level != r.low && *s.level != r.high))) {
        r.refused = NoSolid::level_crosses;
    }
    // x and z, the plane of axis y, are left-handed. A mirrored part keeps its front.
    const int hand = (s.axis == 1 ? -1 : 1) * (s.to_world.determinant() < 0 ? -1 : 1);
    out.looks = up > 0 ? hand : -hand;
    return out;
}

/// The lowest vertex that is connected to each by edges along the axis, so that both end at the same place.
std::vector<Index> joined_along(const Mesh& mesh, const SurfaceToExtrude& surface, std::size_t axis) {
    DisjointSets joined(mesh.vertex_count());
    const std::size_t u = axis == 0 ? 1 : 0, w = axis == 2 ? 1 : 2;
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            const Index a = mesh.vertex(c), b = mesh.vertex(next_corner(mesh, f, c));
            const Vec3 &p = surface.world[a], &q = surface.world[b];
            if (p[u] == q[u] && p[w] == q[w]) joined.join(a, b);
        }
    std::vector<Index> root(mesh.vertex_count());
    for (Index v = 0; v < root.size(); ++v) root[v] = joined.find(v);
    return root;
}

/// The vertices of the other side: the counterpart of each vertex, and the sources of new vertices.
struct OtherSide {
    std::vector<Index> vertex, copies;
};

OtherSide other_side_of(const Mesh& mesh, const SurfaceToExtrude& surface, const ExtrudeSettings& s) {
    const auto n = static_cast<Index>(mesh.vertex_count());
    OtherSide other{std::vector<Index>(n, none), {}};
    std::vector<Index> root(n);
    std::iota(root.begin(), root.end(), Index{0});
    if (s.level) root = joined_along(mesh, surface, s.axis);
    for (Index v = 0; v < n; ++v) // a vertex at the level is its own counterpart, and that of those above it
        if (s.level && surface.world[v][s.axis] == *s.level && other.vertex[root[v]] == none)
            other.vertex[root[v]] = v;
    for (Index v = 0; v < n; ++v) {
        if (other.vertex[root[v]] == none) {
            other.vertex[root[v]] = n + static_cast<Index>(other.copies.size());
            other.copies.push_back(v);
        }
        other.vertex[v] = other.vertex[root[v]];
    }
    return other;
}

/// Moves the new vertices to the other side.
void move_copies(Mesh& solid, const OtherSide& other, const SurfaceToExtrude& surface,
                 const ExtrudeSettings& s) {
    const Transform back = inverse(s.to_world).value_or(Transform{});
    const std::size_t n = surface.world.size();
    for (std::size_t i = 0; i < other.copies.size(); ++i) {
        Vec3 p = surface.world[other.copies[i]];
        p[s.axis] = s.level ? *s.level : p[s.axis] + s.length;
        solid.positions[n + i] = back.point(p);
    }
}

/// [faces] 1 for faces of the other side without area, because their vertices were joined, and for faces at
/// the level on both sides.
std::vector<std::uint8_t> vanished_faces(const Mesh& solid, const OtherSide& other, std::size_t faces) {
    std::vector<std::uint8_t> gone(solid.face_count(), 0);
    std::vector<Index> ring;
    for (Index f = 0; f < 2 * faces; ++f) {
        ring.clear();
        bool at_level = true;
        for (Index c = solid.face_begin(f); c < solid.face_end(f); ++c) {
            const Index v = solid.vertex(c);
            ring.push_back(v);
            at_level = at_level && v < other.vertex.size() && other.vertex[v] == v;
        }
        std::sort(ring.begin(), ring.end());
        const bool joined = f >= faces && std::adjacent_find(ring.begin(), ring.end()) != ring.end();
        gone[f] = at_level || joined;
    }
    return gone;
}

void turn_faces_over(Mesh& mesh) {
    for (Index f = 0; f < mesh.face_count(); ++f)
        std::reverse(mesh.corners.begin() + mesh.face_begin(f) + 1, mesh.corners.begin() + mesh.face_end(f));
}

/// Gives the wedges of the other side the normal of a flat face.
void add_flat_normals(const Mesh& mesh, bool down, const ExtrudeSettings& s, WedgeNormals& normals) {
    Vec3 out;
    out[s.axis] = down ? -1 : 1;
    const Vec3 normal = normalised(s.to_world.pull_normal(out));
    const auto n = static_cast<Index>(mesh.wedge_count());
    normals.reserve(normals.size() + n);
    for (Index w = 0; w < n; ++w) normals.emplace_back(n + w, normal);
}

/// Without attributes and seams, wedges are vertices.
void vertices_for_wedges(Doubled& d) {
    for (Index& c : d.mesh.corners) c = d.mesh.wedge_vertex[c];
    d.mesh.wedge_vertex = {};
    d.provenance.wedges = d.provenance.vertices;
}

void make_solid(Mesh mesh, const SurfaceToExtrude& surface, const ExtrudeSettings& s, ExtrudeResult& r) {
    const bool down = s.level ? *s.level <= r.low : s.length < 0, turns = (down ? 1 : -1) != surface.looks;
    if (turns) turn_faces_over(mesh);
    const OtherSide other = other_side_of(mesh, surface, s);
    Doubled d = doubled(mesh, other.vertex, other.copies);
    move_copies(d.mesh, other, surface, s);
    WedgeNormals normals;
    r.wall_faces = add_walls(mesh, d, normals);
    const bool plain =
        !mesh.has_seams() && std::none_of(mesh.attributes.begin(), mesh.attributes.end(),
                                          [](const auto& a) { return a.domain == Domain::wedge; });
    if (plain) vertices_for_wedges(d);
    r.changes = inherit_attributes(d.mesh, mesh, d.provenance);
    if (!plain) {
        if (turns) turn_wedges(d.mesh, 0, r.changes); // the other side is then turned twice
        turn_wedges(d.mesh, mesh.wedge_count(), r.changes);
        if (s.level) add_flat_normals(mesh, down, s, normals);
        set_normals(d.mesh, normals);
    }
    std::vector<std::uint8_t> drop(d.mesh.vertex_count(), 1);
    std::fill_n(drop.begin(), mesh.vertex_count(), 0);
    for (Index c = 0; c < mesh.corner_count(); ++c) drop[mesh.vertex(c)] = 1;
    const std::vector<std::uint8_t> gone = vanished_faces(d.mesh, other, mesh.face_count());
    drop_unused(d.mesh, drop);
    r.mesh = std::count(gone.begin(), gone.end(), 1) > 0 ? keep_faces(d.mesh, faces_without(gone))
                                                         : std::move(d.mesh);
}

} // namespace

ExtrudeResult extrude(const Mesh& mesh, const ExtrudeSettings& s) {
    ExtrudeResult r;
    if (mesh.face_count() == 0) {
        r.mesh = mesh;
        r.changes = kept_changes(mesh.attributes);
        return r;
    }
    Mesh sheets = connectivity_of(mesh).is_manifold() ? mesh : split_non_manifold(mesh);
    const SurfaceToExtrude surface = look_along(sheets, s, r);
    if (r.refused == NoSolid::none) make_solid(std::move(sheets), surface, s, r);
    return r;
}

} // namespace facetmill
