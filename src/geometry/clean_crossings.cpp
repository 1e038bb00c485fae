// The step of clean that replaces faces that intersect others.
#include "geometry/clean_steps.hpp"
#include "geometry/self_intersections.hpp"
#include "geometry/surgery.hpp"
#include "mesh/topology.hpp"

#include <fmt/format.h>

namespace facetmill::clean_steps {

namespace {

/// Flags the faces that share a vertex with a flagged one.
void widen(const Mesh& mesh, std::vector<std::uint8_t>& flags) {
    std::vector<std::uint8_t> vertices(mesh.vertex_count(), 0);
    for (Index f = 0; f < flags.size(); ++f)
        if (flags[f])
            for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) vertices[mesh.vertex(c)] = 1;
    for (Index f = 0; f < flags.size(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) flags[f] |= vertices[mesh.vertex(c)];
}

std::size_t open_edges(const Mesh& mesh) {
    const auto edges = build_edges(mesh);
    std::size_t open = 0;
    for (Index e = 0; e < edges.size(); ++e) open += edges.corners_of(e).size() % 2;
    return open;
}

} // namespace

bool resolve_self_intersections(Work& work) {
    constexpr std::size_t most_pairs = std::size_t{1} << 22;
    constexpr int most_rings = 4;
    const SelfIntersections found = find_self_intersections(work.mesh, {.limit = most_pairs});
    if (found.count == 0) return false;
    const std::size_t open = open_edges(work.mesh);
    Vec3 at;
    for (Index c = work.mesh.face_begin(found.pairs[0].first); c < work.mesh.face_end(found.pairs[0].first);
         ++c)
        at += work.mesh.point(c) / work.mesh.face_size(found.pairs[0].first);
    std::vector<std::uint8_t> flags(work.mesh.face_count(), 0);
    for (const auto& [f, g] : found.pairs) flags[f] = flags[g] = 1;
    for (int ring = 0; ring < most_rings; ++ring) {
        const auto kept = faces_without(flags);
        Work trial;
        trial.mesh = keep_faces(work.mesh, kept);
        split_non_manifold(trial);
        fill_holes(trial, {});
        if (open_edges(trial.mesh) <= open && find_self_intersections(trial.mesh, {.limit = 0}).count == 0) {
            work.counts.intersecting_faces += flags.size() - kept.size();
            work.mesh = std::move(trial.mesh);
            if (!trial.fates.empty()) work.fates = std::move(trial.fates);
            return true;
        }
        widen(work.mesh, flags);
    }
    work.not_done.push_back(
        {"self_intersections",
         fmt::format(
             "the holes that {} intersecting pairs would leave cannot be filled without new intersections",
             found.count),
         at});
    return false;
}

} // namespace facetmill::clean_steps
