#include "geometry/boolean/solids.hpp"

#include "geometry/boolean/touched_cells.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "geometry/spatial/components_around.hpp"
#include "mesh/component_volumes.hpp"
#include "mesh/face.hpp"
#include "mesh/indices_where.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>

namespace facetmill::clean_steps {

namespace {

enum class Fitness : std::uint8_t { fit, open, disagreeing, flat };

const char* reason(Fitness f) {
    switch (f) {
    case Fitness::fit:
        break;
    case Fitness::open:
        return "is open (only closed components can be united: fill the holes first)";
    case Fitness::disagreeing:
        return "has inconsistently oriented faces (use orient first)";
    case Fitness::flat:
        return "has faces without area (see degenerate) or without a finite size";
    }
    return "";
}

/// True if all corner means are certainly finite.
bool are_small(const std::vector<Vec3>& positions) {
    constexpr double most = 1e290;
    return parallel_reduce(
               positions.size(), 1,
               [&](std::size_t begin, std::size_t end) {
                   int all = 1;
                   for (std::size_t v = begin; v < end; ++v)
                       for (std::size_t k = 0; k < 3; ++k) all &= std::abs(positions[v][k]) < most;
                   return all;
               },
               std::bit_and<>()) != 0;
}

std::vector<Fitness> fitness_of(const Mesh& mesh, const LooseEdges& edges, const Components& components,
                                bool have_area) {
    std::vector<Fitness> fitness(components.count, Fitness::fit);
    const std::vector<Index> faces = edges.size() > 0 ? corner_faces(mesh) : std::vector<Index>{};
    for (Index e = 0; e < edges.size(); ++e) {
        int balance = 0;
        const Index from = mesh.vertex(edges.corners_of(e)[0]);
        for (const Index c : edges.corners_of(e)) balance += mesh.vertex(c) == from ? 1 : -1;
        if (balance == 0) continue;
        Fitness& f = fitness[components.of_face[faces[edges.corners_of(e)[0]]]];
        if (edges.corners_of(e).size() % 2 == 1) f = Fitness::open;
        if (f == Fitness::fit) f = Fitness::disagreeing;
    }
    if (have_area && are_small(mesh.positions)) return fitness;
    std::vector<std::uint8_t> flat(mesh.face_count());
    parallel_for(flat.size(), [&](std::size_t i) {
        const auto f = static_cast<Index>(i);
        flat[f] = is_degenerate(mesh, f) || !is_finite(corner_mean(mesh, f));
    });
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (flat[f]) fitness[components.of_face[f]] = Fitness::flat;
    return fitness;
}

/// An entry for each unsuitable component that intersects another.
std::vector<NotDone> unfit_places(const Mesh& mesh, const Components& components,
                                  const std::vector<Fitness>& fitness, const SelfIntersections& found) {
    struct Place {
        std::size_t pairs = 0;
        Index face = none;
    };
    std::map<Index, Place> places;
    for (const auto& [f, g] : found.pairs) {
        const Index a = components.of_face[f], b = components.of_face[g];
        const bool first = fitness[a] != Fitness::fit;
        if (!first && fitness[b] == Fitness::fit) continue;
        Place& place = places[first ? a : b];
        if (place.pairs++ == 0) place.face = first ? f : g;
    }
    std::vector<NotDone> all;
    all.reserve(places.size());
    for (const auto& [component, place] : places)
        all.push_back({"self_intersections",
                       fmt::format("{} pairs of faces intersect on a component that {}", place.pairs,
                                   reason(fitness[component])),
                       corner_mean(mesh, place.face)});
    return all;
}

/// Positions and faces only, with vertices at the same position merged.
Mesh at_places(const Mesh& mesh, const std::vector<Index>& place) {
    Mesh plain;
    plain.positions = mesh.positions;
    plain.face_offsets = mesh.face_offsets;
    plain.corners.resize(mesh.corner_count());
    parallel_for(plain.corners.size(),
                 [&](std::size_t c) { plain.corners[c] = place[mesh.vertex(static_cast<Index>(c))]; });
    return plain;
}

/// The stars of a triangle mesh.
std::vector<Star> stars_of(const Mesh& mesh) {
    if (!mesh.has_seams()) return plain_stars(mesh.positions, mesh.corners);
    std::vector<Index> corners(mesh.corner_count());
    parallel_for(corners.size(), [&](std::size_t c) { corners[c] = mesh.vertex(static_cast<Index>(c)); });
    return plain_stars(mesh.positions, corners);
}

/// Finds the pairs without lost faces.
SelfIntersections find_but(const std::vector<std::uint8_t>& lost, const Mesh& mesh, std::size_t limit,
                           std::vector<Star> stars) {
    if (lost.empty()) return find_self_intersections(mesh, {.limit = limit, .stars = std::move(stars)});
    const std::vector<Index> faces = faces_without(lost);
    SelfIntersectionSettings settings{.limit = limit, .stars = std::move(stars)};
    SelfIntersections found;
    if (mesh.all_triangles()) {
        Surface rest{mesh.positions, std::vector<Index>(3 * faces.size()), {}};
        parallel_for(faces.size(), [&](std::size_t i) {
            for (Index k = 0; k < 3; ++k) rest.corners[3 * i + k] = mesh.vertex(3 * faces[i] + k);
        });
        found = find_self_intersections(std::move(rest), faces.size(), settings);
    } else {
        Mesh rest;
        rest.positions = mesh.positions;
        rest.face_offsets.push_back(0);
        for (const Index f : faces) {
            for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
                rest.corners.push_back(mesh.vertex(c));
            rest.face_offsets.push_back(static_cast<Index>(rest.corners.size()));
        }
        found = find_self_intersections(rest, settings);
    }
    for (auto& [f, g] : found.pairs) {
        f = faces[f];
        g = faces[g];
    }
    return found;
}

} // namespace

bool are_distinct(const std::vector<Index>& place) {
    for (Index v = 0; v < place.size(); ++v)
        if (place[v] != v) return false;
    return true;
}

SelfIntersections crossings(const Mesh& mesh, std::vector<std::uint8_t> among, std::size_t max_box_pairs) {
    return find_self_intersections(
        at_places(mesh, lowest_at_place(mesh)),
        {.limit = max_pairs, .among = std::move(among), .max_box_pairs = max_box_pairs});
}

CrossingsAndRings crossings_and_rings(const Mesh& mesh, const std::vector<Index>& place, std::size_t limit,
                                      const std::vector<std::uint8_t>& lost) {
    if (!are_distinct(place)) return {find_but(lost, at_places(mesh, place), limit, {}), {}};
    if (!mesh.all_triangles()) return {find_but(lost, mesh, limit, {}), {}};
    std::vector<Star> stars = stars_of(mesh);
    Rings rings(stars.size());
    for (std::size_t v = 0; v < rings.size(); ++v) rings[v] = stars[v] == Star::ring;
    return {find_but(lost, mesh, limit, std::move(stars)), std::move(rings)};
}

Mesh only_faces(const Mesh& mesh, const std::vector<Index>& faces) {
    Mesh some;
    std::vector<Index> number(mesh.vertex_count(), none);
    some.face_offsets.push_back(0);
    for (const Index f : faces) {
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            Index& n = number[mesh.vertex(c)];
            if (n == none) {
                n = static_cast<Index>(some.positions.size());
                some.positions.push_back(mesh.point(c));
            }
            some.corners.push_back(n);
        }
        some.face_offsets.push_back(static_cast<Index>(some.corners.size()));
    }
    normalise_offsets(some);
    return some;
}

namespace {

/// Faces whose boxes meet the box of a flagged face, ascending.
std::vector<Index> faces_near(const Mesh& mesh, const std::vector<std::uint8_t>& flags) {
    const auto box_of = [&](Index f) {
        Box box;
        add_corners(box, mesh, f);
        return box;
    };
    std::vector<Box> boxes;
    const auto flagged = indices_where(flags.size(), [&](Index f) { return flags[f] != 0; });
    boxes.reserve(flagged.size());
    for (const Index f : flagged) boxes.push_back(box_of(f));
    const FaceCells cells(mesh, box_of_all(boxes));
    TouchedCells touched;
    for (const Index f : flagged) touched.mark(cells[f]);
    const BoxTree tree(std::move(boxes));
    std::vector<std::uint8_t> near(flags);
    parallel_for(near.size(), [&](std::size_t f) {
        if (!near[f] && touched.may_meet(cells[f]))
            tree.visit(box_of(static_cast<Index>(f)), [&](Index) { near[f] = 1; });
    });
    return indices_where(near.size(), [&](Index f) { return near[f] != 0; });
}

} // namespace

SelfIntersections crossings_near(const Mesh& mesh, const std::vector<std::uint8_t>& flags,
                                 std::size_t max_box_pairs) {
    const std::vector<Index> near = faces_near(mesh, flags);
    std::vector<std::uint8_t> among(near.size());
    for (std::size_t i = 0; i < near.size(); ++i) among[i] = flags[near[i]];
    const Mesh some = only_faces(mesh, near), plain = at_places(some, lowest_at_place(some));
    SelfIntersectionSettings settings{
        .limit = max_pairs, .among = std::move(among), .max_box_pairs = max_box_pairs};
    if (plain.all_triangles()) settings.stars = plain_stars(plain.positions, plain.corners);
    SelfIntersections found = find_self_intersections(plain, settings);
    for (auto& [f, g] : found.pairs) {
        f = near[f];
        g = near[g];
    }
    return found;
}

Solids find_solids(const Mesh& mesh, const SelfIntersections& found, Rings rings, bool have_area) {
    Solids s;
    s.rings = std::move(rings);
    s.edges = LooseEdges(mesh, s.rings);
    s.components = face_components(mesh, s.rings, s.edges);
    const auto fitness = fitness_of(mesh, s.edges, s.components, have_area);
    s.six_volumes = six_volumes(mesh, s.components);
    for (Index p = 0; p < s.components.count; ++p) {
        s.closed.push_back(fitness[p] == Fitness::fit);
        s.why_not.push_back(reason(fitness[p]));
        s.inward.push_back(s.six_volumes[p] < 0);
    }
    s.unfit = unfit_places(mesh, s.components, fitness, found);
    DisjointSets sets(s.components.count);
    const auto both_fit = [&](Index f, Index g) {
        return s.closed[s.components.of_face[f]] && s.closed[s.components.of_face[g]];
    };
    for (const auto& [f, g] : found.pairs)
        if (both_fit(f, g)) sets.join(s.components.of_face[f], s.components.of_face[g]);
    std::map<Index, Index> numbers; // numbers of sets, by their first pair
    for (const auto& [f, g] : found.pairs)
        if (both_fit(f, g) &&
            numbers.try_emplace(sets.find(s.components.of_face[f]), static_cast<Index>(s.at.size())).second)
            s.at.push_back(corner_mean(mesh, f));
    for (Index p = 0; p < s.components.count; ++p) {
        const auto at = s.closed[p] ? numbers.find(sets.find(p)) : numbers.end();
        s.cluster.push_back(at == numbers.end() ? none : at->second);
    }
    s.meets_unfit.assign(s.clusters(), 0);
    for (const auto& [f, g] : found.pairs)
        if (!both_fit(f, g))
            for (const Index face : {f, g})
                if (s.cluster_of_face(face) != none) s.meets_unfit[s.cluster_of_face(face)] = 1;
    return s;
}

} // namespace facetmill::clean_steps

namespace facetmill {

namespace {

using clean_steps::Solids;

/// For each closed component, the closed components that contain it, ascending.
std::vector<std::vector<Index>> around_each(const Mesh& mesh, const Solids& solids) {
    std::vector<Index> first(solids.components.count, none);
    for (Index f = mesh.face_count(); f-- > 0;) first[solids.components.of_face[f]] = f;
    const FaceTree rays(surface_of(mesh), FaceTree::Use::rays);
    std::vector<std::vector<Index>> around(solids.components.count);
    parallel_for(
        around.size(),
        [&](std::size_t p) {
            if (!solids.closed[p]) return;
            around[p] =
                components_around(rays, mesh.point(mesh.face_begin(first[p])), solids.components.of_face,
                                  [&](Index q) { return q != p && solids.closed[q]; });
        },
        1);
    return around;
}

} // namespace

Components solid_components(const Mesh& mesh) {
    Solids solids = clean_steps::find_solids(mesh, {});
    const auto is_cavity = [&](Index p) { return solids.closed[p] && solids.inward[p]; };
    std::vector<Index> solid_of(solids.components.count);
    bool any = false;
    for (Index p = 0; p < solid_of.size(); ++p) {
        solid_of[p] = p;
        any |= is_cavity(p);
    }
    if (!any || solid_of.size() < 2) return std::move(solids.components);
    const auto around = around_each(mesh, solids);
    for (Index p = 0; p < solid_of.size(); ++p) {
        if (!is_cavity(p)) continue;
        std::size_t depth = 0; // the innermost is itself inside most others
        for (const Index q : around[p])
            if (!is_cavity(q) && (solid_of[p] == p || around[q].size() > depth)) {
                solid_of[p] = q;
                depth = around[q].size();
            }
    }
    std::vector<Index> number(solid_of.size(), none);
    Components joined{std::move(solids.components.of_face), 0};
    for (Index& component : joined.of_face) {
        Index& n = number[solid_of[component]];
        if (n == none) n = static_cast<Index>(joined.count++);
        component = n;
    }
    return joined;
}

} // namespace facetmill
