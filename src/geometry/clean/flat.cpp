// Triangles without area, as rounding makes them of the pieces of a union.
#include "geometry/clean/united.hpp"
#include "geometry/inspect/evidence.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace facetmill::clean_steps {

namespace {

/// The corner opposite to the longest side of a triangle on a line; none where corners are at one place.
std::optional<Index> middle_corner(const Mesh& mesh, Index f) {
    const Index begin = mesh.face_begin(f);
    std::array<Index, 3> c{begin, begin + 1, begin + 2};
    Box box;
    add_corners(box, mesh, f);
    const Vec3 extent = box.extent();
    const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    std::sort(c.begin(), c.end(),
              [&](Index i, Index j) { return mesh.point(i)[axis] < mesh.point(j)[axis]; });
    const bool apart =
        mesh.point(c[0])[axis] < mesh.point(c[1])[axis] && mesh.point(c[1])[axis] < mesh.point(c[2])[axis];
    return apart ? std::optional(c[1]) : std::nullopt;
}

/// One round: triangles that go, and what is put where. Each face takes part once.
struct Round {
    std::vector<std::uint8_t> goes;
    std::vector<Insertion> insertions;
    std::vector<Index> cut; ///< triangles that become two, ascending
};

Round plan(const Mesh& mesh) {
    Round round;
    std::vector<Index> flat;
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_size(f) == 3 && is_degenerate(mesh, f)) flat.push_back(f);
    if (flat.empty()) return round;
    round.goes.assign(mesh.face_count(), 0);
    const auto edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    std::vector<std::uint8_t> busy(mesh.face_count(), 0);
    for (const Index f : flat) {
        const auto middle = middle_corner(mesh, f);
        if (!middle || busy[f]) continue;
        const Index from = next_corner(mesh, f, *middle), e = edges.corner_edge[from];
        if (e == none) continue;
        for (const Index c : edges.corners_of(e)) {
            const Index g = faces[c];
            if (mesh.vertex(c) == mesh.vertex(from) || busy[g] || g == f) continue;
            const Vec3 &a = mesh.point(c), &b = mesh.point(next_corner(mesh, g, c));
            const double t = length(mesh.point(*middle) - a) / length(b - a);
            round.insertions.push_back({c, t, mesh.vertex(*middle)});
            if (mesh.face_size(g) == 3) round.cut.push_back(g);
            busy[f] = busy[g] = 1;
            round.goes[f] = 1;
            break;
        }
    }
    std::sort(round.cut.begin(), round.cut.end());
    return round;
}

} // namespace

void take_out_flat(Work& work) {
    constexpr int most_rounds = 64;
    for (int i = 0; i < most_rounds; ++i) {
        Round round = plan(work.mesh);
        if (round.insertions.empty()) return;
        std::vector<std::uint8_t> goes(round.goes.size() + round.cut.size(), 0);
        std::size_t before = 0; // triangles that became two, below f
        for (Index f = 0; f < round.goes.size(); ++f) {
            goes[f + before] = round.goes[f];
            if (before < round.cut.size() && round.cut[before] == f) ++before;
        }
        work.mesh = insert_on_edges(work.mesh, std::move(round.insertions), {}, &work.changes);
        work.mesh = keep_faces(work.mesh, faces_without(goes));
    }
}

} // namespace facetmill::clean_steps
