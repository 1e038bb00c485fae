#include "geometry/crop.hpp"

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "geometry/clip.hpp"
#include "geometry/score.hpp"
#include "geometry/trace.hpp"
#include "geometry/triangulate_rings.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

using polygon::Place;

/// Where points are, by the rule asked for.
class Inside {
  public:
    Inside(const Footprint& footprint, InsideBy by)
        : footprint_(footprint), by_(by), spans_(footprint.spans()) {
        if (by != InsideBy::half_planes && by != InsideBy::angles_3d) return;
        if (spans_.size() != 1 || !polygon::is_convex(spans_[0]))
            throw Error(ErrorKind::usage, "E-FOOTPRINT",
                        "this rule for points inside needs a footprint of one convex ring",
                        "take inside_by: crossings, which takes any");
        for (const Vec2& p : spans_[0]) flat_.push_back({p.x, p.y, 0});
    }

    Place operator()(const Vec2& p) const {
        const Place place = footprint_.locate(p); // on the outline, all rules would depend on rounding
        if (by_ == InsideBy::crossings || place > Place::inside) return place;
        if (by_ == InsideBy::half_planes) return polygon::locate_convex(p, spans_[0]);
        const bool inside = by_ == InsideBy::angles ? polygon::inside_by_angles(p, spans_)
                                                    : polygon::inside_by_angles({p.x, p.y, 0}, flat_);
        return inside ? Place::inside : Place::outside;
    }

  private:
    const Footprint& footprint_;
    InsideBy by_;
    std::vector<polygon::Ring> spans_;
    std::vector<Vec3> flat_;
};

/// A mesh as the footprint sees it.
struct Seen {
    std::vector<Vec2> points;  ///< [vertices]
    std::vector<Place> places; ///< [vertices]
};

class Cropper {
  public:
    Cropper(const Footprint& footprint, const CropSettings& settings)
        : footprint_(footprint), settings_(settings), inside_(footprint, settings.inside_by) {}

    CropResult run(const Mesh& mesh) {
        result_.memory = settings_.memory;
        look_at(mesh);
        if (settings_.by == CropBy::cut)
            cut(mesh);
        else
            keep_whole(mesh);
        return std::move(result_);
    }

  private:
    Vec2 seen(const Vec3& p) const { return seen_along(settings_.axis, settings_.to_world.point(p)); }
    bool kept(Place place) const {
        return (place == Place::inside) == (settings_.keep == polygon::Keep::inside);
    }

    void look_at(const Mesh& mesh) {
        seen_.points.resize(mesh.vertex_count()), seen_.places.resize(mesh.vertex_count());
        parallel_for(
            mesh.vertex_count(),
            [&](std::size_t v) {
                seen_.points[v] = seen(mesh.positions[v]);
                seen_.places[v] = inside_(seen_.points[v]);
            },
            1024);
        meets_.resize(mesh.face_count());
        parallel_chunks(
            mesh.face_count(),
            [&](std::size_t begin, std::size_t end) {
                std::vector<Vec2> face;
                for (std::size_t f = begin; f < end; ++f)
                    meets_[f] = meeting_of(mesh, static_cast<Index>(f), face);
            },
            1024);
    }
    void gather(const Mesh& mesh, Index f, std::vector<Vec2>& face) const {
        face.clear();
        for (const Index w : mesh.face_wedges(f)) face.push_back(seen_.points[mesh.vertex_of_wedge(w)]);
    }
    static polygon::RingTree::Bounds bounds_of(const std::vector<Vec2>& face) {
        polygon::RingTree::Bounds box;
        for (const Vec2& p : face) box.add(p);
        return box;
    }
    OutlineMeeting meeting_of(const Mesh& mesh, Index f, std::vector<Vec2>& face) const {
        gather(mesh, f, face);
        OutlineMeeting most = OutlineMeeting::apart;
        footprint_.tree().query(bounds_of(face), [&](Index i) {
            const auto& e = footprint_.tree().edges()[i];
            most = std::max(most, meeting(face, e.a, e.b));
            return most != OutlineMeeting::crossing;
        });
        return most;
    }

    // --- by whole faces

    bool stays(const Mesh& mesh, Index f, std::vector<Vec2>& face) const {
        if (settings_.by == CropBy::centre) {
            gather(mesh, f, face);
            Vec2 sum;
            for (const Vec2& p : face) sum = sum + (p - face[0]);
            const Place place = inside_(face[0] + sum * (1 / static_cast<double>(face.size())));
            return kept(place == Place::outside ? place : Place::inside);
        }
        bool any = false, all = true; // corners on the outline are on either side
        for (const Index w : mesh.face_wedges(f)) {
            const Place place = seen_.places[mesh.vertex_of_wedge(w)];
            const bool on = place > Place::inside;
            any |= !on && kept(place), all &= on || kept(place);
        }
        if (settings_.by == CropBy::whole && (!all || meets_[f] == OutlineMeeting::crossing)) return false;
        if (settings_.by == CropBy::touching && (any || meets_[f] == OutlineMeeting::crossing)) return true;
        return any || (all && kept(middle(mesh, f)));
    }

    void keep_whole(const Mesh& mesh) {
        std::vector<std::uint8_t> stay(mesh.face_count());
        parallel_chunks(
            mesh.face_count(),
            [&](std::size_t begin, std::size_t end) {
                std::vector<Vec2> face;
                for (std::size_t f = begin; f < end; ++f) stay[f] = stays(mesh, static_cast<Index>(f), face);
            },
            1024);
        std::vector<Index> faces;
        for (Index f = 0; f < stay.size(); ++f)
            if (stay[f]) faces.push_back(f);
        result_.kept_faces = faces.size();
        result_.changed = faces.size() < mesh.face_count();
        for (const Attribute& a : mesh.attributes)
            result_.fates.push_back({a.name, a.domain, Fate::Kind::kept, {}});
        result_.mesh = select_faces(mesh, faces);
    }

    // --- cut at the outline

    /// The place of a point in the middle of a face.
    Place middle(const Mesh& mesh, Index f) const {
        std::vector<Vec2> face;
        for (const Index w : mesh.face_wedges(f))
            face.push_back(seen(mesh.positions[mesh.vertex_of_wedge(w)]));
        const polygon::Ring ring = face;
        Vec2 sum;
        if (face.size() > 3 && !polygon::is_convex(ring) && polygon::orientation(ring) != 0) {
            const auto t = polygon::triangulate_rings(polygon::Rings(&ring, 1));
            double most = -1;
            for (const auto& abc : t.triangles) {
                if (*std::max_element(abc.begin(), abc.end()) >= face.size()) continue; // rounded crossings
                const double area = cross(face[abc[1]] - face[abc[0]], face[abc[2]] - face[abc[0]]);
                if (area > most) most = area, sum = face[abc[0]] + face[abc[1]] + face[abc[2]];
            }
            if (most >= 0) return settle(inside_(sum * (1.0 / 3)), mesh, f);
        }
        sum = {};
        for (const Vec2& p : face) sum = sum + (p - face[0]);
        return settle(inside_(face[0] + sum * (1 / static_cast<double>(face.size()))), mesh, f);
    }
    /// A face along the outline, seen edge-on, bounds the side that it looks away from.
    Place settle(Place place, const Mesh& mesh, Index f) const {
        if (place <= Place::inside) return place;
        std::vector<Vec3> corners;
        for (const Index w : mesh.face_wedges(f))
            corners.push_back(settings_.to_world.point(mesh.positions[mesh.vertex_of_wedge(w)]));
        const Vec3 n = polygon::area_vector(corners);
        const Vec2 out = seen_along(settings_.axis, n), at = seen_along(settings_.axis, corners[0]);
        double nearest = HUGE_VAL;
        bool inside = true;
        for (const auto& e : footprint_.tree().edges()) { // rare: walls that stand on the outline
            const Vec2 d = e.b - e.a;
            const double t = std::clamp(dot(at - e.a, d) / dot(d, d), 0.0, 1.0),
                         far = length(e.a + d * t - at);
            const double along = std::fabs(dot(d, out)) / (length(d) * length(out));
            if (far + along < nearest) nearest = far + along, inside = cross(d, out) < 0;
        }
        return inside ? Place::inside : Place::outside;
    }

    void cut(const Mesh& mesh) {
        std::vector<std::uint8_t> near(mesh.vertex_count());
        std::vector<Index> whole, beside;
        for (Index f = 0; f < mesh.face_count(); ++f)
            if (meets_[f] == OutlineMeeting::crossing)
                for (const Index w : mesh.face_wedges(f)) near[mesh.vertex_of_wedge(w)] = 1;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            bool any = false;
            for (const Index w : mesh.face_wedges(f)) any |= near[mesh.vertex_of_wedge(w)] != 0;
            if (any)
                beside.push_back(f);
            else if (stays_whole(mesh, f))
                whole.push_back(f);
        }
        result_.kept_faces = whole.size();
        result_.changed = whole.size() < mesh.face_count();
        if (beside.empty()) {
            for (const Attribute& a : mesh.attributes)
                result_.fates.push_back({a.name, a.domain, Fate::Kind::kept, {}});
            result_.mesh = select_faces(mesh, whole);
            return;
        }
        Mesh traced = mesh;
        trace(traced);
        const Mesh pieces = cut_outline(select_faces(traced, beside));
        result_.mesh = join_traced(select_faces(traced, whole), pieces);
        untrace(result_.mesh);
        std::erase_if(result_.fates, [](const Fate& f) { return f.attribute == trace_attribute; });
    }
    /// Of a face that no segment enters: any corner off the outline tells.
    bool stays_whole(const Mesh& mesh, Index f) const {
        for (const Index w : mesh.face_wedges(f)) {
            const Place place = seen_.places[mesh.vertex_of_wedge(w)];
            if (place <= Place::inside) return kept(place);
        }
        return kept(middle(mesh, f));
    }

    /// The kept pieces of faces beside the outline.
    Mesh cut_outline(Mesh mesh) {
        std::vector<Index> origin(mesh.face_count()); // of each piece
        for (Index f = 0; f < origin.size(); ++f) origin[f] = f;
        const auto lists = faces_by_segment(mesh);
        std::vector<std::uint8_t> listed(origin.size()), wanted;
        std::vector<std::uint8_t> was_cut(origin.size());
        std::vector<Vec2> face;
        for (std::size_t s = 0; s < lists.size(); ++s) {
            for (const Index f : lists[s]) listed[f] = 1;
            const auto& e = footprint_.tree().edges()[s];
            wanted.assign(mesh.face_count(), 0);
            bool any = false;
            for (Index f = 0; f < mesh.face_count(); ++f) {
                if (!listed[origin[f]]) continue;
                face.clear();
                for (const Index w : mesh.face_wedges(f))
                    face.push_back(seen(mesh.positions[mesh.vertex_of_wedge(w)]));
                wanted[f] = meeting(face, e.a, e.b) == OutlineMeeting::crossing;
                any |= wanted[f] != 0;
                if (wanted[f]) was_cut[origin[f]] = 1;
            }
            for (const Index f : lists[s]) listed[f] = 0;
            if (any) score_along(mesh, origin, e.a, e.b, wanted);
        }
        result_.cut_faces = static_cast<std::size_t>(std::count(was_cut.begin(), was_cut.end(), 1));
        std::vector<std::uint8_t> stay(mesh.face_count());
        parallel_for(
            stay.size(), [&](std::size_t f) { stay[f] = kept(middle(mesh, static_cast<Index>(f))); }, 256);
        std::vector<Index> faces;
        for (Index f = 0; f < stay.size(); ++f)
            if (stay[f]) faces.push_back(f);
        if (result_.fates.empty()) // nothing was mixed
            for (const Attribute& a : mesh.attributes)
                result_.fates.push_back({a.name, a.domain, Fate::Kind::kept, {}});
        return select_faces(mesh, faces);
    }
    void score_along(Mesh& mesh, std::vector<Index>& origin, const Vec2& a, const Vec2& b,
                     const std::vector<std::uint8_t>& wanted) {
        ScoreSettings settings;
        settings.plane = pulled_back(wall(a, b), settings_.to_world);
        settings.faces = wanted;
        ScoreResult scored = score(mesh, settings, result_.memory);
        merge_fates(result_.fates, scored.fates);
        std::vector<Index> from(scored.source.size());
        for (std::size_t f = 0; f < from.size(); ++f) from[f] = origin[scored.source[f]];
        origin = std::move(from);
        mesh = std::move(scored.mesh);
    }
    /// For each segment the faces that it enters.
    std::vector<std::vector<Index>> faces_by_segment(const Mesh& mesh) const {
        std::vector<std::vector<Index>> lists(footprint_.tree().edges().size());
        std::vector<Vec2> face;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            face.clear();
            for (const Index w : mesh.face_wedges(f))
                face.push_back(seen(mesh.positions[mesh.vertex_of_wedge(w)]));
            footprint_.tree().query(bounds_of(face), [&](Index i) {
                const auto& e = footprint_.tree().edges()[i];
                if (meeting(face, e.a, e.b) == OutlineMeeting::crossing) lists[i].push_back(f);
                return true;
            });
        }
        return lists;
    }
    /// The plane along the axis through a segment; it looks to the segment's left.
    Plane wall(const Vec2& a, const Vec2& b) const {
        const std::size_t u = settings_.axis == 0 ? 1 : 0, v = settings_.axis == 2 ? 1 : 2;
        Plane plane{{}, {}, 0};
        plane.normal[u] = -(b.y - a.y), plane.normal[v] = b.x - a.x;
        plane.through[u] = a.x, plane.through[v] = a.y;
        return plane;
    }

    const Footprint& footprint_;
    const CropSettings& settings_;
    Inside inside_;
    Seen seen_;
    std::vector<OutlineMeeting> meets_; ///< [faces] with any segment
    CropResult result_;
};

} // namespace

Vec2 seen_along(std::size_t axis, const Vec3& p) { return {axis == 0 ? p.y : p.x, axis == 2 ? p.y : p.z}; }

CropResult crop(const Mesh& mesh, const Footprint& footprint, const CropSettings& settings) {
    return Cropper(footprint, settings).run(mesh);
}

} // namespace facetmill
