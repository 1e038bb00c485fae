#include "geometry/crop/piece_tree.hpp"

#include <algorithm>
#include <bit>
#include <utility>

namespace facetmill {

Index PieceTree::new_node() {
    if (free_.empty()) {
        nodes_.emplace_back();
        return static_cast<Index>(nodes_.size() - 1);
    }
    const Index node = free_.back();
    free_.pop_back();
    nodes_[node] = {};
    return node;
}

Index PieceTree::new_leaf(Index piece, const Bounds& box) {
    const Index node = new_node();
    nodes_[node].box = box;
    nodes_[node].piece = piece;
    pieces_[piece].node = node;
    return node;
}

void PieceTree::add_face(std::vector<Index> wedges, const Bounds& box) {
    pieces_.push_back({static_cast<Index>(roots_.size()), std::move(wedges), none});
    roots_.push_back(new_leaf(numbers() - 1, box));
}

/// Makes a node the root of a balanced tree over these leaves; a single leaf replaces the node.
void PieceTree::build(Index node, std::span<const Index> leaves) {
    nodes_[node].first = nodes_[node].second = nodes_[node].piece = none;
    nodes_[node].leaves = static_cast<Index>(leaves.size());
    if (leaves.empty()) return;
    if (leaves.size() == 1) {
        Node& leaf = nodes_[leaves[0]];
        nodes_[node].box = leaf.box;
        nodes_[node].piece = leaf.piece;
        pieces_[leaf.piece].node = node;
        free_.push_back(leaves[0]);
        return;
    }
    const std::size_t half = leaves.size() / 2;
    Bounds box;
    for (const auto part : {leaves.first(half), leaves.subspan(half)}) {
        const Index child = part.size() == 1 ? part[0] : new_node();
        if (part.size() > 1) build(child, part);
        nodes_[child].parent = node;
        (nodes_[node].first == none ? nodes_[node].first : nodes_[node].second) = child;
        box.add(nodes_[child].box);
    }
    nodes_[node].box = box;
}

void PieceTree::rebuild(Index node) {
    std::vector<Index> leaves, open{node};
    while (!open.empty()) {
        const Index n = open.back();
        open.pop_back();
        if (nodes_[n].piece != none)
            leaves.push_back(n);
        else if (n != node)
            free_.push_back(n);
        for (const Index child : {nodes_[n].second, nodes_[n].first})
            if (child != none) open.push_back(child);
    }
    build(node, leaves);
}

void PieceTree::widen(Index node, const Bounds& box) {
    for (; node != none; node = nodes_[node].parent) {
        Bounds& b = nodes_[node].box;
        if (b.x0 <= box.x0 && b.y0 <= box.y0 && b.x1 >= box.x1 && b.y1 >= box.y1) return;
        b.add(box);
    }
}

/// The lowest unbalanced node above a leaf that is too deep, or none. In an unbalanced node, one side has
/// more than two thirds of the leaves.
Index PieceTree::unbalanced_above(Index leaf) const {
    std::size_t depth = 0;
    Index root = leaf;
    for (; nodes_[root].parent != none; root = nodes_[root].parent) ++depth;
    if (depth <= 4 + 2 * static_cast<std::size_t>(std::bit_width(nodes_[root].leaves))) return none;
    for (Index n = leaf; nodes_[n].parent != none; n = nodes_[n].parent)
        if (3 * std::size_t{nodes_[n].leaves} > 2 * std::size_t{nodes_[nodes_[n].parent].leaves} + 2)
            return nodes_[n].parent;
    return root;
}

void PieceTree::replace(Index piece, std::span<std::vector<Index>> parts, std::span<const Bounds> boxes) {
    const Index node = std::exchange(pieces_[piece].node, none), face = pieces_[piece].face;
    pieces_[piece].wedges = {};
    const auto most = std::max_element(parts.begin(), parts.end(),
                                       [](const auto& a, const auto& b) { return a.size() < b.size(); });
    leaves_.clear();
    Bounds box;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const bool keeps_number = parts.begin() + static_cast<std::ptrdiff_t>(i) == most;
        if (!keeps_number) pieces_.push_back({face, std::move(parts[i]), none});
        leaves_.push_back(new_leaf(keeps_number ? piece : numbers() - 1, boxes[i]));
        box.add(boxes[i]);
    }
    if (!parts.empty()) pieces_[piece].wedges = std::move(*most);
    build(node, leaves_);
    for (Index n = nodes_[node].parent; n != none; n = nodes_[n].parent)
        nodes_[n].leaves += static_cast<Index>(parts.size()) - 1;
    if (parts.empty()) return;
    widen(nodes_[node].parent, box);
    if (parts.size() > 1)
        if (const Index top = unbalanced_above(nodes_[node].first); top != none) rebuild(top);
}

void PieceTree::reshape(Index piece, std::vector<Index> wedges, const Bounds& box) {
    pieces_[piece].wedges = std::move(wedges);
    widen(pieces_[piece].node, box);
}

} // namespace facetmill
