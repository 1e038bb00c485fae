#pragma once
// Numbers the vertices of all cells, each vertex once.

#include "cells/partition/partition.hpp"

#include <unordered_map>

namespace facetmill::cells {

/// Numbers vertices while the cells pass in the order of the leaves. It keeps only shared vertices that
/// later cells may have.
class Numbering {
  public:
    explicit Numbering(const Tree& tree) : tree_(tree) {}

    struct Numbers {
        std::vector<std::uint64_t> of; ///< [vertices] numbers
        std::vector<Index> fresh;      ///< vertices new to all cells so far, ascending: consecutive numbers
    };
    /// The cell must belong to the next leaf.
    Numbers next(const Cell& cell);
    std::uint64_t count() const { return count_; } ///< number of vertices so far

  private:
    struct Vertex {
        std::uint64_t name;
        Vec3 position;
        bool operator==(const Vertex&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Vertex& v) const;
    };

    const Tree& tree_;
    std::uint32_t leaf_ = 0;
    std::uint64_t count_ = 0;
    std::vector<std::unordered_map<Vertex, std::uint64_t, Hash>>
        known_; ///< shared vertices by the depth of their home
};

} // namespace facetmill::cells
