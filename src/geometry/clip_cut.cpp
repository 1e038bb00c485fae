#include "geometry/clip_cut.hpp"

#include "base/parallel.hpp"

#include <bit>

namespace facetmill {

namespace {

struct Tally {
    std::size_t above = 0, below = 0, on = 0;
};

void classify_vertices(PlaneCut& cut) {
    const auto& positions = cut.mesh->positions;
    cut.signs.resize(positions.size());
    const Tally tally = parallel_reduce(
        positions.size(), Tally{},
        [&](std::size_t begin, std::size_t end) {
            Tally t;
            for (std::size_t v = begin; v < end; ++v) {
                const double s = side(cut.plane, positions[v]);
                cut.signs[v] = s > 0 ? 1 : s < 0 ? -1 : 0;
                t.above += s > 0, t.below += s < 0, t.on += s == 0;
            }
            return t;
        },
        [](Tally a, const Tally& b) {
            return Tally{a.above + b.above, a.below + b.below, a.on + b.on};
        });
    cut.above_count = tally.above, cut.below_count = tally.below, cut.on_count = tally.on;
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

/// The faces whose class the predicate likes, ascending.
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

/// A corner whose edge the plane crosses: its wedges, that at the lower vertex first, and where the answer
/// goes.
struct Crossing {
    Index low, high; ///< wedges
    Index slot;      ///< into PlaneCut::crossings
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
    const double t = a / (a - b);      // the signs differ and neither is 0
    return t >= 0 && t <= 1 ? t : 0.5; // overflow only
}

/// One wedge per pair of wedges.
void make_wedges(PlaneCut& cut, std::vector<Crossing> crossings) {
    const std::size_t wedges = cut.mesh->wedge_count();
    const int bits = static_cast<int>(std::bit_width(wedges));
    radix_sort(
        crossings, [&](const Crossing& c) { return static_cast<std::uint64_t>(c.low) << bits | c.high; },
        2 * bits);
    cut.crossings.resize(crossings.size());
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

/// One vertex per edge: the new wedges again, but by vertices.
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
    const int axis = axis_of(cut.plane);
    const auto i = static_cast<std::size_t>(std::max(axis, 0));
    const double level = cut.plane.through[i] - (axis >= 0 ? cut.plane.offset / cut.plane.normal[i] : 0);
    cut.points.resize(cut.vertices.size());
    parallel_for(cut.points.size(), [&](std::size_t v) {
        const auto& e = cut.vertices[v];
        cut.points[v] = mix(cut.mesh->positions[e.a], cut.mesh->positions[e.b], e.t);
        if (axis >= 0) cut.points[v][i] = level;
    });
}

/// Twice the area of a face as a vector (Newell).
Vec3 area_vector(const Mesh& mesh, Index f) {
    Vec3 sum;
    const Vec3 origin = mesh.point(mesh.face_begin(f));
    for (Index c = mesh.face_begin(f) + 1; c + 1 < mesh.face_end(f); ++c)
        sum += cross(mesh.point(c) - origin, mesh.point(c + 1) - origin);
    return sum;
}

/// Cuts one face. Its corners and crossings become a ring of nodes; what lies on a side is chains of that
/// ring.
class FaceCutter {
  public:
    FaceCutter(const PlaneCut& cut, int side) : cut_(cut), side_(side) {}

    void cut(std::size_t i, Pieces& out) {
        const Index face = cut_.cut_faces[i];
        make_ring(face, cut_.crossings.data() + cut_.crossing_offsets[i]);
        find_chains();
        if (cut_.mesh->face_size(face) > 3) {
            along_ = cross(cut_.plane.normal, area_vector(*cut_.mesh, face)) * side_;
            for (Chain& c : chains_) trim(c);
        }
        join_chains();
        emit(face, out);
    }

  private:
    struct Node {
        Index wedge;
        int sign; ///< 1 on the wanted side
    };
    struct Chain {
        std::size_t begin, end; ///< nodes, from where the boundary leaves the plane to where it comes back
    };

    void make_ring(Index face, const Index* crossing) {
        ring_.clear();
        for_polygon_edges(cut_.mesh->face_wedges(face), [&](Index a, Index b) {
            const int s = cut_.sign_of(a) * side_;
            ring_.push_back({a, s});
            if (s * cut_.sign_of(b) * side_ < 0) ring_.push_back({*crossing++, 0});
        });
        // Start behind a node of the other side, so that no chain wraps around.
        const auto other = std::find_if(ring_.begin(), ring_.end(), [](const Node& n) { return n.sign < 0; });
        std::rotate(ring_.begin(), other, ring_.end());
    }

    void find_chains() {
        chains_.clear();
        for (std::size_t i = 0; i < ring_.size();) {
            std::size_t end = i;
            bool inside = false;
            while (end < ring_.size() && ring_[end].sign >= 0) inside |= ring_[end++].sign > 0;
            if (inside) chains_.push_back({i, end});
            i = end + 1;
        }
    }

    const Vec3& point(std::size_t node) const { return cut_.point(cut_.vertex_of(ring_[node].wedge)); }

    /// An edge in the plane at the end of a chain belongs to it only when it runs the way that this side's
    /// boundary runs in the plane; else it is the other side's.
    void trim(Chain& c) const {
        const auto against = [&](std::size_t a, std::size_t b) {
            return ring_[a].sign == 0 && ring_[b].sign == 0 && dot(point(b) - point(a), along_) < 0;
        };
        while (c.end - c.begin > 2 && against(c.end - 2, c.end - 1)) --c.end;
        while (c.end - c.begin > 2 && against(c.begin, c.begin + 1)) ++c.begin;
    }

    /// next_[i]: the chain that follows chain i after a stretch in the plane. With several chains their ends
    /// are paired in order along the line of the cut; where that makes no sense (self-crossing faces), in
    /// ring order.
    void join_chains() {
        const std::size_t n = chains_.size();
        next_.resize(n);
        for (std::size_t i = 0; i < n; ++i) next_[i] = (i + 1) % n;
        if (n < 2) return;
        struct End {
            double at;
            std::size_t chain;
            bool starts;
        };
        std::vector<End> ends;
        for (std::size_t i = 0; i < n; ++i) {
            ends.push_back({dot(point(chains_[i].begin), along_), i, true});
            ends.push_back({dot(point(chains_[i].end - 1), along_), i, false});
        }
        std::stable_sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.at < b.at; });
        for (std::size_t i = 0; i < ends.size(); i += 2)
            if (ends[i].starts == ends[i + 1].starts) return;
        for (std::size_t i = 0; i < ends.size(); i += 2) {
            const End &a = ends[i], &b = ends[i + 1];
            a.starts ? next_[b.chain] = a.chain : next_[a.chain] = b.chain;
        }
    }

    void emit(Index face, Pieces& out) {
        done_.assign(chains_.size(), false);
        for (std::size_t first = 0; first < chains_.size(); ++first) {
            if (done_[first]) continue;
            polygon_.clear();
            for (std::size_t i = first; !done_[i]; i = next_[i]) {
                done_[i] = true;
                for (std::size_t n = chains_[i].begin; n < chains_[i].end; ++n)
                    polygon_.push_back(ring_[n].wedge);
            }
            if (polygon_.size() > 2) out.add(face, polygon_); // two corners: there and back, nothing
        }
    }

    const PlaneCut& cut_;
    int side_;
    Vec3 along_; ///< the way in which this side's boundary runs in the plane
    std::vector<Node> ring_;
    std::vector<Chain> chains_;
    std::vector<std::size_t> next_;
    std::vector<bool> done_;
    std::vector<Index> polygon_;
};

} // namespace

PlaneCut cut_by_plane(const Mesh& mesh, const Plane& plane) {
    PlaneCut cut;
    cut.mesh = &mesh;
    cut.plane = plane;
    classify_vertices(cut);
    if (!cut.meets()) return cut;
    classify_faces(cut);
    using namespace face_class;
    cut.cut_faces = faces_where(cut, [](std::uint8_t c) { return (c & (above | below)) == (above | below); });
    if (cut.on_count > 0) {
        cut.touching =
            faces_where(cut, [](std::uint8_t c) { return c == (above | touches) || c == (below | touches); });
        cut.flat = faces_where(cut, [](std::uint8_t c) { return c == touches; });
    }
    make_wedges(cut, find_crossings(cut));
    make_vertices(cut);
    place_vertices(cut);
    return cut;
}

void settle_flat_by_normal(PlaneCut& cut) {
    for (const Index f : cut.flat) {
        const double s = dot(area_vector(*cut.mesh, f), cut.plane.normal);
        if (s != 0) cut.classes[f] |= s < 0 ? face_class::flat_above : face_class::flat_below;
    }
}

void settle_flat(PlaneCut& cut, int side) {
    if (side == 0) return;
    for (const Index f : cut.flat)
        cut.classes[f] |= side > 0 ? face_class::flat_above : face_class::flat_below;
}

Pieces pieces_on_side(const PlaneCut& cut, int side) {
    Pieces out;
    FaceCutter cutter(cut, side);
    for (std::size_t i = 0; i < cut.cut_faces.size(); ++i) cutter.cut(i, out);
    return out;
}

} // namespace facetmill
