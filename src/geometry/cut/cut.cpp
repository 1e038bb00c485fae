#include "geometry/cut/cut.hpp"

#include "mesh/float32_ulp.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <set>

namespace facetmill {

namespace {

struct Tally {
    std::size_t above = 0, below = 0, on = 0, snapped = 0, remembered = 0;
    double by = 0; ///< the largest |side| of a snapped vertex
};

Tally operator+(const Tally& a, const Tally& b) {
    return {a.above + b.above,     a.below + b.below,           a.on + b.on,
            a.snapped + b.snapped, a.remembered + b.remembered, std::max(a.by, b.by)};
}

bool is_float32(double x) {
    return std::fabs(x) <= std::numeric_limits<float>::max() && x == static_cast<float>(x);
}

/// The length of the plane's normal, which may be tiny or huge.
double normal_length(const Plane& plane) {
    const Vec3& n = plane.normal;
    const double largest = std::max({std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)});
    return largest * length(n / largest);
}

void classify_vertices(PlaneCut& cut, const OnPlane& on) {
    const auto& positions = cut.mesh->positions;
    const CutMemory::Entry* known = on.memory ? on.memory->find(cut.plane) : nullptr;
    const auto finite = [](double reach) { return std::isfinite(reach) ? reach : 0; };
    const double snap = finite(on.snap.of_single(cut.plane.normal)),
                 rounding = finite(on.snap.of_double(cut.plane.normal));
    const auto classify = [&](const Vec3& p, Tally& t) -> std::int8_t {
        const double s = side(cut.plane, p);
        if (s == 0) {
            ++t.on;
            return 0;
        }
        if (std::fabs(s) <= snap && is_float32(p)) {
            ++t.on;
            ++t.snapped;
            t.by = std::max(t.by, std::fabs(s));
            return 0;
        }
        if (known && known->has(p, known->plane == cut.plane ? s : side(known->plane, p))) {
            ++t.on;
            ++t.remembered;
            return 0;
        }
        if (std::fabs(s) <= rounding) {
            ++t.on;
            ++t.snapped;
            t.by = std::max(t.by, std::fabs(s));
            return 0;
        }
        ++(s > 0 ? t.above : t.below);
        return s > 0 ? 1 : -1;
    };
    cut.signs.resize(positions.size());
    const Tally tally = parallel_reduce(
        positions.size(), Tally{},
        [&](std::size_t begin, std::size_t end) {
            Tally t;
            for (std::size_t v = begin; v < end; ++v) cut.signs[v] = classify(positions[v], t);
            return t;
        },
        [](const Tally& a, const Tally& b) { return a + b; });
    cut.above_count = tally.above;
    cut.below_count = tally.below;
    cut.on_count = tally.on;
    cut.snapped_count = tally.snapped;
    if (tally.by > 0) cut.snapped_by = tally.by / normal_length(cut.plane);
    cut.remembered_count = tally.remembered;
}

constexpr std::uint8_t class_of_sign[3] = {face_class::below, face_class::touches, face_class::above};

void classify_faces(PlaneCut& cut) {
    const Mesh& mesh = *cut.mesh;
    cut.classes.resize(mesh.face_count());
    parallel_chunks(mesh.face_count(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            std::uint8_t bits = 0;
            for (const Index w : mesh.face_wedges(static_cast<Index>(f)))
                bits |= class_of_sign[cut.signs[mesh.vertex_of_wedge(w)] + 1];
            cut.classes[f] = bits;
        }
    });
}

/// The faces whose class satisfies the predicate, ascending.
template <class Predicate>
std::vector<Index> faces_where(const PlaneCut& cut, Predicate&& likes) {
    constexpr std::size_t chunk = 65536;
    const std::size_t n = cut.classes.size();
    std::vector<std::vector<Index>> lists((n + chunk - 1) / chunk);
    parallel_chunks(
        n,
        [&](std::size_t begin, std::size_t end) {
            for (std::size_t f = begin; f < end; ++f)
                if (likes(cut.classes[f])) lists[begin / chunk].push_back(static_cast<Index>(f));
        },
        chunk);
    std::vector<Index> all;
    for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
    return all;
}

/// A corner whose edge the plane crosses: the wedges of the edge (the wedge at the lower vertex first), and
/// the slot for the result.
struct Crossing {
    Index low, high; ///< wedges
    Index slot;      ///< index in PlaneCut::crossings
};

std::vector<Crossing> find_crossings(PlaneCut& cut) {
    const Mesh& mesh = *cut.mesh;
    std::vector<Crossing> found;
    cut.crossing_offsets.push_back(0);
    for (const Index f : cut.cut_faces) {
        for_polygon_edges(mesh.face_wedges(f), [&](Index a, Index b) {
            const Index va = mesh.vertex_of_wedge(a), vb = mesh.vertex_of_wedge(b);
            if (cut.signs[va] * cut.signs[vb] < 0)
                found.push_back({va < vb ? a : b, va < vb ? b : a, static_cast<Index>(found.size())});
        });
        cut.crossing_offsets.push_back(static_cast<Index>(found.size()));
    }
    return found;
}

double parameter_at(const PlaneCut& cut, Index low, Index high) {
    const double a = side(cut.plane, cut.mesh->positions[low]),
                 b = side(cut.plane, cut.mesh->positions[high]);
    return CrossingPoints::parameter(a, b);
}

std::uint64_t edge_key(Index low, Index high) { return std::uint64_t{low} << 32 | high; }

/// Appends the crossings of faces that stay whole, at edges where other faces are cut.
void add_passing(PlaneCut& cut, const std::vector<Index>& whole, std::vector<Crossing>& found, Index& slots) {
    const Mesh& mesh = *cut.mesh;
    std::vector<std::uint64_t> edges;
    edges.reserve(found.size());
    for (const Crossing& c : found)
        edges.push_back(edge_key(mesh.vertex_of_wedge(c.low), mesh.vertex_of_wedge(c.high)));
    std::sort(edges.begin(), edges.end());
    for (const Index f : whole) {
        Index slot = slots;
        bool any = false;
        for_polygon_edges(mesh.face_wedges(f), [&](Index a, Index b) {
            const Index va = mesh.vertex_of_wedge(a), vb = mesh.vertex_of_wedge(b);
            if (cut.signs[va] * cut.signs[vb] >= 0) return;
            if (std::binary_search(edges.begin(), edges.end(),
                                   edge_key(std::min(va, vb), std::max(va, vb)))) {
                found.push_back({va < vb ? a : b, va < vb ? b : a, slot});
                any = true;
            }
            ++slot;
        });
        if (!any) continue;
        cut.passing.push_back(f);
        cut.crossing_offsets.push_back(slots = slot);
    }
}

/// Makes a new wedge per pair of wedges.
void make_wedges(PlaneCut& cut, std::vector<Crossing> crossings, Index slots) {
    const std::size_t wedges = cut.mesh->wedge_count();
    const int bits = static_cast<int>(std::bit_width(wedges));
    radix_sort(
        crossings, [&](const Crossing& c) { return static_cast<std::uint64_t>(c.low) << bits | c.high; },
        2 * bits);
    cut.crossings.assign(slots, none);
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        const Crossing& c = crossings[i];
        if (i == 0 || c.low != crossings[i - 1].low || c.high != crossings[i - 1].high)
            cut.wedges.push_back({c.low, c.high, 0});
        cut.crossings[c.slot] = static_cast<Index>(wedges + cut.wedges.size() - 1);
    }
    parallel_for(cut.wedges.size(), [&](std::size_t i) {
        auto& e = cut.wedges[i];
        e.t = parameter_at(cut, cut.mesh->vertex_of_wedge(e.a), cut.mesh->vertex_of_wedge(e.b));
    });
}

/// Makes a new vertex per edge, by grouping the new wedges by vertices.
void make_vertices(PlaneCut& cut) {
    const Mesh& mesh = *cut.mesh;
    if (!mesh.has_seams()) {
        cut.vertices = cut.wedges;
        return;
    }
    struct Item {
        Index low, high, wedge;
    };
    std::vector<Item> items(cut.wedges.size());
    for (std::size_t i = 0; i < items.size(); ++i)
        items[i] = {mesh.vertex_of_wedge(cut.wedges[i].a), mesh.vertex_of_wedge(cut.wedges[i].b),
                    static_cast<Index>(i)};
    const int bits = static_cast<int>(std::bit_width(mesh.vertex_count()));
    radix_sort(
        items, [&](const Item& e) { return static_cast<std::uint64_t>(e.low) << bits | e.high; }, 2 * bits);
    cut.wedge_vertex.resize(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (i == 0 || items[i].low != items[i - 1].low || items[i].high != items[i - 1].high)
            cut.vertices.push_back({items[i].low, items[i].high, cut.wedges[items[i].wedge].t});
        cut.wedge_vertex[items[i].wedge] = static_cast<Index>(mesh.vertex_count() + cut.vertices.size() - 1);
    }
}

void place_vertices(PlaneCut& cut) {
    const CrossingPoints point(cut.plane);
    cut.points.resize(cut.vertices.size());
    parallel_for(cut.points.size(), [&](std::size_t v) {
        const auto& e = cut.vertices[v];
        cut.points[v] = point(cut.mesh->positions[e.a], cut.mesh->positions[e.b], e.t);
    });
}

} // namespace

CrossingPoints::CrossingPoints(const Plane& plane) : axis_(axis_of(plane)) {
    const auto i = static_cast<std::size_t>(std::max(axis_, 0));
    level_ = plane.through[i] - (axis_ >= 0 ? plane.offset / plane.normal[i] : 0);
}

double CrossingPoints::parameter(double side_of_a, double side_of_b) {
    const double t = side_of_a / (side_of_a - side_of_b); // the signs differ and neither is 0
    return t >= 0 && t <= 1 ? t : 0.5;                    // outside only by overflow
}

Vec3 CrossingPoints::operator()(const Vec3& a, const Vec3& b, double t) const {
    Vec3 p = mix(a, b, t);
    for (std::size_t i = 0; i < 3; ++i)
        if (a[i] == b[i]) p[i] = a[i];
    if (axis_ >= 0) p[static_cast<std::size_t>(axis_)] = level_;
    return p;
}

bool is_float32(const Vec3& p) { return is_float32(p.x) && is_float32(p.y) && is_float32(p.z); }

/// Whether the directions of the faces cancel at every edge.
bool is_closed(const Mesh& mesh) {
    const EdgeTable table = build_edges(mesh);
    for (Index e = 0; e < table.size(); ++e) {
        int balance = 0;
        for (const Index c : table.corners_of(e)) balance += mesh.vertex(c) == table.edges[e].low ? 1 : -1;
        if (balance != 0) return false;
    }
    return true;
}

namespace {

/// The 32-bit floats along one axis, except 0.
class AxisFloats {
  public:
    void add(double x) {
        if (x == 0) return;
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(std::fabs(x)));
        const std::uint32_t exponent = bits >> 23, fraction = bits & 0x7FFFFF;
        const int ulp = static_cast<int>(std::max(exponent, 1U)) - 150;
        multiple_ =
            std::min(multiple_, ulp + std::countr_zero(exponent > 0 ? fraction | 1U << 23 : fraction));
        largest_ulp_ = std::max(largest_ulp_, ulp);
        if (some_.size() < enough) some_.insert(std::fabs(x));
    }
    bool empty() const { return some_.empty(); }
    int largest_ulp() const { return largest_ulp_; } ///< these are exponents of 2

    /// All numbers are multiples of 2^multiple.
    int multiple() const { return multiple_; }
    /// The chance that rounded numbers are such multiples is 2^-bits: each float is a multiple of twice its
    /// ulp with a chance of one half.
    int bits(int multiple) const {
        int sum = 0;
        for (const double x : some_) sum += std::max(0, multiple - exponent_of_ulp(x));
        return sum;
    }
    bool are_many_multiples(int of) const {
        return multiple_ >= of && some_.size() == enough && largest_ulp_ < of;
    }

  private:
    static constexpr std::size_t enough = 24;
    static int exponent_of_ulp(double x) { return std::max(std::ilogb(x) - 23, -149); }

    int multiple_ = 1024, largest_ulp_ = -149;
    std::set<double> some_; ///< distinct
};

/// Whether the numbers of an axis show that they were not rounded.
bool are_not_rounded(const std::array<AxisFloats, 3>& axes, std::size_t axis) {
    constexpr int enough = 10; // bits: one in a thousand
    const int ulp = axes[axis].largest_ulp();
    const int own = axes[axis].multiple() > ulp ? axes[axis].bits(axes[axis].multiple()) : 0;
    if (own >= enough) return true;
    int others = 0;
    bool all = true;
    for (const std::size_t i : {(axis + 1) % 3, (axis + 2) % 3}) {
        if (axes[i].are_many_multiples(ulp)) return true;
        if (axes[i].empty()) continue;
        const int bits = axes[i].multiple() >= ulp ? axes[i].bits(ulp) : 0;
        all = all && bits >= 4; // an axis proves nothing if its floats are hardly finer
        others += bits;
    }
    return all && own + others >= enough;
}

} // namespace

CoordinateErrors rounding_of(const Mesh& mesh) {
    const Box bounds = mesh.bounds();
    CoordinateErrors r;
    if (bounds.empty()) return r;
    std::array<AxisFloats, 3> axes;
    std::size_t floats = 0;
    for (const Vec3& p : mesh.positions) {
        if (!is_float32(p)) continue;
        ++floats;
        for (std::size_t i = 0; i < 3; ++i) axes[i].add(p[i]);
    }
    const bool are_floats = 2 * floats >= mesh.positions.size();
    for (std::size_t i = 0; i < 3; ++i) {
        const double largest = std::max(std::fabs(bounds.min[i]), std::fabs(bounds.max[i]));
        const double step = float32_ulp(Box{{0, 0, 0}, {largest, 0, 0}});
        r.twice[i] = std::ldexp(step, -27); // 4 units of a double's last place
        if (are_floats && !are_not_rounded(axes, i)) r.single[i] = step / 2;
    }
    return r;
}

namespace {

/// Everything that follows from the signs of the vertices.
void make_cut(PlaneCut& cut, std::span<const std::uint8_t> faces) {
    classify_faces(cut);
    using namespace face_class;
    cut.cut_faces = faces_where(cut, [](std::uint8_t c) { return (c & (above | below)) == (above | below); });
    std::vector<Index> whole;
    if (!faces.empty()) {
        std::copy_if(cut.cut_faces.begin(), cut.cut_faces.end(), std::back_inserter(whole),
                     [&](Index f) { return faces[f] == 0; });
        std::erase_if(cut.cut_faces, [&](Index f) { return faces[f] == 0; });
    }
    if (cut.on_count > 0) {
        cut.touching =
            faces_where(cut, [](std::uint8_t c) { return c == (above | touches) || c == (below | touches); });
        cut.flat = faces_where(cut, [](std::uint8_t c) { return c == touches; });
    }
    auto crossings = find_crossings(cut);
    auto slots = static_cast<Index>(crossings.size());
    add_passing(cut, whole, crossings, slots);
    make_wedges(cut, std::move(crossings), slots);
    make_vertices(cut);
    place_vertices(cut);
}

} // namespace

PlaneCut cut_by_plane(const Mesh& mesh, const Plane& plane, const OnPlane& on,
                      std::span<const std::uint8_t> faces) {
    PlaneCut cut;
    cut.mesh = &mesh;
    cut.plane = plane;
    classify_vertices(cut, on);
    if (cut.meets()) make_cut(cut, faces);
    return cut;
}

PlaneCut cut_by_signs(const Mesh& mesh, const Plane& plane, std::vector<std::int8_t> signs,
                      std::span<const std::uint8_t> faces) {
    PlaneCut cut;
    cut.mesh = &mesh;
    cut.plane = plane;
    cut.signs = std::move(signs);
    for (const std::int8_t s : cut.signs)
        ++(s > 0 ? cut.above_count : s < 0 ? cut.below_count : cut.on_count);
    if (cut.meets()) make_cut(cut, faces);
    return cut;
}

void remember(CutMemory& memory, const PlaneCut& cut, std::span<const Vec3> more) {
    const auto& positions = cut.mesh->positions;
    if (!memory.entries.empty()) {
        std::vector<Vec3> ends;
        for (const auto& e : cut.vertices) ends.insert(ends.end(), {positions[e.a], positions[e.b]});
        const auto at = memory.entries_at(ends);
        std::vector<std::vector<Vec3>> on(memory.entries.size());
        for (std::size_t i = 0; i < cut.points.size(); ++i)
            for (const auto e : at[2 * i])
                if (std::binary_search(at[2 * i + 1].begin(), at[2 * i + 1].end(), e))
                    on[e].push_back(cut.points[i]);
        for (std::size_t e = 0; e < on.size(); ++e)
            if (!on[e].empty() && !same_plane(memory.entries[e].plane, cut.plane))
                memory.add_to(e, std::move(on[e]));
    }
    std::vector<Vec3> points = cut.points;
    points.insert(points.end(), more.begin(), more.end());
    if (cut.snapped_count > 0)
        for (std::size_t v = 0; v < positions.size(); ++v)
            if (cut.signs[v] == 0) points.push_back(positions[v]);
    memory.add(cut.plane, std::move(points));
}

} // namespace facetmill
