// Chooses the diagonals along which quads are cut.
#include "mesh/quad_diagonal.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>
#include <unordered_map>

namespace facetmill {

namespace {

std::uint64_t key_of(Index a, Index b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

std::uint64_t diagonal_of(const Mesh& mesh, Index f, bool second) {
    const Index c = mesh.face_begin(f) + second;
    return key_of(mesh.vertex(c), mesh.vertex(c + 2));
}

/// The counts of keys that occur more than once.
std::unordered_map<std::uint64_t, int> repeated_keys(std::vector<std::uint64_t> keys) {
    radix_sort(keys, [](std::uint64_t k) { return k; });
    std::unordered_map<std::uint64_t, int> found;
    for (std::size_t i = 1; i < keys.size(); ++i)
        if (keys[i] == keys[i - 1]) ++found.emplace(keys[i], 1).first->second;
    return found;
}

/// The edges that a diagonal may coincide with, each once.
std::vector<std::uint64_t> edges_between_corners_of_quads(const Mesh& mesh) {
    std::vector<std::uint8_t> of_quad(mesh.vertex_count());
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_size(f) == 4)
            for (const Index w : mesh.face_wedges(f)) of_quad[mesh.vertex_of_wedge(w)] = 1;
    std::vector<std::uint64_t> keys;
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f), last = mesh.face_end(f) - 1; c < mesh.face_end(f); last = c++) {
            const Index from = mesh.vertex(last), to = mesh.vertex(c);
            if (of_quad[from] && of_quad[to] && from != to) keys.push_back(key_of(from, to));
        }
    radix_sort(keys, [](std::uint64_t k) { return k; });
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
    return keys;
}

} // namespace

QuadDiagonals quad_diagonals(const Mesh& mesh, Index f) {
    const Index c = mesh.face_begin(f);
    const Vec3 &p0 = mesh.point(c), &p1 = mesh.point(c + 1), &p2 = mesh.point(c + 2), &p3 = mesh.point(c + 3);
    const auto agree = [](const Vec3& a, const Vec3& b) { return dot(a, b) > 0; };
    QuadDiagonals quad;
    quad.first = agree(cross(p1 - p0, p2 - p0), cross(p2 - p0, p3 - p0));
    quad.second = agree(cross(p2 - p1, p3 - p1), cross(p3 - p1, p0 - p1));
    const Vec3 d0 = p2 - p0, d1 = p3 - p1;
    quad.cut_at_second = quad.concave() ? quad.second : dot(d1, d1) < dot(d0, d0);
    return quad;
}

QuadCuts quad_cuts(const Mesh& mesh) {
    QuadCuts cuts;
    cuts.at_second.resize(mesh.face_count());
    parallel_for(mesh.face_count(), [&](std::size_t f) {
        if (mesh.face_size(static_cast<Index>(f)) == 4)
            cuts.at_second[f] = quad_diagonals(mesh, static_cast<Index>(f)).cut_at_second;
    });
    std::vector<std::uint64_t> keys = edges_between_corners_of_quads(mesh);
    const std::size_t old = keys.size();
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_size(f) == 4) keys.push_back(diagonal_of(mesh, f, cuts.at_second[f]));
    auto taken = repeated_keys(keys);
    if (taken.empty()) return cuts;
    std::sort(keys.begin() + static_cast<std::ptrdiff_t>(old), keys.end());
    const auto is_free = [&](std::uint64_t key) {
        const auto half = keys.begin() + static_cast<std::ptrdiff_t>(old);
        return !taken.contains(key) && !std::binary_search(keys.begin(), half, key) &&
               !std::binary_search(half, keys.end(), key);
    };
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (mesh.face_size(f) != 4) continue;
        const auto mine = taken.find(diagonal_of(mesh, f, cuts.at_second[f]));
        if (mine == taken.end() || mine->second < 2) continue;
        const QuadDiagonals quad = quad_diagonals(mesh, f);
        const std::uint64_t other = diagonal_of(mesh, f, !cuts.at_second[f]);
        if (!quad.first || !quad.second || !is_free(other)) {
            ++cuts.coinciding;
            continue;
        }
        --mine->second;
        taken.emplace(other, 1);
        cuts.at_second[f] = !cuts.at_second[f];
    }
    return cuts;
}

} // namespace facetmill
