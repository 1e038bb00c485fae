#include "geometry/hull/convex_parts.hpp"

#include "geometry/hull/cut_sweep.hpp"
#include "geometry/hull/enclosing.hpp"
#include "geometry/hull/merged_hulls.hpp"
#include "mesh/power_scale.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace facetmill {

namespace {

/// Hulls of cells have steps, so that even a convex solid has empty cells inside its hull.
constexpr double least_concavity = 1.5; // cells

/// Calls visit with each cell of the box.
template <class Visit>
void for_each_cell(const CellBox& box, Visit&& visit) {
    Cell c{};
    for (c[2] = box.low[2]; c[2] < box.high[2]; ++c[2])
        for (c[1] = box.low[1]; c[1] < box.high[1]; ++c[1])
            for (c[0] = box.low[0]; c[0] < box.high[0]; ++c[0]) visit(c);
}

bool contains(const CellBox& box, const Cell& c) {
    for (std::size_t k = 0; k < 3; ++k)
        if (c[k] < box.low[k] || c[k] >= box.high[k]) return false;
    return true;
}

/// Calls visit with the cell and its neighbours in the box.
template <class Visit>
void for_each_near(const Cell& c, const CellBox& box, Visit&& visit) {
    for (int i = 0; i < 27; ++i)
        if (const Cell near{c[0] + i % 3 - 1, c[1] + i / 3 % 3 - 1, c[2] + i / 9 - 1}; contains(box, near))
            visit(near);
}

/// A connected component of the solid between planes of cuts.
struct PartLeaf {
    CellBox region; ///< between the planes
    CellSet set;
    ConvexSurface hull; ///< in cells
    Voids voids;
    GridCut cut; ///< the best, if its hull is too concave
};

/// Cuts the solid into leaves.
class LeafCutter {
  public:
    LeafCutter(const SolidGrid& grid, double concavity)
        : grid_(grid), concavity_(concavity), labels_(grid.count()) {
        for (std::size_t i = 0; i < labels_.size(); ++i) labels_[i] = grid.solid(i) ? unlabelled : 0;
        const CellBox all{{0, 0, 0}, grid.cells()};
        add_leaves(all, all);
    }

    /// Cuts the most concave leaf. False if all are good enough, or cannot be cut.
    bool cut_worst() {
        std::size_t worst = leaves_.size();
        const auto key = [&](std::size_t i) {
            return std::tuple(leaves_[i].voids.distance, leaves_[i].voids.cells);
        };
        for (std::size_t i = 0; i < leaves_.size(); ++i)
            if (leaves_[i].cut.axis >= 0 && (worst == leaves_.size() || key(i) > key(worst))) worst = i;
        if (worst == leaves_.size()) return false;
        const PartLeaf leaf = std::move(leaves_[worst]);
        leaves_.erase(leaves_.begin() + static_cast<std::ptrdiff_t>(worst));
        for_each_cell(leaf.set.box, [&](const Cell& c) {
            std::uint32_t& label = labels_[grid_.index(c)];
            if (label == leaf.set.label) label = unlabelled;
        });
        const auto k = static_cast<std::size_t>(leaf.cut.axis);
        CellBox low = leaf.region, high = leaf.region;
        low.high[k] = high.low[k] = leaf.cut.corner;
        add_leaves(low, leaf.set.box);
        add_leaves(high, leaf.set.box);
        return true;
    }

    const std::vector<PartLeaf>& leaves() const { return leaves_; }
    const std::vector<std::uint32_t>& labels() const { return labels_; }

  private:
    static constexpr std::uint32_t unlabelled = UINT32_MAX;

    /// Turns the unlabelled cells of the region into leaves, one for each connected component. around: has
    /// these cells.
    void add_leaves(const CellBox& region, const CellBox& around) {
        CellBox box;
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = std::max(region.low[k], around.low[k]);
            box.high[k] = std::min(region.high[k], around.high[k]);
        }
        const std::size_t first = leaves_.size();
        for_each_cell(box, [&](const Cell& c) {
            if (labels_[grid_.index(c)] == unlabelled)
                leaves_.push_back({region, connected(c, box), {}, {}, {}});
        });
        parallel_for(
            leaves_.size() - first, [&](std::size_t i) { judge(leaves_[first + i]); }, 1);
    }
    /// Labels the unlabelled cells that are connected with this one in the box.
    CellSet connected(const Cell& first, const CellBox& box) {
        CellSet set{{first, first}, ++last_label_, 0};
        labels_[grid_.index(first)] = set.label;
        std::vector<Cell> stack{first};
        while (!stack.empty()) {
            const Cell c = stack.back();
            stack.pop_back();
            ++set.cells;
            for (std::size_t k = 0; k < 3; ++k) {
                set.box.low[k] = std::min(set.box.low[k], c[k]);
                set.box.high[k] = std::max(set.box.high[k], c[k] + 1);
            }
            for_each_near(c, box, [&](const Cell& near) {
                std::uint32_t& label = labels_[grid_.index(near)];
                if (label != unlabelled) return;
                label = set.label;
                stack.push_back(near);
            });
        }
        return set;
    }
    void judge(PartLeaf& leaf) const {
        leaf.hull = hull_of_cells(grid_, labels_, leaf.set);
        leaf.voids = voids_of(grid_, leaf.hull);
        if (leaf.voids.distance > concavity_)
            leaf.cut = best_cut(grid_, labels_, leaf.set, volume_of(leaf.hull));
    }

    const SolidGrid& grid_;
    double concavity_;                  ///< in cells
    std::vector<std::uint32_t> labels_; ///< [cells] the label of the cell's leaf; 0: not of the solid
    std::uint32_t last_label_ = 0;
    std::vector<PartLeaf> leaves_;
};

/// The part of a convex polygon on one side of a plane across an axis. sign: 1 keeps what is below.
void keep_side(std::vector<Vec3>& polygon, std::size_t axis, double at, double sign,
               std::vector<Vec3>& scratch) {
    scratch.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = sign * (a[axis] - at), db = sign * (b[axis] - at);
        if (da <= 0) scratch.push_back(a);
        if ((da < 0 && db > 0) || (da > 0 && db < 0)) {
            scratch.push_back(mix(a, b, da / (da - db)));
            scratch.back()[axis] = at;
        }
    }
    polygon.swap(scratch);
}

/// Collects the points of the surface in each leaf.
class LeafPoints {
  public:
    LeafPoints(const SolidGrid& grid, const LeafCutter& cutter, const Surface& surface)
        : grid_(grid), cutter_(cutter), surface_(surface), points_(cutter.leaves().size()) {
        std::vector<std::size_t> firsts; // the first leaf of each region
        for (std::size_t i = 0; i < points_.size(); ++i)
            if (first_in(leaf(i).region) == i) firsts.push_back(i);
        parallel_for(
            firsts.size(), [&](std::size_t i) { collect(leaf(firsts[i]).region); }, 1);
    }
    std::vector<std::vector<Vec3>> take() && { return std::move(points_); }

  private:
    const PartLeaf& leaf(std::size_t i) const { return cutter_.leaves()[i]; }
    std::size_t first_in(const CellBox& region) const {
        std::size_t i = 0;
        while (!(leaf(i).region == region)) ++i;
        return i;
    }
    void collect(const CellBox& region) {
        std::vector<std::size_t> inside;
        for (std::size_t i = 0; i < points_.size(); ++i)
            if (leaf(i).region == region) inside.push_back(i);
        Vec3 low, high; // of the region
        for (int k = 0; k < 3; ++k) {
            low[static_cast<std::size_t>(k)] = grid_.coordinate(k, region.low[static_cast<std::size_t>(k)]);
            high[static_cast<std::size_t>(k)] = grid_.coordinate(k, region.high[static_cast<std::size_t>(k)]);
        }
        std::vector<Vec3> polygon, scratch;
        for (std::size_t t = 0; t < surface_.size(); ++t) {
            const Vec3 &a = surface_.point(t, 0), &b = surface_.point(t, 1), &c = surface_.point(t, 2);
            if (!is_finite(a) || !is_finite(b) || !is_finite(c)) continue;
            polygon.assign({a, b, c});
            for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
                if (std::max({a[k], b[k], c[k]}) > high[k]) keep_side(polygon, k, high[k], 1, scratch);
                if (std::min({a[k], b[k], c[k]}) < low[k]) keep_side(polygon, k, low[k], -1, scratch);
            }
            if (!polygon.empty()) add(polygon, region, inside);
        }
        for (const std::size_t i : inside) reduce(points_[i]);
    }
    /// The cells that a piece touches are connected, so its first point decides.
    void add(const std::vector<Vec3>& polygon, const CellBox& region,
             const std::vector<std::size_t>& inside) {
        const Cell c = grid_.cell_at(polygon.front(), region);
        std::uint32_t label = label_of(c);
        if (label == 0)
            for_each_near(c, region, [&](const Cell& near) { label = std::max(label, label_of(near)); });
        for (const std::size_t i : inside)
            if (label == 0 || leaf(i).set.label == label) {
                points_[i].insert(points_[i].end(), polygon.begin(), polygon.end());
                if (points_[i].size() > most_points) reduce(points_[i]);
            }
    }
    std::uint32_t label_of(const Cell& c) const { return cutter_.labels()[grid_.index(c)]; }
    /// Keeps the corners of the hull, to save memory.
    static void reduce(std::vector<Vec3>& points) {
        if (points.size() > 256 && dimension_of(points) == HullDimension::space)
            points = convex_surface(points).points;
    }

    static constexpr std::size_t most_points = 100000;
    const SolidGrid& grid_;
    const LeafCutter& cutter_;
    const Surface& surface_;
    std::vector<std::vector<Vec3>> points_;
};

/// The size of cells for which the smallest concavity can be measured, or else for few cells.
double cell_size_for(const Box& box, double concavity, std::size_t cells) {
    double size = box.longest_side();
    const auto many = [&] {
        double product = 1;
        for (std::size_t k = 0; k < 3; ++k) product *= std::ceil(box.extent()[k] / size) + 3;
        return product;
    };
    const double smallest = box.longest_side() / 256;
    while (many() < static_cast<double>(cells) && size > smallest) size /= 1.05;
    return std::max(std::min(size, concavity / 2), smallest / 2);
}

/// The hull of the points as cells see it, and its largest distance from the solid.
double concavity_of(const SolidGrid& grid, const std::vector<Vec3>& points) {
    if (dimension_of(points) != HullDimension::space) return 0;
    ConvexSurface hull = convex_surface(points);
    for (Vec3& p : hull.points) p = grid.in_cells(p);
    return voids_of(grid, hull).distance * grid.cell_size();
}

/// Moves points to the nearest corners of a lattice.
void snap(std::vector<Vec3>& points, double pitch) {
    for (Vec3& p : points)
        for (std::size_t k = 0; k < 3; ++k) p[k] = std::floor(p[k] / pitch + 0.5) * pitch;
}

} // namespace

ConvexPartsResult convex_parts(const Mesh& mesh, const ConvexPartsSettings& settings) {
    ConvexPartsResult out;
    Surface surface = surface_of(mesh);
    const PowerScale scale = even_scale(surface.bounds()), back = scale.inverse();
    surface.positions = scale(surface.positions);
    const Box box = surface.bounds();
    if (!(box.diagonal() > 0)) return out;
    const double wanted = scale({settings.concavity, 0, 0}).x;
    SolidGrid grid(surface, cell_size_for(box, wanted, settings.cells), 4 * settings.cells);
    grid.measure_distances();
    const double concavity = std::max(wanted / grid.cell_size(), least_concavity);
    LeafCutter cutter(grid, concavity);
    const std::size_t most_leaves = 2 * settings.parts + 4;
    while (cutter.leaves().size() < most_leaves && cutter.cut_worst()) {
    }

    std::vector<MergedHull> hulls;
    hulls.reserve(cutter.leaves().size());
    for (std::size_t i = 0; i < cutter.leaves().size(); ++i)
        hulls.push_back({{i}, simple_hull(cutter.leaves()[i].hull.points), 0});
    for (MergedHull& hull : hulls) hull.volume = volume_of(hull.hull);
    merge_hulls(grid, hulls, {settings.parts, concavity});

    // Points closer than this merge, so that they still differ in the precision of files.
    const double pitch = std::ldexp(1, std::ilogb(box.diagonal()) - 20);
    auto points = LeafPoints(grid, cutter, surface).take();
    for (const MergedHull& hull : hulls) {
        ConvexPart part;
        for (const std::size_t i : hull.leaves)
            part.points.insert(part.points.end(), points[i].begin(), points[i].end());
        if (part.points.empty()) continue;
        snap(part.points, pitch);
        part.concavity = back({concavity_of(grid, part.points), 0, 0}).x;
        part.points = back(part.points);
        out.parts.push_back(std::move(part));
    }
    out.resolution = back({grid.cell_size(), 0, 0}).x;
    out.margin = back({pitch, 0, 0}).x; // twice the largest move of a coordinate
    return out;
}

} // namespace facetmill
