// The faces that are left when vertices are joined in cells.

#include "base/parallel.hpp"
#include "geometry/simplify/cluster.hpp"

#include <bit>

namespace facetmill::simplification {

namespace {

/// A face by its three roots, from the lowest on; turned: against the order of the other two.
struct Triple {
    Index low, middle, high;
    bool turned;
    Index face;
    bool same_place(const Triple& o) const { return low == o.low && middle == o.middle && high == o.high; }
};

Triple triple_of(const Work& s, const Clusters& c, Index f) {
    std::array<Index, 3> v{c.root[s.tri[3 * f]], c.root[s.tri[3 * f + 1]], c.root[s.tri[3 * f + 2]]};
    std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
    const bool turned = v[1] > v[2];
    return {v[0], std::min(v[1], v[2]), std::max(v[1], v[2]), turned, f};
}

/// Of faces in one place the first that looks to the side of the majority; one to each side when there is
/// none.
void keep_some(std::span<const Triple> same, std::vector<Index>& faces) {
    const auto turned = std::count_if(same.begin(), same.end(), [](const Triple& t) { return t.turned; });
    const auto other = static_cast<std::ptrdiff_t>(same.size()) - turned;
    const auto first = [&](bool side) {
        faces.push_back(
            std::find_if(same.begin(), same.end(), [&](const Triple& t) { return t.turned == side; })->face);
    };
    if (turned >= other) first(true);
    if (other >= turned) first(false);
}

} // namespace

void keep_faces(const Work& s, Clusters& c) {
    std::vector<Triple> triples;
    for (Index f = 0; f < s.face_slots(); ++f) {
        const Index x = c.root[s.tri[3 * f]], y = c.root[s.tri[3 * f + 1]], z = c.root[s.tri[3 * f + 2]];
        if (x != y && y != z && z != x) triples.push_back(triple_of(s, c, f));
    }
    const int bits = std::bit_width(s.vertex_slots());
    radix_sort( // stable: faces stay in order where all three agree
        triples, [](const Triple& t) { return t.high; }, bits);
    radix_sort(
        triples, [](const Triple& t) { return (std::uint64_t{t.low} << 32) | t.middle; }, 32 + bits);
    for (std::size_t begin = 0, end = 0; begin < triples.size(); begin = end) {
        while (end < triples.size() && triples[end].same_place(triples[begin])) ++end;
        keep_some({&triples[begin], end - begin}, c.faces);
    }
    std::sort(c.faces.begin(), c.faces.end());
}

} // namespace facetmill::simplification
