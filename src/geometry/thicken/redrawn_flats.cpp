#include "geometry/thicken/redrawn_flats.hpp"

#include "base/math/predicates.hpp"
#include "geometry/cgal/triangulate_polygon.hpp"
#include "geometry/edit/redrawn_faces.hpp"
#include "geometry/thicken/moved_surface.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

namespace facetmill {

namespace {

using Triangles = std::vector<std::array<Index, 3>>;

/// The plane and the size of a growing patch.
class PatchPlane {
  public:
    void add(const Mesh& mesh, Index f) {
        const Vec3 area = area_vector(mesh, f);
        const double size = length(area);
        normal_ += area;
        centre_ += corner_mean(mesh, f) * size;
        weight_ += size;
        add_corners(box_, mesh, f);
    }
    bool contains(const Mesh& mesh, Index f) const {
        const Vec3 unit = normalised(normal_), centre = centre_ / weight_;
        Box box = box_;
        add_corners(box, mesh, f);
        const double most = 2 * box.diagonal() * 1e-6;
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            if (!(std::abs(dot(unit, mesh.point(c) - centre)) <= most)) return false;
        return true;
    }
    const Vec3& normal() const { return normal_; }

  private:
    Vec3 normal_, centre_; ///< sums
    double weight_ = 0;
    Box box_;
};

struct Patch {
    std::vector<Index> faces; ///< ascending
    Vec3 normal;
};

/// Finds patches, each from its largest face.
class PatchSearch {
  public:
    explicit PatchSearch(const Mesh& mesh)
        : mesh_(mesh), edges_(build_edges(mesh)), face_of_(corner_faces(mesh)),
          patch_of_(mesh.face_count(), none) {}

    /// The patches that contain flagged faces.
    std::vector<Patch> run(const std::vector<std::uint8_t>& flags) {
        std::vector<double> area(mesh_.face_count());
        for (Index f = 0; f < area.size(); ++f) area[f] = length(area_vector(mesh_, f));
        std::vector<Index> order(mesh_.face_count());
        std::iota(order.begin(), order.end(), Index{0});
        std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return area[a] > area[b]; });
        std::vector<Patch> found;
        for (const Index seed : order) {
            if (patch_of_[seed] != none || !(area[seed] > 0) || !(area[seed] < HUGE_VAL)) continue;
            Patch patch = grow(seed);
            if (std::any_of(patch.faces.begin(), patch.faces.end(), [&](Index f) { return flags[f] != 0; }))
                found.push_back(std::move(patch));
        }
        return found;
    }

    /// Whether the edge at the corner separates its face's patch from others.
    bool is_border(Index corner) const {
        const Index other = across(corner);
        return other == none || patch_of_[face_of_[other]] != patch_of_[face_of_[corner]];
    }

  private:
    Patch grow(Index seed) {
        PatchPlane plane;
        Patch patch;
        const auto take = [&](Index f) {
            patch_of_[f] = seed;
            plane.add(mesh_, f);
            patch.faces.push_back(f);
        };
        take(seed);
        for (std::size_t i = 0; i < patch.faces.size(); ++i) {
            const Index f = patch.faces[i];
            for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c) {
                const Index other = across(c);
                if (other == none || patch_of_[face_of_[other]] != none) continue;
                if (plane.contains(mesh_, face_of_[other])) take(face_of_[other]);
            }
        }
        std::sort(patch.faces.begin(), patch.faces.end());
        patch.normal = plane.normal();
        return patch;
    }

    /// The corner along the edge in the only other face, if the faces continue each other at the edge; else
    /// none.
    Index across(Index corner) const {
        const Index e = edges_.corner_edge[corner];
        if (e == none || edges_.corners_of(e).size() != 2) return none;
        const auto corners = edges_.corners_of(e);
        const Index other = corners[0] == corner ? corners[1] : corners[0];
        const Index f = face_of_[corner], g = face_of_[other];
        if (mesh_.corners[corner] != mesh_.corners[next_corner(mesh_, g, other)] ||
            mesh_.corners[other] != mesh_.corners[next_corner(mesh_, f, corner)])
            return none;
        const bool equal = std::all_of(mesh_.attributes.begin(), mesh_.attributes.end(), [&](const auto& a) {
            return a.domain != Domain::face || is_same_value(a, f, g);
        });
        return equal ? other : none;
    }

    const Mesh& mesh_;
    EdgeTable edges_;
    std::vector<Index> face_of_;  ///< [corners]
    std::vector<Index> patch_of_; ///< [faces] the first face of its patch
};

/// A patch at the moved positions, seen along the axis nearest to its normal.
class MovedPatch {
  public:
    MovedPatch(const Mesh& mesh, const Patch& patch, const PatchSearch& search,
               const std::vector<Vec3>& moved)
        : mesh_(mesh), moved_(moved) {
        for (std::size_t i = 1; i < 3; ++i)
            if (std::abs(patch.normal[i]) > std::abs(patch.normal[axis_])) axis_ = i;
        mirrored_ = patch.normal[axis_] < 0;
        for (const Index f : patch.faces)
            for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
                if (search.is_border(c)) add_edge(c, next_corner(mesh, f, c));
        border_ = wedges_.size();
        for (const Index f : patch.faces)
            for (const Index w : mesh.face_wedges(f)) static_cast<void>(point_of(w));
    }

    /// Triangles of wedges. None if an edge of the outline is reversed, or the outline crosses or touches
    /// itself.
    std::optional<Triangles> triangulated() {
        if (!finite_ || reversed_) return {};
        Filling filling = fill(contours_);
        if (drop_inner_points_on_outline(filling)) filling = fill(contours_);
        if (!filling.added.empty() || !filling.path.empty()) return {};
        for (Index i = 0; i < border_; ++i)
            if (filling.same[i] != i) return {};
        std::sort(filling.triangles.begin(), filling.triangles.end());
        Triangles out;
        out.reserve(filling.triangles.size());
        for (std::size_t i = 0; i < filling.triangles.size(); ++i) {
            const auto& t = filling.triangles[i];
            const Vec2 &a = contours_.points[t[0]], &b = contours_.points[t[1]], &c = contours_.points[t[2]];
            if (orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y) <= 0) return {}; // it winds backward
            if (i > 0 && t == filling.triangles[i - 1]) return {};            // it winds twice
            out.push_back({wedges_[t[0]], wedges_[t[1]], wedges_[t[2]]});
        }
        if (out.empty()) return {};
        return out;
    }

    /// Whether the outline has that many edges. A face with a bridge to a hole has more.
    bool has_edges(std::size_t count) const { return contours_.edges.size() == count; }

  private:
    void add_edge(Index from, Index to) {
        contours_.edges.push_back({point_of(mesh_.corners[from]), point_of(mesh_.corners[to]), 1});
        const Index a = mesh_.vertex(from), b = mesh_.vertex(to);
        const Vec3 before = mesh_.positions[b] - mesh_.positions[a], after = moved_[b] - moved_[a];
        const double whole = dot(before, before);
        reversed_ = reversed_ || (whole > 0 && !(dot(before, after) > collapse_rounding * whole));
    }

    Index point_of(Index wedge) {
        const auto [at, fresh] = number_.try_emplace(wedge, static_cast<Index>(wedges_.size()));
        if (fresh) {
            const Vec3& p = moved_[mesh_.vertex_of_wedge(wedge)];
            finite_ = finite_ && std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
            const double u = p[(axis_ + 1) % 3], v = p[(axis_ + 2) % 3];
            wedges_.push_back(wedge);
            contours_.points.push_back({mirrored_ ? -u : u, v});
        }
        return at->second;
    }

    /// Inner points number from border_ on.
    bool drop_inner_points_on_outline(const Filling& filling) {
        std::vector<std::uint8_t> on(wedges_.size(), 0);
        for (const Index i : filling.path)
            if (i >= border_ && i < on.size()) on[i] = 1;
        if (std::find(on.begin(), on.end(), 1) == on.end()) return false;
        std::size_t left = border_;
        for (std::size_t i = border_; i < on.size(); ++i) {
            if (on[i]) continue;
            wedges_[left] = wedges_[i];
            contours_.points[left++] = contours_.points[i];
        }
        wedges_.resize(left);
        contours_.points.resize(left);
        return true;
    }

    const Mesh& mesh_;
    const std::vector<Vec3>& moved_;
    std::size_t axis_ = 0;
    bool mirrored_ = false, finite_ = true, reversed_ = false;
    std::map<Index, Index> number_; ///< wedge -> point
    std::vector<Index> wedges_;     ///< [points]; the points of the outline first
    std::size_t border_ = 0;
    Contours contours_;
};

} // namespace

std::vector<Vec3> moved_positions(const Mesh& surface, const std::vector<Vec3>& ways, double distance) {
    std::vector<Vec3> moved(surface.positions.size());
    parallel_for(moved.size(), [&](std::size_t v) { moved[v] = surface.positions[v] + ways[v] * distance; });
    return moved;
}

RedrawnFlats redrawn_flats(const Mesh& surface, const std::vector<Vec3>& moved,
                           std::vector<std::uint8_t>& turned) {
    RedrawnFlats r;
    if (std::find(turned.begin(), turned.end(), 1) == turned.end()) return r;
    PatchSearch search(surface);
    for (const Patch& patch : search.run(turned)) {
        MovedPatch flat(surface, patch, search, moved);
        const auto triangles = flat.triangulated();
        if (!triangles) continue;
        for (const Index f : patch.faces) turned[f] = 0;
        if (patch.faces.size() == 1 && flat.has_edges(surface.face_size(patch.faces[0])))
            continue; // a polygon's triangles follow its corners
        r.replaced.resize(surface.face_count());
        for (const Index f : patch.faces) r.replaced[f] = 1;
        r.triangles.insert(r.triangles.end(), triangles->begin(), triangles->end());
        r.source.resize(r.triangles.size(), patch.faces[0]);
    }
    return r;
}

} // namespace facetmill
