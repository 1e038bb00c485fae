#include "geometry/unwrap/cell_mask.hpp"

#include <bit>

namespace facetmill::unwrap_room {

void CellMask::reset(std::size_t w, std::size_t h) {
    width = w;
    height = h;
    words = (w + 63) / 64;
    bits.assign(words * h, 0);
}

void CellMask::set_run(std::size_t begin, std::size_t end, std::size_t y) {
    for (std::size_t x = begin; x < end;) {
        const std::size_t n = std::min<std::size_t>(end - x, 64 - x % 64);
        const std::uint64_t run = n == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << n) - 1;
        bits[y * words + x / 64] |= run << (x % 64);
        x += n;
    }
}

namespace {

/// The range of x of a triangle between two heights.
struct Span {
    double low = HUGE_VAL, high = -HUGE_VAL;
    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
};

Span span_between(const Vec2* p, double bottom, double top) {
    Span span;
    for (int i = 0; i < 3; ++i) {
        Vec2 a = p[i], b = p[(i + 1) % 3];
        if (a.y > b.y) std::swap(a, b);
        if (b.y < bottom || a.y > top) continue;
        const double dy = b.y - a.y;
        const auto x_at = [&](double y) { return dy > 0 ? a.x + (b.x - a.x) * ((y - a.y) / dy) : a.x; };
        span.add(a.y >= bottom ? a.x : x_at(bottom));
        span.add(b.y <= top ? b.x : x_at(top));
    }
    return span;
}

std::size_t cell_of(double x, std::size_t size) {
    return x > 0 ? std::min(static_cast<std::size_t>(x), size - 1) : 0;
}

} // namespace

void touch_cells(const std::vector<Index>& corners, const std::vector<Vec2>& points, double scale,
                 CellMask& mask) {
    Vec2 most;
    for (const Vec2& p : points) most = {std::max(most.x, p.x * scale), std::max(most.y, p.y * scale)};
    mask.reset(static_cast<std::size_t>(most.x + 2 * cell_slack) + 1,
               static_cast<std::size_t>(most.y + 2 * cell_slack) + 1);
    for (std::size_t t = 0; t < corners.size(); t += 3) {
        Vec2 p[3];
        for (std::size_t i = 0; i < 3; ++i)
            p[i] = points[corners[t + i]] * scale + Vec2{cell_slack, cell_slack};
        const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
        const std::size_t first = cell_of(low - cell_slack, mask.height),
                          last = cell_of(high + cell_slack, mask.height);
        for (std::size_t y = first; y <= last; ++y) {
            const auto bottom = static_cast<double>(y);
            const Span s = first == last
                               ? Span{std::min({p[0].x, p[1].x, p[2].x}), std::max({p[0].x, p[1].x, p[2].x})}
                               : span_between(p, bottom - cell_slack, bottom + 1 + cell_slack);
            if (s.low <= s.high)
                mask.set_run(cell_of(s.low - cell_slack, mask.width),
                             cell_of(s.high + cell_slack, mask.width) + 1, y);
        }
    }
}

void quarter_turn(const CellMask& mask, CellMask& turned) {
    turned.reset(mask.height, mask.width);
    for (std::size_t y = 0; y < mask.height; ++y)
        for (std::size_t w = 0; w < mask.words; ++w)
            for (std::uint64_t left = mask.bits[y * mask.words + w]; left != 0; left &= left - 1)
                turned.set(mask.height - 1 - y, 64 * w + static_cast<std::size_t>(std::countr_zero(left)));
}

std::uint64_t OccupiedCells::word_at(std::size_t bit, std::size_t y) const {
    const std::uint64_t* row = &bits_[y * words_ + bit / 64];
    const std::size_t shift = bit % 64;
    return shift == 0 ? row[0] : row[0] >> shift | row[1] << (64 - shift);
}

std::size_t OccupiedCells::end_of_run(std::size_t bit, std::size_t y) const {
    while (bit < width_) {
        const auto ones = static_cast<std::size_t>(std::countr_one(word_at(bit, y)));
        bit += ones;
        if (ones < 64) break;
    }
    return bit;
}

std::size_t OccupiedCells::after_collision(const CellMask& mask, std::size_t row, std::size_t x,
                                           std::size_t y) const {
    if (y + row >= rows_) return x;
    for (std::size_t w = 0; w < mask.words; ++w) {
        const std::uint64_t own = mask.bits[row * mask.words + w];
        if (own == 0) continue;
        const std::uint64_t both = own & word_at(x + 64 * w, y + row);
        if (both == 0) continue;
        // Until the run of the chart has passed the occupied run, the two meet.
        const auto bit = static_cast<std::size_t>(63 - std::countl_zero(both));
        const std::uint64_t gaps = ~own & (bit == 0 ? 0 : (std::uint64_t{1} << bit) - 1);
        const std::size_t start = gaps == 0 ? 0 : static_cast<std::size_t>(64 - std::countl_zero(gaps));
        return end_of_run(x + 64 * w + bit, y + row) - (64 * w + start);
    }
    return x;
}

std::size_t OccupiedCells::free_place(const CellMask& mask, std::size_t from, std::size_t last,
                                      std::size_t y) {
    for (std::size_t x = from; x <= last;) {
        // The row of the last collision most likely collides again.
        if (last_row_ >= mask.height) last_row_ = 0;
        std::size_t next = after_collision(mask, last_row_, x, y);
        for (std::size_t row = 0; row < mask.height && next == x; ++row) {
            next = after_collision(mask, row, x, y);
            if (next != x) last_row_ = row;
        }
        if (next == x) return x;
        x = next;
    }
    return SIZE_MAX;
}

void OccupiedCells::take(const CellMask& mask, std::size_t x, std::size_t y, std::size_t gutter) {
    const std::size_t top = y + mask.height + gutter;
    if (top > rows_) {
        rows_ = top;
        bits_.resize(rows_ * words_);
    }
    // Widens each row, then takes it into the rows around it.
    std::vector<std::uint64_t> row(words_);
    for (std::size_t r = 0; r < mask.height; ++r) {
        std::fill(row.begin(), row.end(), 0);
        std::size_t begin = 0;
        for (std::size_t c = 0; c <= mask.width; ++c) {
            const bool on = c < mask.width && mask.at(c, r);
            if (on && (c == 0 || !mask.at(c - 1, r))) begin = c;
            if (on || c == 0 || !mask.at(c - 1, r)) continue;
            const std::size_t low = x + begin - std::min(x + begin, gutter),
                              high = std::min(x + c + gutter, width_);
            for (std::size_t i = low; i < high; ++i) row[i / 64] |= std::uint64_t{1} << (i % 64);
        }
        for (std::size_t to = y + r - std::min(y + r, gutter); to <= y + r + gutter; ++to)
            for (std::size_t w = 0; w < words_; ++w) bits_[to * words_ + w] |= row[w];
    }
}

} // namespace facetmill::unwrap_room
