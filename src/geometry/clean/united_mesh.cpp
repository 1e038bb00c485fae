#include "geometry/clean/united_mesh.hpp"

#include "base/numbers.hpp"
#include "geometry/edit/surgery.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace facetmill::clean_steps {

namespace {

constexpr std::array sides{std::array{0, 1}, std::array{1, 2}, std::array{2, 0}};

/// How a point is mixed from the corners of a triangle.
struct Mix {
    std::array<Index, 3> corners;
    std::array<double, 3> weights;
    std::size_t size;
};

/// p between a and b, from 0 to 1.
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
             const Rounding& rounding)
        : mesh_(mesh), arrangement_(arrangement), triangles_(triangles), tolerance_(rounding.tolerance),
          single_(rounding.single), plain_(is_plain(mesh)) {
        result_.positions = mesh.positions;
        result_.face_offsets = mesh.face_offsets;
        result_.corners = mesh.corners;
        if (!plain_) {
            result_.wedge_vertex = mesh.wedge_vertex;
            if (!mesh.has_seams()) {
                result_.wedge_vertex.resize(mesh.wedge_count());
                std::iota(result_.wedge_vertex.begin(), result_.wedge_vertex.end(), Index{0});
            }
        }
        descent_.vertices.identity = descent_.wedges.identity = true;
        descent_.faces.resize(mesh.face_count());
        std::iota(descent_.faces.begin(), descent_.faces.end(), Index{0});
    }

    Mesh run(std::vector<Index> kept, const std::vector<OuterPiece>& pieces, AttributeChanges& changes) {
        std::vector<std::uint8_t> seen(mesh_.vertex_count(), 0);
        for (const OuterPiece& p : pieces)
            for (const Index node : p.nodes)
                if (node < seen.size() && !std::exchange(seen[node], 1))
                    at_place_[cell(mesh_.positions[node])].push_back(node);
        for (const OuterPiece& p : pieces) add(p);
        for (Index f = static_cast<Index>(mesh_.face_count()); f < result_.face_count(); ++f)
            kept.push_back(f);
        if (plain_) descent_.wedges = descent_.vertices;
        changes = inherit_attributes(result_, mesh_, descent_);
        return keep_faces(result_, kept);
    }

  private:
    using Place = std::tuple<double, double, double>;
    Place cell(const Vec3& p, const Vec3& beside = {}) const {
        const auto place = [&](double x, double d) {
            return tolerance_ > 0 ? std::floor(x / tolerance_) + d : x;
        };
        return {place(p.x, beside.x), place(p.y, beside.y), place(p.z, beside.z)};
    }

    /// The lowest vertex at the place or near it.
    Index vertex_near(const Vec3& p) const {
        Index lowest = none;
        const int reach = tolerance_ > 0 ? 1 : 0;
        for (int i = -reach; i <= reach; ++i)
            for (int j = -reach; j <= reach; ++j)
                for (int k = -reach; k <= reach; ++k) {
                    const auto at = at_place_.find(cell(p, {double(i), double(j), double(k)}));
                    if (at == at_place_.end()) continue;
                    for (const Index v : at->second)
                        if (length(result_.positions[v] - p) <= tolerance_) lowest = std::min(lowest, v);
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
        for (std::size_t i = 0; i < 3; ++i) vertices[i] = vertex_of(p.nodes[i], p.triangle);
        if (vertices[0] == vertices[1] || vertices[1] == vertices[2] || vertices[2] == vertices[0]) return;
        for (std::size_t i = 0; i < 3; ++i) wedges[i] = wedge_of(p.nodes[i], vertices[i], p.triangle);
        add_face(result_, wedges);
        descent_.faces.push_back(triangles_.face[p.triangle]);
    }

    Index vertex_of(Index node, Index triangle) {
        if (node < mesh_.vertex_count()) return node;
        const Vec3 exact = arrangement_.position(node);
        const Vec3 place = single_ && is_finite(as_float32(exact)) ? as_float32(exact) : exact;
        const auto [known, unknown] = of_node_.try_emplace(node, none);
        if (!unknown) return known->second;
        known->second = vertex_near(place);
        if (known->second != none) return known->second;
        known->second = static_cast<Index>(result_.positions.size());
        at_place_[cell(place)].push_back(known->second);
        result_.positions.push_back(place);
        Mix m = mix_of(node, triangle);
        for (std::size_t i = 0; i < m.size; ++i) m.corners[i] = mesh_.vertex(m.corners[i]);
        push(descent_.vertices, m);
        return known->second;
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
        const auto [at, fresh] = made_.try_emplace(made, static_cast<Index>(result_.wedge_vertex.size()));
        if (fresh) {
            result_.wedge_vertex.push_back(vertex);
            push(descent_.wedges, m);
        }
        return at->second;
    }

    /// Corners and weights. On a side the lower corner's vertex comes first, for the same weights from both
    /// faces.
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

    static void push(Lineage& lineage, const Mix& m) {
        lineage.mix_sources.insert(lineage.mix_sources.end(), m.corners.begin(),
                                   m.corners.begin() + static_cast<std::ptrdiff_t>(m.size));
        lineage.mix_weights.insert(lineage.mix_weights.end(), m.weights.begin(),
                                   m.weights.begin() + static_cast<std::ptrdiff_t>(m.size));
        lineage.mix_offsets.push_back(static_cast<Index>(lineage.mix_sources.size()));
    }

    const Mesh& mesh_;
    const Arrangement& arrangement_;
    const TriangleFaces& triangles_;
    double tolerance_;
    bool single_;
    bool plain_; ///< a vertex is all there is to a wedge
    Mesh result_;
    Descent descent_;
    std::map<Place, std::vector<Index>> at_place_;                 ///< vertices that pieces use, by cell
    std::unordered_map<Index, Index> of_node_;                     ///< vertices of new nodes
    std::map<std::tuple<Index, Index, Index, Index>, Index> made_; ///< wedges
};

} // namespace

Mesh united_mesh(const Mesh& mesh, const std::vector<Index>& uncut, const std::vector<OuterPiece>& pieces,
                 const Arrangement& arrangement, const TriangleFaces& triangles, const Rounding& rounding,
                 AttributeChanges& changes) {
    return Assembly(mesh, arrangement, triangles, rounding).run(uncut, pieces, changes);
}

} // namespace facetmill::clean_steps
