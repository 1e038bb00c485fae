#include "geometry/normals/normals.hpp"

#include "base/math/angle.hpp"
#include "base/math/portable_math.hpp"
#include "geometry/edit/moved.hpp"
#include "geometry/normals/one_ring.hpp"
#include "mesh/face.hpp"
#include "parallel/parallel.hpp"

#include <numeric>
#include <tuple>

namespace facetmill {

namespace {

double angle_at(const Mesh& mesh, Index f, Index c) {
    const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
    const Vec3 to = normalised(mesh.point(next_corner(c, begin, end)) - mesh.point(c));
    const Vec3 from = normalised(mesh.point(previous_corner(c, begin, end)) - mesh.point(c));
    return angle_between(to, from);
}

/// The faces of a mesh, and how their normals are combined.
struct FaceNormals {
    std::vector<Vec3> units;   ///< [faces] normals; zero without area
    std::vector<double> areas; ///< [faces] twice the areas; empty: angles are the weights
    double least_cosine = 0;   ///< of the angle between the normals of faces that share a normal
};

/// Finds the corners of a vertex that share a normal, and the corners that also share a wedge.
class SmoothFan {
  public:
    SmoothFan(const Mesh& mesh, const std::vector<Index>& face_of, const FaceNormals& normals)
        : mesh_(mesh), face_of_(face_of), normals_(normals) {}

    /// Numbers the new wedges from 0, and assigns a wedge to each corner. Returns the number of wedges.
    Index number(std::span<const Index> corners, std::vector<Index>& wedge_of_corner) {
        join(corners);
        keys_.clear();
        for (std::size_t i = 0; i < corners.size(); ++i)
            keys_.push_back({root(i), mesh_.corners[corners[i]], corners[i]});
        std::sort(keys_.begin(), keys_.end(), [](const Key& a, const Key& b) {
            return std::tie(a.root, a.wedge, a.corner) < std::tie(b.root, b.wedge, b.corner);
        });
        Index count = 0;
        for (std::size_t i = 0; i < keys_.size(); ++i) {
            if (i == 0 || keys_[i].root != keys_[i - 1].root || keys_[i].wedge != keys_[i - 1].wedge) ++count;
            wedge_of_corner[keys_[i].corner] = count - 1;
        }
        return count;
    }

    /// Computes the normal of each corner, in order. number() must have been called.
    void sum(std::span<const Index> corners, std::vector<Vec3>& of_corner) {
        join(corners);
        of_corner.assign(corners.size(), {});
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Index c = corners[i], f = face_of_[c];
            const Vec3& normal = normals_.units[f];
            if (dot(normal, normal) > 0)
                of_corner[root(i)] +=
                    normal * (normals_.areas.empty() ? angle_at(mesh_, f, c) : normals_.areas[f]);
        }
        for (std::size_t i = corners.size(); i-- > 0;) of_corner[i] = normalised(of_corner[root(i)]);
    }

  private:
    struct Key {
        std::size_t root;
        Index wedge, corner;
    };

    std::size_t root(std::size_t i) {
        while (roots_[i] != i) i = roots_[i] = roots_[roots_[i]];
        return i;
    }

    void join(std::span<const Index> corners) {
        roots_.resize(corners.size());
        std::iota(roots_.begin(), roots_.end(), std::size_t{0});
        const auto place = [&](Index c) {
            return static_cast<std::size_t>(std::lower_bound(corners.begin(), corners.end(), c) -
                                            corners.begin());
        };
        ring_.pairs(mesh_, face_of_, corners, [&](Index c, Index d, bool agree) {
            if (!agree || exceeds_feature_angle(dot(normals_.units[face_of_[c]], normals_.units[face_of_[d]]),
                                                normals_.least_cosine))
                return;
            const std::size_t a = root(place(c)), b = root(place(d));
            roots_[std::max(a, b)] = std::min(a, b);
        });
    }

    const Mesh& mesh_;
    const std::vector<Index>& face_of_;
    const FaceNormals& normals_;
    OneRing ring_;
    std::vector<std::size_t> roots_; ///< indexed like the vertex's corners
    std::vector<Key> keys_;
};

/// Lays out the new wedges vertex by vertex; attributes follow. With as many wedges as vertices, the mesh
/// has no seams.
void set_wedges(Mesh& mesh, const std::vector<Index>& wedge_of_corner, const std::vector<Index>& first,
                Index wedges, const VertexLists& corners_at) {
    std::vector<Index> source(wedges), vertex_of(wedges);
    parallel_for(mesh.vertex_count(), [&](std::size_t v) {
        for (const Index c : corners_at.of(static_cast<Index>(v))) {
            const Index w = first[v] + wedge_of_corner[c];
            source[w] = mesh.corners[c];
            vertex_of[w] = static_cast<Index>(v);
        }
    });
    parallel_for(mesh.vertex_count(), [&](std::size_t v) {
        for (const Index c : corners_at.of(static_cast<Index>(v)))
            mesh.corners[c] = first[v] + wedge_of_corner[c];
    });
    for (auto& a : mesh.attributes)
        if (a.domain == Domain::wedge) a.select(source);
    mesh.wedge_vertex = std::move(vertex_of);
}

FaceNormals face_normals(const Mesh& mesh, bool by_area, double feature_angle) {
    FaceNormals normals;
    normals.units.resize(mesh.face_count());
    if (by_area) normals.areas.resize(mesh.face_count());
    normals.least_cosine = feature_angle >= pi ? -2 : cosine(feature_angle);
    parallel_for(normals.units.size(), [&](std::size_t f) {
        const Vec3 area = area_vector(mesh, static_cast<Index>(f));
        normals.units[f] = normalised(area);
        if (by_area) normals.areas[f] = length(area);
    });
    return normals;
}

void set_smooth_normals(Mesh& mesh, bool by_area, double feature_angle) {
    const FaceNormals normals = face_normals(mesh, by_area, feature_angle);
    const auto face_of = corner_faces(mesh);
    const auto corners_at = corners_at_vertices(mesh);
    std::vector<Index> wedge_of_corner(mesh.corner_count()), first(mesh.vertex_count());
    parallel_chunks(mesh.vertex_count(), [&](std::size_t begin, std::size_t end) {
        SmoothFan fan(mesh, face_of, normals);
        for (std::size_t v = begin; v < end; ++v)
            first[v] = fan.number(corners_at.of(static_cast<Index>(v)), wedge_of_corner);
    });
    const bool apart =
        mesh.has_seams() || std::any_of(first.begin(), first.end(), [](Index count) { return count > 1; });
    if (apart) {
        const Index wedges = exclusive_scan(first);
        set_wedges(mesh, wedge_of_corner, first, wedges, corners_at);
    }
    std::vector<float> values(3 * mesh.wedge_count());
    parallel_chunks(mesh.vertex_count(), [&](std::size_t begin, std::size_t end) {
        SmoothFan fan(mesh, face_of, normals);
        std::vector<Vec3> of_corner;
        for (std::size_t v = begin; v < end; ++v) {
            const auto corners = corners_at.of(static_cast<Index>(v));
            fan.sum(corners, of_corner);
            for (std::size_t i = 0; i < corners.size(); ++i)
                for (std::size_t k = 0; k < 3; ++k)
                    values[3 * std::size_t{mesh.corners[corners[i]]} + k] =
                        static_cast<float>(of_corner[i][k]);
        }
    });
    mesh.attributes.push_back({"NORMAL", Domain::wedge, Role::normal, 3, false, std::move(values)});
}

/// Whether the attribute is meaningless without normals: tangents, and changes of normals and tangents by
/// morph targets.
bool needs_normals(std::string_view name) {
    return name == "TANGENT" ||
           (name.starts_with("TARGET_") && (name.ends_with("_NORMAL") || name.ends_with("_TANGENT")));
}

/// Makes primitives that list their attributes also list NORMAL, or nothing that needs it.
void list_normals(Mesh& mesh, bool there) {
    for (Primitive& p : mesh.primitives) {
        if (p.attributes.empty()) continue;
        std::erase(p.attributes, "NORMAL");
        if (there) p.attributes.insert(p.attributes.begin(), "NORMAL");
        if (!there) std::erase_if(p.attributes, needs_normals);
    }
}

AttributeChanges without_normals(Mesh& mesh, bool had) {
    AttributeChanges changes;
    if (had) changes.push_back({"NORMAL", Domain::wedge, AttributeChange::Kind::dropped, "asked for"});
    std::erase_if(mesh.attributes, [&](const Attribute& a) {
        if (a.domain != Domain::wedge || !needs_normals(a.name)) return false;
        changes.push_back({a.name, a.domain, AttributeChange::Kind::dropped, "meaningless without normals"});
        return true;
    });
    list_normals(mesh, false);
    return changes;
}

} // namespace

AttributeChanges give_normals(Mesh& mesh, NormalKind kind, double feature_angle) {
    if (kind == NormalKind::keep) return {};
    const bool had = mesh.find("NORMAL", Domain::wedge) != nullptr;
    forget_normals(mesh);
    if (kind == NormalKind::none) return without_normals(mesh, had);
    list_normals(mesh, true);
    if (kind == NormalKind::flat) {
        mesh.attributes.push_back(
            {"NORMAL", Domain::wedge, Role::normal, 3, false, std::vector<float>(3 * mesh.wedge_count())});
        set_facet_normals(mesh);
    } else
        set_smooth_normals(mesh, kind == NormalKind::area, feature_angle);
    AttributeChanges changes{{"NORMAL", Domain::wedge, AttributeChange::Kind::recomputed,
                              kind == NormalKind::flat ? "the normals of the faces"
                              : kind == NormalKind::area
                                  ? "the mean of the surrounding faces, weighted by areas"
                                  : "the mean of the surrounding faces, weighted by angles"}};
    if (straighten_tangents(mesh))
        changes.push_back({"TANGENT", Domain::wedge, AttributeChange::Kind::recomputed,
                           "perpendicular to the new normals"});
    return changes;
}

} // namespace facetmill
