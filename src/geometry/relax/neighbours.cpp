#include "geometry/relax/relax.hpp"

#include "base/error.hpp"
#include "base/math/portable_math.hpp"
#include "base/sort_unique.hpp"
#include "mesh/buckets.hpp"
#include "mesh/face.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// The other ends of the feature edges at each vertex, ascending. An edge is a feature if the normals of its
/// two faces differ by more than the angle (radians, in world space). The faces' directions are compared
/// along the edge, so neighbours with opposite orientation make no feature edge. An edge with more than two
/// faces is a feature; with `boundaries`, an edge with a single face too. Faces without area make no
/// features.
VertexLists feature_ends(const Mesh& mesh, double angle, const Transform& to_world, bool boundaries) {
    const EdgeTable table = build_edges(mesh);
    const std::vector<Index> faces = corner_faces(mesh);
    const double limit = cosine(angle);
    std::vector<std::uint8_t> is_feature(table.size());
    parallel_for(table.size(), [&](std::size_t e) {
        const auto at = table.corners_of(static_cast<Index>(e));
        if (at.size() != 2) {
            is_feature[e] = boundaries || at.size() > 2;
            return;
        }
        const Vec3 a = normalised(area_vector(mesh, faces[at[0]], to_world)),
                   b = normalised(area_vector(mesh, faces[at[1]], to_world));
        const bool agree = mesh.vertex(at[0]) != mesh.vertex(at[1]);
        if (a == Vec3{} || b == Vec3{}) return;
        is_feature[e] = exceeds_feature_angle(agree ? dot(a, b) : -dot(a, b), limit);
    });
    VertexLists lists;
    lists.offsets.assign(mesh.vertex_count() + 1, 0);
    for (std::size_t e = 0; e < is_feature.size(); ++e)
        if (is_feature[e]) {
            ++lists.offsets[table.edges[e].low];
            ++lists.offsets[table.edges[e].high];
        }
    lists.items.resize(exclusive_scan(lists.offsets));
    std::vector<Index> at(lists.offsets.begin(), lists.offsets.end());
    for (std::size_t e = 0; e < is_feature.size(); ++e) {
        if (!is_feature[e]) continue;
        const auto& [low, high] = table.edges[e];
        lists.items[at[low]++] = high;
        lists.items[at[high]++] = low;
    }
    parallel_for(mesh.vertex_count(), [&](std::size_t v) {
        std::sort(lists.items.begin() + lists.offsets[v], lists.items.begin() + lists.offsets[v + 1]);
    });
    return lists;
}

using Settings = RelaxSettings;

/// A corner, seen from its vertex.
struct Corner {
    Index vertex, next, previous, face;
};

void sort_few(std::vector<Index>& items) {
    if (items.size() > 24) return std::sort(items.begin(), items.end());
    for (std::size_t i = 1; i < items.size(); ++i) {
        const Index item = items[i];
        std::size_t j = i;
        for (; j > 0 && item < items[j - 1]; --j) items[j] = items[j - 1];
        items[j] = item;
    }
}

/// Whether both lists have the same items, each once, in any order. Compares all pairs: for the few
/// neighbours of a vertex, this is faster than sorting, because branches are predictable.
bool same_once(const std::vector<Index>& a, const std::vector<Index>& b) {
    const std::size_t n = a.size();
    if (b.size() != n || n > 24) return false;
    std::size_t matches = 0, repeated = 0;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            matches += a[i] == b[j];
            repeated += static_cast<std::size_t>(a[i] == a[j]) + (b[i] == b[j]);
        }
    return matches == n && repeated == 2 * n;
}

/// A thread's buffers for the surroundings of a vertex. They are reused, so that no memory is allocated per
/// vertex.
struct Surroundings {
    std::vector<Index> next, previous; ///< the other ends of the two edges of each corner
    std::vector<Index> all;            ///< the neighbours, each once
    std::vector<Index> boundary;       ///< other ends of the boundary edges, ascending

    void look(const Mesh& mesh, std::span<const Corner> corners, bool whole_faces) {
        next.clear();
        previous.clear();
        all.clear();
        boundary.clear();
        bool polygons = false;
        for (const Corner& c : corners) {
            if (c.next != c.vertex) next.push_back(c.next);
            if (c.previous != c.vertex) previous.push_back(c.previous);
            polygons = polygons || (whole_faces && mesh.face_size(c.face) > 3);
        }
        // If faces go round the vertex, each neighbour occurs once in `next` and once in `previous`.
        if (same_once(next, previous))
            all = next;
        else
            walk();
        if (polygons) add_whole_faces(mesh, corners);
    }

  private:
    /// Builds the union of next and previous. A neighbour that occurs only once in both is at the end of a
    /// boundary edge.
    void walk() {
        sort_few(next);
        sort_few(previous);
        std::size_t i = 0, j = 0;
        while (i < next.size() || j < previous.size()) {
            const Index v =
                std::min(i < next.size() ? next[i] : none, j < previous.size() ? previous[j] : none);
            std::size_t count = 0;
            for (; i < next.size() && next[i] == v; ++i) ++count;
            for (; j < previous.size() && previous[j] == v; ++j) ++count;
            all.push_back(v);
            if (count == 1) boundary.push_back(v);
        }
    }
    void add_whole_faces(const Mesh& mesh, std::span<const Corner> corners) {
        for (const Corner& c : corners)
            for (Index other = mesh.face_begin(c.face); other < mesh.face_end(c.face); ++other)
                if (mesh.vertex(other) != c.vertex) all.push_back(mesh.vertex(other));
        sort_unique(all);
    }
};

/// Calls visit(vertex, surroundings) for every vertex of a chunk that some face uses. Chunks are buckets of
/// vertices, so that their data is in the cache.
template <class Visit>
void around_vertices(const Mesh& mesh, bool whole_faces, Buckets<Corner>& buckets, Visit&& visit) {
    buckets = fill_buckets<Corner>(mesh, [&](Index f, auto&& emit) {
        const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
        for (Index c = begin; c < end; ++c) {
            const Index v = mesh.vertex(c);
            emit(v, Corner{v, mesh.vertex(next_corner(c, begin, end)),
                           mesh.vertex(previous_corner(c, begin, end)), f});
        }
    });
    struct Room {
        std::vector<Index> ends;
        std::vector<Corner> sorted;
        Surroundings around;
    };
    const auto visit_bucket = [&](std::size_t b, Room& room) {
        auto& [ends, sorted, around] = room;
        const std::size_t first = buckets.first_vertex(b),
                          last = std::min(mesh.vertex_count(), buckets.first_vertex(b + 1));
        ends.assign(last - first + 1, 0);
        for (const Corner& c : buckets.of(b)) ++ends[c.vertex - first];
        exclusive_scan(ends);
        sorted.resize(buckets.of(b).size());
        for (const Corner& c : buckets.of(b)) sorted[ends[c.vertex - first]++] = c;
        for (std::size_t v = first, begin = 0; v < last; begin = ends[v - first], ++v) {
            around.look(mesh, {sorted.data() + begin, sorted.data() + ends[v - first]}, whole_faces);
            visit(b, static_cast<Index>(v), around);
        }
    };
    parallel_chunks(
        buckets.count(),
        [&](std::size_t begin, std::size_t end) {
            Room room;
            for (std::size_t b = begin; b < end; ++b) visit_bucket(b, room);
        },
        buckets.at_once());
}

/// In a polygon with n corners, every vertex has n - 1 neighbours. Refuses such polygons in advance if the
/// lists would not fit.
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

/// Chooses the neighbours that a vertex moves towards.
class NeighbourChoice {
  public:
    NeighbourChoice(const Mesh& mesh, const Settings& settings) : mesh_(mesh), settings_(settings) {
        if (!settings.feature_angle) return;
        straight_ = cosine(*settings.feature_angle);
        tracks_ = feature_ends(mesh, *settings.feature_angle, settings.to_world,
                               settings.boundary == Settings::Boundary::slide);
    }

    struct Chosen {
        std::span<const Index> list{};
        bool held = false, along = false;
    };
    Chosen operator()(Index v, const Surroundings& around) const {
        if (!settings_.mask.empty() && settings_.mask[v] == 0) return {.held = true};
        const bool boundary = !around.boundary.empty();
        if (boundary && settings_.boundary == Settings::Boundary::fixed) return {.held = true};
        if (settings_.feature_angle && !tracks_.of(v).empty()) {
            if (tracks_.of(v).size() != 2 || turns(v)) return {.held = true};
            return {.list = tracks_.of(v), .along = true};
        }
        if (boundary && settings_.boundary == Settings::Boundary::slide)
            return {.list = around.boundary, .along = true};
        return {.list = around.all};
    }

  private:
    /// Whether the line of features has a corner at the vertex: it turns by more than the feature angle.
    bool turns(Index v) const {
        const auto& p = mesh_.positions;
        const Vec3 in = settings_.to_world.vector(p[v] - p[tracks_.of(v)[0]]),
                   out = settings_.to_world.vector(p[tracks_.of(v)[1]] - p[v]);
        return dot(in, out) < straight_ * std::sqrt(dot(in, in) * dot(out, out));
    }

    const Mesh& mesh_;
    const Settings& settings_;
    double straight_ = -2;
    VertexLists tracks_;
};

} // namespace

Neighbourhoods neighbourhoods(const Mesh& mesh, const Settings& settings) {
    refuse_giants(mesh, settings);
    const std::size_t n = mesh.vertex_count();
    const NeighbourChoice choose(mesh, settings);
    Neighbourhoods result;
    auto& offsets = result.lists.offsets;
    offsets.assign(n + 1, 0);
    if (settings.feature_angle || settings.boundary == Settings::Boundary::slide) result.along.resize(n);
    struct Part {
        std::vector<Index> items;
        std::size_t held = 0;
    };
    Buckets<Corner> buckets;
    std::vector<Part> parts(number_of_buckets(n));
    around_vertices(mesh, settings.neighbours == Settings::Neighbours::faces, buckets,
                    [&](std::size_t b, Index v, const Surroundings& around) {
                        Part& part = parts[b];
                        if (part.items.capacity() == 0) part.items.reserve(buckets.of(b).size() + 64);
                        const auto chosen = choose(v, around);
                        part.held += chosen.held;
                        if (chosen.along) result.along[v] = 1;
                        offsets[v] = static_cast<Index>(chosen.list.size());
                        part.items.insert(part.items.end(), chosen.list.begin(), chosen.list.end());
                    });
    result.lists.items.resize(exclusive_scan(offsets));
    parallel_for(
        buckets.count(),
        [&](std::size_t b) {
            std::copy(parts[b].items.begin(), parts[b].items.end(),
                      result.lists.items.begin() + offsets[buckets.first_vertex(b)]);
            parts[b].items = {};
        },
        1);
    for (const auto& part : parts) result.held += part.held;
    return result;
}

std::vector<std::uint8_t> boundary_vertices(const Mesh& mesh) {
    std::vector<std::uint8_t> boundary(mesh.vertex_count());
    Buckets<Corner> buckets;
    around_vertices(mesh, false, buckets, [&](std::size_t, Index v, const Surroundings& around) {
        boundary[v] = !around.boundary.empty();
    });
    return boundary;
}

} // namespace facetmill
