#include "geometry/spatial/face_tree.hpp"

#include "geometry/spatial/dense_box.hpp"
#include "geometry/spatial/hilbert_curve.hpp"
#include "geometry/spatial/median_order.hpp"
#include "parallel/parallel.hpp"
#include "parallel/storage.hpp"

#include <algorithm>
#include <atomic>
#include <span>

namespace facetmill {

namespace {

bool is_finite(const Surface& surface, std::size_t t) {
    return facetmill::is_finite(surface.point(t, 0)) && facetmill::is_finite(surface.point(t, 1)) &&
           facetmill::is_finite(surface.point(t, 2));
}

/// Whether all vertices are finite, including vertices without faces.
bool is_finite(const Surface& surface) {
    std::atomic<bool> all = true;
    parallel_for(surface.positions.size(), [&](std::size_t v) {
        if (!facetmill::is_finite(surface.positions[v])) all = false;
    });
    return all;
}

/// The numbers of the triangles with finite corners, ascending.
std::vector<Index> finite_triangles(const Surface& surface) {
    std::vector<Index> kept;
    resize_large(kept, surface.size());
    parallel_for(surface.size(), [&](std::size_t t) { kept[t] = static_cast<Index>(t); });
    if (!is_finite(surface)) std::erase_if(kept, [&](Index t) { return !is_finite(surface, t); });
    return kept;
}

constexpr int coarse_run_bits = 3;
constexpr std::size_t node_run = 4; ///< number of triangles in a node

Box box_of_triangle(const Surface& surface, std::size_t t) {
    Box box;
    for (std::size_t k = 0; k < 3; ++k) box.add(surface.point(t, k));
    return box;
}

/// Whether consecutive triangles are neighbours in space, as in most files: runs of `length` triangles are
/// at most `near` times as long as a triangle. Tests a thousand runs. A run of eight is three times as long
/// in rows of a grid, and twice as long if sorted along a curve.
bool has_neighbours_in_runs(const Surface& surface, const std::vector<Index>& kept, std::size_t length,
                            double near) {
    const std::size_t runs = kept.size() / length;
    double of_runs = 0, of_triangles = 0;
    for (std::size_t run = 0; run < runs; run += runs / 1024 + 1) {
        Box all;
        double sum = 0;
        for (std::size_t i = run * length; i < (run + 1) * length; ++i) {
            const Box box = box_of_triangle(surface, kept[i]);
            all.add(box);
            sum += box.diagonal();
        }
        of_runs += all.diagonal();
        of_triangles += sum / static_cast<double>(length);
    }
    return of_runs <= near * of_triangles;
}

} // namespace

/// A frame of the region of most triangles, so that float32 separates them despite outliers. Rays need a
/// frame of everything.
void FaceTree::set_dense_frame(const Surface& surface, const Box& all, const std::vector<Index>& kept) {
    const Box dense = dense_box(kept.size(), all, [&](std::size_t i) { return surface.point(kept[i], 0); });
    constexpr double most = 1e20; // squares of this still fit float32
    const Vec3 whole = all.extent(), part = dense.extent();
    if (std::max({whole.x, whole.y, whole.z}) > most * std::max({part.x, part.y, part.z})) return;
    set_frame(dense);
    const Vec3 low = local(all.min), high = local(all.max);
    for (std::size_t axis = 0; axis < 3; ++axis) reach = std::max({reach, -low[axis], high[axis]});
}

std::vector<Index> FaceTree::in_median_order(const Surface& surface, const std::vector<Index>& kept) const {
    std::vector<CentredItem> order;
    resize_large(order, kept.size());
    parallel_for(order.size(), [&](std::size_t i) {
        const Index t = kept[i];
        const Vec3 sum = local(surface.point(t, 0)) + local(surface.point(t, 1)) + local(surface.point(t, 2));
        order[i] = {{static_cast<float>(sum.x), static_cast<float>(sum.y), static_cast<float>(sum.z)}, t};
    });
    sort_in_median_order(order);
    std::vector<Index> out;
    resize_large(out, order.size());
    parallel_for(out.size(), [&](std::size_t i) { out[i] = order[i].item; });
    return out;
}

std::vector<Index> FaceTree::along_curve(const Surface& surface, const std::vector<Index>& kept) const {
    const auto centre = [&](std::size_t i) {
        const Index t = kept[i];
        return (local(surface.point(t, 0)) + local(surface.point(t, 1)) + local(surface.point(t, 2))) / 3;
    };
    std::vector<Index> order = order_along_curve(kept.size(), {{-1, -1, -1}, {1, 1, 1}}, centre);
    parallel_for(order.size(), [&](std::size_t i) { order[i] = kept[order[i]]; });
    return order;
}

std::vector<Index> FaceTree::runs_along_curve(const Surface& surface, const std::vector<Index>& kept,
                                              std::size_t length) const {
    const std::size_t runs = kept.size() / length;
    const std::vector<Index> order = order_along_curve(runs, {{-1, -1, -1}, {1, 1, 1}}, [&](std::size_t run) {
        return local(surface.point(kept[run * length + length / 2], 0));
    });
    std::vector<Index> out = kept; // triangles too few for a run stay at the end
    parallel_for(runs, [&](std::size_t i) {
        for (std::size_t k = 0; k < length; ++k) out[i * length + k] = kept[order[i] * length + k];
    });
    return out;
}

std::vector<Index> FaceTree::in_order(const Surface& surface, const std::vector<Index>& kept, Use use) const {
    if (use != Use::coarse && use != Use::few) return in_median_order(surface, kept);
    // Runs of triangles are as good as single triangles if they are at most this many times as long.
    const std::size_t length = use == Use::coarse ? std::size_t{1} << coarse_run_bits : node_run;
    if (has_neighbours_in_runs(surface, kept, length, use == Use::coarse ? 6 : 3))
        return runs_along_curve(surface, kept, length);
    return along_curve(surface, kept);
}

FaceTree::FaceTree(const Surface& surface, Use use) { build_over(surface, surface.bounds(), use, true); }

FaceTree FaceTree::over(const Surface& surface, const Box& bounds, Use use) {
    FaceTree tree;
    tree.positions_ = surface.positions;
    tree.corners_ = surface.corners;
    tree.faces_ = surface.faces;
    tree.build_over(surface, bounds, use, false);
    return tree;
}

void FaceTree::build_over(const Surface& surface, const Box& all, Use use, bool keeps_triangles) {
    std::vector<Index> kept = finite_triangles(surface);
    if (kept.empty()) return;
    set_frame(all);
    const bool is_near = use == Use::near || use == Use::few || use == Use::coarse;
    if (use == Use::coarse) run_bits = coarse_run_bits;
    if (is_near) set_dense_frame(surface, all, kept);
    std::vector<Index> order = in_order(surface, kept, use);
    kept = {};
    if (keeps_triangles) {
        resize_large(triangles, order.size());
        resize_large(faces, order.size());
        parallel_for(order.size(), [&](std::size_t i) {
            const Index t = order[i];
            triangles[i] = {surface.point(t, 0), surface.point(t, 1), surface.point(t, 2)};
            faces[i] = surface.face(t);
        });
    }
    if (is_near) sources = std::move(order);

    build(run_count(), [&](Node& node, std::size_t slot, std::size_t run) {
        Box box;
        for (std::size_t i = run << run_bits; i < std::min((run + 1) << run_bits, size()); ++i) {
            const auto [a, b, c] = triangle(i);
            box.add(a);
            box.add(b);
            box.add(c);
        }
        node.set(slot, local(box.min), local(box.max));
    });
    if (use == Use::all) flatten();
}

// The part of the tree that follows the surface: plates and patches.

namespace {

using Patches = FaceTree::Patches;
using Plates = FaceTree::Plates;

/// Two unit vectors perpendicular to a unit vector and to each other.
std::array<Vec3, 2> across(const Vec3& n) {
    const Vec3 u = normalised(cross(n, std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    return {u, cross(n, u)};
}

/// The unit vector in the direction of v, or `otherwise` if v is too short.
Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
    const double square = dot(v, v);
    return square > 1e-280 ? v / std::sqrt(square) : otherwise;
}

void clear(Plates& plates, std::size_t slot) {
    plates.offset[slot] = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        plates.normal[axis][slot] = 0;
        plates.reach[axis][slot] = -HUGE_VALF;
        for (std::size_t k = 0; k < 3; ++k) plates.beyond[axis][k][slot] = 0;
    }
}

void clear(Patches& patches, std::size_t slot) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        patches.centre[axis][slot] = 0;
        patches.half[axis][slot] = -HUGE_VALF;
        for (std::size_t k = 0; k < 3; ++k) patches.axis[axis][k][slot] = 0;
    }
}

/// The possible float32 error at points outside the frame (see FaceTree::reach). Queries only know the
/// frame.
double beyond_frame(const Vec3& p) {
    const double far = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return far > 2 ? far * 0x1p-18 : 0;
}

/// a, b and c are in the tree's frame. Any normal gives half spaces that contain the triangle; a sliver's
/// normal is imprecise.
void set(Plates& plates, std::size_t slot, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 area = cross(b - a, c - a), edges[] = {b - a, c - b, a - c};
    const Vec3& longest =
        *std::max_element(std::begin(edges), std::end(edges),
                          [](const Vec3& x, const Vec3& y) { return dot(x, x) < dot(y, y); });
    Vec3 normal = unit_or(area, across(unit_or(longest, {0, 0, 1}))[0]);
    // The corners of a sliver differ along its normal, so the plane gives no information.
    const double na = dot(normal, a), nb = dot(normal, b), nc = dot(normal, c);
    const auto [low, high] = std::minmax({na, nb, nc});
    const double error = std::max({beyond_frame(a), beyond_frame(b), beyond_frame(c)});
    const bool flat = high - low < 1e-8 && error == 0;
    plates.offset[slot] = flat ? static_cast<float>((low + high) / 2) : 0;
    for (std::size_t k = 0; k < 3; ++k) plates.normal[k][slot] = flat ? static_cast<float>(normal[k]) : 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 beyond = unit_or(cross(edges[i], normal), {});
        for (std::size_t k = 0; k < 3; ++k) plates.beyond[i][k][slot] = static_cast<float>(beyond[k]);
        plates.reach[i][slot] =
            rounded_up(std::max({dot(beyond, a), dot(beyond, b), dot(beyond, c)}) + error);
    }
}

/// Sums over the corners of triangles, and over their area vectors.
struct Moments {
    Vec3 normal, sum;
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, count = 0;

    void add(const Vec3& p) {
        sum += p;
        xx += p.x * p.x;
        xy += p.x * p.y;
        xz += p.x * p.z;
        yy += p.y * p.y;
        yz += p.y * p.z;
        zz += p.z * p.z;
        count += 1;
    }
    void add(const Moments& m) {
        normal += m.normal;
        sum += m.sum;
        xx += m.xx;
        xy += m.xy;
        xz += m.xz;
        yy += m.yy;
        yz += m.yz;
        zz += m.zz;
        count += m.count;
    }
    /// The covariance times v.
    Vec3 spread(const Vec3& v) const {
        return Vec3{xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z,
                    xz * v.x + yz * v.y + zz * v.z} -
               sum * (dot(sum, v) / count);
    }
};

/// The axes: two principal axes perpendicular to the mean normal, then the mean normal.
std::array<Vec3, 3> axes_of(const Moments& m) {
    const Vec3 normal = unit_or(m.normal, {0, 0, 1});
    const auto [u, v] = across(normal);
    const Vec3 su = m.spread(u), sv = m.spread(v);
    const double uu = dot(u, su), uv = dot(v, su), vv = dot(v, sv);
    const double difference = (uu - vv) / 2, root = std::sqrt(difference * difference + uv * uv);
    // The longer of two forms of the same eigenvector.
    const Vec3 major =
        unit_or(difference >= 0 ? u * (difference + root) + v * uv : u * uv + v * (root - difference), u);
    return {major, cross(normal, major), normal};
}

void set(Patches& patches, std::size_t slot, const FaceTree& tree, const std::array<Vec3, 3>& axes,
         std::size_t first, std::size_t last) {
    double low[] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    double error = 0;
    for (std::size_t t = first; t < last; ++t) {
        const auto [a, b, c] = tree.triangle(t);
        for (const Vec3* p : {&a, &b, &c}) {
            const Vec3 at = tree.local(*p);
            error = std::max(error, beyond_frame(at));
            for (std::size_t i = 0; i < 3; ++i) {
                const double x = dot(at, axes[i]);
                low[i] = x < low[i] ? x : low[i];
                high[i] = x > high[i] ? x : high[i];
            }
        }
    }
    Vec3 centre;
    for (std::size_t i = 0; i < 3; ++i) centre += axes[i] * ((low[i] + high[i]) / 2);
    for (std::size_t i = 0; i < 3; ++i) {
        patches.centre[i][slot] = static_cast<float>(centre[i]);
        for (std::size_t k = 0; k < 3; ++k) patches.axis[i][k][slot] = static_cast<float>(axes[i][k]);
        patches.half[i][slot] = rounded_up((high[i] - low[i]) / 2 + error);
    }
}

/// The plates of four triangles, and their moments.
Moments flatten_leaf(const FaceTree& tree, std::size_t n, Plates& plates) {
    Moments m;
    for (std::size_t slot = 0; slot < 4; ++slot) {
        const std::size_t t = 4 * n + slot;
        if (t >= tree.size()) {
            clear(plates, slot);
            continue;
        }
        const auto corners = tree.triangle(t);
        const Vec3 a = tree.local(corners.a), b = tree.local(corners.b), c = tree.local(corners.c);
        set(plates, slot, a, b, c);
        m.normal += cross(b - a, c - a);
        m.add(a);
        m.add(b);
        m.add(c);
    }
    return m;
}

} // namespace

void FaceTree::flatten() {
    constexpr std::size_t chunk = 1024;
    resize_large(plates, (this->size() + 3) / 4);
    std::vector<Moments> moments(plates.size());
    parallel_for(
        plates.size(), [&](std::size_t n) { moments[n] = flatten_leaf(*this, n, plates[n]); }, chunk);
    patch_levels = std::min(2, height() - 1);
    for (int level = 1; level <= patch_levels; ++level) {
        const std::size_t size = std::size_t{1} << 2 * level; // number of triangles below a child
        const std::size_t begin = patches.size(), children = moments.size();
        patch_begin.push_back(begin);
        patches.resize(begin + (children + 3) / 4);
        std::vector<Moments> above((children + 3) / 4);
        parallel_for(
            above.size(),
            [&](std::size_t n) {
                for (std::size_t slot = 0; slot < 4; ++slot) {
                    const std::size_t child = 4 * n + slot;
                    if (child >= children) {
                        clear(patches[begin + n], slot);
                        continue;
                    }
                    const std::size_t first = child * size, last = std::min(first + size, this->size());
                    set(patches[begin + n], slot, *this, axes_of(moments[child]), first, last);
                    above[n].add(moments[child]);
                }
            },
            std::max<std::size_t>(1, chunk >> 2 * (level - 1)));
        moments = std::move(above);
    }
}

} // namespace facetmill
