#pragma once
// Plain, slow measurements of meshes, independent of the tested code.

#include "mesh/mesh.hpp"
#include "mesh/scene.hpp"

#include <map>
#include <set>

namespace facetmill::test {

inline double area(const Mesh& mesh) {
    double sum = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        Vec3 twice;
        for (Index c = mesh.face_begin(f) + 1; c + 1 < mesh.face_end(f); ++c)
            twice += cross(mesh.point(c) - mesh.point(mesh.face_begin(f)),
                           mesh.point(c + 1) - mesh.point(mesh.face_begin(f)));
        sum += length(twice) / 2;
    }
    return sum;
}

inline double volume(const Mesh& mesh) {
    double six = 0;
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f) + 1; c + 1 < mesh.face_end(f); ++c)
            six += dot(mesh.point(mesh.face_begin(f)), cross(mesh.point(c), mesh.point(c + 1)));
    return six / 6;
}

/// The uses of each undirected edge: forward minus backward, and the total.
inline std::map<std::pair<Index, Index>, std::pair<int, int>> edge_uses(const Mesh& mesh) {
    std::map<std::pair<Index, Index>, std::pair<int, int>> uses;
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            const Index a = mesh.vertex(c),
                        b = mesh.vertex(c + 1 == mesh.face_end(f) ? mesh.face_begin(f) : c + 1);
            if (a == b) continue;
            auto& use = uses[{std::min(a, b), std::max(a, b)}];
            use.first += a < b ? 1 : -1;
            ++use.second;
        }
    return uses;
}

/// Whether the directions of the faces cancel at every edge.
inline bool closed(const Mesh& mesh) {
    for (const auto& [edge, use] : edge_uses(mesh))
        if (use.first != 0) return false;
    return true;
}

inline bool edge_manifold(const Mesh& mesh) {
    for (const auto& [edge, use] : edge_uses(mesh))
        if (use.second > 2) return false;
    return true;
}

/// V - E + F, V without isolated vertices.
inline long euler(const Mesh& mesh) {
    std::set<Index> used;
    for (Index c = 0; c < mesh.corner_count(); ++c) used.insert(mesh.vertex(c));
    return static_cast<long>(used.size()) - static_cast<long>(edge_uses(mesh).size()) +
           static_cast<long>(mesh.face_count());
}

/// The sum over all parts, each in its own space.
inline double area(const Scene& scene) {
    double sum = 0;
    for (const Part& part : scene.parts) sum += area(part.mesh);
    return sum;
}

} // namespace facetmill::test
