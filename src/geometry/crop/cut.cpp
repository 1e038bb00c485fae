#include "geometry/crop/cut.hpp"

#include "base/parallel.hpp"
#include "geometry/clip/clip.hpp"
#include "geometry/crop/outline_walls.hpp"
#include "geometry/crop/trace.hpp"
#include "geometry/cut/score.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

constexpr Index stretch = 64; ///< segments that are cut along one after the other, over the same faces
constexpr std::string_view stretch_trace = "#stretch"; ///< and the depth

/// Whether the plane passes the box, or by no more than rounding beside it.
bool passes(const Plane& plane, const Box& box) {
    const Vec3 middle = box.centre(), half = box.extent() * 0.5;
    double reach = 0, size = std::fabs(plane.offset);
    for (std::size_t i = 0; i < 3; ++i) {
        reach += std::fabs(plane.normal[i]) * half[i];
        size += std::fabs(plane.normal[i]) * (std::fabs(middle[i]) + half[i] + std::fabs(plane.through[i]));
    }
    return !(std::fabs(side(plane, middle)) > reach + 1e-9 * size);
}

/// The entries of a memory whose planes pass a box, taken out of it while this lives.
class NearMemory {
  public:
    NearMemory(CutMemory& memory, const Box& box) : memory_(memory), all_(std::move(memory)) {
        memory_ = {};
        for (std::size_t i = 0; i < all_.entries.size(); ++i) {
            if (!passes(all_.entries[i].plane, box)) continue;
            from_.push_back(i);
            memory_.entries.push_back(std::move(all_.entries[i]));
        }
    }
    /// Puts them back, and what came to them.
    void end() {
        for (std::size_t k = 0; k < memory_.entries.size(); ++k)
            if (k < from_.size())
                all_.entries[from_[k]] = std::move(memory_.entries[k]);
            else
                all_.entries.push_back(std::move(memory_.entries[k]));
        memory_ = std::move(all_);
    }

  private:
    CutMemory& memory_;
    CutMemory all_;
    std::vector<std::size_t> from_;
};

using Lists = std::vector<std::vector<Index>>; ///< by segment: faces

class Cutter {
  public:
    Cutter(Mesh mesh, const CropView& view, CutMemory& memory) : view_(view), memory_(memory) {
        result_.mesh = std::move(mesh);
    }

    OutlineCut run() {
        Mesh& mesh = result_.mesh;
        for (Index f = 0; f < mesh.face_count(); ++f) origin_.push_back(f);
        was_cut_.resize(origin_.size());
        const auto lists = faces_by_segment();
        const auto segments = static_cast<Index>(lists.size());
        if (segments <= stretch)
            cut_segments(0, segments, lists);
        else
            cut_near(0, segments, lists, 0);
        result_.cut_faces = static_cast<std::size_t>(std::count(was_cut_.begin(), was_cut_.end(), 1));
        result_.stays.resize(mesh.face_count());
        parallel_for(
            result_.stays.size(),
            [&](std::size_t f) { result_.stays[f] = view_.kept(view_.middle(mesh, static_cast<Index>(f))); },
            256);
        return std::move(result_);
    }

  private:
    /// For each segment the faces that it enters.
    Lists faces_by_segment() const {
        Lists lists(view_.footprint().tree().edges().size());
        std::vector<Vec2> face;
        for (Index f = 0; f < result_.mesh.face_count(); ++f) {
            view_.gather(result_.mesh, f, face);
            view_.meetings(face, [&](Index i, OutlineMeeting meets) {
                if (meets == OutlineMeeting::crossing) lists[i].push_back(f);
                return true;
            });
        }
        return lists;
    }

    /// Cuts along the segments [first, last). Each cut is a pass over a mesh and over what is known of
    /// planes, so it is over the faces near these segments only, and over the planes that pass there: the
    /// faces that are cut, and those that share a vertex with them and so all that get points. Of many
    /// segments, first along the one half of them, then along the other.
    void cut_near(Index first, Index last, const Lists& lists, int depth) {
        std::vector<Index> about, rest;
        const Box box = split_about(first, last, lists, about, rest);
        if (about.empty()) return;
        const std::string name = fmt::format("{}{}", stretch_trace, depth);
        Mesh& mesh = result_.mesh;
        trace(mesh, name);
        Mesh others = select_faces(mesh, rest);
        std::vector<Index> origin;
        origin.reserve(rest.size());
        for (const Index f : rest) origin.push_back(origin_[f]);
        mesh = select_faces(mesh, about);
        for (Index& f : about) f = origin_[f];
        origin_ = std::move(about);
        NearMemory near(memory_, box);
        if (last - first <= stretch)
            cut_segments(first, last, lists);
        else {
            const Index middle = first + (last - first) / 2;
            cut_near(first, middle, lists, depth + 1);
            cut_near(middle, last, lists, depth + 1);
        }
        near.end();
        mesh = join_traced(std::move(others), mesh, name);
        untrace(mesh, name);
        forget_change(result_.changes, name);
        origin_.insert(origin_.begin(), origin.begin(), origin.end());
    }
    /// Parts the faces into those near the segments and the rest; returns the box of those that may be cut.
    Box split_about(Index first, Index last, const Lists& lists, std::vector<Index>& about,
                    std::vector<Index>& rest) const {
        const Mesh& mesh = result_.mesh;
        std::vector<std::uint8_t> listed(was_cut_.size()), near(mesh.vertex_count());
        polygon::RingTree::Bounds segments;
        for (Index s = first; s < last; ++s) {
            const auto& e = view_.footprint().tree().edges()[s];
            segments.add(polygon::RingTree::bounds(e));
            for (const Index f : lists[s]) listed[f] = 1;
        }
        Box box;
        std::vector<Vec2> face;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            if (!listed[origin_[f]]) continue;
            view_.gather(mesh, f, face);
            polygon::RingTree::Bounds piece;
            for (const Vec2& p : face) piece.add(p);
            if (!piece.meets(segments)) continue;
            for (const Index w : mesh.face_wedges(f)) {
                near[mesh.vertex_of_wedge(w)] = 1;
                box.add(mesh.positions[mesh.vertex_of_wedge(w)]);
            }
        }
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const auto corners = mesh.face_wedges(f);
            const bool any = std::any_of(corners.begin(), corners.end(),
                                         [&](Index w) { return near[mesh.vertex_of_wedge(w)] != 0; });
            (any ? about : rest).push_back(f);
        }
        return box;
    }
    void cut_segments(Index first, Index last, const Lists& lists) {
        for (Index s = first; s < last; ++s)
            if (!lists[s].empty()) cut_along(s, lists[s]);
    }

    /// Cuts the pieces of these faces (ascending) that the segment still enters.
    void cut_along(Index segment, const std::vector<Index>& faces) {
        const auto& e = view_.footprint().tree().edges()[segment];
        std::vector<std::uint8_t> wanted(result_.mesh.face_count());
        std::vector<Vec2> face;
        bool any = false;
        for (Index f = 0; f < wanted.size(); ++f) {
            if (!std::binary_search(faces.begin(), faces.end(), origin_[f])) continue;
            view_.gather(result_.mesh, f, face);
            if (meeting(face, e.a, e.b) != OutlineMeeting::crossing) continue;
            wanted[f] = was_cut_[origin_[f]] = 1;
            any = true;
        }
        if (!any) return;
        ScoreSettings settings;
        settings.plane = plane_of(e);
        settings.faces = wanted;
        const std::size_t old_vertices = result_.mesh.vertex_count();
        ScoreResult scored = score(result_.mesh, settings, memory_);
        remember_corners(e, std::span(scored.mesh.positions).subspan(old_vertices));
        merge_changes(result_.changes, scored.changes);
        std::vector<Index> origin(scored.source.size());
        for (std::size_t f = 0; f < origin.size(); ++f) origin[f] = origin_[scored.source[f]];
        origin_ = std::move(origin);
        result_.mesh = std::move(scored.mesh);
    }

    Plane plane_of(const polygon::RingTree::Edge& e) const {
        return pulled_back(upright_plane(view_.settings().axis, e.a, e.b), view_.settings().to_world);
    }

    /// New points at a corner of the outline, but for rounding, are on the next segment's plane, too: else an
    /// edge that passes the corner would be cut twice there.
    void remember_corners(const polygon::RingTree::Edge& e, std::span<const Vec3> points) {
        const auto& edges = view_.footprint().tree().edges();
        std::vector<Vec3> at_a, at_b;
        for (const Vec3& p : points) {
            const Vec2 at = view_.seen(p);
            const double size = std::max({length(p), length(at), length(e.a), length(e.b)});
            const double rounding = 16 * 2.220446049250313e-16 * size;
            if (length(at - e.a) <= rounding) at_a.push_back(p);
            if (length(at - e.b) <= rounding) at_b.push_back(p);
        }
        if (!at_a.empty()) memory_.add(plane_of(edges[e.previous]), std::move(at_a));
        if (!at_b.empty()) memory_.add(plane_of(edges[e.next]), std::move(at_b));
    }

    const CropView& view_;
    CutMemory& memory_;
    OutlineCut result_;
    std::vector<Index> origin_;         ///< [faces] of each piece
    std::vector<std::uint8_t> was_cut_; ///< [old faces]
};

} // namespace

OutlineCut cut_at_outline(Mesh mesh, const CropView& view, CutMemory& memory) {
    return Cutter(std::move(mesh), view, memory).run();
}

} // namespace facetmill
