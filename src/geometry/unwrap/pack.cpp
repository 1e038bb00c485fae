#include "geometry/unwrap/pack.hpp"

#include "base/error.hpp"
#include "base/text/readable_numbers.hpp"
#include "geometry/unwrap/cell_mask.hpp"
#include "parallel/parallel.hpp"

#include <bit>
#include <fmt/format.h>
#include <numeric>

namespace facetmill::unwrap_room {

namespace {

constexpr std::size_t most_cells = 4096; // along the side of the square
constexpr std::size_t most_texels = 16384;
constexpr double tall = 1.5; // heights above this share of the width need not be exact
/// Few charts are packed in several orders and to a finer scale, since it takes little time.
constexpr std::size_t few_charts = 300;

/// The largest size of charts that are tried at every height; larger charts skip some.
constexpr std::size_t fine_steps = 32;

class Strip {
  public:
    Strip(const std::vector<PackItem>& items, const std::vector<Index>& order, std::size_t width,
          std::size_t gutter)
        : items_(items), order_(order), width_(width), gutter_(gutter), margin_((gutter + 1) / 2),
          cells_(width), first_height_(64 * 64) {}

    /// Places all items at a scale, and returns the height, or a larger number if that is above `limit`.
    std::size_t pack(double scale, std::size_t limit, std::vector<PackedItem>& placed) {
        placed.assign(items_.size(), {});
        std::size_t height = 0;
        double done = 0, all = 0;
        for (const PackItem& item : items_) all += item.area;
        for (const Index i : order_) {
            touch_cells(items_[i].corners, items_[i].points, scale, turned_[0]);
            if (std::max(turned_[0].width, turned_[0].height) + 2 * margin_ > 2 * limit) return SIZE_MAX;
            placed[i] = place();
            if (placed[i].width == 0) return SIZE_MAX;
            const CellMask& mask = turned_[placed[i].turns];
            height = std::max(height, placed[i].y + mask.height + margin_);
            done += items_[i].area;
            if (height > limit) {
                const double share = all > 0 ? std::max(done / all, 0.05) : 1;
                return static_cast<std::size_t>(static_cast<double>(height) / std::sqrt(share)) + 1;
            }
            cells_.take(mask, placed[i].x, placed[i].y, gutter_);
        }
        return height;
    }

  private:
    PackedItem place() {
        for (std::size_t k = 1; k < 4; ++k) quarter_turn(turned_[k - 1], turned_[k]);
        PackedItem best;
        std::size_t lowest = SIZE_MAX;
        const bool small = std::max(turned_[0].width, turned_[0].height) <= 4;
        for (int turns = 0; turns < (small ? 2 : 4); ++turns) {
            const CellMask& mask = turned_[turns];
            if (mask.width + 2 * margin_ > width_) continue;
            const std::size_t last = width_ - margin_ - mask.width;
            const std::size_t step = std::max<std::size_t>(1, mask.height / fine_steps);
            std::size_t& first = first_height_[size_class(mask)];
            for (std::size_t y = std::max(margin_, first); y + mask.height < lowest; y += step) {
                const std::size_t x = cells_.free_place(mask, margin_, last, y);
                if (x == SIZE_MAX) continue;
                lowest = y + mask.height;
                best = {turns, x, y, turned_[0].width, turned_[0].height};
                first = y;
                break;
            }
        }
        return best;
    }

    /// Charts of similar size have the same class. The places before the last chart of a class count as full.
    static std::size_t size_class(const CellMask& mask) {
        const auto steps = [](std::size_t n) {
            const auto bits = static_cast<std::size_t>(std::bit_width(n));
            return 4 * bits + (bits > 2 ? n >> (bits - 3) & 3 : 0);
        };
        return std::min<std::size_t>(63, steps(mask.width)) * 64 +
               std::min<std::size_t>(63, steps(mask.height));
    }

    const std::vector<PackItem>& items_;
    const std::vector<Index>& order_;
    const std::size_t width_, gutter_, margin_;
    OccupiedCells cells_;
    std::vector<std::size_t> first_height_; ///< [classes] where the search starts
    CellMask turned_[4];
};

enum class Order { by_length, by_area, by_height };

std::vector<Index> largest_first(const std::vector<PackItem>& items, Order by) {
    std::vector<Index> order(items.size());
    std::iota(order.begin(), order.end(), Index{0});
    const auto first = [&](const PackItem& p) {
        return by == Order::by_length ? p.size.x : by == Order::by_area ? p.area : p.size.y;
    };
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        const PackItem &p = items[a], &q = items[b];
        if (first(p) != first(q)) return first(p) > first(q);
        return p.area != q.area ? p.area > q.area : a < b;
    });
    return order;
}

[[noreturn]] void fail(std::size_t charts, std::size_t texture, const UnwrapSettings& s) {
    throw Error(
        ErrorKind::limit, "E-UNWRAP-FULL",
        s.texels_per_unit > 0
            ? fmt::format("unwrap: {} charts at this texel density need more than {} x {} texels",
                          grouped(charts), texture, texture)
            : fmt::format("unwrap: {} charts do not fit into {} x {} texels with a gutter of {}",
                          grouped(charts), texture, texture, s.gutter),
        s.texels_per_unit > 0
            ? "use fewer texels_per_m"
            : "use a larger texture or a smaller gutter; clean joins vertices at the same place, which "
              "gives fewer charts");
}

class Packer {
  public:
    Packer(const std::vector<PackItem>& items, const UnwrapSettings& settings, Order order)
        : items_(items), settings_(settings), order_(largest_first(items, order)) {
        for (const PackItem& item : items) {
            area_ += item.area;
            longest_ = std::max(longest_, item.size.x);
        }
    }

    Packing into_square(std::size_t texture) {
        use(texture);
        if (!can_fit()) fail(items_.size(), texture, settings_);
        double fits = 0, fails = HUGE_VAL;
        double scale = static_cast<double>(side_) * std::sqrt(0.6 / area_);
        scale = std::min(scale, static_cast<double>(side_) / (0.72 * longest_));
        Packing best;
        const bool few = items_.size() <= few_charts;
        const int search_rounds = few ? 12 : 7;
        const double close = few ? 1.004 : 1.01; // ratio of scales at which the search ends
        for (int round = 0; round < 40; ++round) {
            Packing packing;
            const std::size_t height = pack(scale, packing.items);
            if (height <= side_) {
                fits = scale;
                best = std::move(packing);
                best.scale = scale;
            } else {
                fails = scale;
            }
            if (fits > 0 && (round >= search_rounds || fails / fits < close)) break;
            const double step = std::sqrt(static_cast<double>(side_) / static_cast<double>(height));
            double next = scale * (height == SIZE_MAX ? 0.7 : std::clamp(step, 0.5, 2.0) * 0.997);
            if (fits > 0 && fails < HUGE_VAL && !(next > fits * 1.002 && next < fails * 0.998))
                next = (fits + fails) / 2;
            if (!(next > 0) || next * longest_ < 1e-6) fail(items_.size(), texture, settings_);
            scale = next;
        }
        if (!(fits > 0)) fail(items_.size(), texture, settings_);
        best.texture = texture;
        best.cell = cell_;
        return best;
    }

    Packing at_density(double texels) {
        const double least = std::max(std::sqrt(area_) * texels, 1.0);
        for (std::size_t texture = 16; texture <= most_texels; texture *= 2) {
            if (static_cast<double>(texture) < least) continue;
            use(texture);
            if (!can_fit()) continue;
            Packing packing;
            packing.scale = texels / static_cast<double>(cell_);
            if (pack(packing.scale, packing.items) > side_) continue;
            packing.texture = texture;
            packing.cell = cell_;
            return packing;
        }
        fail(items_.size(), most_texels, settings_);
    }

  private:
    void use(std::size_t texture) {
        cell_ = (texture + most_cells - 1) / most_cells;
        side_ = texture / cell_;
        gutter_ = (settings_.gutter + cell_ - 1) / cell_;
    }

    /// Every chart takes at least a cell and its gutter.
    bool can_fit() const {
        const auto cells = static_cast<double>(gutter_ + 1), side = static_cast<double>(side_ + gutter_);
        return static_cast<double>(items_.size()) * cells * cells <= side * side;
    }

    std::size_t pack(double scale, std::vector<PackedItem>& placed) {
        if (!(scale * longest_ < 4.0 * static_cast<double>(side_))) return SIZE_MAX;
        const auto limit = static_cast<std::size_t>(tall * static_cast<double>(side_));
        return Strip(items_, order_, side_, gutter_).pack(scale, limit, placed);
    }

    const std::vector<PackItem>& items_;
    const UnwrapSettings& settings_;
    const std::vector<Index> order_;
    double area_ = 0, longest_ = 0;
    std::size_t side_ = 0, cell_ = 1, gutter_ = 0; ///< in cells; the cell in texels
};

} // namespace

Vec2 Packing::place(const PackedItem& item, const Vec2& point) const {
    Vec2 p = point * scale + Vec2{cell_slack, cell_slack};
    auto w = static_cast<double>(item.width), h = static_cast<double>(item.height);
    for (int i = 0; i < item.turns; ++i) {
        p = {h - p.y, p.x};
        std::swap(w, h);
    }
    p = p + Vec2{static_cast<double>(item.x), static_cast<double>(item.y)};
    return p * static_cast<double>(cell);
}

Packing pack(const std::vector<PackItem>& items, const UnwrapSettings& settings) {
    if (settings.texels_per_unit > 0)
        return Packer(items, settings, Order::by_length).at_density(settings.texels_per_unit);
    std::vector<Order> orders{Order::by_length};
    if (items.size() <= few_charts) orders = {Order::by_length, Order::by_area, Order::by_height};
    std::vector<Packing> packings(orders.size());
    parallel_for(
        orders.size(),
        [&](std::size_t i) {
            packings[i] = Packer(items, settings, orders[i]).into_square(settings.texture);
        },
        1);
    return *std::max_element(packings.begin(), packings.end(),
                             [](const Packing& a, const Packing& b) { return a.scale < b.scale; });
}

} // namespace facetmill::unwrap_room
