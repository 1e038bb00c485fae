#include "geometry/spatial/face_tree.hpp"

#include "base/parallel.hpp"
#include "base/storage.hpp"
#include "geometry/spatial/median_order.hpp"

#include <algorithm>
#include <atomic>

namespace facetmill {

namespace {

bool is_finite(const Surface& surface, std::size_t t) {
    return facetmill::is_finite(surface.point(t, 0)) && facetmill::is_finite(surface.point(t, 1)) &&
           facetmill::is_finite(surface.point(t, 2));
}

/// The numbers of the triangles with finite corners, ascending.
std::vector<Index> finite_triangles(const Surface& surface) {
    std::vector<Index> kept;
    resize_large(kept, surface.size());
    std::atomic<bool> all = true;
    parallel_for(surface.size(), [&](std::size_t t) {
        kept[t] = static_cast<Index>(t);
        if (!is_finite(surface, t)) all = false;
    });
    if (!all) std::erase_if(kept, [&](Index t) { return !is_finite(surface, t); });
    return kept;
}

} // namespace

FaceTree::FaceTree(const Surface& surface, Use use) {
    const std::vector<Index> kept = finite_triangles(surface);
    if (kept.empty()) return;
    const Box all = surface.bounds();
    set_frame(all);
    std::vector<CentredItem> order;
    resize_large(order, kept.size());
    parallel_for(order.size(), [&](std::size_t i) {
        const Index t = kept[i];
        const Vec3 sum = local(surface.point(t, 0)) + local(surface.point(t, 1)) + local(surface.point(t, 2));
        order[i] = {{static_cast<float>(sum.x), static_cast<float>(sum.y), static_cast<float>(sum.z)}, t};
    });
    sort_in_median_order(order);
    resize_large(triangles, kept.size());
    resize_large(faces, kept.size());
    parallel_for(kept.size(), [&](std::size_t i) {
        const Index t = order[i].item;
        triangles[i] = {surface.point(t, 0), surface.point(t, 1), surface.point(t, 2)};
        faces[i] = surface.face(t);
    });

    build(triangles.size(), [&](Node& node, std::size_t slot, std::size_t i) {
        const auto& [a, b, c] = triangles[i];
        Box box;
        box.add(a);
        box.add(b);
        box.add(c);
        node.set(slot, local(box.min), local(box.max));
    });
    if (use == Use::all) flatten();
}

} // namespace facetmill
