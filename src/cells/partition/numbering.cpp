#include "cells/partition/numbering.hpp"

#include "base/math/random.hpp"

#include <bit>

namespace facetmill::cells {

std::size_t Numbering::Hash::operator()(const Vertex& v) const {
    std::uint64_t hash = v.name;
    for (std::size_t axis = 0; axis < 3; ++axis)
        hash = hashed(hash, std::bit_cast<std::uint64_t>(v.position[axis] + 0.0)); // -0 equals 0
    return static_cast<std::size_t>(hash);
}

Numbering::Numbers Numbering::next(const Cell& cell) {
    if (leaf_ > 0) { // vertices with a home below the leaves' common node are done
        const std::size_t common = tree_.common_depth(leaf_ - 1, leaf_);
        for (std::size_t depth = common + 1; depth < known_.size(); ++depth) known_[depth].clear();
    }
    ++leaf_;
    Numbers numbers;
    numbers.of.resize(cell.home.size());
    for (Index v = 0; v < cell.home.size(); ++v) {
        if (cell.home[v] != Cell::inner) {
            if (known_.size() <= cell.home[v]) known_.resize(std::size_t{cell.home[v]} + 1);
            const auto [at, is_new] =
                known_[cell.home[v]].try_emplace({cell.names[v], cell.mesh.positions[v]}, count_);
            numbers.of[v] = at->second;
            if (!is_new) continue;
        } else {
            numbers.of[v] = count_;
        }
        ++count_;
        numbers.fresh.push_back(v);
    }
    return numbers;
}

} // namespace facetmill::cells
