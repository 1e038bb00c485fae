#include "geometry/clean/solid_pieces.hpp"

#include "base/parallel.hpp"
#include "geometry/clean/solids.hpp"
#include "geometry/spatial/rays.hpp"

#include <algorithm>
#include <map>

namespace facetmill {

namespace {

using clean_steps::Solids;

/// For each closed piece the closed pieces that it lies in, ascending.
std::vector<std::vector<Index>> pieces_around(const Mesh& mesh, const Solids& solids) {
    std::vector<Index> first(solids.pieces.count, none);
    for (Index f = mesh.face_count(); f-- > 0;) first[solids.pieces.of_face[f]] = f;
    const FaceTree rays(surface_of(mesh), FaceTree::Use::rays);
    std::vector<std::vector<Index>> around(solids.pieces.count);
    parallel_for(
        around.size(),
        [&](std::size_t p) {
            if (!solids.closed[p]) return;
            std::map<Index, int> turns; // of each piece around the point
            visit_along_axis(rays, mesh.point(mesh.face_begin(first[p])), 0, true, [&](Index f, int way) {
                const Index q = solids.pieces.of_face[f];
                if (q != p && solids.closed[q]) turns[q] += way;
            });
            for (const auto& [q, n] : turns)
                if (n != 0) around[p].push_back(q);
        },
        1);
    return around;
}

} // namespace

Components solid_pieces(const Mesh& mesh) {
    Solids solids = clean_steps::find_solids(mesh, {});
    const auto is_cavity = [&](Index p) { return solids.closed[p] && solids.inward[p]; };
    std::vector<Index> solid_of(solids.pieces.count);
    bool any = false;
    for (Index p = 0; p < solid_of.size(); ++p) {
        solid_of[p] = p;
        any |= is_cavity(p);
    }
    if (!any || solid_of.size() < 2) return std::move(solids.pieces);
    const auto around = pieces_around(mesh, solids);
    for (Index p = 0; p < solid_of.size(); ++p) {
        if (!is_cavity(p)) continue;
        std::size_t depth = 0; // the innermost lies in most others itself
        for (const Index q : around[p])
            if (!is_cavity(q) && (solid_of[p] == p || around[q].size() > depth)) {
                solid_of[p] = q;
                depth = around[q].size();
            }
    }
    std::vector<Index> number(solid_of.size(), none);
    Components joined{std::move(solids.pieces.of_face), 0};
    for (Index& piece : joined.of_face) {
        Index& n = number[solid_of[piece]];
        if (n == none) n = static_cast<Index>(joined.count++);
        piece = n;
    }
    return joined;
}

} // namespace facetmill
