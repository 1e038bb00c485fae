#include "geometry/hull/cut_sweep.hpp"

#include "geometry/hull/enclosing.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

namespace facetmill {

namespace {

/// The distinct points in order, each moved by less than 2^-20.
std::vector<Vec3> moved_apart(std::vector<Vec3> points) {
    const auto key = [](const Vec3& p) { return std::tie(p.x, p.y, p.z); };
    std::sort(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) { return key(a) < key(b); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::uint64_t state = 0;
    const auto next = [&] {
        state = state * 6364136223846793005U + 1442695040888963407U;
        return static_cast<double>(state >> 43U) * 0x1p-41; // 21 bits
    };
    for (Vec3& p : points)
        for (std::size_t k = 0; k < 3; ++k) p[k] += next();
    return points;
}

constexpr std::size_t directions = 98; ///< whole coordinates from -2 to 2, no multiples of others
const std::array<Vec3, directions>& all_directions() {
    static const auto all = [] {
        std::array<Vec3, directions> out;
        std::size_t n = 0;
        for (int i = 0; i < 125; ++i) {
            const Vec3 d{i % 5 - 2.0, i / 5 % 5 - 2.0, i / 25 - 2.0};
            const auto is_odd = [](double x) { return std::abs(x) == 1; };
            if (is_odd(d.x) || is_odd(d.y) || is_odd(d.z)) out.at(n++) = d;
        }
        return out;
    }();
    return all;
}

/// The points of a set that are farthest in some directions.
class Extremes {
  public:
    Extremes() { reach_.fill(-HUGE_VAL); }

    void add(const Vec3& p) {
        const auto& all = all_directions();
        for (std::size_t i = 0; i < directions; ++i) keep(i, dot(all[i], p), p);
    }
    void add(const Extremes& other) {
        for (std::size_t i = 0; i < directions; ++i) keep(i, other.reach_[i], other.points_[i]);
    }
    ConvexSurface hull() const { return convex_surface(moved_apart({points_.begin(), points_.end()})); }

  private:
    void keep(std::size_t i, double reach, const Vec3& p) {
        if (!(reach > reach_[i])) return;
        reach_[i] = reach;
        points_[i] = p;
    }

    std::array<double, directions> reach_{};
    std::array<Vec3, directions> points_{};
};

/// A connected component of a layer of cells: its cells, and the corners of its convex hull in the layer's
/// plane.
struct LayerComponent {
    std::vector<std::array<std::int32_t, 2>> cells;
    std::vector<FlatPoint> outline;
};

/// Finds the components of layers of a set across an axis.
class Layers {
  public:
    Layers(const SolidGrid& grid, std::span<const std::uint32_t> labels, const CellSet& set, std::size_t axis)
        : grid_(grid), labels_(labels), set_(set), k_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3),
          width_(set.box.high[u_] - set.box.low[u_]), height_(set.box.high[v_] - set.box.low[v_]),
          unseen_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}

    std::size_t size() const { return unseen_.size(); }
    std::size_t at(std::int32_t u, std::int32_t v) const {
        return static_cast<std::size_t>(u) + static_cast<std::size_t>(width_) * static_cast<std::size_t>(v);
    }
    /// Calls visit with the places of the cell and its eight neighbours.
    template <class Visit>
    void each_near(std::int32_t u, std::int32_t v, Visit&& visit) const {
        for (std::int32_t y = std::max(v - 1, 0); y <= std::min(v + 1, height_ - 1); ++y)
            for (std::int32_t x = std::max(u - 1, 0); x <= std::min(u + 1, width_ - 1); ++x) visit(at(x, y));
    }
    /// A corner of the outline on the lower or upper side of a layer.
    Vec3 corner(std::int32_t side, const FlatPoint& p) const {
        Vec3 out;
        out[k_] = side;
        out[u_] = p.x;
        out[v_] = p.y;
        return out;
    }
    std::vector<LayerComponent> components_of(std::int32_t layer) {
        Cell c{};
        c[k_] = layer;
        for (std::int32_t v = 0; v < height_; ++v) {
            c[v_] = set_.box.low[v_] + v;
            for (std::int32_t u = 0; u < width_; ++u) {
                c[u_] = set_.box.low[u_] + u;
                unseen_[at(u, v)] = labels_[grid_.index(c)] == set_.label;
            }
        }
        std::vector<LayerComponent> components;
        for (std::size_t i = 0; i < unseen_.size(); ++i)
            if (unseen_[i]) components.push_back(component_from(i));
        return components;
    }

  private:
    LayerComponent component_from(std::size_t first) {
        LayerComponent out;
        const auto add = [&](std::size_t i) {
            unseen_[i] = 0;
            const auto w = static_cast<std::size_t>(width_);
            out.cells.push_back({static_cast<std::int32_t>(i % w), static_cast<std::int32_t>(i / w)});
        };
        add(first);
        std::array<std::int32_t, 2> rows{height_, -1};
        for (std::size_t done = 0; done < out.cells.size(); ++done) {
            const auto [u, v] = out.cells[done];
            rows = {std::min(rows[0], v), std::max(rows[1], v)};
            each_near(u, v, [&](std::size_t near) {
                if (unseen_[near]) add(near);
            });
        }
        out.outline = outline_of(out.cells, rows);
        return out;
    }
    std::vector<FlatPoint> outline_of(const std::vector<std::array<std::int32_t, 2>>& cells,
                                      const std::array<std::int32_t, 2>& rows) const {
        std::vector<std::array<std::int32_t, 2>> ends(static_cast<std::size_t>(rows[1] - rows[0] + 1),
                                                      {width_, -1});
        for (const auto& [u, v] : cells) {
            auto& row = ends[static_cast<std::size_t>(v - rows[0])];
            row = {std::min(row[0], u), std::max(row[1], u)};
        }
        std::vector<FlatPoint> corners;
        corners.reserve(4 * ends.size());
        for (std::size_t i = 0; i < ends.size(); ++i)
            for (const std::int32_t y : {0, 1})
                for (const std::int32_t x : {ends[i][0], ends[i][1] + 1})
                    corners.push_back(
                        {static_cast<double>(set_.box.low[u_] + x),
                         static_cast<double>(set_.box.low[v_] + rows[0] + y) + static_cast<double>(i), none});
        return flat_hull(std::move(corners));
    }

    const SolidGrid& grid_;
    std::span<const std::uint32_t> labels_;
    CellSet set_;
    std::size_t k_, u_, v_;
    std::int32_t width_, height_;
    std::vector<std::uint8_t> unseen_; ///< [cells of a layer]
};

/// Sweeps over the layers of a set along an axis, and keeps the extremes of the connected components so far.
class LayerSweep {
  public:
    explicit LayerSweep(Layers& layers) : layers_(layers), before_(layers.size(), none) {}

    /// Adds the layer of cells at this position.
    void add(std::int32_t layer) {
        const std::vector<LayerComponent> components = layers_.components_of(layer);
        join(components);
        const auto first = static_cast<Index>(active_.size());
        std::vector<Index> number(root_.size(), none); // of the component with this root
        std::vector<Component> next;
        for (Index c = 0; c < components.size(); ++c) {
            Index& n = number[find(first + c)];
            if (n == none) {
                n = static_cast<Index>(next.size());
                next.emplace_back();
            }
            next[n].cells += components[c].cells.size();
            for (const FlatPoint& p : components[c].outline)
                for (const std::int32_t side : {layer, layer + 1})
                    next[n].extremes.add(layers_.corner(side, p));
        }
        for (Index a = 0; a < first; ++a) {
            const Index n = number[find(a)];
            if (n == none) {
                finished_ += volume_of_component(active_[a]);
                continue;
            }
            next[n].extremes.add(active_[a].extremes);
            next[n].cells += active_[a].cells;
        }
        std::fill(before_.begin(), before_.end(), none);
        for (Index c = 0; c < components.size(); ++c)
            for (const auto& [u, v] : components[c].cells)
                before_[layers_.at(u, v)] = number[find(first + c)];
        active_ = std::move(next);
    }

    /// The number of components that the last layer touches.
    std::size_t active() const { return active_.size(); }
    /// The sum of the volumes of all hulls.
    double volume() const {
        double sum = finished_;
        for (const Component& c : active_) sum += volume_of_component(c);
        return sum;
    }

  private:
    struct Component {
        Extremes extremes;
        std::size_t cells = 0;
    };

    /// Joins the components of the layer with those of the last one that they touch.
    void join(const std::vector<LayerComponent>& components) {
        const auto first = static_cast<Index>(active_.size());
        root_.resize(first + components.size());
        for (Index i = 0; i < root_.size(); ++i) root_[i] = i;
        for (Index c = 0; c < components.size(); ++c)
            for (const auto& [u, v] : components[c].cells)
                layers_.each_near(u, v, [&](std::size_t at) {
                    if (before_[at] == none) return;
                    const Index a = find(before_[at]), b = find(first + c);
                    root_[std::max(a, b)] = std::min(a, b);
                });
    }
    Index find(Index i) {
        while (root_[i] != i) i = root_[i] = root_[root_[i]];
        return i;
    }
    static double volume_of_component(const Component& c) {
        constexpr std::size_t few = 64; // their hull hardly matters
        return c.cells <= few ? static_cast<double>(c.cells) : volume_of(c.extremes.hull());
    }

    Layers& layers_;
    std::vector<Index> before_; ///< [cells of a layer] the active component of the last layer
    std::vector<Component> active_;
    std::vector<Index> root_; ///< of active components, and then those of the layer
    double finished_ = 0;     ///< the volumes of components that ended before the last layer
};

/// Whether a sweep measures at this distance from the start of the set, with this many components.
bool is_tried(std::size_t distance, std::size_t active) {
    const std::size_t step = std::bit_ceil((active + 7) / 8);
    return distance % step == 0;
}

} // namespace

ConvexSurface hull_of_cells(const SolidGrid& grid, std::span<const std::uint32_t> labels,
                            const CellSet& set) {
    Layers layers(grid, labels, set, 2);
    std::vector<Vec3> points;
    for (std::int32_t l = set.box.low[2]; l < set.box.high[2]; ++l)
        for (const LayerComponent& component : layers.components_of(l))
            for (const FlatPoint& p : component.outline)
                for (const std::int32_t side : {l, l + 1}) points.push_back(layers.corner(side, p));
    return convex_surface(moved_apart(std::move(points)));
}

ConvexSurface simple_hull(std::span<const Vec3> points) {
    Extremes extremes;
    for (const Vec3& p : points) extremes.add(p);
    return extremes.hull();
}

GridCut best_cut(const SolidGrid& grid, std::span<const std::uint32_t> labels, const CellSet& set,
                 double hull_volume) {
    std::array<std::vector<double>, 6> sums; // by axis: below each plane, above it
    parallel_for(
        6,
        [&](std::size_t i) {
            const std::size_t k = i / 2;
            const bool upward = i % 2 == 0;
            const std::int32_t low = set.box.low[k], high = set.box.high[k];
            sums[i].assign(static_cast<std::size_t>(high - low + 1), HUGE_VAL);
            Layers layers(grid, labels, set, k);
            LayerSweep sweep(layers);
            for (std::int32_t l = 1; l < high - low; ++l) {
                sweep.add(upward ? low + l - 1 : high - l);
                const auto plane = static_cast<std::size_t>(upward ? l : high - low - l);
                if (is_tried(plane, sweep.active())) sums[i][plane] = sweep.volume();
            }
        },
        1);
    GridCut best;
    double least = HUGE_VAL;
    const double preference = 0.25 * std::max(0.0, hull_volume - static_cast<double>(set.cells));
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t n = sums[2 * k].size() - 1;
        for (std::size_t i = 1; i < n; ++i) {
            const double off = std::abs(2 * static_cast<double>(i) / static_cast<double>(n) - 1);
            const double left = sums[2 * k][i] + sums[2 * k + 1][i] - static_cast<double>(set.cells);
            const double cost = left + preference * off;
            if (cost >= least) continue;
            least = cost;
            best = {static_cast<int>(k), set.box.low[k] + static_cast<std::int32_t>(i)};
        }
    }
    if (best.axis >= 0) return best;
    for (std::size_t k = 0; k < 3; ++k) // too many components everywhere: the middle of the longest side
        if (const std::int32_t n = set.box.high[k] - set.box.low[k];
            n > 1 && (best.axis < 0 || n > set.box.high[static_cast<std::size_t>(best.axis)] -
                                               set.box.low[static_cast<std::size_t>(best.axis)]))
            best = {static_cast<int>(k), set.box.low[k] + n / 2};
    return best;
}

} // namespace facetmill
