#include "geometry/crop_cut.hpp"

#include "base/parallel.hpp"
#include "geometry/clip.hpp"
#include "geometry/outline_walls.hpp"
#include "geometry/score.hpp"

#include <algorithm>

namespace facetmill {

namespace {

class Cutter {
  public:
    Cutter(Mesh mesh, const CropView& view, CutMemory& memory) : view_(view), memory_(memory) {
        result_.mesh = std::move(mesh);
    }

    OutlineCut run() {
        const Mesh& mesh = result_.mesh;
        for (Index f = 0; f < mesh.face_count(); ++f) origin_.push_back(f);
        was_cut_.resize(origin_.size());
        const auto lists = faces_by_segment();
        for (Index s = 0; s < lists.size(); ++s)
            if (!lists[s].empty()) cut_along(s, lists[s]);
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
    std::vector<std::vector<Index>> faces_by_segment() const {
        std::vector<std::vector<Index>> lists(view_.footprint().tree().edges().size());
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

    /// Cuts the pieces of these faces that the segment still enters.
    void cut_along(Index segment, const std::vector<Index>& faces) {
        const auto& e = view_.footprint().tree().edges()[segment];
        std::vector<std::uint8_t> listed(was_cut_.size()), wanted(result_.mesh.face_count());
        for (const Index f : faces) listed[f] = 1;
        std::vector<Vec2> face;
        bool any = false;
        for (Index f = 0; f < wanted.size(); ++f) {
            if (!listed[origin_[f]]) continue;
            view_.gather(result_.mesh, f, face);
            if (meeting(face, e.a, e.b) != OutlineMeeting::crossing) continue;
            wanted[f] = was_cut_[origin_[f]] = 1, any = true;
        }
        if (!any) return;
        ScoreSettings settings;
        settings.plane = plane_of(e);
        settings.faces = wanted;
        const std::size_t old_vertices = result_.mesh.vertex_count();
        ScoreResult scored = score(result_.mesh, settings, memory_);
        remember_corners(e, std::span(scored.mesh.positions).subspan(old_vertices));
        merge_fates(result_.fates, scored.fates);
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
