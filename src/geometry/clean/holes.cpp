// The clean step that fills holes.
#include "base/math/predicates.hpp"
#include "base/text/words.hpp"
#include "geometry/boolean/span_outline.hpp"
#include "geometry/cgal/fair_patch.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/triangulate/triangulate.hpp"
#include "mesh/face.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>
#include <set>

namespace facetmill {

namespace {

// Holes of a surface, found by their outlines.

/// A hole's outline in the direction of the faces that would fill it. The wedge of corner i is at the start
/// of the edge to corner i + 1.
struct Outline {
    std::vector<Index> wedges;
    std::vector<Index> faces; ///< [i] the face across the edge from i to i + 1
};

class Outlines {
  public:
    explicit Outlines(const Mesh& mesh)
        : mesh_(mesh), edges_(build_edges(mesh)), faces_(corner_faces(mesh)), done_(mesh.corner_count(), 0) {}

    /// Calls body(outline) for each loop of boundary edges, and broken(corner) for paths that do not close. A
    /// path that returns to a vertex surrounds several holes that touch there, and each becomes an outline.
    template <class Body, class Broken>
    void each(Body&& body, Broken&& broken) {
        for (Index c = 0; c < mesh_.corner_count(); ++c) {
            if (done_[c] || !is_open(c)) continue;
            Outline outline;
            if (walk(c, outline))
                each_loop(outline, body);
            else
                broken(c);
        }
    }

  private:
    template <class Body>
    void each_loop(const Outline& walked, Body&& body) {
        Outline path;
        std::map<Index, std::size_t> place; // index of each vertex in the path
        for (std::size_t i = 0; i < walked.wedges.size(); ++i) {
            const Index v = mesh_.vertex_of_wedge(walked.wedges[i]);
            if (const auto again = place.find(v); again != place.end()) {
                const auto from = static_cast<std::ptrdiff_t>(again->second);
                const Outline loop{{path.wedges.begin() + from, path.wedges.end()},
                                   {path.faces.begin() + from, path.faces.end()}};
                for (const Index w : loop.wedges) place.erase(mesh_.vertex_of_wedge(w));
                path.wedges.resize(static_cast<std::size_t>(from));
                path.faces.resize(static_cast<std::size_t>(from));
                body(loop);
            }
            place[v] = path.wedges.size();
            path.wedges.push_back(walked.wedges[i]);
            path.faces.push_back(walked.faces[i]);
        }
        body(path);
    }

    bool is_open(Index c) const {
        const Index e = edges_.corner_edge[c];
        return e != none && edges_.corners_of(e).size() == 1;
    }
    Index next(Index c) const { return next_corner(mesh_, faces_[c], c); }

    /// The next boundary edge after c's, around the vertex at its end, or none.
    Index follow(Index c) const {
        Index at = next(c); // an edge that leaves the vertex
        for (std::size_t turns = 0; turns <= mesh_.corner_count(); ++turns) {
            const Index e = edges_.corner_edge[at];
            if (e == none) return none;
            const auto corners = edges_.corners_of(e);
            if (corners.size() == 1) return at;
            if (corners.size() > 2) return none;
            const Index other = corners[0] == at ? corners[1] : corners[0];
            if (mesh_.vertex(other) == mesh_.vertex(at)) return none; // neighbours have opposite orientations
            at = next(other);
        }
        return none;
    }

    bool walk(Index start, Outline& outline) {
        Index c = start;
        do {
            if (done_[c]) return false;
            done_[c] = 1;
            outline.wedges.push_back(mesh_.corners[next(c)]);
            outline.faces.push_back(faces_[c]);
            c = follow(c);
            if (c == none) return false;
        } while (c != start);
        // The walk follows the faces' edges; a face in the hole has the opposite direction.
        std::reverse(outline.wedges.begin(), outline.wedges.end());
        std::reverse(outline.faces.begin(), outline.faces.end());
        return true;
    }

    const Mesh& mesh_;
    EdgeTable edges_;
    std::vector<Index> faces_;
    std::vector<std::uint8_t> done_;
};

} // namespace

} // namespace facetmill

namespace facetmill::clean_steps {

namespace {

// Geometry that a patch must not duplicate.

/// Existing edges and triangles by position. Vertices at the same position count as equal, so that a patch
/// stays valid after welding.
class Occupied {
  public:
    explicit Occupied(const Mesh& mesh) : place_(lowest_at_place(mesh)) {
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const Index begin = mesh.face_begin(f), end = mesh.face_end(f);
            for (Index c = begin; c < end; ++c)
                edges_.push_back(edge(mesh.vertex(c), mesh.vertex(next_corner(c, begin, end))));
            if (end - begin == 3)
                triangles_.push_back(
                    triangle({mesh.vertex(begin), mesh.vertex(begin + 1), mesh.vertex(begin + 2)}));
        }
        std::sort(edges_.begin(), edges_.end());
        std::sort(triangles_.begin(), triangles_.end());
    }
    bool has_edge(Index a, Index b) const {
        return std::binary_search(edges_.begin(), edges_.end(), edge(a, b)) ||
               new_edges_.contains(edge(a, b));
    }
    bool has_triangle(const std::array<Index, 3>& abc) const {
        const auto t = triangle(abc);
        return std::binary_search(triangles_.begin(), triangles_.end(), t) || new_triangles_.contains(t);
    }
    void add_edge(Index a, Index b) { new_edges_.insert(edge(a, b)); }
    void add_triangle(const std::array<Index, 3>& abc) { new_triangles_.insert(triangle(abc)); }

  private:
    std::pair<Index, Index> edge(Index a, Index b) const {
        return {std::min(place_[a], place_[b]), std::max(place_[a], place_[b])};
    }
    std::array<Index, 3> triangle(std::array<Index, 3> abc) const {
        for (Index& v : abc) v = place_[v];
        std::sort(abc.begin(), abc.end());
        return abc;
    }

    std::vector<Index> place_;
    std::vector<std::pair<Index, Index>> edges_;
    std::vector<std::array<Index, 3>> triangles_;
    std::set<std::pair<Index, Index>> new_edges_;
    std::set<std::array<Index, 3>> new_triangles_;
};

/// The rounding error of files with 32-bit coordinates.
double rounding(const Vec3& p) { return 0x1p-21 * std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// The outline as a polygon, triangulated.
HolePatch planar(const std::vector<Vec3>& ring, std::string& why) {
    Mesh polygon;
    polygon.positions = ring;
    std::vector<Index> wedges(ring.size());
    for (Index i = 0; i < wedges.size(); ++i) wedges[i] = i;
    add_face(polygon, wedges);
    TriangulateResult cut = triangulate(polygon);
    HolePatch patch;
    double rounded = 0;
    for (const Vec3& p : ring) rounded = std::max(rounded, rounding(p));
    if (cut.kinds.non_planar > 0 && cut.kinds.deviation > rounded) {
        why = fmt::format("its boundary loop is not planar: it deviates by {:.6g}", cut.kinds.deviation);
        return patch;
    }
    if (cut.fans > 0) {
        why = "its boundary loop intersects itself or has no area";
        return patch;
    }
    for (Index c = 0; c < cut.mesh.corner_count(); c += 3)
        patch.triangles.push_back({cut.mesh.corners[c], cut.mesh.corners[c + 1], cut.mesh.corners[c + 2]});
    return patch;
}

HolePatch fan_around_middle(const std::vector<Vec3>& ring) {
    HolePatch patch;
    Vec3 middle;
    const auto n = static_cast<Index>(ring.size());
    for (const Vec3& p : ring) middle += p;
    patch.points.push_back(middle / n);
    for (Index i = 0; i < n; ++i) patch.triangles.push_back({i, (i + 1) % n, n});
    return patch;
}

bool in_plane(const Vec3& p, const Vec3& from, const Vec3& normal) {
    return std::abs(dot(p - from, normalised(normal))) <= rounding(p) + rounding(from);
}

Vec3 corner_of(const std::vector<Vec3>& ring, const HolePatch& patch, Index i) {
    return i < ring.size() ? ring[i] : patch.points[i - ring.size()];
}

/// True if a triangle of the patch has exactly zero area, because it would be removed again.
bool lacks_area(const std::vector<Vec3>& ring, const HolePatch& patch) {
    const auto at = [&](Index i) { return corner_of(ring, patch, i); };
    return std::any_of(patch.triangles.begin(), patch.triangles.end(),
                       [&](const auto& t) { return collinear(at(t[0]), at(t[1]), at(t[2])); });
}

class Filler {
  public:
    Filler(Work& work, const HoleSettings& settings, const EdgeList* other_than)
        : work_(work), mesh_(work.mesh), settings_(settings), other_than_(other_than), occupied_(work.mesh),
          corners_(corners_at_vertices(work.mesh)), face_of_(corner_faces(work.mesh)) {}

    /// The indices of outlines whose patches intersect faces.
    std::set<std::size_t> crossing() const {
        std::set<std::size_t> into;
        if (filled_ == 0) return into;
        const Mesh trial = with_patches(mesh_, patches_);
        std::vector<std::uint8_t> among(trial.face_count(), 0);
        std::fill(among.begin() + static_cast<std::ptrdiff_t>(mesh_.face_count()), among.end(), 1);
        const auto found = crossings(trial, std::move(among));
        const auto outline = [&](Index f) { return outline_of_face_[f - mesh_.face_count()]; };
        for (const auto& [low, high] : found.pairs)
            if (low < mesh_.face_count()) into.insert(outline(high));
        for (const auto& [low, high] : found.pairs) // if two patches intersect each other, the first may stay
            if (low >= mesh_.face_count() && !into.contains(outline(low))) into.insert(outline(high));
        return into;
    }

    bool run(const std::set<std::size_t>& left) {
        left_ = &left;
        Outlines(mesh_).each(
            [&](const Outline& o) {
                fill(o);
                ++outline_;
            },
            [&](Index c) {
                refuse("neighbouring faces are oriented inconsistently, or the edge has "
                       "more than two faces: use orient first",
                       mesh_.point(c));
            });
        return filled_ > 0;
    }

    void accept() {
        work_.counts.filled_holes += filled_;
        work_.counts.hole_faces += patches_.sources.size();
        work_.mesh = with_patches(mesh_, patches_, patches_.points.empty() ? nullptr : &work_.changes);
    }

  private:
    void refuse(std::string why, const Vec3& at) { work_.not_done.push_back({"holes", std::move(why), at}); }

    /// True if an edge of the outline must stay open.
    bool is_excepted(const Outline& o) const {
        const auto n = static_cast<Index>(o.wedges.size());
        for (Index i = 0; other_than_ && i < n; ++i) {
            const std::pair<Index, Index> ends = std::minmax({vertex(o, i), vertex(o, (i + 1) % n)});
            if (std::binary_search(other_than_->begin(), other_than_->end(), ends)) return true;
        }
        return false;
    }

    void fill(const Outline& o) {
        if (is_excepted(o)) return;
        const std::size_t n = o.wedges.size();
        std::vector<Vec3> ring;
        double around = 0;
        for (const Index w : o.wedges) ring.push_back(mesh_.positions[mesh_.vertex_of_wedge(w)]);
        for (std::size_t i = 0; i < n; ++i) around += length(ring[(i + 1) % n] - ring[i]);
        if (n < 3) return refuse("its boundary loop has fewer than three edges", ring[0]);
        if (settings_.max_edges > 0 && n > settings_.max_edges)
            return refuse(fmt::format("its boundary loop has {}, more than {}", counted(n, "edge"),
                                      settings_.max_edges),
                          ring[0]);
        if (settings_.max_length > 0 && around > settings_.max_length)
            return refuse(fmt::format("its boundary loop is {:.6g} long, more than {:.6g}", around,
                                      settings_.max_length),
                          ring[0]);
        if (std::all_of(o.faces.begin(), o.faces.end(), [&](Index f) { return f == o.faces[0]; }))
            return refuse("it is the boundary of a single face", ring[0]);
        std::string why;
        HolePatch patch = patch_for(o, ring, why);
        if (patch.triangles.empty()) return refuse(why, ring[0]);
        if (collides(o, patch) || lacks_area(ring, patch)) patch = fan_around_middle(ring);
        if (lacks_area(ring, patch)) return refuse("every patch would have faces without area", ring[0]);
        if (collides(o, patch))
            return refuse("a patch would duplicate a face or make an edge with more than two faces", ring[0]);
        if (folds_back(o, ring, patch))
            return refuse("a patch would overlap the neighbouring faces: this is the border of a flat "
                          "surface, not a hole",
                          ring[0]);
        if (left_->contains(outline_)) return refuse("a patch would intersect other faces", ring[0]);
        add(o, ring, patch);
    }

    HolePatch patch_for(const Outline& o, const std::vector<Vec3>& ring, std::string& why) const {
        if (settings_.method == HoleFill::planar) return planar(ring, why);
        std::vector<Vec3> across;
        for (const Index f : o.faces) across.push_back(area_vector(mesh_, f));
        HolePatch patch{span_outline(ring, across), {}};
        return settings_.method == HoleFill::smooth ? fair_patch(ring, patch.triangles, surroundings(o))
                                                    : patch;
    }

    /// The triangles of two rings of faces around the outline.
    HolePatch surroundings(const Outline& o) const {
        std::map<Index, Index> number; // numbers of vertices
        for (Index i = 0; i < o.wedges.size(); ++i) number.try_emplace(vertex(o, i), i);
        std::set<Index> faces, seen;
        for (const auto& [v, i] : number) seen.insert(v);
        std::vector<Index> reached(seen.begin(), seen.end());
        for (int ring = 0; ring < 2; ++ring) {
            std::vector<Index> next;
            for (const Index v : reached)
                for (const Index c : corners_.of(v)) {
                    const Index f = face_of_[c];
                    if (!faces.insert(f).second) continue;
                    for (Index d = mesh_.face_begin(f); d < mesh_.face_end(f); ++d)
                        if (seen.insert(mesh_.vertex(d)).second) next.push_back(mesh_.vertex(d));
                }
            reached = std::move(next);
        }
        HolePatch around;
        const auto numbered = [&](Index v) {
            const auto [at, fresh] =
                number.try_emplace(v, static_cast<Index>(o.wedges.size() + around.points.size()));
            if (fresh) around.points.push_back(mesh_.positions[v]);
            return at->second;
        };
        for (const Index f : faces)
            for (Index c = mesh_.face_begin(f) + 1; c + 1 < mesh_.face_end(f); ++c)
                around.triangles.push_back({numbered(mesh_.vertex(mesh_.face_begin(f))),
                                            numbered(mesh_.vertex(c)), numbered(mesh_.vertex(c + 1))});
        return around;
    }

    /// True if a triangle of the patch is coplanar with the face across an outline edge, and on the same side
    /// of the edge. Such a patch would cover the face from behind.
    bool folds_back(const Outline& o, const std::vector<Vec3>& ring, const HolePatch& patch) const {
        const auto n = static_cast<Index>(ring.size());
        for (const auto& t : patch.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const Index i = t[k], j = t[(k + 1) % 3];
                if (i >= n || j >= n || (i + 1) % n != j) continue;
                const Vec3 apex = corner_of(ring, patch, t[(k + 2) % 3]);
                const Vec3 beyond = area_vector(mesh_, o.faces[i]),
                           own = cross(ring[j] - ring[i], apex - ring[i]);
                const auto face = mesh_.face_wedges(o.faces[i]);
                if (dot(beyond, own) < 0 && in_plane(apex, ring[i], beyond) &&
                    std::all_of(face.begin(), face.end(), [&](Index w) {
                        return in_plane(mesh_.positions[mesh_.vertex_of_wedge(w)], ring[i], own);
                    }))
                    return true;
            }
        return false;
    }

    /// True if an inner edge or a triangle of the patch already exists.
    bool collides(const Outline& o, const HolePatch& patch) const {
        const auto n = static_cast<Index>(o.wedges.size());
        for (const auto& t : patch.triangles) {
            if (t[0] < n && t[1] < n && t[2] < n &&
                occupied_.has_triangle({vertex(o, t[0]), vertex(o, t[1]), vertex(o, t[2])}))
                return true;
            for (std::size_t k = 0; k < 3; ++k) {
                const Index i = t[k], j = t[(k + 1) % 3];
                if (i >= n || j >= n || (i + 1) % n == j || (j + 1) % n == i) continue;
                if (occupied_.has_edge(vertex(o, i), vertex(o, j))) return true;
            }
        }
        return false;
    }
    Index vertex(const Outline& o, Index i) const { return mesh_.vertex_of_wedge(o.wedges[i]); }

    void add(const Outline& o, const std::vector<Vec3>& ring, const HolePatch& patch) {
        const auto n = static_cast<Index>(o.wedges.size());
        const auto first = static_cast<Index>(mesh_.wedge_count() + patches_.points.size());
        for (const Vec3& p : patch.points) add_point(o, ring, p);
        for (const auto& t : patch.triangles) {
            std::array<Index, 3> wedges;
            Index source = o.faces[0];
            for (std::size_t k = 0; k < 3; ++k) {
                wedges[k] = t[k] < n ? o.wedges[t[k]] : first + (t[k] - n);
                const Index i = t[k], j = t[(k + 1) % 3];
                if (i < n && j < n && (i + 1) % n == j) source = o.faces[i];
                if (i < n && j < n) occupied_.add_edge(vertex(o, i), vertex(o, j));
            }
            if (t[0] < n && t[1] < n && t[2] < n)
                occupied_.add_triangle({vertex(o, t[0]), vertex(o, t[1]), vertex(o, t[2])});
            patches_.add_face(wedges, source);
            outline_of_face_.push_back(outline_);
        }
        ++filled_;
    }

    /// A new point interpolates the outline's attributes; nearer vertices have larger weights.
    void add_point(const Outline& o, const std::vector<Vec3>& ring, const Vec3& p) {
        std::vector<double> weights;
        double sum = 0;
        for (const Vec3& q : ring) {
            const double d = dot(q - p, q - p);
            weights.push_back(1 / std::max(d, 1e-300));
            sum += weights.back();
        }
        patches_.points.push_back(p);
        for (std::size_t i = 0; i < ring.size(); ++i) {
            patches_.mix_wedges.push_back(o.wedges[i]);
            patches_.mix_weights.push_back(weights[i] / sum);
        }
        patches_.mix_offsets.push_back(static_cast<Index>(patches_.mix_wedges.size()));
    }

    Work& work_;
    const Mesh& mesh_;
    const HoleSettings& settings_;
    const EdgeList* other_than_;
    Occupied occupied_;
    VertexLists corners_;
    std::vector<Index> face_of_;
    Patches patches_;
    std::vector<std::size_t> outline_of_face_; ///< outline of each patch face
    const std::set<std::size_t>* left_ = nullptr;
    std::size_t filled_ = 0, outline_ = 0;
};

} // namespace

bool fill_holes(Work& work, const HoleSettings& settings, const EdgeList* other_than, bool may_cross) {
    const std::size_t told = work.not_done.size();
    for (std::set<std::size_t> left;;) {
        Filler filler(work, settings, other_than);
        if (!filler.run(left)) return false;
        const auto more = may_cross ? std::set<std::size_t>{} : filler.crossing();
        if (more.empty()) {
            filler.accept();
            return true;
        }
        left.insert(more.begin(), more.end());
        work.not_done.resize(told);
    }
}

} // namespace facetmill::clean_steps
