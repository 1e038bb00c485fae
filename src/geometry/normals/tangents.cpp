// Computes tangents like glTF viewers for files without tangents: M. S. Mikkelsen, "Simulation of Wrinkled
// Surfaces Revisited" (2008), chapter 3 and appendix A, in the form that bakers of normal maps agree on
// (MikkTSpace).

#include "geometry/normals/tangents.hpp"
#include "base/math/portable_math.hpp"
#include "mesh/separate_wedges.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <numeric>

namespace facetmill {

namespace {

constexpr double smallest_float =
    1.1754943508222875e-38; ///< the smallest normal float32; smaller numbers count as zero

bool vanishes(const Vec3& v) {
    return std::abs(v.x) <= smallest_float && std::abs(v.y) <= smallest_float &&
           std::abs(v.z) <= smallest_float;
}

Vec3 unit_or_zero(const Vec3& v) { return vanishes(v) ? v : v / length(v); }

/// The unit vector along v projected into the plane with this normal; zero if the projection is zero.
Vec3 unit_in_plane(const Vec3& v, const Vec3& normal) { return unit_or_zero(v - normal * dot(normal, v)); }

/// A corner's position, normal and texture coordinates.
using CornerTuple = std::array<float, 8>;

struct Unfolded {
    std::vector<Index> ids;          ///< [corners] equal for corners with equal tuples
    std::vector<CornerTuple> tuples; ///< tuples by id
    Vec3 position(Index corner) const { return {tuple(corner)[0], tuple(corner)[1], tuple(corner)[2]}; }
    Vec3 normal(Index corner) const { return {tuple(corner)[3], tuple(corner)[4], tuple(corner)[5]}; }
    const CornerTuple& tuple(Index corner) const { return tuples[ids[corner]]; }
};

Unfolded unfolded(const Mesh& mesh, const Attribute& normals, const Attribute& uvs) {
    std::vector<CornerTuple> by_wedge(mesh.wedge_count());
    for (Index w = 0; w < by_wedge.size(); ++w) {
        CornerTuple& t = by_wedge[w];
        const Vec3& p = mesh.positions[mesh.vertex_of_wedge(w)];
        for (std::size_t c = 0; c < 3; ++c) t[c] = static_cast<float>(p[c]) + 0.0F; // -0 is 0
        for (int c = 0; c < 3; ++c)
            t[static_cast<std::size_t>(3 + c)] = static_cast<float>(normals.value(w, c)) + 0.0F;
        for (int c = 0; c < 2; ++c)
            t[static_cast<std::size_t>(6 + c)] = static_cast<float>(uvs.value(w, c)) + 0.0F;
    }
    std::vector<Index> order(by_wedge.size()), id(by_wedge.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return by_wedge[a] < by_wedge[b]; });
    Unfolded out;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || by_wedge[order[i]] != by_wedge[order[i - 1]]) out.tuples.push_back(by_wedge[order[i]]);
        id[order[i]] = static_cast<Index>(out.tuples.size() - 1);
    }
    for (const Index w : mesh.corners) out.ids.push_back(id[w]);
    return out;
}

struct MappedFace {
    Vec3 along_u, along_v;   ///< unit vectors, reversed if u and v are mirrored
    bool preserving = false; ///< u, v and the normal are right-handed
    bool any = true;         ///< has no direction of its own, and joins any neighbour
    bool degenerate = false;
    std::array<Index, 3> beside{none, none, none}; ///< the triangle across each edge
    std::array<Index, 3> group{none, none, none};  ///< group of each corner
};

void set_texture_directions(MappedFace& t, const Unfolded& s, Index f) {
    const Index c = 3 * f;
    const auto u = [&](Index k, std::size_t i) {
        return double(s.tuple(c + k)[6 + i]) - double(s.tuple(c)[6 + i]);
    };
    const Vec3 p = s.position(c), d1 = s.position(c + 1) - p, d2 = s.position(c + 2) - p;
    t.degenerate = vanishes(d1) || vanishes(d2) || vanishes(d1 - d2);
    const double area = u(1, 0) * u(2, 1) - u(1, 1) * u(2, 0);
    t.along_u = d1 * u(2, 1) - d2 * u(1, 1);
    t.along_v = d2 * u(1, 0) - d1 * u(2, 0);
    t.preserving = area > 0;
    if (!(std::abs(area) > smallest_float)) return;
    t.any = !(length(t.along_u) / std::abs(area) > smallest_float &&
              length(t.along_v) / std::abs(area) > smallest_float);
    const double sign = t.preserving ? 1 : -1;
    t.along_u = unit_or_zero(t.along_u) * sign;
    t.along_v = unit_or_zero(t.along_v) * sign;
}

/// Neighbouring triangles have the same ids at both ends of an edge, which they pass in opposite directions.
/// If there are more than two, they pair up in their order.
void find_mapped_neighbours(std::vector<MappedFace>& triangles, const Unfolded& s) {
    struct Edge {
        Index low, high, face, corner;
        auto ends() const { return std::pair(low, high); }
    };
    std::vector<Edge> edges;
    for (Index f = 0; f < triangles.size(); ++f) {
        if (triangles[f].degenerate) continue;
        for (Index k = 0; k < 3; ++k) {
            const Index a = s.ids[3 * f + k], b = s.ids[3 * f + (k + 1) % 3];
            edges.push_back({std::min(a, b), std::max(a, b), f, k});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.low, a.high, a.face) < std::tie(b.low, b.high, b.face);
    });
    const auto begin_of = [&](const Edge& e) { return s.ids[3 * e.face + e.corner]; };
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Edge& a = edges[i];
        if (triangles[a.face].beside[a.corner] != none) continue;
        constexpr std::size_t farthest =
            64; // with thousands of triangles at an edge, the right pairs are unknown
        for (std::size_t j = i + 1; j < std::min(edges.size(), i + farthest) && edges[j].ends() == a.ends();
             ++j) {
            const Edge& b = edges[j];
            if (begin_of(a) == begin_of(b) || triangles[b.face].beside[b.corner] != none) continue;
            triangles[a.face].beside[a.corner] = b.face;
            triangles[b.face].beside[b.corner] = a.face;
            break;
        }
    }
}

/// Corners with the same id that share a tangent: they are connected across edges, and have the same
/// handedness.
struct TangentGroup {
    bool preserving;
    std::vector<Index> corners;
};

/// Adds the triangle's corner with this id, and the neighbouring triangles.
void grow_tangent_group(TangentGroup& group, Index number, Index id, Index first,
                        std::vector<MappedFace>& triangles, const Unfolded& s) {
    std::vector<Index> open{first};
    while (!open.empty()) {
        const Index f = open.back();
        open.pop_back();
        MappedFace& t = triangles[f];
        Index k = 0;
        while (k < 3 && s.ids[3 * f + k] != id) ++k;
        if (k == 3 || t.group[k] != none) continue;
        if (t.any && t.group == std::array<Index, 3>{none, none, none}) t.preserving = group.preserving;
        if (t.preserving != group.preserving) continue;
        t.group[k] = number;
        group.corners.push_back(3 * f + k);
        for (const Index next :
             {t.beside[(k + 2) % 3], t.beside[k]}) // the triangle pushed last is visited first
            if (next != none) open.push_back(next);
    }
}

std::vector<TangentGroup> tangent_groups(std::vector<MappedFace>& triangles, const Unfolded& s) {
    std::vector<TangentGroup> groups;
    for (Index f = 0; f < triangles.size(); ++f)
        for (Index k = 0; k < 3; ++k) {
            const MappedFace& t = triangles[f];
            if (t.degenerate || t.any || t.group[k] != none) continue;
            groups.push_back({t.preserving, {}});
            grow_tangent_group(groups.back(), static_cast<Index>(groups.size() - 1), s.ids[3 * f + k], f,
                               triangles, s);
        }
    return groups;
}

/// The mean direction of u around the corners, weighted by the angles of the faces.
Vec3 tangent_of(TangentGroup& group, const std::vector<MappedFace>& triangles, const Unfolded& s) {
    std::sort(group.corners.begin(), group.corners.end());
    Vec3 sum;
    for (const Index corner : group.corners) {
        const Index f = corner / 3, k = corner % 3;
        if (triangles[f].any) continue;
        const Vec3 n = s.normal(corner), p = s.position(corner);
        const Vec3 to_last = unit_in_plane(s.position(3 * f + (k + 2) % 3) - p, n);
        const Vec3 to_next = unit_in_plane(s.position(3 * f + (k + 1) % 3) - p, n);
        sum += unit_in_plane(triangles[f].along_u, n) * arc_cosine(dot(to_last, to_next));
    }
    return unit_or_zero(sum);
}

/// The group of each corner; no_group for corners without one.
std::vector<Index> groups_of_corners(const std::vector<MappedFace>& triangles, const Unfolded& s,
                                     Index no_group) {
    std::vector<Index> group(3 * triangles.size(), no_group), first(s.tuples.size(), none);
    for (Index f = 0; f < triangles.size(); ++f)
        for (Index k = 0; k < 3 && !triangles[f].degenerate; ++k) {
            if (triangles[f].group[k] != none) group[3 * f + k] = triangles[f].group[k];
            if (first[s.ids[3 * f + k]] == none) first[s.ids[3 * f + k]] = 3 * f + k;
        }
    for (Index f = 0; f < triangles.size(); ++f) // faces without area join the first group at their corner
        for (Index k = 0; k < 3 && triangles[f].degenerate; ++k)
            if (const Index like = first[s.ids[3 * f + k]]; like != none) group[3 * f + k] = group[like];
    return group;
}

} // namespace

std::optional<AttributeChange> give_tangents(Mesh& mesh, int uv_set) {
    const Attribute* normals = mesh.find("NORMAL", Domain::wedge);
    const Attribute* uvs = mesh.find(fmt::format("TEXCOORD_{}", uv_set), Domain::wedge);
    if (!normals || !uvs || normals->components != 3 || uvs->components != 2 || !mesh.all_triangles())
        return {};
    const Unfolded s = unfolded(mesh, *normals, *uvs);
    std::vector<MappedFace> triangles(mesh.face_count());
    for (Index f = 0; f < triangles.size(); ++f) set_texture_directions(triangles[f], s, f);
    find_mapped_neighbours(triangles, s);
    std::vector<TangentGroup> groups = tangent_groups(triangles, s);
    const auto no_group = static_cast<Index>(groups.size());
    std::vector<std::array<float, 4>> tangents;
    for (TangentGroup& group : groups) {
        Vec3 t = tangent_of(group, triangles, s);
        if (vanishes(t)) t = {1, 0, 0};
        // v points down in glTF, and up in the original method.
        tangents.push_back({static_cast<float>(t.x), static_cast<float>(t.y), static_cast<float>(t.z),
                            group.preserving ? -1.0F : 1.0F});
    }
    tangents.push_back({1, 0, 0, 1});
    mesh.drop("TANGENT", Domain::wedge);
    const std::vector<Index> of_wedge = separate_wedges(mesh, groups_of_corners(triangles, s, no_group));
    std::vector<float> numbers;
    for (const Index group : of_wedge) {
        const auto& t = tangents[group == none ? no_group : group];
        numbers.insert(numbers.end(), t.begin(), t.end());
    }
    mesh.attributes.push_back({"TANGENT", Domain::wedge, Role::tangent, 4, false, std::move(numbers)});
    return AttributeChange{"TANGENT", Domain::wedge, AttributeChange::Kind::recomputed, "by MikkTSpace"};
}

} // namespace facetmill
