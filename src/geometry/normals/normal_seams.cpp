#include "geometry/normals/normals.hpp"

#include "base/math/portable_math.hpp"
#include "geometry/edit/moved.hpp"
#include "geometry/normals/one_ring.hpp"
#include "mesh/face.hpp"
#include "mesh/provenance.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <cstring>

namespace facetmill {

namespace {

constexpr double bent = 0.99985;        // cosine of 1 degree: straighter edges give no evidence
constexpr double near_face = 0.9986;    // cosine of 3 degrees: the precision of quantised normals
constexpr double nearly_all = 0.95;     // share of the edges or corners
constexpr double same_facet = 0.999962; // cosine of half a degree
// The maximum number of wedges to compare at a vertex, which may have a million faces.
constexpr std::size_t max_compared = 64;

Vec3 normal_of(const Attribute& a, Index w) { return {a.value(w, 0), a.value(w, 1), a.value(w, 2)}; }

/// For each face, a vector along its normal whose length is twice the area.
std::vector<Vec3> double_area_vectors(const Mesh& mesh) {
    std::vector<Vec3> areas(mesh.face_count());
    parallel_for(areas.size(), [&](std::size_t f) { areas[f] = area_vector(mesh, static_cast<Index>(f)); });
    return areas;
}

double cosine_between(const Vec3& a, const Vec3& b) { return dot(normalised(a), normalised(b)); }

/// The attributes of wedges except their normals and tangents.
class Others {
  public:
    explicit Others(const Mesh& mesh) {
        for (const auto& a : mesh.attributes)
            if (a.domain == Domain::wedge && a.role != Role::normal && a.role != Role::tangent)
                std::visit(
                    [&](const auto& v) {
                        columns_.push_back({reinterpret_cast<const std::byte*>(v.data()),
                                            sizeof(v[0]) * static_cast<std::size_t>(a.components)});
                    },
                    a.data);
    }
    bool same(Index a, Index b) const {
        return std::all_of(columns_.begin(), columns_.end(), [&](const Column& c) {
            return std::memcmp(c.data + a * c.bytes, c.data + b * c.bytes, c.bytes) == 0;
        });
    }

  private:
    struct Column {
        const std::byte* data;
        std::size_t bytes;
    };
    std::vector<Column> columns_;
};

struct SeamEvidence {
    std::size_t bent = 0, seams = 0, corners = 0, facing = 0;
};

/// Whether the normals are flat-shaded.
bool flat_shaded(const Mesh& mesh, const Attribute& normals, const std::vector<Vec3>& areas,
                 const std::vector<Index>& face_of) {
    const EdgeTable edges = build_edges(mesh);
    const auto differ = [&](Index a, Index b) { return !(normal_of(normals, a) == normal_of(normals, b)); };
    const auto join = [](SeamEvidence a, const SeamEvidence& b) {
        a.bent += b.bent;
        a.seams += b.seams;
        a.corners += b.corners;
        a.facing += b.facing;
        return a;
    };
    const auto at_edges = [&](std::size_t begin, std::size_t end) {
        SeamEvidence e;
        for (std::size_t i = begin; i < end; ++i) {
            const auto corners = edges.corners_of(static_cast<Index>(i));
            if (corners.size() != 2) continue;
            const Index f = face_of[corners[0]], g = face_of[corners[1]];
            if (!(cosine_between(areas[f], areas[g]) < bent)) continue;
            Index a = corners[0], b = next_corner(mesh, f, a), c = corners[1], d = next_corner(mesh, g, c);
            if (mesh.vertex(a) != mesh.vertex(c)) std::swap(c, d);
            ++e.bent;
            e.seams += differ(mesh.corners[a], mesh.corners[c]) && differ(mesh.corners[b], mesh.corners[d]);
        }
        return e;
    };
    const auto at_corners = [&](std::size_t begin, std::size_t end) {
        SeamEvidence e;
        for (std::size_t c = begin; c < end; ++c) {
            const Vec3& area = areas[face_of[c]];
            if (!(dot(area, area) > 0)) continue;
            ++e.corners;
            e.facing += cosine_between(area, normal_of(normals, mesh.corners[c])) > near_face;
        }
        return e;
    };
    const SeamEvidence e = join(parallel_reduce(edges.size(), SeamEvidence{}, at_edges, join),
                                parallel_reduce(mesh.corner_count(), SeamEvidence{}, at_corners, join));
    const auto share = [](std::size_t part, std::size_t whole) {
        return static_cast<double>(part) >= nearly_all * static_cast<double>(whole);
    };
    return e.bent > 0 && share(e.seams, e.bent) && share(e.facing, e.corners);
}

/// The wedges at one vertex, and which of them may be merged.
class Fan {
  public:
    Fan(const Mesh& mesh, const std::vector<Vec3>& areas, const std::vector<Index>& face_of,
        const Attribute& normals, const Others& others, double least_cosine)
        : mesh_(mesh), areas_(areas), face_of_(face_of), normals_(normals), others_(others),
          least_cosine_(least_cosine) {}

    /// Fills into[w] for the wedges at the corners, and gives merged wedges their normal. Returns the number
    /// of removed wedges.
    std::size_t merge(std::span<const Index> corners, bool faceted, std::vector<Index>& into,
                      Attribute& renewed) {
        wedges_.clear();
        for (const Index c : corners) wedges_.push_back({mesh_.corners[c], 0, {}, false});
        std::sort(wedges_.begin(), wedges_.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
        wedges_.erase(std::unique(wedges_.begin(), wedges_.end(),
                                  [](const auto& a, const auto& b) { return a.id == b.id; }),
                      wedges_.end());
        if (wedges_.size() < 2) return 0;
        for (std::size_t i = 0; i < wedges_.size(); ++i) wedges_[i].root = faceted ? 0 : i;
        if (!faceted) {
            join_across_edges(corners);
            renew_normals(corners, renewed);
        }
        return point_to_first(into);
    }

  private:
    struct Member {
        Index id;
        std::size_t root; ///< the lowest of the wedges joined so far
        Vec3 area;
        bool several; ///< whether the joined wedges have different normals
    };
    std::size_t place(Index wedge) const {
        return static_cast<std::size_t>(std::lower_bound(wedges_.begin(), wedges_.end(), wedge,
                                                         [](const Member& m, Index w) { return m.id < w; }) -
                                        wedges_.begin());
    }
    std::size_t root(std::size_t i) {
        while (wedges_[i].root != i) i = wedges_[i].root = wedges_[wedges_[i].root].root;
        return i;
    }

    void join_across_edges(std::span<const Index> corners) {
        ring_.pairs(mesh_, face_of_, corners, [&](Index c, Index d, bool) {
            if (!smooth(c, d)) return;
            const std::size_t a = root(place(mesh_.corners[c])), b = root(place(mesh_.corners[d]));
            wedges_[std::max(a, b)].root = std::min(a, b);
        });
    }

    /// Whether the edge between the faces of two corners is to be shaded smoothly.
    bool smooth(Index a, Index b) const {
        return normal_of(normals_, mesh_.corners[a]) == normal_of(normals_, mesh_.corners[b]) ||
               cosine_between(areas_[face_of_[a]], areas_[face_of_[b]]) > least_cosine_;
    }

    void renew_normals(std::span<const Index> corners, Attribute& renewed) {
        for (const Index c : corners) wedges_[root(place(mesh_.corners[c]))].area += areas_[face_of_[c]];
        for (std::size_t i = 0; i < wedges_.size(); ++i) {
            Member& r = wedges_[root(i)];
            r.several |= !(normal_of(normals_, wedges_[i].id) == normal_of(normals_, r.id));
        }
        for (std::size_t i = 0; i < wedges_.size(); ++i) {
            const Member& r = wedges_[root(i)];
            const Vec3 normal = normalised(r.area);
            if (!r.several || !(dot(normal, normal) > 0)) continue;
            for (int k = 0; k < 3; ++k)
                renewed.set_value(wedges_[i].id, k, normal[static_cast<std::size_t>(k)]);
        }
    }

    std::size_t point_to_first(std::vector<Index>& into) {
        std::size_t gone = 0;
        firsts_.clear();
        for (std::size_t i = 0; i < wedges_.size(); ++i) {
            const std::size_t from = firsts_.size() - std::min(firsts_.size(), max_compared);
            const auto same = std::find_if(
                firsts_.begin() + static_cast<std::ptrdiff_t>(from), firsts_.end(), [&](std::size_t j) {
                    return root(i) == root(j) && others_.same(wedges_[i].id, wedges_[j].id);
                });
            if (same == firsts_.end())
                firsts_.push_back(i);
            else {
                into[wedges_[i].id] = wedges_[*same].id;
                ++gone;
            }
        }
        return gone;
    }

    const Mesh& mesh_;
    const std::vector<Vec3>& areas_;
    const std::vector<Index>& face_of_;
    const Attribute& normals_;
    const Others& others_;
    double least_cosine_;
    std::vector<Member> wedges_;
    OneRing ring_;
    std::vector<std::size_t> firsts_;
};

/// If every vertex has a single wedge left, converts the mesh to the form without seams, in which wedge v
/// belongs to vertex v.
void forget_wedges(Mesh& mesh) {
    if (mesh.wedge_count() != mesh.vertex_count()) return;
    std::vector<Index> wedge_of(mesh.vertex_count(), none);
    for (Index w = 0; w < mesh.wedge_count(); ++w) {
        if (wedge_of[mesh.vertex_of_wedge(w)] != none) return;
        wedge_of[mesh.vertex_of_wedge(w)] = w;
    }
    for (auto& a : mesh.attributes)
        if (a.domain == Domain::wedge) a.select(wedge_of);
    parallel_for(mesh.corner_count(),
                 [&](std::size_t c) { mesh.corners[c] = mesh.vertex(static_cast<Index>(c)); });
    mesh.wedge_vertex = {};
}

/// Merges wedges: all wedges of a vertex that only normals separate (faceted), or wedges across smooth
/// edges. Returns the number of removed wedges.
std::size_t merge_wedges(Mesh& mesh, const std::vector<Vec3>& areas, const std::vector<Index>& face_of,
                         bool faceted, double least_cosine) {
    Attribute& normals = *mesh.find("NORMAL", Domain::wedge);
    const auto corners = corners_at_vertices(mesh);
    const Others others(mesh);
    Attribute renewed = normals;
    std::vector<Index> into(mesh.wedge_count());
    parallel_for(into.size(), [&](std::size_t w) { into[w] = static_cast<Index>(w); });
    const std::size_t merged = parallel_reduce(
        mesh.vertex_count(), std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
            Fan fan(mesh, areas, face_of, normals, others, least_cosine);
            std::size_t gone = 0;
            for (std::size_t v = begin; v < end; ++v)
                gone += fan.merge(corners.of(static_cast<Index>(v)), faceted, into, renewed);
            return gone;
        },
        [](std::size_t a, std::size_t b) { return a + b; });
    if (merged == 0) return 0;
    normals = std::move(renewed);
    parallel_for(mesh.corner_count(), [&](std::size_t c) { mesh.corners[c] = into[mesh.corners[c]]; });
    drop_unused(mesh);
    forget_wedges(mesh);
    return merged;
}

} // namespace

NormalSeams merge_normal_seams(Mesh& mesh, double feature_angle) {
    NormalSeams result;
    const Attribute* normals = mesh.find("NORMAL", Domain::wedge);
    if (!mesh.has_seams() || !normals || normals->components != 3 || !(feature_angle > 0)) return result;
    const auto areas = double_area_vectors(mesh);
    const auto face_of = corner_faces(mesh);
    const bool faceted = flat_shaded(mesh, *normals, areas, face_of);
    result.merged = merge_wedges(mesh, areas, face_of, faceted, cosine(feature_angle));
    if (result.merged == 0) return result;
    result.shading = faceted ? NormalSeams::Shading::faceted : NormalSeams::Shading::smoothed;
    return result;
}

std::size_t forget_normals(Mesh& mesh) {
    Attribute* normals = mesh.find("NORMAL", Domain::wedge);
    if (!normals) return 0;
    std::size_t merged = 0;
    if (mesh.has_seams() && normals->components == 3)
        merged = merge_wedges(mesh, double_area_vectors(mesh), corner_faces(mesh), true, 1);
    mesh.drop("NORMAL", Domain::wedge);
    return merged;
}

namespace {

/// A new wedge: the old wedge, and its faces with the same direction.
struct Facet {
    Index wedge;
    Vec3 area; ///< area vector of the first face, then the sum
};

} // namespace

void set_facet_normals(Mesh& mesh) {
    const auto areas = double_area_vectors(mesh);
    const auto face_of = corner_faces(mesh);
    const auto corners_at = corners_at_vertices(mesh);
    std::vector<Facet> facets;
    std::vector<Index> corners(mesh.corner_count()), vertex_of;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const std::size_t mine = facets.size();
        for (const Index c : corners_at.of(v)) {
            const Vec3& area = areas[face_of[c]];
            std::size_t i = std::max(mine, facets.size() - std::min(facets.size(), max_compared));
            while (i < facets.size() && !(facets[i].wedge == mesh.corners[c] &&
                                          (cosine_between(facets[i].area, area) > same_facet)))
                ++i;
            if (i == facets.size()) {
                facets.push_back({mesh.corners[c], area});
                vertex_of.push_back(v);
            } else
                facets[i].area += area;
            corners[c] = static_cast<Index>(i);
        }
    }
    Provenance copies;
    for (const Facet& facet : facets) copies.copies.push_back(facet.wedge);
    mesh.corners = std::move(corners);
    mesh.wedge_vertex = std::move(vertex_of);
    for (auto& a : mesh.attributes)
        if (a.domain == Domain::wedge) a.select(copies.copies);
    Attribute& normals = *mesh.find("NORMAL", Domain::wedge);
    parallel_for(facets.size(), [&](std::size_t w) {
        const Vec3 n = normalised(facets[w].area);
        for (int i = 0; i < 3 && dot(n, n) > 0; ++i) normals.set_value(w, i, n[static_cast<std::size_t>(i)]);
    });
    straighten_tangents(mesh);
}

} // namespace facetmill
