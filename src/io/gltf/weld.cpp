#include "io/gltf/mesh.hpp"

#include "base/parallel.hpp"

#include <cstring>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

/// Compares wedges by the bits of all their attributes, then by index.
class WedgeOrder {
  public:
    explicit WedgeOrder(const Mesh& mesh) {
        for (const auto& a : mesh.attributes)
            if (a.domain == Domain::wedge)
                std::visit(
                    [&](const auto& v) {
                        columns_.push_back({reinterpret_cast<const std::byte*>(v.data()),
                                            static_cast<std::size_t>(a.components) * sizeof(v[0])});
                    },
                    a.data);
    }
    int compare(Index a, Index b) const {
        for (const auto& c : columns_)
            if (const int order = std::memcmp(c.data + a * c.width, c.data + b * c.width, c.width))
                return order;
        return 0;
    }
    bool operator()(Index a, Index b) const {
        const int order = compare(a, b);
        return order != 0 ? order < 0 : a < b;
    }

  private:
    struct Column {
        const std::byte* data;
        std::size_t width;
    };
    std::vector<Column> columns_;
};

/// The wedges of each vertex, ascending.
struct Groups {
    std::vector<Index> offsets, wedges;
};
Groups wedges_of_vertices(const Mesh& mesh) {
    Groups g;
    g.offsets.assign(mesh.vertex_count() + 1, 0);
    for (const Index v : mesh.wedge_vertex) ++g.offsets[v];
    exclusive_scan(g.offsets);
    g.wedges.resize(mesh.wedge_count());
    auto next = g.offsets;
    for (Index w = 0; w < mesh.wedge_count(); ++w) g.wedges[next[mesh.wedge_vertex[w]]++] = w;
    return g;
}

/// Keeps the wedges that stand for themselves, in order; attributes follow.
void keep_representatives(Mesh& mesh, const std::vector<Index>& representative) {
    std::vector<Index> kept, number(representative.size());
    for (Index w = 0; w < representative.size(); ++w)
        if (representative[w] == w) number[w] = static_cast<Index>(kept.size()), kept.push_back(w);
    if (kept.size() == representative.size()) return;
    parallel_for(mesh.corners.size(),
                 [&](std::size_t c) { mesh.corners[c] = number[representative[mesh.corners[c]]]; });
    for (auto& a : mesh.attributes)
        if (a.domain == Domain::wedge) a.select(kept);
    std::vector<Index> vertices(kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) vertices[i] = mesh.wedge_vertex[kept[i]];
    mesh.wedge_vertex = std::move(vertices);
}

/// When wedge w is vertex w everywhere, the map is not stored.
void drop_identity(Mesh& mesh) {
    if (mesh.wedge_vertex.size() != mesh.positions.size()) return;
    for (Index w = 0; w < mesh.wedge_vertex.size(); ++w)
        if (mesh.wedge_vertex[w] != w) return;
    mesh.wedge_vertex.clear();
}

/// Corner c of the mesh is at the returned vertex, a wedge's number; empty when the extension does not say.
std::vector<Index> told_vertices(Source& source, const Place& extension, const Mesh& mesh) {
    const Place primitive = extension.at("manifoldPrimitive");
    std::vector<Index> vertices = decode_indices(source, primitive.at("indices"), mesh.positions.size());
    if (vertices.size() != mesh.corners.size()) return {};
    return vertices;
}

} // namespace

void merge_equal_wedges(Mesh& mesh) {
    if (mesh.wedge_vertex.empty()) return;
    const Groups groups = wedges_of_vertices(mesh);
    const WedgeOrder order(mesh);
    std::vector<Index> representative(mesh.wedge_count());
    parallel_chunks(mesh.vertex_count(), [&](std::size_t begin, std::size_t end) {
        std::vector<Index> sorted;
        for (std::size_t v = begin; v < end; ++v) {
            sorted.assign(groups.wedges.begin() + groups.offsets[v],
                          groups.wedges.begin() + groups.offsets[v + 1]);
            std::sort(sorted.begin(), sorted.end(), order);
            for (std::size_t i = 0; i < sorted.size(); ++i)
                representative[sorted[i]] = i > 0 && order.compare(sorted[i - 1], sorted[i]) == 0
                                                ? representative[sorted[i - 1]]
                                                : sorted[i];
        }
    });
    keep_representatives(mesh, representative);
    drop_identity(mesh);
}

bool merge_as_told(Source& source, const Place& mesh_place, Mesh& mesh, std::vector<Diagnostic>& warnings) {
    const auto extensions = mesh_place.find("extensions");
    const auto extension = extensions ? extensions->find("EXT_mesh_manifold") : std::nullopt;
    if (!extension) return false;
    const auto ignore = [&](const char* why) {
        warnings.push_back({Severity::warning,
                            "W-MANIFOLD",
                            extension->path() + ": " + why + ", so vertices are merged by position",
                            {},
                            ""});
        return false;
    };
    const std::vector<Index> vertices = told_vertices(source, *extension, mesh);
    if (vertices.empty()) return ignore("its indices are not as many as the primitives'");
    std::vector<Index> vertex_of(mesh.positions.size(), none);
    for (std::size_t c = 0; c < vertices.size(); ++c) {
        Index& v = vertex_of[mesh.corners[c]];
        if (v != none && v != vertices[c]) return ignore("it puts one vertex of a primitive at two places");
        v = vertices[c];
        if (!(mesh.positions[v] == mesh.positions[mesh.corners[c]]))
            return ignore("it merges different positions");
    }
    // Unused vertices stand for themselves; the others are numbered by first occurrence.
    std::vector<Index> number(mesh.positions.size(), none);
    std::vector<Vec3> positions;
    mesh.wedge_vertex.resize(vertex_of.size());
    for (Index w = 0; w < vertex_of.size(); ++w) {
        const Index v = vertex_of[w] == none ? w : vertex_of[w];
        if (number[v] == none)
            number[v] = static_cast<Index>(positions.size()), positions.push_back(mesh.positions[v]);
        mesh.wedge_vertex[w] = number[v];
    }
    mesh.positions = std::move(positions);
    drop_identity(mesh);
    return true;
}

} // namespace facetmill::io::gltf
