#include "geometry/neighbours.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"

#include <algorithm>

namespace facetmill {

namespace {

using Settings = RelaxSettings;

/// What one thread needs to look around a vertex; reused, so that nothing is allocated per vertex.
struct Surroundings {
    std::vector<Index> along;    ///< other ends of the edges at the vertex, once per face, ascending
    std::vector<Index> all;      ///< vertices of all its faces, ascending, each once
    std::vector<Index> boundary; ///< other ends of its boundary edges, ascending

    void look(const Mesh& mesh, const VertexLists& at, const std::vector<Index>& faces, Index v,
              bool whole_faces) {
        along.clear(), all.clear(), boundary.clear();
        for (const Index c : at.of(v)) {
            const Index f = faces.empty() ? c / 3 : faces[c];
            const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
            const Index next = mesh.vertex(c + 1 == end ? begin : c + 1);
            const Index previous = mesh.vertex(c == begin ? end - 1 : c - 1);
            if (next != v) along.push_back(next);
            if (previous != v) along.push_back(previous);
            if (whole_faces && end - begin > 3)
                for (Index other = begin; other < end; ++other)
                    if (mesh.vertex(other) != v) all.push_back(mesh.vertex(other));
        }
        std::sort(along.begin(), along.end());
        const bool polygons = !all.empty();
        all.insert(all.end(), along.begin(), along.end());
        if (polygons) std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        for (std::size_t i = 0, j = 0; i < along.size(); i = j) {
            while (j < along.size() && along[j] == along[i]) ++j;
            if (j - i == 1) boundary.push_back(along[i]);
        }
    }

    /// The neighbours that v moves towards.
    const std::vector<Index>& chosen(Settings::Boundary kind) {
        if (boundary.empty() || kind == Settings::Boundary::free) return all;
        if (kind == Settings::Boundary::fixed) all.clear();
        return kind == Settings::Boundary::fixed ? all : boundary;
    }
};

/// In a polygon of n corners every vertex has n - 1 neighbours: refuses what would not fit before it starts.
void refuse_giants(const Mesh& mesh, const Settings& settings) {
    if (mesh.all_triangles() || settings.neighbours == Settings::Neighbours::edges) return;
    const auto pairs = parallel_reduce(
        mesh.face_count(), std::uint64_t{0},
        [&](std::size_t begin, std::size_t end) {
            std::uint64_t sum = 0;
            for (std::size_t f = begin; f < end; ++f) {
                const std::uint64_t size = mesh.face_size(static_cast<Index>(f));
                sum += size * size;
            }
            return sum;
        },
        [](std::uint64_t a, std::uint64_t b) { return a + b; });
    if (pairs >= none)
        throw Error(ErrorKind::limit, "E-LIMIT",
                    "relax: the polygons are so large that their vertices have " + std::to_string(pairs) +
                        " neighbours, more than " + std::to_string(none - 1),
                    "use neighbours: edges, or triangulate first");
}

/// Lists of each chunk of vertices, before they are put behind one another.
struct ChunkLists {
    std::vector<Index> items;
    std::size_t held = 0;
};

} // namespace

Neighbourhoods neighbourhoods(const Mesh& mesh, const Settings& settings) {
    refuse_giants(mesh, settings);
    const std::size_t n = mesh.vertex_count(), chunks = (n + default_chunk - 1) / default_chunk;
    const VertexLists at = corners_at_vertices(mesh);
    const std::vector<Index> faces = mesh.all_triangles() ? std::vector<Index>{} : corner_faces(mesh);
    Neighbourhoods result;
    auto& offsets = result.lists.offsets;
    offsets.assign(n + 1, 0);
    std::vector<ChunkLists> parts(chunks);
    parallel_chunks(n, [&](std::size_t begin, std::size_t end) {
        Surroundings around;
        ChunkLists& part = parts[begin / default_chunk];
        part.items.reserve(8 * (end - begin));
        for (std::size_t v = begin; v < end; ++v) {
            around.look(mesh, at, faces, static_cast<Index>(v),
                        settings.neighbours == Settings::Neighbours::faces);
            const auto& list = around.chosen(settings.boundary);
            part.held += !around.boundary.empty() && settings.boundary == Settings::Boundary::fixed;
            offsets[v] = static_cast<Index>(list.size());
            part.items.insert(part.items.end(), list.begin(), list.end());
        }
    });
    result.lists.items.resize(exclusive_scan(offsets));
    parallel_for(
        chunks,
        [&](std::size_t c) {
            std::copy(parts[c].items.begin(), parts[c].items.end(),
                      result.lists.items.begin() + offsets[c * default_chunk]);
            parts[c].items = {};
        },
        1);
    for (const auto& part : parts) result.held += part.held;
    return result;
}

std::vector<std::uint8_t> boundary_vertices(const Mesh& mesh) {
    const VertexLists at = corners_at_vertices(mesh);
    const std::vector<Index> faces = mesh.all_triangles() ? std::vector<Index>{} : corner_faces(mesh);
    std::vector<std::uint8_t> boundary(mesh.vertex_count());
    parallel_chunks(boundary.size(), [&](std::size_t begin, std::size_t end) {
        Surroundings around;
        for (std::size_t v = begin; v < end; ++v) {
            around.look(mesh, at, faces, static_cast<Index>(v), false);
            boundary[v] = !around.boundary.empty();
        }
    });
    return boundary;
}

} // namespace facetmill
