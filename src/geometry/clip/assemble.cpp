#include "geometry/clip/assemble.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

namespace {

constexpr std::size_t block = 16384;

/// The old elements that remain, and the new number of each old element (none if removed).
struct Renumbering {
    std::vector<Index> kept, number;
};

/// Numbers the elements for which stays(i) is true, in order.
template <class Stays>
Renumbering renumber(std::size_t n, Stays&& stays) {
    Renumbering r;
    std::vector<std::size_t> counts((n + block - 1) / block);
    const auto count = [&](std::size_t begin, std::size_t end) {
        std::size_t sum = 0;
        for (std::size_t i = begin; i < end; ++i) sum += stays(i);
        counts[begin / block] = sum;
    };
    parallel_chunks(n, count, block);
    r.kept.resize(exclusive_scan(counts));
    r.number.resize(n);
    const auto fill = [&](std::size_t begin, std::size_t end) {
        std::size_t next = counts[begin / block];
        for (std::size_t i = begin; i < end; ++i) {
            r.number[i] = stays(i) ? static_cast<Index>(next) : none;
            if (stays(i)) r.kept[next++] = static_cast<Index>(i);
        }
    };
    parallel_chunks(n, fill, block);
    return r;
}

class Assembler {
  public:
    Assembler(const PlaneCut& cut, int side, const Pieces& pieces, const Cap& cap)
        : cut_(cut), from_(*cut.mesh), side_(side), pieces_(pieces), cap_(cap) {}

    ClippedSide run(const CapPaint& paint) {
        number_elements();
        place_vertices();
        number_cap_wedges();
        describe_wedges();
        fill_faces();
        add_cap_faces();
        ClippedSide result;
        result.changes = inherit_attributes(out_, from_, provenance_);
        if (!cap_.corners.empty()) {
            std::vector<Index> own;
            if (own_wedges_)
                for (const Index w : cap_wedge_) own.push_back(w);
            paint_cap(out_, {cap_face_, out_.face_count()}, own, outward(), paint);
        }
        normalise_offsets(out_);
        result.mesh = std::move(out_);
        return result;
    }

  private:
    /// Elements on the kept side stay; elements on the plane stay if a kept face uses them. In a point
    /// cloud, points on the plane are in front.
    void number_elements() {
        const bool cloud = from_.corner_count() == 0;
        std::vector<std::uint8_t> wedge_used, vertex_used;
        if (cut_.on_count > 0) find_used(wedge_used, vertex_used);
        wedges_ = renumber(from_.wedge_count(), [&](std::size_t w) {
            const int s = cut_.signs[from_.vertex_of_wedge(static_cast<Index>(w))];
            return s == 0 ? (cloud ? side_ > 0 : wedge_used[w] != 0) : s == side_;
        });
        if (from_.has_seams())
            vertices_ = renumber(from_.vertex_count(), [&](std::size_t v) {
                const int s = cut_.signs[v];
                return s == 0 ? (cloud ? side_ > 0 : vertex_used[v] != 0) : s == side_;
            });
    }
    void find_used(std::vector<std::uint8_t>& wedge_used, std::vector<std::uint8_t>& vertex_used) {
        wedge_used.resize(from_.wedge_count());
        vertex_used.resize(from_.vertex_count());
        const auto use = [&](std::span<const Index> polygon) {
            for (const Index w : polygon)
                if (w < wedge_used.size()) {
                    wedge_used[w] = 1;
                    vertex_used[from_.vertex_of_wedge(w)] = 1;
                }
        };
        for (const auto* list : {&cut_.touching, &cut_.flat})
            for (const Index f : *list)
                if (cut_.stays(f, side_)) use(from_.face_wedges(f));
        for (std::size_t i = 0; i < pieces_.size(); ++i) use(pieces_.of(i));
        use(cap_.wedges);
    }
    const Renumbering& vertices() const { return from_.has_seams() ? vertices_ : wedges_; }

    void place_vertices() {
        const auto& kept = vertices().kept;
        provenance_.vertices.copies = kept;
        provenance_.vertices.edges = cut_.vertices;
        const Provenance& extra = cap_.extra.vertices;
        provenance_.vertices.mix_offsets = extra.mix_offsets;
        provenance_.vertices.mix_sources = extra.mix_sources;
        provenance_.vertices.mix_weights = extra.mix_weights;
        out_.positions.resize(kept.size());
        parallel_for(kept.size(), [&](std::size_t i) { out_.positions[i] = from_.positions[kept[i]]; });
        out_.positions.insert(out_.positions.end(), cut_.points.begin(), cut_.points.end());
        out_.positions.insert(out_.positions.end(), cap_.extra.points.begin(), cap_.extra.points.end());
    }
    Index new_vertex(Index v) const {
        if (v < from_.vertex_count()) return vertices().number[v];
        return static_cast<Index>(vertices().kept.size() + (v - from_.vertex_count()));
    }

    /// If a cap has its own normals or coordinates, each of its vertices gets a new wedge with the sources
    /// of the wall's wedge. The order is: copies, points on edges, mixes.
    void number_cap_wedges() {
        own_wedges_ = !cap_.corners.empty() && caps_have_own_wedges(from_);
        if (!own_wedges_) return;
        cap_order_.resize(cap_.wedges.size());
        for (Index i = 0; i < cap_order_.size(); ++i) cap_order_[i] = i;
        std::sort(cap_order_.begin(), cap_order_.end(),
                  [&](Index a, Index b) { return cap_.wedges[a] < cap_.wedges[b]; });
        for (const Index w : cap_.wedges) {
            cap_copies_ += w < from_.wedge_count();
            cap_edges_ += w >= from_.wedge_count() && w < cut_.first_extra_wedge();
        }
    }

    /// The number of a wedge of the cut; cap wedges of each kind follow the wall wedges of that kind.
    Index new_wedge(Index w) const {
        if (w < from_.wedge_count()) return wedges_.number[w];
        if (w < cut_.first_extra_wedge())
            return static_cast<Index>(wedges_.kept.size() + cap_copies_ + (w - from_.wedge_count()));
        return static_cast<Index>(wedges_.kept.size() + cap_copies_ + cap_edges_ + (w - from_.wedge_count()));
    }

    void describe_wedges() {
        Provenance& to = provenance_.wedges;
        const Provenance& extra = from_.has_seams() ? cap_.extra.wedges : cap_.extra.vertices;
        to.copies = wedges_.kept;
        to.edges = cut_.wedges;
        to.mix_offsets = extra.mix_offsets;
        to.mix_sources = extra.mix_sources;
        to.mix_weights = extra.mix_weights;
        const std::size_t extras = extra.mixes();
        cap_wedge_.resize(own_wedges_ ? cap_.vertices.size() : 0);
        for (std::size_t k = 0; k < cap_order_.size(); ++k) {
            const Index i = cap_order_[k], w = cap_.wedges[i];
            if (k < cap_copies_) {
                cap_wedge_[i] = static_cast<Index>(wedges_.kept.size() + k);
                to.copies.push_back(w);
            } else if (k < cap_copies_ + cap_edges_) {
                cap_wedge_[i] = static_cast<Index>(wedges_.kept.size() + cut_.wedges.size() + k);
                to.edges.push_back(cut_.wedges[w - from_.wedge_count()]);
            } else {
                cap_wedge_[i] = static_cast<Index>(wedges_.kept.size() + cut_.wedges.size() + extras + k);
                copy_mix(to, extra, w - static_cast<Index>(cut_.first_extra_wedge()));
            }
        }
        if (!from_.has_seams() && !own_wedges_) return;
        out_.wedge_vertex.resize(to.copies.size() + to.edges.size() + to.mixes());
        parallel_for(wedges_.kept.size(), [&](std::size_t i) {
            out_.wedge_vertex[i] = new_vertex(from_.vertex_of_wedge(wedges_.kept[i]));
        });
        for (Index i = 0; i < cut_.wedges.size(); ++i)
            set_vertex(static_cast<Index>(from_.wedge_count() + i));
        for (Index i = 0; i < extras; ++i) set_vertex(static_cast<Index>(cut_.first_extra_wedge() + i));
        for (std::size_t i = 0; i < cap_wedge_.size(); ++i)
            out_.wedge_vertex[cap_wedge_[i]] = new_vertex(cap_.vertices[i]);
    }
    static void copy_mix(Provenance& to, const Provenance& from, Index i) {
        for (Index k = from.mix_offsets[i]; k < from.mix_offsets[i + 1]; ++k) {
            to.mix_sources.push_back(from.mix_sources[k]);
            to.mix_weights.push_back(from.mix_weights[k]);
        }
        to.mix_offsets.push_back(static_cast<Index>(to.mix_sources.size()));
    }
    void set_vertex(Index w) {
        const Index extra = static_cast<Index>(cut_.first_extra_wedge());
        const Index v =
            w < extra || !from_.has_seams() ? cut_.vertex_of(w) : cap_.extra.wedge_vertex[w - extra];
        out_.wedge_vertex[new_wedge(w)] = new_vertex(v);
    }

    /// The faces and corners that a range of old faces becomes.
    struct Count {
        std::size_t faces = 0, corners = 0;
    };
    /// Calls whole(f) for each face that stays and piece(i) for each polygon that replaces a face, in order
    /// of the faces.
    template <class Whole, class Piece>
    void for_kept(std::size_t begin, std::size_t end, Whole&& whole, Piece&& piece) const {
        std::size_t i = static_cast<std::size_t>(
            std::lower_bound(pieces_.source.begin(), pieces_.source.end(), begin) - pieces_.source.begin());
        for (std::size_t f = begin; f < end; ++f) {
            if (cut_.stays(static_cast<Index>(f), side_)) whole(static_cast<Index>(f));
            for (; i < pieces_.size() && pieces_.source[i] == f; ++i) piece(i);
        }
    }

    void fill_faces() {
        std::vector<Count> counts((from_.face_count() + block - 1) / block + 1);
        const auto count = [&](std::size_t begin, std::size_t end) {
            Count c;
            for_kept(
                begin, end,
                [&](Index f) {
                    ++c.faces;
                    c.corners += from_.face_size(f);
                },
                [&](std::size_t i) {
                    ++c.faces;
                    c.corners += pieces_.of(i).size();
                });
            counts[begin / block + 1] = c;
        };
        parallel_chunks(from_.face_count(), count, block);
        for (std::size_t b = 1; b < counts.size(); ++b) {
            counts[b].faces += counts[b - 1].faces;
            counts[b].corners += counts[b - 1].corners;
        }
        cap_face_ = counts.back().faces;
        const std::size_t faces = cap_face_ + cap_.corners.size() / 3;
        out_.corners.resize(counts.back().corners);
        if (faces * 3 != out_.corners.size() + cap_.corners.size() || !from_.all_triangles())
            out_.face_offsets.resize(faces + 1);
        provenance_.faces.resize(faces);
        parallel_chunks(
            from_.face_count(),
            [&](std::size_t begin, std::size_t end) { fill_block(begin, end, counts[begin / block]); },
            block);
    }
    void fill_block(std::size_t begin, std::size_t end, Count at) {
        const auto add = [&](Index source, std::span<const Index> polygon) {
            for (const Index w : polygon) out_.corners[at.corners++] = new_wedge(w);
            provenance_.faces[at.faces++] = source;
            if (!out_.face_offsets.empty()) out_.face_offsets[at.faces] = static_cast<Index>(at.corners);
        };
        for_kept(
            begin, end, [&](Index f) { add(f, from_.face_wedges(f)); },
            [&](std::size_t i) { add(pieces_.source[i], pieces_.of(i)); });
    }

    void add_cap_faces() {
        for (const Index v : cap_.corners) {
            const auto i = static_cast<std::size_t>(
                std::lower_bound(cap_.vertices.begin(), cap_.vertices.end(), v) - cap_.vertices.begin());
            out_.corners.push_back(own_wedges_ ? cap_wedge_[i] : new_wedge(cap_.wedges[i]));
        }
        for (std::size_t f = cap_face_; f < provenance_.faces.size(); ++f) {
            provenance_.faces[f] = 0;
            if (!out_.face_offsets.empty()) out_.face_offsets[f + 1] = out_.face_offsets[f] + 3;
        }
    }

    /// The plane, with its normal in the direction of the cap's faces.
    Plane outward() const {
        const auto end = static_cast<Index>(out_.corners.size());
        const Vec3 sum = area_of_triangles(out_, end - static_cast<Index>(cap_.corners.size()), end);
        Plane plane = cut_.plane;
        const double agrees = dot(sum, plane.normal);
        if (agrees < 0 || (agrees == 0 && side_ > 0)) plane.normal = -plane.normal;
        return plane;
    }

    const PlaneCut& cut_;
    const Mesh& from_;
    int side_;
    const Pieces& pieces_;
    const Cap& cap_;
    Mesh out_;
    MeshProvenance provenance_;
    Renumbering wedges_, vertices_; ///< vertices_ is filled only with seams
    bool own_wedges_ = false;
    std::size_t cap_copies_ = 0, cap_edges_ = 0, cap_face_ = 0;
    std::vector<Index> cap_order_; ///< cap vertices by their wall wedge
    std::vector<Index> cap_wedge_; ///< [cap vertices] new wedge, if the cap has its own wedges
};

} // namespace

ClippedSide assemble(const PlaneCut& cut, int side, const Pieces& pieces, const Cap& cap,
                     const CapPaint& paint) {
    return Assembler(cut, side, pieces, cap).run(paint);
}

} // namespace facetmill
