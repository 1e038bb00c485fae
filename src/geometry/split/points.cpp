#include "geometry/split/points.hpp"

#include "parallel/parallel.hpp"
#include "parallel/storage.hpp"

#include <algorithm>

namespace facetmill {

namespace {

std::vector<Index> next_corners(const Mesh& mesh) {
    std::vector<Index> next(mesh.corner_count());
    parallel_for(mesh.face_count(), [&](std::size_t f) {
        const Index begin = mesh.face_begin(static_cast<Index>(f)),
                    end = mesh.face_end(static_cast<Index>(f));
        for (Index c = begin; c + 1 < end; ++c) next[c] = c + 1;
        next[end - 1] = begin;
    });
    return next;
}

bool comes_before(const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

} // namespace

EdgePoints::EdgePoints(const Mesh& mesh, const EdgeTable& edges, int pieces,
                       const std::vector<std::uint8_t>& marks, std::vector<double> at)
    : mesh_(&mesh), table_(&edges), points_(pieces - 1), first_wedge_(static_cast<Index>(mesh.wedge_count())),
      at_(std::move(at)) {
    edge_count_ = edges.size();
    if (!marks.empty()) {
        ranks_.assign(edges.size(), none);
        Index count = 0;
        for (std::size_t e = 0; e < edges.size(); ++e)
            if (marks[e]) ranks_[e] = count++;
        edge_count_ = count;
    }
    bundle_count_ = edge_count_;
    if (mesh.has_seams()) number_bundles();
}

/// Numbers the distinct wedge pairs of every edge with points: by edge, then by first corner.
void EdgePoints::number_bundles() {
    next_ = next_corners(*mesh_);
    bundles_.assign(mesh_->corner_count(), none);
    std::vector<Index> counts(table_->size());
    // The pair of corner c, packed with the wedge at the edge's low vertex first.
    const auto pair_of = [&](Index c, Index low) {
        const std::uint64_t a = mesh_->corners[c], b = mesh_->corners[next_[c]];
        return mesh_->vertex(c) == low ? a << 32 | b : b << 32 | a;
    };
    parallel_chunks(table_->size(), [&](std::size_t begin, std::size_t end) {
        std::vector<std::pair<std::uint64_t, Index>> pairs;
        for (std::size_t e = begin; e < end; ++e) {
            if (rank(static_cast<Index>(e)) == none) continue;
            pairs.clear();
            for (const Index c : table_->corners_of(static_cast<Index>(e)))
                pairs.emplace_back(pair_of(c, table_->edges[e].low), c);
            std::sort(pairs.begin(), pairs.end());
            for (std::size_t i = 0; i < pairs.size(); ++i) {
                if (i == 0 || pairs[i].first != pairs[i - 1].first) ++counts[e];
                bundles_[pairs[i].second] = counts[e] - 1;
            }
        }
    });
    bundle_count_ = exclusive_scan(counts);
    bundle_corner_.assign(bundle_count_, none);
    parallel_for(table_->size(), [&](std::size_t e) {
        if (rank(static_cast<Index>(e)) == none) return;
        for (const Index c : table_->corners_of(static_cast<Index>(e))) {
            bundles_[c] += counts[e];
            bundle_corner_[bundles_[c]] = std::min(bundle_corner_[bundles_[c]], c);
        }
    });
}

void EdgePoints::describe(Provenance& vertices, Provenance& wedges) const {
    const auto n = static_cast<std::size_t>(points_);
    // Points are computed from the lexicographically smaller end. So unwelded copies of an edge, in this
    // mesh or another, get exactly the same points whatever their vertex numbers.
    const auto fill = [&](std::vector<Provenance::Edge>& out, std::size_t at, std::size_t e, Index low,
                          Index high) {
        const auto& [a, b] = table_->edges[e];
        const bool turn = at_.empty() && comes_before(mesh_->positions[b], mesh_->positions[a]);
        for (std::size_t i = 0; i < n; ++i) {
            const double share = static_cast<double>(turn ? n - i : i + 1) / static_cast<double>(n + 1);
            out[at + i] = {turn ? high : low, turn ? low : high, at_.empty() ? share : at_[e]};
        }
    };
    const std::size_t first = vertices.edges.size();
    resize_large(vertices.edges, first + vertex_points());
    parallel_for(table_->size(), [&](std::size_t e) {
        const Index r = rank(static_cast<Index>(e));
        if (r != none) fill(vertices.edges, first + r * n, e, table_->edges[e].low, table_->edges[e].high);
    });
    if (bundles_.empty()) return;
    const std::size_t first_wedge = wedges.edges.size();
    resize_large(wedges.edges, first_wedge + wedge_points());
    parallel_for(bundle_count_, [&](std::size_t b) {
        const Index c = bundle_corner_[b], e = table_->corner_edge[c];
        Index low = mesh_->corners[c], high = mesh_->corners[next_[c]];
        if (mesh_->vertex(c) != table_->edges[e].low) std::swap(low, high);
        fill(wedges.edges, first_wedge + b * n, e, low, high);
    });
}

void EdgePoints::append_wedge_vertices(std::vector<Index>& wedge_vertex) const {
    const auto n = static_cast<std::size_t>(points_);
    const std::size_t first = wedge_vertex.size();
    wedge_vertex.resize(first + wedge_points());
    parallel_for(bundle_count_, [&](std::size_t b) {
        const Index r = rank(table_->corner_edge[bundle_corner_[b]]);
        for (std::size_t i = 0; i < n; ++i)
            wedge_vertex[first + b * n + i] = static_cast<Index>(mesh_->vertex_count() + r * n + i);
    });
}

} // namespace facetmill
