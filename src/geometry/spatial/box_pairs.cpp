#include "geometry/spatial/box_pairs.hpp"

#include "geometry/spatial/box_tree.hpp"
#include "geometry/spatial/hilbert_curve.hpp"

namespace facetmill {

BoxPairs::BoxPairs(std::span<const Box> boxes, std::span<const std::uint8_t> among, const Box& frame) {
    all_ = box_of_all(boxes);
    all_.add(frame);
    items_ = order_along_curve(boxes.size(), all_, [&](std::size_t i) {
        return boxes[i].empty() ? all_.min : boxes[i].min * 0.5 + boxes[i].max * 0.5;
    });
    build(boxes);
    choose(among);
}

void BoxPairs::set(Node& node, std::size_t slot, const Box& box) const {
    if (box.empty())
        node.clear(slot);
    else
        node.set(slot, levels_.local(box.min), levels_.local(box.max));
}

void BoxPairs::build(std::span<const Box> boxes) {
    if (all_.empty()) return;
    levels_.set_frame(all_);
    levels_.build(items_.size(),
                  [&](Node& node, std::size_t slot, std::size_t i) { set(node, slot, boxes[items_[i]]); });
}

void BoxPairs::move_to(std::span<const Box> boxes, std::span<const std::uint8_t> moved) {
    if (moved.empty() || levels_.height() == 0) {
        all_.add(box_of_all(boxes));
        return build(boxes);
    }
    levels_.update(
        items_.size(), [&](std::size_t i) { return moved[items_[i]] != 0; },
        [&](Node& node, std::size_t slot, std::size_t i) { set(node, slot, boxes[items_[i]]); });
}

void BoxPairs::choose(std::span<const std::uint8_t> among) {
    flags_.clear();
    if (among.empty() || levels_.height() == 0) return;
    flags_.emplace_back(items_.size());
    parallel_for(items_.size(), [&](std::size_t i) { flags_[0][i] = among[items_[i]]; });
    while (flags_.size() < static_cast<std::size_t>(levels_.height())) {
        const auto& below = flags_.back();
        std::vector<std::uint8_t> flags((below.size() + 3) / 4, 0);
        for (std::size_t i = 0; i < below.size(); ++i) flags[i / 4] |= below[i];
        flags_.push_back(std::move(flags));
    }
}

std::vector<BoxPairs::Couple> BoxPairs::couples_above() const {
    constexpr std::size_t enough = 4096;
    std::vector<Couple> couples;
    if (levels_.height() == 0) return couples;
    couples.push_back({levels_.height() - 1, 0, 0});
    while (couples[0].level > 0 && couples.size() < enough) {
        std::vector<Couple> below;
        for (const Couple& c : couples)
            children(c, [&](std::uint32_t s, std::uint32_t four, unsigned bits) {
                for (; bits != 0; bits &= bits - 1)
                    below.push_back({c.level - 1, s, four + static_cast<std::uint32_t>(lowest(bits))});
            });
        if (below.empty()) return below;
        couples = std::move(below);
    }
    return couples;
}

} // namespace facetmill
