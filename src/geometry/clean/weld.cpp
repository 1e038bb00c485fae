// The clean steps that merge vertices.
#include "base/math/numbers.hpp"
#include "geometry/clean/steps.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/spatial/box_tree.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <tuple>

namespace facetmill::clean_steps {

namespace {

/// Cancels merges at positions where the faces would be separated again into the same parts.
void spare_disjoint(const Mesh& mesh, std::vector<Index>& target) {
    Mesh merged;
    merged.positions = mesh.positions;
    merged.face_offsets = mesh.face_offsets;
    merged.corners.resize(mesh.corner_count());
    for (Index c = 0; c < mesh.corner_count(); ++c) merged.corners[c] = target[mesh.vertex(c)];
    const Fans fans = disjoint_fans(merged);
    // If old and new vertices match one to one in all corners at a position, a weld changes nothing there.
    std::vector<Index> new_of_old(mesh.vertex_count(), none),
        old_of_new(mesh.vertex_count() + fans.copies.size(), none);
    std::vector<std::uint8_t> differs(mesh.vertex_count(), 0);
    for (Index c = 0; c < mesh.corner_count(); ++c) {
        const Index v = mesh.vertex(c), w = fans.vertex_of_corner[c];
        if (new_of_old[v] == none) new_of_old[v] = w;
        if (old_of_new[w] == none) old_of_new[w] = v;
        if (new_of_old[v] != w || old_of_new[w] != v) differs[target[v]] = 1;
    }
    for (Index v = 0; v < target.size(); ++v) // isolated vertices merge in any case
        if (!differs[target[v]] && new_of_old[v] != none) target[v] = v;
    for (Index v = 0; v < target.size(); ++v)
        while (target[target[v]] != target[v]) target[v] = target[target[v]];
}

bool merge(Work& work, const std::vector<Index>& target, std::size_t CleanCounts::*count) {
    const std::size_t merged = merge_vertices(work.mesh, target);
    if (count) work.counts.*count += merged;
    return merged > 0;
}

/// Decides whether two vertices share a face, from lists of their faces' vertices.
class SharedFaces {
  public:
    explicit SharedFaces(const Mesh& mesh)
        : mesh_(mesh), corners_(corners_at_vertices(mesh)), faces_(corner_faces(mesh)) {}
    bool share(Index v, Index w) const {
        for (const Index c : corners_.of(v))
            for (Index d = mesh_.face_begin(faces_[c]); d < mesh_.face_end(faces_[c]); ++d)
                if (mesh_.vertex(d) == w) return true;
        return false;
    }

  private:
    const Mesh& mesh_;
    VertexLists corners_;
    std::vector<Index> faces_;
};

double squared(const Vec3& a) { return dot(a, a); }

Box around(const Vec3& p, double r) { return {p - Vec3{r, r, r}, p + Vec3{r, r, r}}; }

Index root(const std::vector<Index>& target, Index v) {
    while (target[v] != v) v = target[v];
    return v;
}

} // namespace

bool round_to_single(Work& work) {
    std::size_t moved = 0;
    for (Vec3& p : work.mesh.positions) {
        const Vec3 rounded = as_float32(p);
        if (p == rounded || !is_finite(rounded)) continue;
        p = rounded;
        ++moved;
    }
    work.counts.rounded_vertices += moved;
    return moved > 0;
}

bool weld_equal(Work& work, bool comes_apart) {
    auto target = lowest_at_place(work.mesh);
    bool any = false;
    for (Index v = 0; v < target.size() && !any; ++v) any = target[v] != v;
    if (!any) return false;
    if (comes_apart) spare_disjoint(work.mesh, target);
    return merge(work, target, &CleanCounts::welded_vertices);
}

bool weld_near(Work& work, double tolerance) {
    const Mesh& mesh = work.mesh;
    const auto& p = mesh.positions;
    std::vector<Box> boxes(p.size()); // boxes of the ends of boundary edges only
    for (const BoundaryEdge& e : boundary_edges(mesh)) {
        boxes[e.from].add(p[e.from]);
        boxes[e.to].add(p[e.to]);
    }
    const BoxTree tree(boxes);
    const SharedFaces faces(mesh);
    std::vector<Index> target(p.size());
    for (Index v = 0; v < p.size(); ++v) {
        target[v] = v;
        if (boxes[v].empty()) continue;
        double nearest = tolerance * tolerance;
        tree.visit(around(p[v], tolerance), [&](Index w) {
            const double d = squared(p[w] - p[v]);
            if (w >= v || target[w] != w || d > nearest || (d == nearest && w > target[v])) return;
            if (!(d > 0) || faces.share(v, w)) return; // weld_equal handles equal positions
            nearest = d;
            target[v] = w;
        });
    }
    // Two vertices that share no face with a third may share a face with each other. In that case, the later
    // vertex stays.
    std::vector<std::vector<Index>> members(p.size());
    for (Index v = 0; v < p.size(); ++v) {
        if (target[v] == v) continue;
        auto& mine = members[target[v]];
        if (std::any_of(mine.begin(), mine.end(), [&](Index w) { return faces.share(v, w); }))
            target[v] = v;
        else
            mine.push_back(v);
    }
    for (Index v = 0; v < p.size(); ++v) target[v] = root(target, v);
    return merge(work, target, &CleanCounts::welded_vertices);
}

bool stitch(Work& work, double tolerance) {
    const Mesh& mesh = work.mesh;
    const auto& p = mesh.positions;
    const auto open = boundary_edges(mesh);
    std::vector<Box> boxes(open.size());
    for (std::size_t i = 0; i < open.size(); ++i) boxes[i].add(p[open[i].from]);
    const BoxTree tree(boxes);
    struct Pair {
        double distance;
        Index a, b;
    };
    std::vector<Pair> pairs;
    const double limit = tolerance * tolerance;
    for (Index i = 0; i < open.size(); ++i)
        tree.visit(around(p[open[i].to], tolerance), [&](Index j) {
            const double d = squared(p[open[i].to] - p[open[j].from]),
                         e = squared(p[open[i].from] - p[open[j].to]);
            if (i < j && d <= limit && e <= limit) pairs.push_back({d + e, i, j});
        });
    std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
        return std::tie(x.distance, x.a, x.b) < std::tie(y.distance, y.a, y.b);
    });
    const SharedFaces faces(mesh);
    std::vector<Index> target(p.size());
    for (Index v = 0; v < p.size(); ++v) target[v] = v;
    std::vector<std::uint8_t> done(open.size(), 0);
    std::size_t count = 0;
    for (const Pair& pair : pairs) {
        if (done[pair.a] || done[pair.b]) continue;
        const Index ends[2][2] = {{root(target, open[pair.a].from), root(target, open[pair.b].to)},
                                  {root(target, open[pair.a].to), root(target, open[pair.b].from)}};
        bool fits = true;
        for (const auto& [v, w] : ends) fits = fits && (v == w || !faces.share(v, w));
        if (!fits) continue;
        for (const auto& [v, w] : ends)
            if (root(target, v) != root(target, w))
                target[std::max(root(target, v), root(target, w))] =
                    std::min(root(target, v), root(target, w));
        done[pair.a] = done[pair.b] = 1;
        ++count;
    }
    for (Index v = 0; v < p.size(); ++v) target[v] = root(target, v);
    if (!merge(work, target, nullptr)) return false;
    work.counts.stitched_edges += count;
    return true;
}

} // namespace facetmill::clean_steps
