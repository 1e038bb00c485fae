#include "geometry/clip/cap.hpp"

#include "base/sort_unique.hpp"
#include "geometry/cut/fill_disjoint.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <bit>
#include <map>
#include <numeric>

namespace facetmill {

namespace {

// Finds the edges in the plane of a cut at which the kept faces end.

/// The undirected edges in the plane at which kept faces do not cancel, ascending by (low, high).
struct CutSection {
    struct Edge {
        Index low, high;             ///< vertices
        Index low_wedge, high_wedge; ///< of the first kept face along the edge
        int count;                   ///< uses from low to high minus uses from high to low
        bool touching;               ///< of a face outside the plane, on either side; set if count is 0
    };
    struct Point {
        Index vertex, wedge;
        bool kept;
    };
    std::vector<Edge> edges;
    /// Vertices in the plane whose faces are not in the plane, each with one wedge, ascending. Those inside
    /// the cap become its corners. Otherwise faces would end in the middle of the cap's triangles.
    std::vector<Point> points;

    bool has_contours() const {
        return std::any_of(edges.begin(), edges.end(), [](const Edge& e) { return e.count != 0; });
    }

    /// The index of the edge between two vertices, or none.
    Index number(Index low, Index high) const;
};

Index CutSection::number(Index low, Index high) const {
    const auto it = std::lower_bound(edges.begin(), edges.end(), std::pair{low, high},
                                     [](const Edge& e, const auto& key) {
                                         return e.low != key.first ? e.low < key.first : e.high < key.second;
                                     });
    return it != edges.end() && it->low == low && it->high == high ? static_cast<Index>(it - edges.begin())
                                                                   : none;
}

/// Collects the edges and vertices in the plane.
class SectionBuilder {
  public:
    SectionBuilder(const PlaneCut& cut, int side) : cut_(cut), side_(side) {}

    CutSection run(const Pieces& pieces) {
        for (std::size_t i = 0; i < pieces.size(); ++i) collect(pieces.of(i), 1, false);
        for (const Index f : cut_.flat)
            if (cut_.stays(f, side_)) collect(cut_.mesh->face_wedges(f), 1, false);
        for (const Index f : cut_.touching) {
            const bool kept = cut_.stays(f, side_);
            collect(cut_.mesh->face_wedges(f), kept ? 1 : 0, true);
            collect_points(f, kept);
        }
        for (const Index f : cut_.cut_faces) collect_points(f, true);
        sum_edges();
        sum_points();
        return std::move(section_);
    }

  private:
    void collect(std::span<const Index> polygon, int count, bool touching) {
        for_polygon_edges(polygon, [&](Index a, Index b) {
            if (cut_.sign_of(a) != 0 || cut_.sign_of(b) != 0) return;
            const Index va = cut_.vertex_of(a), vb = cut_.vertex_of(b);
            if (va < vb) uses_.push_back({va, vb, a, b, count, touching});
            if (vb < va) uses_.push_back({vb, va, b, a, -count, touching});
        });
    }
    void collect_points(Index face, bool kept) {
        for (const Index w : cut_.mesh->face_wedges(face))
            if (cut_.sign_of(w) == 0) section_.points.push_back({cut_.vertex_of(w), w, kept});
    }
    void sum_edges() {
        const int bits = static_cast<int>(std::bit_width(cut_.first_extra_vertex()));
        radix_sort(
            uses_,
            [&](const CutSection::Edge& e) { return static_cast<std::uint64_t>(e.low) << bits | e.high; },
            2 * bits);
        for (std::size_t i = 0; i < uses_.size();) {
            CutSection::Edge sum = uses_[i++];
            for (; i < uses_.size() && uses_[i].low == sum.low && uses_[i].high == sum.high; ++i) {
                sum.count += uses_[i].count;
                sum.touching |= uses_[i].touching;
            }
            if (sum.count != 0 || sum.touching) section_.edges.push_back(sum);
        }
    }
    void sum_points() {
        auto& points = section_.points;
        std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
            return a.vertex != b.vertex ? a.vertex < b.vertex : a.kept != b.kept ? a.kept : a.wedge < b.wedge;
        });
        points.erase(std::unique(points.begin(), points.end(),
                                 [](const auto& a, const auto& b) { return a.vertex == b.vertex; }),
                     points.end());
    }

    const PlaneCut& cut_;
    int side_;
    std::vector<CutSection::Edge> uses_;
    CutSection section_;
};

/// Union-find over the vertices of a section. Each vertex has its number of outgoing minus incoming edges.
struct SectionGraph {
    std::vector<Index> vertices, root;
    std::vector<long long> balance;

    explicit SectionGraph(const CutSection& section) {
        for (const auto& e : section.edges) {
            if (e.count == 0) continue;
            vertices.push_back(e.low);
            vertices.push_back(e.high);
        }
        sort_unique(vertices);
        root.resize(vertices.size());
        std::iota(root.begin(), root.end(), Index{0});
        balance.resize(vertices.size());
        for (const auto& e : section.edges) {
            if (e.count == 0) continue;
            const Index a = local(e.low), b = local(e.high);
            balance[a] += e.count;
            balance[b] -= e.count;
            const Index ra = find(a), rb = find(b);
            root[std::max(ra, rb)] = std::min(ra, rb);
        }
    }
    Index local(Index v) const {
        return static_cast<Index>(std::lower_bound(vertices.begin(), vertices.end(), v) - vertices.begin());
    }
    Index find(Index i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    }
};

/// Removes contours that do not close (connected edges with a vertex whose incoming and outgoing edges
/// differ in number). Returns their ends, in order of their lowest vertex.
std::vector<OpenEnd> drop_open_contours(CutSection& section, const PlaneCut& cut) {
    SectionGraph graph(section);
    std::vector<Index> number(graph.vertices.size(), none); // number of the open contour with this root
    std::vector<OpenEnd> open;
    for (Index i = 0; i < graph.vertices.size(); ++i) {
        if (graph.balance[i] == 0 || number[graph.find(i)] != none) continue;
        number[graph.find(i)] = static_cast<Index>(open.size());
        open.push_back({0, cut.point(graph.vertices[i])});
    }
    if (open.empty()) return open;
    std::erase_if(section.edges, [&](const CutSection::Edge& e) {
        if (e.count == 0) return false;
        const Index n = number[graph.find(graph.local(e.low))];
        if (n != none) ++open[n].edges;
        return n != none;
    });
    return open;
}

/// Makes the cap of one section.
class Capper {
  public:
    Capper(PlaneCut& cut, int side, Pieces& pieces) : cut_(cut), side_(side), pieces_(pieces) {}

    Cap run() {
        section_ = SectionBuilder(cut_, side_).run(pieces_);
        cap_.open = drop_open_contours(section_, cut_);
        if (!section_.has_contours()) return std::move(cap_);
        make_contours();
        filling_ = fill_disjoint(contours_);
        cap_.overlaps = overlaps();
        add_points();
        insert_into_walls();
        for (const auto& t : filling_.triangles)
            for (const Index i : t) cap_.corners.push_back(vertex(i));
        find_cap_wedges();
        return std::move(cap_);
    }

  private:
    void make_contours() {
        const Vec3& n = cut_.plane.normal;
        const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
        dropped_ = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
        first_ = (dropped_ + 1) % 3;
        second_ = (dropped_ + 2) % 3;
        for (const auto& e : section_.edges) {
            local_.push_back(e.low);
            local_.push_back(e.high);
        }
        for (const auto& p : section_.points) local_.push_back(p.vertex);
        sort_unique(local_);
        for (const Index v : local_) {
            const Vec3& p = cut_.point(v);
            contours_.points.push_back({p[first_], p[second_]});
        }
        // The boundary of the cap is the section in the opposite direction.
        for (const auto& e : section_.edges)
            contours_.edges.push_back({local(e.low), local(e.high), -e.count});
    }
    Index local(Index vertex) const {
        return static_cast<Index>(std::lower_bound(local_.begin(), local_.end(), vertex) - local_.begin());
    }
    bool overlaps() const {
        const auto& all = filling_.triangles; // copies follow each other
        return !filling_.added.empty() || std::adjacent_find(all.begin(), all.end()) != all.end();
    }
    /// The vertex of a point of the filling.
    Index vertex(Index i) const {
        return i < local_.size() ? local_[i]
                                 : static_cast<Index>(cut_.first_extra_vertex() + i - local_.size());
    }
    Vec3 place(Index i) const {
        return i < local_.size() ? cut_.point(local_[i]) : cap_.extra.points[i - local_.size()];
    }

    /// Appends the sources of a wedge or vertex to a mix.
    static void add_sources(Provenance& mixes, Index id, std::size_t old,
                            const std::vector<Provenance::Edge>& fresh, double weight) {
        if (id < old) {
            mixes.mix_sources.push_back(id);
            mixes.mix_weights.push_back(weight);
            return;
        }
        const auto& e = fresh[id - old];
        mixes.mix_sources.insert(mixes.mix_sources.end(), {e.a, e.b});
        mixes.mix_weights.insert(mixes.mix_weights.end(), {weight * (1 - e.t), weight * e.t});
    }

    /// Adds vertices where contours cross.
    void add_points() {
        Provenance& mixes = cap_.extra.vertices;
        for (const auto& a : filling_.added) {
            const auto& e = section_.edges[a.edge];
            Vec3 p = mix(cut_.point(e.low), cut_.point(e.high), a.t);
            p[first_] = a.at.x;
            p[second_] = a.at.y;
            cap_.extra.points.push_back(p);
            add_sources(mixes, e.low, cut_.mesh->vertex_count(), cut_.vertices, 1 - a.t);
            add_sources(mixes, e.high, cut_.mesh->vertex_count(), cut_.vertices, a.t);
            mixes.mix_offsets.push_back(static_cast<Index>(mixes.mix_sources.size()));
        }
    }

    /// The points inside the section edge with number e, from its low vertex to its high vertex.
    std::span<const Index> path(std::size_t e) const {
        return {filling_.path.data() + filling_.path_offsets[e],
                filling_.path.data() + filling_.path_offsets[e + 1]};
    }
    std::span<const Index> path_between(Index a, Index b) const {
        const auto e = section_.number(std::min(a, b), std::max(a, b));
        return e == none ? std::span<const Index>{} : path(e);
    }

    /// Inserts the points of divided section edges into their faces, so that no T-vertex remains.
    void insert_into_walls() {
        if (filling_.path.empty()) return;
        Pieces whole;
        for (const auto* list : {&cut_.touching, &cut_.flat})
            for (const Index f : *list)
                if (cut_.stays(f, side_) && divided(cut_.mesh->face_wedges(f))) {
                    cut_.classes[f] |= face_class::replaced;
                    whole.add(f, cut_.mesh->face_wedges(f));
                }
        const Pieces before = std::move(pieces_);
        std::vector<std::pair<Index, std::span<const Index>>> all;
        for (const Pieces* p : {&before, static_cast<const Pieces*>(&whole)})
            for (std::size_t i = 0; i < p->size(); ++i) all.emplace_back(p->source[i], p->of(i));
        std::stable_sort(all.begin(), all.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        pieces_ = {};
        std::vector<Index> polygon;
        for (const auto& [face, wedges] : all) {
            polygon.clear();
            for_polygon_edges(wedges, [&](Index a, Index b) {
                polygon.push_back(a);
                append_inserted(polygon, a, b);
            });
            pieces_.add(face, polygon);
        }
    }
    bool divided(std::span<const Index> polygon) const {
        bool any = false;
        for_polygon_edges(polygon, [&](Index a, Index b) {
            any |= !path_between(cut_.vertex_of(a), cut_.vertex_of(b)).empty();
        });
        return any;
    }
    void append_inserted(std::vector<Index>& polygon, Index a, Index b) {
        const Index va = cut_.vertex_of(a), vb = cut_.vertex_of(b);
        const auto points = path_between(va, vb);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Index point = va < vb ? points[i] : points[points.size() - 1 - i];
            polygon.push_back(va < vb ? wedge_on(a, b, point) : wedge_on(b, a, point));
        }
    }

    /// The wedge of a point inside the section edge between two wedges, the one at the lower vertex first.
    Index wedge_on(Index low, Index high, Index point) {
        if (!cut_.mesh->has_seams()) return vertex(point);
        const auto [at, fresh] = wedges_.try_emplace({low, high, point});
        if (!fresh) return at->second;
        ExtraPoints& extra = cap_.extra;
        at->second = static_cast<Index>(cut_.first_extra_wedge() + extra.wedge_vertex.size());
        const Vec3 a = cut_.point(cut_.vertex_of(low)), b = cut_.point(cut_.vertex_of(high)),
                   p = place(point);
        const double length_squared = dot(b - a, b - a);
        const double t = length_squared > 0 ? std::clamp(dot(p - a, b - a) / length_squared, 0.0, 1.0) : 0.0;
        add_sources(extra.wedges, low, cut_.mesh->wedge_count(), cut_.wedges, 1 - t);
        add_sources(extra.wedges, high, cut_.mesh->wedge_count(), cut_.wedges, t);
        extra.wedges.mix_offsets.push_back(static_cast<Index>(extra.wedges.mix_sources.size()));
        extra.wedge_vertex.push_back(vertex(point));
        return at->second;
    }

    /// The lowest wall wedge at every vertex of the cap.
    void find_cap_wedges() {
        cap_.vertices = cap_.corners;
        sort_unique(cap_.vertices);
        cap_.wedges = cap_.vertices;
        if (!cut_.mesh->has_seams()) return;
        std::map<Index, Index> lowest;
        const auto offer = [&](Index v, Index w) {
            const auto [at, fresh] = lowest.try_emplace(v, w);
            if (!fresh) at->second = std::min(at->second, w);
        };
        for (const auto& e : section_.edges) {
            if (e.count == 0) continue;
            offer(e.low, e.low_wedge);
            offer(e.high, e.high_wedge);
        }
        for (const auto& p : section_.points) lowest.try_emplace(p.vertex, p.wedge);
        for (std::size_t i = 0; i < cap_.extra.wedge_vertex.size(); ++i)
            offer(cap_.extra.wedge_vertex[i], static_cast<Index>(cut_.first_extra_wedge() + i));
        for (std::size_t i = 0; i < cap_.vertices.size(); ++i) cap_.wedges[i] = lowest.at(cap_.vertices[i]);
    }

    PlaneCut& cut_;
    int side_;
    Pieces& pieces_;
    CutSection section_;
    std::size_t dropped_ = 2, first_ = 0,
                second_ = 1;   ///< the axis that is projected away, and the axes of the contours' plane
    std::vector<Index> local_; ///< [points of the contours] vertices, ascending
    Contours contours_;
    Filling filling_;
    std::map<std::array<Index, 3>, Index> wedges_; ///< (low wedge, high wedge, point) -> extra wedge
    Cap cap_;
};

} // namespace

Cap make_cap(PlaneCut& cut, int side, Pieces& pieces) { return Capper(cut, side, pieces).run(); }

} // namespace facetmill
