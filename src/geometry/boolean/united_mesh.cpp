#include "geometry/boolean/united_mesh.hpp"

#include "base/math/numbers.hpp"
#include "mesh/indices_where.hpp"
#include "mesh/position_hash.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace facetmill::clean_steps {

namespace {

constexpr std::array sides{std::array{0, 1}, std::array{1, 2}, std::array{2, 0}};

/// A point as a mix of a triangle's corners.
struct Mix {
    std::array<Index, 3> corners;
    std::array<double, 3> weights;
    std::size_t size;
};

/// The position of p between a and b, from 0 to 1.
double along(const Vec3& p, const Vec3& a, const Vec3& b) {
    const double squared = dot(b - a, b - a);
    return squared > 0 ? std::clamp(dot(p - a, b - a) / squared, 0.0, 1.0) : 0.5;
}

std::array<double, 3> barycentric(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 n = cross(b - a, c - a);
    std::array w{dot(n, cross(b - p, c - p)), dot(n, cross(c - p, a - p)), dot(n, cross(a - p, b - p))};
    for (double& x : w) x = std::max(x, 0.0);
    const double sum = w[0] + w[1] + w[2];
    if (!(sum > 0)) return {1.0 / 3, 1.0 / 3, 1.0 / 3};
    return {w[0] / sum, w[1] / sum, 1 - w[0] / sum - w[1] / sum};
}

class Assembly {
  public:
    Assembly(const Mesh& mesh, const Arrangement& arrangement, const TriangleFaces& triangles,
             const SnapTolerance& rounding)
        : mesh_(mesh), arrangement_(arrangement), triangles_(triangles), tolerance_(rounding.tolerance),
          single_(rounding.single), plain_(is_plain(mesh)),
          of_node_(arrangement.node_count() - mesh.vertex_count(), none) {}

    UnitedMesh run(const std::vector<Index>& kept, const std::vector<OuterPiece>& pieces) {
        std::vector<std::uint8_t> seen(mesh_.vertex_count(), 0);
        for (const OuterPiece& p : pieces)
            for (const Index node : p.nodes)
                if (node < seen.size() && !std::exchange(seen[node], 1))
                    at_place_.emplace(cell(mesh_.positions[node]), node);
        for (const OuterPiece& p : pieces) add(p);
        number(kept);
        put_together(kept);
        UnitedMesh united;
        united.changes = inherit_attributes(result_, mesh_, provenance_);
        normalise_offsets(result_);
        normalise_wedges(result_);
        united.old_vertices = std::move(provenance_.vertices.copies);
        united.mesh = std::move(result_);
        return united;
    }

  private:
    /// Numbers the vertices and wedges to copy: the used ones, and the ones that were already unused.
    void number(const std::vector<Index>& kept) {
        enum : std::uint8_t { unused, used, lost };
        std::vector<std::uint8_t> vertices(mesh_.vertex_count(), unused),
            wedges(plain_ ? 0 : mesh_.wedge_count(), unused);
        const auto set = [](std::uint8_t& mark, std::uint8_t as) {
            std::atomic_ref(mark).store(as, std::memory_order_relaxed);
        };
        const auto mark = [&](Index wedge, std::uint8_t as) {
            if (!plain_) set(wedges[wedge], as);
            set(vertices[plain_ ? wedge : mesh_.vertex_of_wedge(wedge)], as);
        };
        parallel_for(mesh_.corners.size(), [&](std::size_t c) { mark(mesh_.corners[c], lost); });
        parallel_for(kept.size(), [&](std::size_t i) {
            for (const Index w : mesh_.face_wedges(kept[i])) mark(w, used);
        });
        for (const Index w : fresh_corners_) { // a new wedge may have an old vertex
            if (w < wedge_count()) mark(w, used);
            if (const Index v = vertex_of(w); v < mesh_.vertex_count()) vertices[v] = used;
        }
        const auto copy = [](const std::vector<std::uint8_t>& marks, std::vector<Index>& copies,
                             std::vector<Index>& numbers) {
            copies = indices_where(marks.size(), [&](Index i) { return marks[i] != lost; });
            numbers.assign(marks.size(), none);
            parallel_for(copies.size(), [&](std::size_t i) { numbers[copies[i]] = static_cast<Index>(i); });
        };
        copy(vertices, provenance_.vertices.copies, vertex_numbers_);
        copy(wedges, provenance_.wedges.copies, wedge_numbers_);
    }

    void put_together(const std::vector<Index>& kept) {
        const auto renumbered = [](Index i, const std::vector<Index>& numbers, std::size_t copies) {
            return i < numbers.size() ? numbers[i] : static_cast<Index>(i - numbers.size() + copies);
        };
        const auto vertex = [&](Index v) {
            return renumbered(v, vertex_numbers_, provenance_.vertices.copies.size());
        };
        const auto wedge = [&](Index w) {
            return plain_ ? vertex(w) : renumbered(w, wedge_numbers_, provenance_.wedges.copies.size());
        };
        const std::size_t faces = kept.size() + fresh_corners_.size() / 3;
        const auto& copies = provenance_.vertices.copies;
        result_.positions.resize(copies.size() + fresh_positions_.size());
        parallel_for(copies.size(),
                     [&](std::size_t i) { result_.positions[i] = mesh_.positions[copies[i]]; });
        std::copy(fresh_positions_.begin(), fresh_positions_.end(),
                  result_.positions.begin() + static_cast<std::ptrdiff_t>(copies.size()));
        if (!plain_) {
            for (const Index w : provenance_.wedges.copies)
                result_.wedge_vertex.push_back(vertex(mesh_.vertex_of_wedge(w)));
            for (const Index v : fresh_wedge_vertex_) result_.wedge_vertex.push_back(vertex(v));
        }
        std::vector<Index> begin; // [kept faces] first corner
        std::size_t corners = 3 * kept.size();
        if (!mesh_.all_triangles()) {
            for (const Index f : kept) begin.push_back(mesh_.face_size(f));
            corners = exclusive_scan(begin);
            result_.face_offsets = begin;
            for (std::size_t i = kept.size(); i <= faces; ++i)
                result_.face_offsets.push_back(static_cast<Index>(corners + 3 * (i - kept.size())));
        }
        result_.corners.resize(corners + fresh_corners_.size());
        parallel_for(kept.size(), [&](std::size_t i) {
            std::size_t at = begin.empty() ? 3 * i : begin[i];
            for (const Index w : mesh_.face_wedges(kept[i])) result_.corners[at++] = wedge(w);
        });
        parallel_for(fresh_corners_.size(),
                     [&](std::size_t i) { result_.corners[corners + i] = wedge(fresh_corners_[i]); });
        provenance_.faces.insert(provenance_.faces.begin(), kept.begin(), kept.end());
        provenance_.wedges_as_vertices = plain_;
    }

    Index wedge_count() const {
        return static_cast<Index>(plain_ ? mesh_.vertex_count() : mesh_.wedge_count());
    }
    Index vertex_of(Index wedge) const {
        if (plain_) return wedge;
        return wedge < wedge_count() ? mesh_.vertex_of_wedge(wedge)
                                     : fresh_wedge_vertex_[wedge - wedge_count()];
    }
    const Vec3& position(Index v) const {
        return v < mesh_.vertex_count() ? mesh_.positions[v] : fresh_positions_[v - mesh_.vertex_count()];
    }

    struct HashOfPlace {
        std::size_t operator()(const Vec3& p) const { return place_hash(p); }
    };
    Vec3 cell(const Vec3& p, const Vec3& beside = {}) const {
        const auto place = [&](double x, double d) {
            return tolerance_ > 0 ? std::floor(x / tolerance_) + d : x;
        };
        return {place(p.x, beside.x), place(p.y, beside.y), place(p.z, beside.z)};
    }

    /// The lowest vertex at the position or within tolerance.
    Index vertex_near(const Vec3& p) const {
        Index lowest = none;
        const int reach = tolerance_ > 0 ? 1 : 0;
        for (int i = -reach; i <= reach; ++i)
            for (int j = -reach; j <= reach; ++j)
                for (int k = -reach; k <= reach; ++k) {
                    const auto [begin, end] =
                        at_place_.equal_range(cell(p, {double(i), double(j), double(k)}));
                    for (auto at = begin; at != end; ++at)
                        if (length(position(at->second) - p) <= tolerance_)
                            lowest = std::min(lowest, at->second);
                }
        return lowest;
    }

    static bool is_plain(const Mesh& mesh) {
        return !mesh.has_seams() &&
               std::none_of(mesh.attributes.begin(), mesh.attributes.end(),
                            [](const Attribute& a) { return a.domain == Domain::wedge; });
    }

    void add(const OuterPiece& p) {
        std::array<Index, 3> wedges{}, vertices{};
        for (std::size_t i = 0; i < 3; ++i) vertices[i] = vertex_of_node(p.nodes[i], p.triangles[i]);
        if (vertices[0] == vertices[1] || vertices[1] == vertices[2] || vertices[2] == vertices[0]) return;
        for (std::size_t i = 0; i < 3; ++i) wedges[i] = wedge_of(p.nodes[i], vertices[i], p.triangles[i]);
        fresh_corners_.insert(fresh_corners_.end(), wedges.begin(), wedges.end());
        provenance_.faces.push_back(triangles_.face[p.triangles[0]]);
    }

    Index vertex_of_node(Index node, Index triangle) {
        if (node < mesh_.vertex_count()) return node;
        const Vec3 exact = arrangement_.position(node);
        const Vec3 place = single_ && is_finite(as_float32(exact)) ? as_float32(exact) : exact;
        Index& known = of_node_[node - mesh_.vertex_count()];
        if (known != none) return known;
        known = vertex_near(place);
        if (known != none) return known;
        known = static_cast<Index>(mesh_.vertex_count() + fresh_positions_.size());
        at_place_.emplace(cell(place), known);
        fresh_positions_.push_back(place);
        Mix m = mix_of(node, triangle);
        for (std::size_t i = 0; i < m.size; ++i) m.corners[i] = mesh_.vertex(m.corners[i]);
        push(provenance_.vertices, m);
        return known;
    }

    Index wedge_of(Index node, Index vertex, Index triangle) {
        if (plain_) return vertex;
        for (const Index c : triangles_.corners[triangle])
            if (mesh_.vertex(c) == node) return mesh_.corners[c];
        Mix m = mix_of(node, triangle);
        for (std::size_t i = 0; i < m.size; ++i) m.corners[i] = mesh_.corners[m.corners[i]];
        if (m.size == 2 && m.corners[0] > m.corners[1]) {
            std::swap(m.corners[0], m.corners[1]);
            std::swap(m.weights[0], m.weights[1]);
        }
        const auto made = m.size == 2 ? std::tuple{vertex, m.corners[0], m.corners[1], none}
                                      : std::tuple{vertex, none, none, triangle};
        const auto [at, fresh] =
            made_.try_emplace(made, wedge_count() + static_cast<Index>(fresh_wedge_vertex_.size()));
        if (fresh) {
            fresh_wedge_vertex_.push_back(vertex);
            push(provenance_.wedges, m);
        }
        return at->second;
    }

    /// Corners and weights. On a side, the lower corner's vertex comes first, so that both faces get the same
    /// weights.
    Mix mix_of(Index node, Index triangle) const {
        const auto& c = triangles_.corners[triangle];
        const Vec3 p = arrangement_.position(node);
        if (const auto side = arrangement_.side_of(triangle, node)) {
            const auto& ends = sides[static_cast<std::size_t>(*side)];
            Index a = c[static_cast<std::size_t>(ends[0])], b = c[static_cast<std::size_t>(ends[1])];
            if (mesh_.vertex(a) > mesh_.vertex(b)) std::swap(a, b);
            const double t = along(p, mesh_.point(a), mesh_.point(b));
            return {{a, b, none}, {1 - t, t, 0}, 2};
        }
        return {c, barycentric(p, mesh_.point(c[0]), mesh_.point(c[1]), mesh_.point(c[2])), 3};
    }

    static void push(Provenance& element_provenance, const Mix& m) {
        element_provenance.mix_sources.insert(element_provenance.mix_sources.end(), m.corners.begin(),
                                              m.corners.begin() + static_cast<std::ptrdiff_t>(m.size));
        element_provenance.mix_weights.insert(element_provenance.mix_weights.end(), m.weights.begin(),
                                              m.weights.begin() + static_cast<std::ptrdiff_t>(m.size));
        element_provenance.mix_offsets.push_back(static_cast<Index>(element_provenance.mix_sources.size()));
    }

    const Mesh& mesh_;
    const Arrangement& arrangement_;
    const TriangleFaces& triangles_;
    double tolerance_;
    bool single_;
    bool plain_; ///< wedges and vertices are the same
    // Corners of the pieces; numbers beyond the mesh's own refer to new elements.
    std::vector<Index> fresh_corners_, fresh_wedge_vertex_;
    std::vector<Vec3> fresh_positions_;
    std::vector<Index> vertex_numbers_, wedge_numbers_; ///< [old elements] number in the result, or none
    Mesh result_;
    MeshProvenance provenance_;
    std::unordered_multimap<Vec3, Index, HashOfPlace> at_place_;   ///< vertices that pieces use, by cell
    std::vector<Index> of_node_;                                   ///< [new nodes] vertices, or none
    std::map<std::tuple<Index, Index, Index, Index>, Index> made_; ///< wedges by source
};

} // namespace

UnitedMesh united_mesh(const Mesh& mesh, const std::vector<Index>& uncut,
                       const std::vector<OuterPiece>& pieces, const Arrangement& arrangement,
                       const TriangleFaces& triangles, const SnapTolerance& rounding) {
    return Assembly(mesh, arrangement, triangles, rounding).run(uncut, pieces);
}

} // namespace facetmill::clean_steps
