#include "geometry/clip/clip.hpp"

#include "base/error.hpp"
#include "geometry/clip/assemble.hpp"
#include "geometry/clip/body.hpp"

#include <algorithm>

namespace facetmill {

namespace {

void make_triangles(ClipResult& result) {
    for (Mesh* m : {&result.front, &result.back})
        if (!m->all_triangles()) *m = triangulated(*m);
}

/// Clips by one plane after the other.
class Clipper {
  public:
    explicit Clipper(const ClipSettings& settings) : settings_(settings) {}

    ClipResult run(Mesh mesh) {
        result_.memory = settings_.memory;
        if (settings_.snap) snap_ = float32_ulp(mesh.bounds());
        if (settings_.cap && settings_.cap_numbers) {
            last_cut_ = largest_number(mesh, cut_id_attribute);
            last_group_ = largest_number(mesh, group_attribute);
        }
        for (std::size_t i = 0; i < settings_.planes.size(); ++i) cut(mesh, i);
        if (settings_.keep != Keep::both)
            (settings_.keep == Keep::front ? result_.front : result_.back) = std::move(mesh);
        if (settings_.triangulate) make_triangles(result_);
        return std::move(result_);
    }

  private:
    void cut(Mesh& mesh, std::size_t number) {
        PlaneCut cut = cut_by_plane(mesh, settings_.planes[number], {snap_, &result_.memory});
        result_.cut_faces += cut.cut_faces.size();
        result_.on_plane += cut.on_count;
        result_.snapped += cut.snapped_count;
        result_.remembered += cut.remembered_count;
        if (!cut.meets()) return keep_or_drop(mesh, cut);
        result_.changed = true;
        settle(cut);
        made_.clear();
        if (settings_.keep == Keep::both) {
            result_.front = side_of(cut, 1, number);
            result_.back = side_of(cut, -1, number);
            remember(result_.memory, cut, made_);
        } else {
            Mesh kept = side_of(cut, settings_.keep == Keep::front ? 1 : -1, number);
            remember(result_.memory, cut, made_);
            mesh = std::move(kept);
        }
    }

    /// The plane misses the mesh.
    void keep_or_drop(Mesh& mesh, const PlaneCut& cut) {
        if (settings_.keep == Keep::both) {
            (cut.above_count > 0 ? result_.front : result_.back) = std::move(mesh);
            (cut.above_count > 0 ? result_.back : result_.front) = {};
            return;
        }
        if ((settings_.keep == Keep::front ? cut.below_count : cut.above_count) == 0) return;
        result_.changed = true;
        Mesh empty;
        empty.attributes = std::move(mesh.attributes);
        for (Attribute& a : empty.attributes) std::visit([](auto& data) { data.clear(); }, a.data);
        empty.primitives = std::move(mesh.primitives);
        mesh = std::move(empty);
    }

    void settle(PlaneCut& cut) const {
        if (cut.flat.empty()) return;
        if (settings_.keep == Keep::both || is_closed(*cut.mesh)) return settle_flat_by_normal(cut);
        const int kept = settings_.keep == Keep::front ? 1 : -1;
        settle_flat(cut, settings_.coplanar == Coplanar::keep ? kept : 0);
    }

    Mesh side_of(PlaneCut& cut, int side, std::size_t number) {
        Pieces pieces = pieces_on_side(cut, side);
        Cap cap;
        if (settings_.cap) cap = make_cap(cut, side, pieces);
        for (const auto& end : cap.open) result_.open.push_back({number, end.edges, end.at});
        result_.cap_faces += cap.corners.size() / 3;
        made_.insert(made_.end(), cap.extra.points.begin(), cap.extra.points.end());
        CapPaint paint{settings_.cap_primitive, 0, 0};
        if (settings_.cap_numbers) {
            paint.cut_id = last_cut_ + 1 + static_cast<Index>(number);
            paint.group = last_group_ + 1 + static_cast<Index>(number);
        }
        ClippedSide made = assemble(cut, side, pieces, cap, paint);
        merge_changes(result_.changes, made.changes);
        return std::move(made.mesh);
    }

    const ClipSettings& settings_;
    ClipResult result_;
    double snap_ = 0;
    Index last_cut_ = 0, last_group_ = 0; ///< numbers that were there
    std::vector<Vec3> made_;              ///< by the caps of a plane
};

} // namespace

ClipResult clip(Mesh mesh, const ClipSettings& settings) {
    for (const Plane& plane : settings.planes) check_plane(plane);
    if (settings.convex && settings.keep != Keep::front && settings.planes.size() > 1) {
        ClipResult result = clip_body(std::move(mesh), settings);
        if (settings.triangulate) make_triangles(result);
        return result;
    }
    if (settings.keep == Keep::both && settings.planes.size() != 1)
        throw Error(ErrorKind::usage, "E-CONFLICT", "keeping both sides takes exactly one plane",
                    "clip once for every plane, or keep the front or the back");
    return Clipper(settings).run(std::move(mesh));
}

} // namespace facetmill
