#include "geometry/inspect/uv_overlaps.hpp"

#include "base/parallel.hpp"
#include "base/predicates.hpp"
#include "geometry/spatial/box_tree.hpp"

#include <algorithm>
#include <array>

namespace facetmill {

namespace {

struct Flat {
    std::array<Vec3, 3> p; ///< z is 0; anticlockwise
    Index face;
};

int side(const Vec3& a, const Vec3& b, const Vec3& p) { return orientation_2d(a.x, a.y, b.x, b.y, p.x, p.y); }

/// Whether an edge of s has all of t on its outer side or on its line.
bool edge_parts(const Flat& s, const Flat& t) {
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &a = s.p[i], &b = s.p[(i + 1) % 3];
        if (std::all_of(t.p.begin(), t.p.end(), [&](const Vec3& p) { return side(a, b, p) <= 0; }))
            return true;
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
        for (Index c = begin + 1; c + 1 < mesh.face_end(f); ++c) {
            Flat flat{{at(begin), at(c), at(c + 1)}, f};
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

std::optional<std::vector<std::pair<Index, Index>>> uv_overlaps(const Mesh& mesh) {
    const Attribute* uv = mesh.find("TEXCOORD_0", Domain::wedge);
    if (!uv || uv->components < 2) return {};
    const auto triangles = triangles_of(mesh, *uv);
    std::vector<Box> boxes(triangles.size());
    for (std::size_t t = 0; t < boxes.size(); ++t)
        for (const Vec3& p : triangles[t].p) boxes[t].add(p);
    const BoxTree tree(boxes);
    using Pairs = std::vector<std::pair<Index, Index>>;
    Pairs pairs = parallel_reduce(
        triangles.size(), Pairs{},
        [&](std::size_t begin, std::size_t end) {
            Pairs found;
            for (std::size_t t = begin; t < end; ++t)
                tree.visit(boxes[t], [&](Index o) {
                    const Flat &a = triangles[t], &b = triangles[o];
                    if (b.face > a.face && !edge_parts(a, b) && !edge_parts(b, a))
                        found.emplace_back(a.face, b.face);
                });
            return found;
        },
        [](Pairs a, const Pairs& b) {
            a.insert(a.end(), b.begin(), b.end());
            return a;
        },
        1024);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

} // namespace facetmill
