#include "geometry/crop/crop.hpp"

#include "base/error.hpp"
#include "geometry/crop/cut.hpp"
#include "geometry/crop/outline_walls.hpp"
#include "geometry/crop/trace.hpp"
#include "geometry/crop/walls.hpp"
#include "geometry/cut/cap_paint.hpp"
#include "geometry/cut/cut.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace facetmill {

namespace {

using polygon::PointLocation;

class Cropper {
  public:
    Cropper(const Mesh& mesh, const Footprint& footprint, const CropSettings& settings)
        : mesh_(mesh), footprint_(footprint), settings_(settings), view_(footprint, settings) {}

    CropResult run() {
        result_.memory = settings_.memory;
        look();
        if (mesh_.face_count() == 0) {
            keep_points();
            return std::move(result_);
        }
        if (settings_.by == CropBy::cut)
            cut();
        else
            keep_whole();
        if (settings_.cap && settings_.by == CropBy::cut) close();
        return std::move(result_);
    }

  private:
    void look() {
        places_.resize(mesh_.vertex_count());
        parallel_for(
            places_.size(), [&](std::size_t v) { places_[v] = view_.place(view_.seen(mesh_.positions[v])); },
            1024);
        if (settings_.snap) snap();
        meets_.resize(mesh_.face_count());
        parallel_chunks(
            mesh_.face_count(),
            [&](std::size_t begin, std::size_t end) {
                std::vector<Vec2> face;
                for (std::size_t f = begin; f < end; ++f) meets_[f] = meeting_of(static_cast<Index>(f), face);
            },
            1024);
    }
    /// Finds vertices near the outline. They count as on the outline, and as on the planes of its segments
    /// nearby.
    void snap() {
        const CoordinateErrors local = rounding_of(mesh_);
        view_.snap = seen_error(local.single);
        view_.rounding = seen_error(local.twice) * 16;
        for (const auto& e : footprint_.tree().edges())
            if (std::fabs(e.b.x - e.a.x) <= 4 * view_.snap.x &&
                std::fabs(e.b.y - e.a.y) <= 4 * view_.snap.y) { // below float precision
                view_.snap = view_.rounding = {};
                return;
            }
        if (view_.snap == Vec2{}) return;
        const Vec2 rounding = view_.rounding * (1.0 / 16);
        struct Found {
            std::size_t off = 0;
            double by = 0;
            std::vector<std::pair<Index, Vec3>> points; ///< with the segments that contain them
        };
        const auto look_at = [&](std::size_t v, Found& some) {
            if (!is_float32(mesh_.positions[v])) return;
            const Vec2 p = view_.seen(mesh_.positions[v]);
            bool off = false;
            footprint_.near(p, view_.snap, [&](Index segment) {
                const auto& e = footprint_.tree().edges()[segment];
                const Vec2 d = e.b - e.a;
                const double distance = std::fabs(cross(d, p - e.a));
                off |= distance > std::fabs(d.x) * rounding.y + std::fabs(d.y) * rounding.x;
                some.by = std::max(some.by, distance / length(d));
                some.points.emplace_back(segment, mesh_.positions[v]);
                if (places_[v] <= PointLocation::inside) places_[v] = PointLocation::on_edge;
                return true;
            });
            some.off += off;
        };
        const Found found = parallel_reduce(
            mesh_.vertex_count(), Found{},
            [&](std::size_t begin, std::size_t end) {
                Found some;
                for (std::size_t v = begin; v < end; ++v) look_at(v, some);
                return some;
            },
            [](Found a, const Found& b) {
                a.off += b.off;
                a.by = std::max(a.by, b.by);
                a.points.insert(a.points.end(), b.points.begin(), b.points.end());
                return a;
            },
            1024);
        result_.snapped += found.off;
        result_.snapped_by = found.by;
        remember(found.points);
    }
    /// The largest error of a point as seen, from the errors along the mesh's own axes.
    Vec2 seen_error(const Vec3& local) const {
        Vec3 world;
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j) world[i] += std::fabs(settings_.to_world.m[i][j]) * local[j];
        const Vec2 seen = seen_along(settings_.axis, world);
        return std::isfinite(seen.x) && std::isfinite(seen.y) ? seen : Vec2{};
    }
    /// Stores points, each with the segment whose plane contains it.
    void remember(const std::vector<std::pair<Index, Vec3>>& points) {
        std::map<Index, std::vector<Vec3>> of_segment;
        for (const auto& [segment, point] : points) of_segment[segment].push_back(point);
        std::vector<CutMemory::Entry> entries;
        for (auto& [segment, some] : of_segment) {
            const auto& e = footprint_.tree().edges()[segment];
            entries.push_back({pulled_back(upright_plane(settings_.axis, e.a, e.b), settings_.to_world), 0,
                               std::move(some)});
        }
        result_.memory.add_all(std::move(entries));
    }
    OutlineMeeting meeting_of(Index f, std::vector<Vec2>& face) const {
        view_.gather(mesh_, f, face);
        OutlineMeeting most = OutlineMeeting::disjoint;
        view_.meetings(face, [&](Index, OutlineMeeting meets) {
            most = std::max(most, meets);
            return most != OutlineMeeting::crossing;
        });
        return most;
    }

    /// For a point cloud: points on the outline count as inside, so that each point is on one side.
    void keep_points() {
        std::vector<std::uint8_t> goes(mesh_.vertex_count());
        for (std::size_t v = 0; v < goes.size(); ++v)
            goes[v] = !view_.kept(places_[v] == PointLocation::outside ? PointLocation::outside
                                                                       : PointLocation::inside);
        result_.mesh = mesh_;
        drop_unused(result_.mesh, goes);
        result_.changed = result_.mesh.vertex_count() < mesh_.vertex_count();
        result_.changes = kept_changes(mesh_.attributes);
    }

    // --- keeping complete faces

    bool stays(Index f, std::vector<Vec2>& face) const {
        if (settings_.by == CropBy::centre) {
            view_.gather(mesh_, f, face);
            const PointLocation place = view_.place(mean_of_corners(face));
            return view_.kept(place == PointLocation::outside ? place : PointLocation::inside);
        }
        bool any = false, all = true; // corners on the outline count for both sides
        for (const Index w : mesh_.face_wedges(f)) {
            const PointLocation place = places_[mesh_.vertex_of_wedge(w)];
            const bool on = place > PointLocation::inside;
            any |= !on && view_.kept(place);
            all &= on || view_.kept(place);
        }
        if (settings_.by == CropBy::whole && (!all || meets_[f] == OutlineMeeting::crossing)) return false;
        if (settings_.by == CropBy::overlapping && (any || meets_[f] == OutlineMeeting::crossing))
            return true;
        return any || (all && view_.kept(view_.middle(mesh_, f)));
    }

    void keep_whole() {
        std::vector<std::uint8_t> stay(mesh_.face_count());
        parallel_chunks(
            mesh_.face_count(),
            [&](std::size_t begin, std::size_t end) {
                std::vector<Vec2> face;
                for (std::size_t f = begin; f < end; ++f) stay[f] = stays(static_cast<Index>(f), face);
            },
            1024);
        std::vector<Index> faces;
        for (Index f = 0; f < stay.size(); ++f)
            if (stay[f]) faces.push_back(f);
        keep(faces);
    }
    /// Keeps exactly these faces, unchanged.
    void keep(const std::vector<Index>& faces) {
        result_.kept_faces = faces.size();
        result_.changed = faces.size() < mesh_.face_count();
        result_.changes = kept_changes(mesh_.attributes);
        result_.mesh = select_faces(mesh_, faces);
    }

    // --- cutting at the outline

    void cut() {
        std::vector<std::uint8_t> near(mesh_.vertex_count());
        std::vector<Index> whole, beside;
        for (Index f = 0; f < mesh_.face_count(); ++f)
            if (meets_[f] == OutlineMeeting::crossing)
                for (const Index w : mesh_.face_wedges(f)) near[mesh_.vertex_of_wedge(w)] = 1;
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            bool any = false;
            for (const Index w : mesh_.face_wedges(f)) any |= near[mesh_.vertex_of_wedge(w)] != 0;
            if (any)
                beside.push_back(f);
            else if (stays_whole(f))
                whole.push_back(f);
        }
        if (beside.empty()) return keep(whole);
        result_.kept_faces = whole.size();
        result_.changed = true;
        Mesh traced = mesh_;
        trace(traced);
        OutlineCut pieces = cut_at_outline(select_faces(traced, beside), view_, result_.memory);
        std::vector<Index> kept;
        for (Index f = 0; f < pieces.stays.size(); ++f)
            if (pieces.stays[f]) kept.push_back(f);
        result_.cut_faces = pieces.cut_faces;
        result_.changes = std::move(pieces.changes);
        if (result_.changes.empty()) result_.changes = kept_changes(mesh_.attributes);
        result_.mesh = join_traced(select_faces(traced, whole), select_faces(pieces.mesh, kept));
        untrace(result_.mesh);
        forget_change(result_.changes, trace_attribute);
    }
    /// For a face that no segment enters: any corner off the outline decides.
    bool stays_whole(Index f) const {
        for (const Index w : mesh_.face_wedges(f)) {
            const PointLocation place = places_[mesh_.vertex_of_wedge(w)];
            if (place <= PointLocation::inside) return view_.kept(place);
        }
        return view_.kept(view_.middle(mesh_, f));
    }

    // --- walls

    void close() {
        WallSettings walls;
        walls.axis = settings_.axis;
        walls.to_world = settings_.to_world;
        walls.primitive = settings_.cap_primitive;
        walls.closed = is_closed(mesh_);
        for (const Vec3& p : mesh_.positions) {
            const Vec2 at = view_.seen(p);
            walls.reach = std::max({walls.reach, std::fabs(at.x), std::fabs(at.y)});
        }
        if (settings_.cap_numbers) {
            walls.last_cut = largest_number(mesh_, cut_id_attribute);
            walls.last_group = largest_number(mesh_, group_attribute);
        }
        WalledCrop closed = close_crop(std::move(result_.mesh), footprint_, walls);
        result_.mesh = std::move(closed.mesh);
        result_.cap_faces = closed.wall_faces;
        result_.open = std::move(closed.open);
        merge_changes(result_.changes, closed.changes);
        remember(closed.made);
    }

    const Mesh& mesh_;
    const Footprint& footprint_;
    const CropSettings& settings_;
    CropView view_;
    std::vector<PointLocation> places_; ///< [vertices]
    std::vector<OutlineMeeting> meets_; ///< [faces] how the face meets the outline
    CropResult result_;
};

} // namespace

Vec2 seen_along(std::size_t axis, const Vec3& p) { return {axis == 0 ? p.y : p.x, axis == 2 ? p.y : p.z}; }

namespace {

/// Crops once for each side; all with snap, or all without.
std::vector<CropResult> crop_sides(const Mesh& mesh, const Footprint& footprint, CropSettings settings,
                                   std::span<const polygon::Keep> sides) {
    const auto run = [&] {
        std::vector<CropResult> results;
        for (const auto side : sides) {
            settings.keep = side;
            results.push_back(Cropper(mesh, footprint, settings).run());
        }
        return results;
    };
    try {
        return run();
    } catch (const UnclosedWalls&) { // an outline may have needles finer than snap; without snap, they can be
                                     // closed
        if (!settings.snap) throw;
    }
    settings.snap = false;
    return run();
}

} // namespace

CropResult crop(const Mesh& mesh, const Footprint& footprint, const CropSettings& settings) {
    return std::move(crop_sides(mesh, footprint, settings, std::array{settings.keep}).front());
}

std::vector<CropResult> crop_both(const Mesh& mesh, const Footprint& footprint,
                                  const CropSettings& settings) {
    return crop_sides(mesh, footprint, settings, std::array{polygon::Keep::inside, polygon::Keep::outside});
}

} // namespace facetmill
