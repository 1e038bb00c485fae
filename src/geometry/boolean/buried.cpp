#include "geometry/boolean/buried.hpp"

#include "base/math/predicates.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace facetmill::clean_steps {

namespace {

constexpr std::size_t max_walls = 4096; ///< walls per core, because each point is compared with all walls

double largest(const Vec3& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// The intersection of the bounding boxes of two triangles. It may be inverted if rounding separates them.
Box common_box(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
    Box one, other;
    for (const Vec3& p : a) one.add(p);
    for (const Vec3& p : b) other.add(p);
    Box both;
    for (std::size_t k = 0; k < 3; ++k) {
        both.min[k] = std::max(one.min[k], other.min[k]);
        both.max[k] = std::min(one.max[k], other.max[k]);
    }
    return both;
}

std::array<int, 3> sides(const std::array<Vec3, 3>& of, const std::array<Vec3, 3>& plane) {
    std::array<int, 3> side{};
    for (std::size_t i = 0; i < 3; ++i) side[i] = orientation_3d(plane[0], plane[1], plane[2], of[i]);
    return side;
}

/// True if both triangles are in the same plane and have the same orientation.
bool is_same_plane(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
    const Vec3 n = cross(a[1] - a[0], a[2] - a[0]), m = cross(b[1] - b[0], b[2] - b[0]);
    return dot(n, m) > 0.5 * length(n) * length(m) && sides(b, a) == std::array{0, 0, 0};
}

using Ends = std::array<NearPoint, 2>;

/// The segment in which a triangle meets the plane of another, given the sides of its corners; empty if it
/// does not meet the plane. The error of the points follows from the bounds in Buried::core_of.
std::optional<Ends> ends_in_plane(const std::array<Vec3, 3>& t, const std::array<int, 3>& side,
                                  const std::array<Vec3, 3>& plane) {
    Box box;
    for (std::size_t i = 0; i < 3; ++i) {
        box.add(t[i]);
        box.add(plane[i]);
    }
    const Vec3 extent = box.extent(), u = plane[1] - plane[0], v = plane[2] - plane[0], normal = cross(u, v);
    double error = 1e-200;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        error += 20 * 0x1p-53 * (std::abs(u[i] * v[j]) + std::abs(u[j] * v[i])) * extent[k];
    }
    Ends ends;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 &p = t[i], &q = t[(i + 1) % 3];
        if (side[i] == 0) ends[std::min<std::size_t>(count++, 1)] = {p, 0};
        if (side[i] * side[(i + 1) % 3] >= 0) continue;
        const double at_p = dot(normal, p - plane[0]), between = std::abs(at_p - dot(normal, q - plane[0]));
        const bool is_clear = between > 4 * error;
        const double share = is_clear ? std::clamp(std::abs(at_p) / between, 0.0, 1.0) : 0.5;
        const double off = is_clear ? 4 * error / between : 1;
        ends[std::min<std::size_t>(count++, 1)] = {
            mix(p, q, share), off * largest(q - p) + 0x1p-50 * std::max(largest(p), largest(q))};
    }
    if (count == 1) ends[1] = ends[0];
    return count == 0 ? std::nullopt : std::optional(ends);
}

/// The overlap of two segments of the same line.
Ends common_stretch(Ends a, Ends b) {
    Box box;
    double off = 0;
    for (const Ends* ends : {&a, &b})
        for (const NearPoint& p : *ends) {
            box.add(p.at);
            off = std::max(off, p.off);
        }
    const Vec3 extent = box.extent();
    const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    for (Ends* ends : {&a, &b})
        if ((*ends)[0].at[axis] > (*ends)[1].at[axis]) std::swap((*ends)[0], (*ends)[1]);
    // Along the axis on which the line is longest, points closer than twice `off` have no certain order. Then
    // the distance between them is less than ten times that.
    const NearPoint& low = a[0].at[axis] > b[0].at[axis] ? a[0] : b[0];
    const NearPoint& high = a[1].at[axis] < b[1].at[axis] ? a[1] : b[1];
    return {NearPoint{low.at, 16 * off}, NearPoint{high.at, 16 * off}};
}

Box box_around(const NearPoint& p) {
    const double off = 2 * p.off; // includes the error of the following steps
    const Vec3 d{off, off, off};
    return {p.at - d, p.at + d};
}

bool is_within(const Box& inner, const Box& outer) {
    for (std::size_t k = 0; k < 3; ++k)
        if (!(inner.min[k] > outer.min[k] && inner.max[k] < outer.max[k])) return false;
    return true;
}

} // namespace

/// The part of a segment, from 0 to 1, inside a core.
struct Buried::Stretch {
    double from = 0, to = 1;
    bool has_start = true, has_end = true; ///< the end points are certainly inside
};

Buried::Buried(const Mesh& mesh, const Solids& solids, const SelfIntersections& found,
               const TriangleFaces& triangles, const std::vector<Index>& first, const Operands* operands)
    : mesh_(mesh), solids_(solids), triangles_(triangles), first_(first) {
    // A buried intersection needs two components, and a third around them.
    if (solids.components.count < 3) return;
    if (operands && operands->operation == CombineOperation::intersect) only_second_ = &operands->second;
    const bool unites = !operands || operands->operation == CombineOperation::unite;
    const bool subtracts = operands && operands->operation == CombineOperation::subtract;
    const auto by_component = triangles_by_component();
    std::vector<std::vector<Wall>> walls(by_component.size());
    std::vector<std::optional<Core>> cores(by_component.size());
    parallel_for(
        cores.size(),
        [&](std::size_t p) {
            if (!solids.closed[p] || solids.inward[p] || solids.cluster[p] == none) return;
            cores[p] = core_of(by_component[p], subtracts && operands->second[p], walls[p]);
        },
        16);
    std::vector<std::uint8_t> has_core(cores.size());
    std::vector<Box> boxes(cores.size());
    bool any = false, all = true;
    for (Index p = 0; p < cores.size(); ++p) {
        has_core[p] = cores[p].has_value();
        any |= has_core[p] != 0;
        all &= has_core[p] != 0 || solids.cluster[p] == none;
    }
    if (!any) return;
    const auto is_doubtful =
        all ? std::vector<std::uint8_t>(cores.size(), 0) : doubtful(found, has_core, operands);
    for (Index p = 0; p < cores.size(); ++p)
        if (is_doubtful[p])
            for (const Index t : by_component[p])
                for (const Vec3& corner : corners(t)) boxes[p].add(corner);
    const BoxTree doubts(std::move(boxes));
    std::vector<Box> boxes_of_cores;
    for (Index p = 0; p < cores.size(); ++p) {
        if (!has_core[p] || (!unites && !operands->second[p])) continue;
        if (doubts.any_of(cores[p]->box, [&](Index q) { return solids.cluster[q] == solids.cluster[p]; }))
            continue;
        Core& core = cores_.emplace_back(*cores[p]);
        core.component = p;
        core.cluster = solids.cluster[p];
        core.begin = walls_.size();
        walls_.insert(walls_.end(), walls[p].begin(), walls[p].end());
        core.end = walls_.size();
        boxes_of_cores.push_back(core.box);
    }
    tree_.emplace(std::move(boxes_of_cores));
}

std::vector<std::vector<Index>> Buried::triangles_by_component() const {
    std::vector<std::vector<Index>> by_component(solids_.components.count);
    for (Index t = 0; t < triangles_.face.size(); ++t)
        by_component[solids_.components.of_face[triangles_.face[t]]].push_back(t);
    return by_component;
}

Buried::Corners Buried::corners(Index triangle) const {
    const auto& [a, b, c] = triangles_.corners[triangle];
    return {mesh_.point(a), mesh_.point(b), mesh_.point(c)};
}

/// The errors, with e the rounding unit 2^-53. A component of the normal has an error below 5 e times the
/// sum of its two products' sizes (`size`). A difference from a corner has a relative error of e. A sum of
/// three products has an error below 4 e times the sum of their sizes. The total is at most 10 e times
/// `size` times the extent of the box around the point. The bound is twice this, and no product underflows.
std::optional<Buried::Core> Buried::core_of(std::span<const Index> triangles, bool turned,
                                            std::vector<Wall>& walls) const {
    if (triangles.empty() || triangles.size() > max_walls) return {};
    Core core{};
    core.box = {};
    Vec3 sum;
    for (const Index t : triangles)
        for (const Vec3& p : corners(t)) {
            core.box.add(p);
            sum += p;
        }
    core.centre = sum / (3.0 * static_cast<double>(triangles.size()));
    const Vec3 extent = core.box.extent();
    if (!(std::max(largest(core.box.min), largest(core.box.max)) < 1e100) ||
        !(std::min({extent.x, extent.y, extent.z}) > 1e-60))
        return {};
    core.radius = HUGE_VAL;
    std::optional<Corners> previous;
    for (const Index t : triangles) {
        auto [a, b, c] = corners(t);
        if (turned) std::swap(b, c);
        const Vec3 u = b - a, v = c - a;
        Wall wall{cross(u, v), a, 1e-200, 0};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
            const double size = std::abs(u[i] * v[j]) + std::abs(u[j] * v[i]);
            wall.unsure += 20 * 0x1p-53 * size * extent[k];
            wall.reach += 1.01 * size;
        }
        const double deep = -(dot(wall.normal, core.centre - a) + wall.unsure);
        if (!(deep > 0)) return {};
        // The normal is no longer than `reach`; a thousandth exceeds all errors of this step and of `holds`.
        core.radius = std::min(core.radius, 0.999 * deep / (length(wall.normal) + 1e-14 * wall.reach));
        if (previous && is_same_plane(*previous, {a, b, c})) continue;
        walls.push_back(wall);
        previous = {a, b, c};
    }
    return core;
}

/// Marks components without a core that may have negative winding numbers.
std::vector<std::uint8_t> Buried::doubtful(const SelfIntersections& found,
                                           const std::vector<std::uint8_t>& has_core,
                                           const Operands* operands) const {
    const auto& of_face = solids_.components.of_face;
    std::vector<std::uint8_t> is(has_core.size(), 0);
    for (Index p = 0; p < is.size(); ++p)
        is[p] = solids_.cluster[p] != none && !has_core[p] && solids_.inward[p];
    for (Index f = 0; operands && f < operands->lost.size();
         ++f) // self-intersections of its component are unknown
        if (operands->lost[f] && !has_core[of_face[f]]) is[of_face[f]] = 1;
    for (const auto& [f, g] : found.pairs)
        if (of_face[f] == of_face[g] && !has_core[of_face[f]]) is[of_face[f]] = 1;
    const auto place = lowest_at_place(mesh_);
    std::vector<std::tuple<Index, Index, Index, bool>>
        edges; // lower position, higher position, component, direction
    for (Index f = 0; f < mesh_.face_count(); ++f) {
        const Index p = of_face[f];
        if (has_core[p] || is[p] || solids_.cluster[p] == none) continue;
        if (mesh_.face_size(f) > 4) is[p] = 1; // the face may overlap itself
        for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) {
            const Index a = place[mesh_.vertex(c)], b = place[mesh_.vertex(next_corner(mesh_, f, c))];
            edges.emplace_back(std::min(a, b), std::max(a, b), p, a < b);
        }
    }
    std::sort(edges.begin(), edges.end());
    const auto same = [&](std::size_t i, std::size_t j) {
        return std::get<0>(edges[i]) == std::get<0>(edges[j]) &&
               std::get<1>(edges[i]) == std::get<1>(edges[j]) &&
               std::get<2>(edges[i]) == std::get<2>(edges[j]);
    };
    for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
        while (end < edges.size() && same(i, end)) ++end;
        if (end != i + 2 || std::get<3>(edges[i]) == std::get<3>(edges[i + 1])) is[std::get<2>(edges[i])] = 1;
    }
    if (operands && operands->operation != CombineOperation::unite)
        for (Index p = 0; p < is.size(); ++p) is[p] = is[p] && operands->second[p];
    return is;
}

bool Buried::holds(const Core& core, const NearPoint& p) const {
    if (!is_within(box_around(p), core.box)) return false;
    if (length(p.at - core.centre) + 2 * p.off < core.radius) return true;
    for (std::size_t w = core.begin; w < core.end; ++w) {
        const Wall& wall = walls_[w];
        if (!(dot(wall.normal, p.at - wall.at) + wall.unsure + p.off * wall.reach < 0)) return false;
    }
    return true;
}

bool Buried::holds(const Core& core, const Box& box) const {
    if (!is_within(box, core.box)) return false;
    for (std::size_t w = core.begin; w < core.end; ++w) {
        const Wall& wall = walls_[w];
        Vec3 farthest;
        for (std::size_t k = 0; k < 3; ++k) farthest[k] = wall.normal[k] > 0 ? box.max[k] : box.min[k];
        if (!(dot(wall.normal, farthest - wall.at) + wall.unsure < 0)) return false;
    }
    return true;
}

std::vector<std::uint8_t> Buried::hold_meetings(std::span<const std::pair<Index, Index>> pairs) const {
    std::vector<std::uint8_t> held(pairs.size(), 0);
    if (empty()) return held;
    parallel_chunks(
        pairs.size(),
        [&](std::size_t begin, std::size_t end) {
            std::vector<Index> near; // components near the first face of the pair
            for (std::size_t i = begin; i < end; ++i) {
                if (i == begin || pairs[i].first != pairs[i - 1].first) near = cores_near(pairs[i].first);
                held[i] = may_leave(pairs[i].first) && may_leave(pairs[i].second) &&
                          holds_meeting(pairs[i].first, pairs[i].second, near);
            }
        },
        512);
    return held;
}

std::vector<Index> Buried::cores_near(Index face) const {
    Box box;
    add_corners(box, mesh_, face);
    std::vector<Index> near;
    tree_->visit(box, [&](Index core) {
        if (cores_[core].cluster == solids_.cluster_of_face(face)) near.push_back(core);
    });
    return near;
}

bool Buried::holds_meeting(Index f, Index g, const std::vector<Index>& cores) const {
    for (Index s = first_[f]; s < first_[f + 1]; ++s)
        for (Index t = first_[g]; t < first_[g + 1]; ++t)
            if (!holds_pair(s, t, cores)) return false;
    return true;
}

bool Buried::holds_point(const NearPoint& p, Index cluster) const {
    return tree_ && tree_->any_of(box_around(p), [&](Index core) {
        return cores_[core].cluster == cluster && holds(cores_[core], p);
    });
}

bool Buried::holds_pair(Index s, Index t, const std::vector<Index>& cores) const {
    const Corners a = corners(s), b = corners(t);
    const Box box = common_box(a, b);
    if (box.empty()) return true; // the triangles have no common points
    std::vector<Index> near;      // a component's own core never contains its faces
    for (const Index core : cores)
        if (boxes_meet(cores_[core].box, box)) near.push_back(core);
    if (near.empty()) return false;
    for (const Index core : near)
        if (holds(cores_[core], box)) return true;
    const auto of_a = sides(a, b), of_b = sides(b, a);
    if (of_a == std::array{0, 0, 0}) {
        int budget = 64;
        return holds_box(box, near, budget);
    }
    const auto in_b = ends_in_plane(a, of_a, b), in_a = ends_in_plane(b, of_b, a);
    if (!in_a || !in_b) return false;
    const auto [p, q] = common_stretch(*in_b, *in_a);
    return holds_segment(p, q, near);
}

Buried::Stretch Buried::stretch_of(const Core& core, const NearPoint& p, const NearPoint& q) const {
    Stretch s;
    s.has_start = is_within(box_around(p), core.box);
    s.has_end = is_within(box_around(q), core.box);
    for (std::size_t w = core.begin; w < core.end && s.from < s.to; ++w) {
        const Wall& wall = walls_[w];
        const double margin = wall.unsure + std::max(p.off, q.off) * wall.reach;
        const double at_p = dot(wall.normal, p.at - wall.at) + margin,
                     at_q = dot(wall.normal, q.at - wall.at) + margin;
        if (!(at_p < 0)) s.has_start = false;
        if (!(at_q < 0)) s.has_end = false;
        if (at_p < 0 && at_q < 0) continue;
        if (!(at_p < 0) && !(at_q < 0)) {
            s.to = s.from;
            continue;
        }
        const double t = at_p / (at_p - at_q);
        if (at_p < 0)
            s.to = std::min(s.to, t);
        else
            s.from = std::max(s.from, t);
    }
    return s;
}

/// Walks from core to core; each contains the point where the next begins.
bool Buried::holds_segment(const NearPoint& p, const NearPoint& q, const std::vector<Index>& cores) const {
    std::vector<std::pair<Stretch, Index>> all;
    const std::pair<Stretch, Index>* current = nullptr;
    bool ends = false;
    for (const Index core : cores) {
        const Stretch s = stretch_of(cores_[core], p, q);
        if (s.has_start && s.has_end) return true;
        if (!(s.from < s.to)) continue;
        all.emplace_back(s, core);
        ends |= s.has_end;
    }
    if (!ends) return false;
    for (const auto& one : all)
        if (one.first.has_start && (!current || one.first.to > current->first.to)) current = &one;
    double from = 0;
    while (current && !current->first.has_end) {
        const std::pair<Stretch, Index>* next = nullptr;
        const auto reach = [](const Stretch& s) { return s.has_end ? 2 : s.to; };
        for (const auto& one : all)
            if (one.first.from < current->first.to && reach(one.first) > current->first.to &&
                (!next || reach(one.first) > reach(next->first)))
                next = &one;
        if (!next) return false;
        from = (std::max(from, next->first.from) + current->first.to) / 2;
        const Vec3 at = mix(p.at, q.at, from);
        const NearPoint between{at,
                                std::max(p.off, q.off) + 0x1p-50 * std::max(largest(p.at), largest(q.at))};
        if (!holds(cores_[current->second], between) || !holds(cores_[next->second], between)) return false;
        current = next;
    }
    return current != nullptr;
}

/// Halves boxes that no core contains completely, until the budget is used up.
bool Buried::holds_box(const Box& box, const std::vector<Index>& cores, int& budget) const {
    for (const Index core : cores)
        if (holds(cores_[core], box)) return true;
    const NearPoint centre{box.centre(), 0};
    const auto holds_centre = [&](Index core) { return holds(cores_[core], centre); };
    if (--budget < 0 || std::none_of(cores.begin(), cores.end(), holds_centre)) return false;
    const Vec3 extent = box.extent();
    const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    Box low = box, high = box;
    low.max[axis] = high.min[axis] = centre.at[axis];
    return holds_box(low, cores, budget) && holds_box(high, cores, budget);
}

} // namespace facetmill::clean_steps
