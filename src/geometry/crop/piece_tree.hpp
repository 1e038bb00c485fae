#pragma once
// The pieces of repeatedly cut faces, searchable by position. Only crop uses it.

#include "geometry/polygon/ring_tree.hpp"

namespace facetmill {

/// For each face, a tree of boxes with its pieces as leaves, in the order of cutting: parts replace their
/// piece. Balanced like I. Galperin and R. L. Rivest, "Scapegoat trees" (1993).
class PieceTree {
  public:
    using Bounds = polygon::RingTree::Bounds;
    struct Piece {
        Index face = none;
        std::vector<Index> wedges; ///< corners in order
        Index node = none;         ///< none: the piece no longer exists
    };

    /// Adds a face as a single piece; faces are numbered in order of insertion.
    void add_face(std::vector<Index> wedges, const Bounds& box);
    /// Replaces a piece by parts, and moves from the parts. The first part with the most wedges keeps its
    /// number; the others get new numbers.
    void replace(Index piece, std::span<std::vector<Index>> parts, std::span<const Bounds> boxes);
    /// Changes the wedges of a piece, for points on its edges.
    void reshape(Index piece, std::vector<Index> wedges, const Bounds& box);

    std::size_t face_count() const { return roots_.size(); }
    /// Upper bound of the piece numbers.
    Index numbers() const { return static_cast<Index>(pieces_.size()); }
    const Piece& operator[](Index piece) const { return pieces_[piece]; }
    /// Calls visit(piece) for the pieces of a face whose boxes meet the box, in order.
    template <class Visit>
    void query(Index face, const Bounds& box, Visit&& visit) const {
        visit_leaves(
            roots_[face], [&](const Node& n) { return n.box.meets(box); }, visit);
    }
    template <class Visit>
    void for_pieces(Index face, Visit&& visit) const {
        visit_leaves(
            roots_[face], [](const Node&) { return true; }, visit);
    }

  private:
    struct Node {
        Bounds box;
        Index parent = none, first = none, second = none; ///< tree nodes
        Index piece = none;                               ///< the piece of a leaf
        Index leaves = 1;
    };

    template <class Enters, class Visit>
    void visit_leaves(Index root, Enters&& enters, Visit&& visit) const {
        std::vector<Index>& open = open_;
        const std::size_t bottom = open.size(); // visits may be nested
        open.push_back(root);
        while (open.size() > bottom) {
            const Node& n = nodes_[open.back()];
            open.pop_back();
            if (!enters(n)) continue;
            if (n.second != none) open.push_back(n.second);
            if (n.first != none) open.push_back(n.first);
            if (n.piece != none) visit(n.piece);
        }
    }
    Index new_node();
    Index new_leaf(Index piece, const Bounds& box);
    void build(Index node, std::span<const Index> leaves);
    void rebuild(Index node);
    void widen(Index node, const Bounds& box);
    Index unbalanced_above(Index node) const;

    std::vector<Piece> pieces_;
    std::vector<Node> nodes_;
    std::vector<Index> roots_;  ///< [faces] root nodes
    std::vector<Index> free_;   ///< unused nodes
    std::vector<Index> leaves_; ///< leaves of the replaced piece
    mutable std::vector<Index> open_;
};

} // namespace facetmill
