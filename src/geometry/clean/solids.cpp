#include "geometry/clean/solids.hpp"

#include "base/parallel.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "geometry/spatial/components_around.hpp"
#include "mesh/component_volumes.hpp"
#include "mesh/face.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace facetmill::clean_steps {

namespace {

enum class Fitness : std::uint8_t { fit, open, disagreeing, flat };

const char* reason(Fitness f) {
    switch (f) {
    case Fitness::fit:
        break;
    case Fitness::open:
        return "is open (only closed components can be united; holes closes them)";
    case Fitness::disagreeing:
        return "has inconsistently oriented faces (use orient first)";
    case Fitness::flat:
        return "has faces without area (see degenerate) or without a finite size";
    }
    return "";
}

std::vector<Fitness> fitness_of(const Mesh& mesh, const LooseEdges& edges, const Components& components) {
    std::vector<Fitness> fitness(components.count, Fitness::fit);
    const auto faces = corner_faces(mesh);
    for (Index e = 0; e < edges.size(); ++e) {
        int balance = 0;
        const Index from = mesh.vertex(edges.corners_of(e)[0]);
        for (const Index c : edges.corners_of(e)) balance += mesh.vertex(c) == from ? 1 : -1;
        if (balance == 0) continue;
        Fitness& f = fitness[components.of_face[faces[edges.corners_of(e)[0]]]];
        if (edges.corners_of(e).size() % 2 == 1) f = Fitness::open;
        if (f == Fitness::fit) f = Fitness::disagreeing;
    }
    std::vector<std::uint8_t> flat(mesh.face_count());
    parallel_for(flat.size(), [&](std::size_t i) {
        const auto f = static_cast<Index>(i);
        flat[f] = is_degenerate(mesh, f) || !is_finite(corner_mean(mesh, f));
    });
    for (Index f = 0; f < mesh.face_count(); ++f)
        if (flat[f]) fitness[components.of_face[f]] = Fitness::flat;
    return fitness;
}

/// Of the components that are not fit, one entry for each that intersects something.
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

SelfIntersections crossings(const Mesh& mesh, const SelfIntersectionSettings& settings,
                            const std::vector<Index>& place) {
    Mesh plain;
    plain.positions = mesh.positions;
    plain.face_offsets = mesh.face_offsets;
    plain.corners.resize(mesh.corner_count());
    parallel_for(plain.corners.size(),
                 [&](std::size_t c) { plain.corners[c] = place[mesh.vertex(static_cast<Index>(c))]; });
    return find_self_intersections(plain, settings);
}

} // namespace

bool are_distinct(const std::vector<Index>& place) {
    for (Index v = 0; v < place.size(); ++v)
        if (place[v] != v) return false;
    return true;
}

SelfIntersections crossings(const Mesh& mesh, std::vector<std::uint8_t> among, std::size_t max_box_pairs) {
    return crossings(mesh, {.limit = max_pairs, .among = std::move(among), .max_box_pairs = max_box_pairs},
                     lowest_at_place(mesh));
}

SelfIntersections crossings_and_rings(const Mesh& mesh, std::size_t limit) {
    const auto place = lowest_at_place(mesh);
    if (!are_distinct(place)) return crossings(mesh, {.limit = limit}, place);
    return find_self_intersections(mesh, {.limit = limit, .tell_rings = true});
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

/// The cells of a grid that some boxes touch: tells quickly of most other boxes that they meet none of them.
class TouchedCells {
  public:
    explicit TouchedCells(std::span<const Box> boxes) : bounds_(box_of_all(boxes)) {
        const Vec3 extent = bounds_.max - bounds_.min;
        for (std::size_t axis = 0; axis < 3; ++axis)
            scale_[axis] = extent[axis] > 0 ? cells / extent[axis] : 0;
        for (const Box& box : boxes)
            rows_of(box, [&](std::uint64_t& row, std::uint64_t mask) {
                row |= mask;
                return false;
            });
    }

    /// False: the box meets none.
    bool may_meet(const Box& box) {
        return rows_of(box, [](std::uint64_t row, std::uint64_t mask) { return (row & mask) != 0; });
    }

  private:
    static constexpr std::size_t cells = 64; ///< along each axis; those of one row are the bits of a number

    /// Never lower for what is higher, so that boxes that meet have a cell in common.
    std::size_t cell(double x, std::size_t axis) const {
        const double at = (x - bounds_.min[axis]) * scale_[axis];
        return !(at > 0) ? 0 : at >= cells - 1 ? cells - 1 : static_cast<std::size_t>(at);
    }
    /// stop(row, bits of the box) for the rows that a box touches, until it is true. Whether it was.
    template <class Stop>
    bool rows_of(const Box& box, Stop&& stop) {
        const auto low = [&](std::size_t axis) { return cell(box.min[axis], axis); };
        const auto high = [&](std::size_t axis) { return cell(box.max[axis], axis); };
        const std::uint64_t mask = ~std::uint64_t{0} >> (63 - high(2)) & ~std::uint64_t{0} << low(2);
        for (std::size_t x = low(0); x <= high(0); ++x)
            for (std::size_t y = low(1); y <= high(1); ++y)
                if (stop(rows_[x * cells + y], mask)) return true;
        return false;
    }

    Box bounds_;
    Vec3 scale_;
    std::vector<std::uint64_t> rows_ = std::vector<std::uint64_t>(cells * cells, 0);
};

/// Those whose boxes meet the box of a flagged face, ascending.
std::vector<Index> faces_near(const Mesh& mesh, const std::vector<std::uint8_t>& flags) {
    const auto box_of = [&](Index f) {
        Box box;
        add_corners(box, mesh, f);
        return box;
    };
    std::vector<Box> boxes;
    for (Index f = 0; f < flags.size(); ++f)
        if (flags[f]) boxes.push_back(box_of(f));
    TouchedCells touched(boxes);
    const BoxTree tree(std::move(boxes));
    std::vector<std::uint8_t> near(flags);
    parallel_for(near.size(), [&](std::size_t f) {
        if (near[f]) return;
        if (const Box box = box_of(static_cast<Index>(f)); touched.may_meet(box))
            tree.visit(box, [&](Index) { near[f] = 1; });
    });
    std::vector<Index> faces;
    for (Index f = 0; f < near.size(); ++f)
        if (near[f]) faces.push_back(f);
    return faces;
}

} // namespace

SelfIntersections crossings_near(const Mesh& mesh, const std::vector<std::uint8_t>& flags,
                                 std::size_t max_box_pairs) {
    const std::vector<Index> near = faces_near(mesh, flags);
    std::vector<std::uint8_t> among(near.size());
    for (std::size_t i = 0; i < near.size(); ++i) among[i] = flags[near[i]];
    SelfIntersections found = crossings(only_faces(mesh, near), std::move(among), max_box_pairs);
    for (auto& [f, g] : found.pairs) {
        f = near[f];
        g = near[g];
    }
    return found;
}

Solids find_solids(const Mesh& mesh, const SelfIntersections& found, Rings rings) {
    Solids s;
    s.rings = std::move(rings);
    s.edges = LooseEdges(mesh, s.rings);
    s.components = face_components(mesh, s.rings, s.edges);
    const auto fitness = fitness_of(mesh, s.edges, s.components);
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
    std::map<Index, Index> numbers; // of sets, by their first pair
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

/// For each closed component the closed components that it lies in, ascending.
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
        std::size_t depth = 0; // the innermost lies in most others itself
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
