#include "cells/process/border_closure.hpp"

#include "base/error.hpp"
#include "base/math/random.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

namespace facetmill::cells {

namespace {

/// An edge between the part and the rest, in the direction of the part's face. The rest's faces around a
/// vertex form arcs, each between two such edges.
struct FrameEdge {
    Index from, to;
    Index arc_from, arc_to; ///< a corner of the arc at each end
    std::uint32_t sheet;
};

class CollarMaker {
  public:
    CollarMaker(const Mesh& mesh, const std::vector<std::uint8_t>& part,
                const std::vector<std::uint32_t>& sheet)
        : mesh_(mesh), part_(part), sheet_(sheet), count_(static_cast<Index>(mesh.vertex_count())) {
        const Box box = mesh.bounds();
        for (std::size_t axis = 0; axis < 3 && !box.empty(); ++axis)
            size_ = std::max({size_, std::abs(box.min[axis]), std::abs(box.max[axis])});
    }

    Collar run() {
        find_frame();
        if (frame_.empty()) {
            const Index p[] = {add_point(), add_point(), add_point(), add_point()};
            add(p[0], p[1], p[2]);
            add(p[0], p[2], p[3]);
            add(p[0], p[3], p[1]);
            add(p[1], p[3], p[2]);
            return std::move(border_closure_);
        }
        std::vector<bool> done(frame_.size(), false);
        for (std::size_t e = 0; e < frame_.size(); ++e)
            if (!done[e]) close_loop(e, done);
        for (const auto& [sheet, caps] : caps_) close_caps(caps);
        return std::move(border_closure_);
    }

  private:
    using Triangle = std::array<Index, 3>;
    using Cap = std::vector<Triangle>;

    void find_frame() {
        const EdgeTable edges = build_edges(mesh_);
        const std::vector<Index> faces = corner_faces(mesh_);
        DisjointSets arcs(mesh_.corner_count());
        const auto after = [&](Index c) { return next_corner(mesh_, faces[c], c); };
        std::vector<Index> at_frame; // corners of the edges in the rest
        for (Index e = 0; e < edges.size(); ++e) {
            const auto corners = edges.corners_of(e);
            if (corners.size() != 2) continue;
            const Index a = corners[0], b = corners[1];
            const bool part_a = part_[faces[a]] != 0, part_b = part_[faces[b]] != 0;
            if (part_a != part_b) {
                at_frame.push_back(part_a ? b : a);
            } else if (!part_a) {
                arcs.join(a, after(b));
                arcs.join(after(a), b);
            }
        }
        for (const Index c : at_frame)
            frame_.push_back({mesh_.vertex(after(c)), mesh_.vertex(c), arcs.find(after(c)), arcs.find(c),
                              sheet_[faces[c]]});
        for (std::size_t e = 0; e < frame_.size(); ++e) starting_.emplace(frame_[e].arc_from, e);
    }

    /// Adds a ring of faces along a loop of the frame, and a cap on it.
    void close_loop(std::size_t first, std::vector<bool>& done) {
        const Index tip = add_point();
        Cap cap;
        for (std::size_t e = first; !done[e]; e = after(e)) {
            done[e] = true;
            const FrameEdge& edge = frame_[e];
            const Index from = point_of(edge.arc_from), to = point_of(edge.arc_to);
            add(edge.to, edge.from, from);
            add(edge.to, from, to);
            cap.push_back({to, from, tip});
        }
        caps_[frame_[first].sheet].push_back(std::move(cap));
    }

    /// Connects caps of the same sheet of the rest: a tube from each cap to the next replaces a face of
    /// each.
    void close_caps(const std::vector<Cap>& caps) {
        for (std::size_t k = 0; k < caps.size(); ++k) {
            const bool is_first = k == 0, is_last = k + 1 == caps.size();
            for (std::size_t i = is_first ? 0 : 1; i < caps[k].size() - (is_last ? 0 : 1); ++i)
                add(caps[k][i][0], caps[k][i][1], caps[k][i][2]);
            if (!is_last) join(caps[k].back(), caps[k + 1].front());
        }
    }

    std::size_t after(std::size_t e) const {
        const auto next = starting_.find(frame_[e].arc_to);
        if (next == starting_.end())
            throw Error(ErrorKind::bug, "E-BUG", "cells: the border of the cleaned area is not closed");
        return next->second;
    }

    void join(const Triangle& a, const Triangle& b) {
        const Triangle c{b[0], b[2], b[1]};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t k = (i + 1) % 3;
            add(a[i], a[k], c[k]);
            add(a[i], c[k], c[i]);
        }
    }

    Index point_of(Index arc) {
        const auto [at, fresh] = point_of_arc_.try_emplace(arc, none);
        if (fresh) at->second = add_point();
        return at->second;
    }

    Index add_point() {
        Vec3 p;
        for (std::size_t axis = 0; axis < 3; ++axis)
            p[axis] = size_ * (2 * uniform(hashed(hashed(0, border_closure_.points.size()), axis)) - 1);
        border_closure_.points.push_back(p);
        return count_ + static_cast<Index>(border_closure_.points.size() - 1);
    }

    void add(Index a, Index b, Index c) {
        for (const Index corner : {a, b, c}) border_closure_.corners.push_back(corner);
    }

    const Mesh& mesh_;
    const std::vector<std::uint8_t>& part_;
    const std::vector<std::uint32_t>& sheet_;
    Index count_;
    double size_ = 0;
    std::vector<FrameEdge> frame_;
    std::unordered_map<Index, std::size_t> starting_; ///< edges by arc_from
    std::unordered_map<Index, Index> point_of_arc_;
    std::map<std::uint32_t, std::vector<Cap>> caps_; ///< caps by sheet
    Collar border_closure_;
};

} // namespace

Collar border_closure_of(const Mesh& mesh, const std::vector<std::uint8_t>& part,
                         const std::vector<std::uint32_t>& sheet) {
    return CollarMaker(mesh, part, sheet).run();
}

} // namespace facetmill::cells
