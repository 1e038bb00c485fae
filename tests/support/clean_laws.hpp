#pragma once
// The guarantees of clean for any mesh, checked in the plainest way.

#include "support/catch.hpp"
#include "support/measure.hpp"

#include "geometry/clean/clean.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/inspect/evidence.hpp"
#include "mesh/invariants.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace facetmill::test {

/// Checks a union: closed, edge-manifold and without intersections.
inline void check_solid(const Mesh& mesh) {
    CHECK(broken_invariants(mesh) == std::vector<std::string>{});
    CHECK(closed(mesh));
    CHECK(edge_manifold(mesh));
    CHECK(clean_steps::crossings(mesh).count == 0);
}

using Shape = std::vector<std::array<double, 3>>;

/// The corner positions, starting at the lowest. Equal for faces that look the same.
inline Shape shape_of(const Mesh& mesh, Index f) {
    Shape shape;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
        const Vec3 p = mesh.point(c) + Vec3{}; // -0 is 0
        shape.push_back({p.x, p.y, p.z});
    }
    std::rotate(shape.begin(), std::min_element(shape.begin(), shape.end()), shape.end());
    return shape;
}

/// Faces with area and without duplicate, whose vertices all lie inside a single fan of a manifold surface.
inline std::vector<Shape> sound_faces(const Mesh& mesh) {
    const auto edges = build_edges(mesh);
    const auto faces = corner_faces(mesh);
    const auto fans = fans_at_vertices(mesh, edges);
    std::set<Index> open;
    for (Index e = 0; e < edges.size(); ++e)
        if (edges.corners_of(e).size() != 2)
            for (const Index c : edges.corners_of(e)) {
                open.insert(mesh.vertex(c));
                open.insert(mesh.vertex(next_corner(mesh, faces[c], c)));
            }
    std::map<std::array<double, 3>, std::set<Index>> at_place;
    for (Index c = 0; c < mesh.corner_count(); ++c) {
        const Vec3 p = mesh.point(c) + Vec3{};
        at_place[{p.x, p.y, p.z}].insert(mesh.vertex(c));
    }
    const auto doubles = duplicate_faces(mesh);
    std::set<std::vector<Index>> doubled;
    const auto set_of = [&](Index f) {
        std::vector<Index> set;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) set.push_back(mesh.vertex(c));
        std::sort(set.begin(), set.end());
        return set;
    };
    for (const Index f : doubles) doubled.insert(set_of(f));
    std::set<Index> unsound; // include vertices of faces without area, which clean may put on adjacent edges
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (is_degenerate(mesh, f))
            for (const Index v : set_of(f)) unsound.insert(v);
    std::vector<Shape> sound;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        bool good = !is_degenerate(mesh, f) && !doubled.contains(set_of(f));
        Index before = none;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            const Index v = mesh.vertex(c);
            const Vec3 p = mesh.point(c) + Vec3{};
            good = good && v != before && fans[v] == 1 && !open.contains(v) && !unsound.contains(v) &&
                   at_place[{p.x, p.y, p.z}].size() == 1;
            before = v;
        }
        if (good) sound.push_back(shape_of(mesh, f));
    }
    std::sort(sound.begin(), sound.end());
    return sound;
}

inline bool same_mesh(const Mesh& a, const Mesh& b) {
    if (a.positions != b.positions || a.wedge_vertex != b.wedge_vertex || a.corners != b.corners ||
        a.face_offsets != b.face_offsets || a.primitives != b.primitives ||
        a.attributes.size() != b.attributes.size())
        return false;
    for (std::size_t i = 0; i < a.attributes.size(); ++i)
        if (a.attributes[i].name != b.attributes[i].name || a.attributes[i].data != b.attributes[i].data)
            return false;
    return true;
}

/// Returns the first violated rule; empty if none. The mesh must be valid, sound faces untouched, and a
/// second run must change nothing.
inline std::string broken_clean_law(const Mesh& mesh, const CleanSettings& settings) {
    const auto sound = sound_faces(mesh);
    const CleanResult once = clean(mesh, settings);
    if (const auto broken = broken_invariants(once.mesh); !broken.empty()) return broken.front();
    if (!settings.components && !settings.inner_components && settings.self_intersections == Untangle::off) {
        std::vector<Shape> after;
        for (Index f = 0; f < once.mesh.face_count(); ++f) after.push_back(shape_of(once.mesh, f));
        std::sort(after.begin(), after.end());
        if (!std::includes(after.begin(), after.end(), sound.begin(), sound.end()))
            return "a sound face was touched";
    }
    const CleanResult twice = clean(once.mesh, settings);
    if (twice.counts.total() != 0) return "the second time counts changes";
    if (!same_mesh(once.mesh, twice.mesh)) return "the second time changes the mesh";
    return {};
}

} // namespace facetmill::test
