#include "geometry/clip.hpp"

#include "base/error.hpp"
#include "geometry/clip_assemble.hpp"
#include "mesh/topology.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// At every edge the directions of the faces cancel.
bool is_closed(const Mesh& mesh) {
    const EdgeTable table = build_edges(mesh);
    for (Index e = 0; e < table.size(); ++e) {
        int balance = 0;
        for (const Index c : table.corners_of(e)) balance += mesh.vertex(c) == table.edges[e].low ? 1 : -1;
        if (balance != 0) return false;
    }
    return true;
}

/// What stages report is the union over the planes: an attribute that was ever mixed was mixed.
void merge_fates(Fates& all, const Fates& more) {
    for (const Fate& fate : more) {
        const auto same = std::find_if(all.begin(), all.end(), [&](const Fate& f) {
            return f.attribute == fate.attribute && f.domain == fate.domain;
        });
        if (same == all.end())
            all.push_back(fate);
        else if (fate.kind != Fate::Kind::kept)
            *same = fate;
    }
}

/// Clips by one plane after the other.
class Clipper {
  public:
    explicit Clipper(const ClipSettings& settings) : settings_(settings) {}

    ClipResult run(Mesh mesh) {
        for (std::size_t i = 0; i < settings_.planes.size(); ++i) cut(mesh, i);
        if (settings_.keep != Keep::both)
            (settings_.keep == Keep::front ? result_.front : result_.back) = std::move(mesh);
        if (settings_.triangulate)
            for (Mesh* m : {&result_.front, &result_.back})
                if (!m->all_triangles()) *m = triangulated(*m);
        return std::move(result_);
    }

  private:
    void cut(Mesh& mesh, std::size_t number) {
        PlaneCut cut = cut_by_plane(mesh, settings_.planes[number]);
        result_.cut_faces += cut.cut_faces.size();
        result_.on_plane += cut.on_count;
        if (!cut.meets()) return keep_or_drop(mesh, cut);
        result_.changed = true;
        settle(cut);
        if (settings_.keep != Keep::both) {
            mesh = side_of(cut, settings_.keep == Keep::front ? 1 : -1, number);
            return;
        }
        result_.front = side_of(cut, 1, number);
        result_.back = side_of(cut, -1, number);
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
        Side made = assemble(cut, side, pieces, cap, settings_.cap_primitive);
        merge_fates(result_.fates, made.fates);
        return std::move(made.mesh);
    }

    const ClipSettings& settings_;
    ClipResult result_;
};

} // namespace

ClipResult clip(Mesh mesh, const ClipSettings& settings) {
    for (const Plane& plane : settings.planes) check_plane(plane);
    if (settings.keep == Keep::both && settings.planes.size() != 1)
        throw Error(ErrorKind::usage, "E-PLANE", "keeping both sides takes exactly one plane",
                    "clip once for every plane, or keep the front or the back");
    return Clipper(settings).run(std::move(mesh));
}

} // namespace facetmill
