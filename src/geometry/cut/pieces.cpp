// Makes the parts of cut faces on a side, and chooses the sides of faces in the plane.
#include "geometry/cut/cut.hpp"

#include "mesh/face.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// Cuts a face. Its corners and crossings become a ring of nodes. Each side consists of chains of this ring.
class PieceCutter {
  public:
    PieceCutter(const PlaneCut& cut, int side) : cut_(cut), side_(side) {}

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
        int sign; ///< 1 for nodes on the wanted side
    };
    struct Chain {
        std::size_t begin, end; ///< nodes, from where the boundary leaves the plane to where it returns
    };

    void make_ring(Index face, const Index* crossing) {
        ring_.clear();
        for_polygon_edges(cut_.mesh->face_wedges(face), [&](Index a, Index b) {
            const int s = cut_.sign_of(a) * side_;
            ring_.push_back({a, s});
            if (s * cut_.sign_of(b) * side_ < 0) ring_.push_back({*crossing++, 0});
        });
        // Start after a node of the other side, so that no chain wraps around.
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

    /// An edge in the plane at the end of a chain belongs to it only if it runs in the direction of this
    /// side's boundary in the plane. Otherwise the edge belongs to the other side. An edge without length
    /// belongs to the front.
    void trim(Chain& c) const {
        const auto against = [&](std::size_t a, std::size_t b) {
            if (ring_[a].sign != 0 || ring_[b].sign != 0) return false;
            const double runs = dot(point(b) - point(a), along_);
            return runs < 0 || (runs == 0 && side_ < 0);
        };
        while (c.end - c.begin > 2 && against(c.end - 2, c.end - 1)) --c.end;
        while (c.end - c.begin > 2 && against(c.begin, c.begin + 1)) ++c.begin;
    }

    /// Sets next_[i], the chain that follows chain i after a segment in the plane. Ends of several chains
    /// are paired in order along the line of the cut, or in ring order if that is impossible (self-crossing
    /// faces).
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
            if (polygon_.size() > 2) out.add(face, polygon_); // two corners enclose no area
        }
    }

    const PlaneCut& cut_;
    int side_;
    Vec3 along_; ///< the direction of this side's boundary in the plane
    std::vector<Node> ring_;
    std::vector<Chain> chains_;
    std::vector<std::size_t> next_;
    std::vector<bool> done_;
    std::vector<Index> polygon_;
};

} // namespace

void settle_flat_by_normal(PlaneCut& cut) {
    for (const Index f : cut.flat) {
        const double s = dot(area_vector(*cut.mesh, f), cut.plane.normal);
        cut.classes[f] |= s < 0 ? face_class::flat_above : face_class::flat_below;
    }
}

void settle_flat(PlaneCut& cut, int side) {
    if (side == 0) return;
    for (const Index f : cut.flat)
        cut.classes[f] |= side > 0 ? face_class::flat_above : face_class::flat_below;
}

Pieces pieces_on_side(const PlaneCut& cut, int side) {
    Pieces out;
    PieceCutter cutter(cut, side);
    for (std::size_t i = 0; i < cut.cut_faces.size(); ++i) cutter.cut(i, out);
    return out;
}

void passing_with_points(const PlaneCut& cut, std::size_t number, std::vector<Index>& polygon) {
    const Index* crossing = cut.crossings.data() + cut.crossing_offsets[cut.cut_faces.size() + number];
    polygon.clear();
    for_polygon_edges(cut.mesh->face_wedges(cut.passing[number]), [&](Index a, Index b) {
        polygon.push_back(a);
        if (cut.sign_of(a) * cut.sign_of(b) >= 0) return;
        if (*crossing != none) polygon.push_back(*crossing);
        ++crossing;
    });
}

} // namespace facetmill
