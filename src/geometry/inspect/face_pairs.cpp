// Finds pairs of faces that cover each other: neighbours, coplanar faces, and faces in the texture.
#include "base/math/predicates.hpp"
#include "base/sort_unique.hpp"
#include "geometry/edit/around_edge.hpp"
#include "geometry/inspect/measures.hpp"
#include "geometry/intersect/self_intersections.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>

namespace facetmill::inspect_room {

namespace {

struct Flat {
    std::array<Vec3, 3> p; ///< anticlockwise, with z 0
    Index face, material;
};

int side(const Vec3& a, const Vec3& b, const Vec3& p) { return orientation_2d(a.x, a.y, b.x, b.y, p.x, p.y); }

/// How far coordinates may be inside another face because they were rounded to 32 bits, as a share of the
/// texture. It is a 256th of a texel in the largest textures, of 16384 texels.
constexpr double rounding_depth = 0x1p-22;

/// Whether an edge of s has all of t on its outer side or on its line, except for the rounding.
bool edge_separates(const Flat& s, const Flat& t) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = s.p[i], &b = s.p[(i + 1) % 3];
        const Vec3 along = b - a;
        const double reach = rounding_depth * length(along);
        const auto is_outside = [&](const Vec3& p) {
            return side(a, b, p) <= 0 || along.x * (p.y - a.y) - along.y * (p.x - a.x) <= reach;
        };
        if (std::all_of(t.p.begin(), t.p.end(), is_outside)) return true;
    }
    return false;
}

std::vector<Flat> triangles_of(const Mesh& mesh, const Attribute& uv) {
    std::vector<Flat> all;
    const auto at = [&](Index c) {
        return Vec3{uv.value(mesh.corners[c], 0), uv.value(mesh.corners[c], 1), 0};
    };
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Index begin = mesh.face_begin(f);
        const Index material =
            mesh.primitives.empty() ? none : mesh.primitives[mesh.primitive_of(f)].material;
        for (Index c = begin + 1; c + 1 < mesh.face_end(f); ++c) {
            Flat flat{{at(begin), at(c), at(c + 1)}, f, material};
            if (!std::all_of(flat.p.begin(), flat.p.end(), [](const Vec3& p) { return is_finite(p); }))
                continue;
            const int turn = side(flat.p[0], flat.p[1], flat.p[2]);
            if (turn < 0) std::swap(flat.p[1], flat.p[2]);
            if (turn != 0) all.push_back(flat);
        }
    }
    return all;
}

} // namespace

Pairs folded_faces(const Mesh& mesh) {
    const auto edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<std::uint8_t> folded(edges.size(), 0);
    parallel_for(edges.size(), [&](std::size_t e) {
        const auto corners = edges.corners_of(static_cast<Index>(e));
        if (corners.size() != 2) return;
        const Index f = faces[corners[0]], g = faces[corners[1]];
        if (f == g || is_degenerate(mesh, f) || is_degenerate(mesh, g)) return;
        const Vec3 &u = mesh.positions[edges.edges[e].low], &v = mesh.positions[edges.edges[e].high];
        const Vec3 p = beside_edge(mesh, f, corners[0]), q = beside_edge(mesh, g, corners[1]);
        folded[e] = orientation_3d(u, v, p, q) == 0 && on_same_side(u, v, p, q);
    });
    Pairs list;
    for (Index e = 0; e < folded.size(); ++e)
        if (folded[e])
            list.push_back(std::minmax(faces[edges.corners_of(e)[0]], faces[edges.corners_of(e)[1]]));
    std::sort(list.begin(), list.end());
    return list;
}

Pairs coplanar_overlaps(const Mesh& mesh) {
    Pairs list;
    for (const auto& [f, g] :
         find_self_intersections(mesh, {.limit = std::size_t{1} << 24, .separate_touching = true}).pairs) {
        const Index begin = mesh.face_begin(f);
        bool flat = true;
        for (Index c = mesh.face_begin(g); c < mesh.face_end(g); ++c)
            for (Index k = begin + 1; k + 1 < mesh.face_end(f); ++k)
                flat = flat && orientation_3d(mesh.point(begin), mesh.point(k), mesh.point(k + 1),
                                              mesh.point(c)) == 0;
        if (flat) list.emplace_back(f, g);
    }
    return list;
}

std::optional<Pairs> uv_overlaps(const Mesh& mesh) {
    const Attribute* uv = mesh.find("TEXCOORD_0", Domain::wedge);
    if (!uv || uv->components < 2) return {};
    const auto triangles = triangles_of(mesh, *uv);
    std::vector<Box> boxes(triangles.size());
    for (std::size_t t = 0; t < boxes.size(); ++t)
        for (const Vec3& p : triangles[t].p) boxes[t].add(p);
    const BoxTree tree(boxes);
    Pairs pairs = parallel_reduce(
        triangles.size(), Pairs{},
        [&](std::size_t begin, std::size_t end) {
            Pairs found;
            for (std::size_t t = begin; t < end; ++t)
                tree.visit(boxes[t], [&](Index o) {
                    const Flat &a = triangles[t], &b = triangles[o];
                    if (b.face > a.face && b.material == a.material && !edge_separates(a, b) &&
                        !edge_separates(b, a))
                        found.emplace_back(a.face, b.face);
                });
            return found;
        },
        [](Pairs a, const Pairs& b) {
            a.insert(a.end(), b.begin(), b.end());
            return a;
        },
        1024);
    sort_unique(pairs);
    return pairs;
}

} // namespace facetmill::inspect_room
