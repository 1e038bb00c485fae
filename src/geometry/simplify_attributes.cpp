// From the working state back to a mesh, and from the log of merges to the weights of attributes.

#include "base/parallel.hpp"
#include "geometry/simplify_surface.hpp"
#include "mesh/lineage.hpp"

namespace facetmill::simplification {

namespace {

/// The lineage of the survivors (old elements, in the new order). Every old element ends in one survivor,
/// with a weight that is the product of what it kept at each merge; so all lineages together are no longer
/// than the input.
Lineage descended(std::size_t old_count, const std::vector<Index>& survivors, const std::vector<Merge>& log) {
    Lineage lineage;
    if (log.empty()) return lineage.copies = survivors, lineage;
    std::vector<Index> root(old_count, none);
    std::vector<double> weight(old_count, 0);
    for (std::size_t i = 0; i < survivors.size(); ++i)
        root[survivors[i]] = static_cast<Index>(i), weight[survivors[i]] = 1;
    // From the last merge to the first, so that what became of a is known when b joins it.
    for (auto m = log.rbegin(); m != log.rend(); ++m) {
        root[m->b] = root[m->a];
        weight[m->b] = weight[m->a] * m->t;
        weight[m->a] *= 1 - m->t;
    }
    auto& offsets = lineage.mix_offsets;
    offsets.assign(survivors.size() + 1, 0);
    for (std::size_t w = 0; w < old_count; ++w)
        if (root[w] != none && weight[w] > 0) ++offsets[root[w]];
    const Index total = exclusive_scan(offsets);
    lineage.mix_sources.resize(total), lineage.mix_weights.resize(total);
    std::vector<Index> place(offsets.begin(), offsets.end() - 1);
    for (std::size_t w = 0; w < old_count; ++w) {
        if (root[w] == none || !(weight[w] > 0)) continue;
        const Index at = place[root[w]]++;
        lineage.mix_sources[at] = static_cast<Index>(w), lineage.mix_weights[at] = weight[w];
    }
    return lineage;
}

/// Fills corners and wedge_vertex; returns the wedges of the input that survive, in the order of the new
/// ones.
std::vector<Index> number_wedges(Mesh& to, const Surface& s, std::size_t old_wedges) {
    if (s.wedge.empty()) {
        to.corners = s.tri;
        return {};
    }
    std::vector<Index> number(old_wedges, none), survivors;
    to.corners.resize(s.wedge.size());
    for (std::size_t c = 0; c < s.wedge.size(); ++c) {
        Index& n = number[s.wedge[c]];
        if (n == none) {
            n = static_cast<Index>(survivors.size());
            survivors.push_back(s.wedge[c]);
            to.wedge_vertex.push_back(s.tri[c]);
        }
        to.corners[c] = n;
    }
    return survivors;
}

} // namespace

Mesh finished(Surface& s, const Mesh& from, Fates& fates) {
    compact(s);
    Mesh to;
    to.positions.resize(s.vertex_slots());
    parallel_for(to.positions.size(), [&](std::size_t v) {
        to.positions[v] = s.moved[v] ? s.at[v] / s.scale + s.centre : from.positions[s.source[v]];
    });
    const std::vector<Index> wedges = number_wedges(to, s, from.wedge_count());
    Descent descent;
    descent.vertices = descended(from.vertex_count(), s.source, s.log.vertices);
    descent.wedges = s.wedge.empty() ? descent.vertices : descended(from.wedge_count(), wedges, s.log.wedges);
    descent.faces = s.face_source;
    fates = inherit_attributes(to, from, descent);
    return to;
}

} // namespace facetmill::simplification
