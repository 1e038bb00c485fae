#include "geometry/clip/clip.hpp"

#include "base/refusal.hpp"
#include "geometry/clip/assemble.hpp"
#include "geometry/cut/score.hpp"
#include "geometry/edit/redrawn_faces.hpp"
#include "geometry/edit/split_non_manifold.hpp"
#include "geometry/inspect/connectivity.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace facetmill {

namespace {

// Clips by one plane after the other, and by convex bodies.

/// Name of the attributes that number the elements of the scored mesh, to trace the elements of the clipped
/// mesh.
constexpr std::string_view trace = "#trace";

void number(Mesh& mesh, Domain domain, Index first) {
    std::vector<std::uint32_t> numbers(mesh.count(domain));
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<Index>(i) + first;
    mesh.attributes.push_back({std::string(trace), domain, Role::index, 1, false, std::move(numbers)});
}

const std::vector<std::uint32_t>& numbers_of(const Mesh& mesh, Domain domain) {
    return std::get<std::vector<std::uint32_t>>(mesh.find(trace, domain)->data);
}

void forget(Mesh& mesh) {
    for (const Domain d : {Domain::vertex, Domain::wedge, Domain::face}) mesh.drop(trace, d);
}

/// Builds the back: the faces of the scored mesh that are not in the front, and the reversed caps of the
/// front.
class Rest {
  public:
    Rest(const Mesh& scored, const Mesh& front) : from_(scored), front_(front) {}

    Mesh run() {
        taken_.resize(from_.face_count());
        for (const Index f : numbers_of(front_, Domain::face))
            if (f > 0) taken_[f - 1] = 1;
        find_inserted();
        Mesh walls = keep_walls();
        append_caps(walls);
        forget(walls);
        normalise_offsets(walls);
        drop_unused(walls);
        return walls;
    }

  private:
    /// The vertex of the scored mesh that a vertex of the front comes from; none for new vertices of caps.
    Index traced(Index v) const {
        const Index i = numbers_of(front_, Domain::vertex)[v];
        return i < from_.vertex_count() && from_.positions[i] == front_.positions[v] ? i : none;
    }

    /// Finds points that caps inserted into edges of the front's walls, where contours cross.
    void find_inserted() {
        for (Index f = 0; f < front_.face_count(); ++f) {
            const Index source = numbers_of(front_, Domain::face)[f];
            if (source == 0 || front_.face_size(f) == from_.face_size(source - 1)) continue;
            std::vector<Index> ring;
            for (const Index w : front_.face_wedges(f)) ring.push_back(front_.vertex_of_wedge(w));
            std::rotate(ring.begin(),
                        std::find_if(ring.begin(), ring.end(), [&](Index v) { return traced(v) != none; }),
                        ring.end());
            for (std::size_t i = 0; i < ring.size();) {
                std::size_t end = i + 1;
                while (end < ring.size() && traced(ring[end]) == none) ++end;
                if (end > i + 1) {
                    const Index a = traced(ring[i]), b = traced(ring[end % ring.size()]);
                    std::vector<Vec3>& points = inserted_[{std::min(a, b), std::max(a, b)}];
                    points.clear();
                    for (std::size_t k = i + 1; k < end; ++k) points.push_back(front_.positions[ring[k]]);
                    if (a > b) std::reverse(points.begin(), points.end());
                }
                i = end;
            }
        }
    }

    Mesh keep_walls() {
        RedrawnFaces kept(from_);
        for (Index f = 0; f < from_.face_count(); ++f) {
            if (taken_[f]) continue;
            for_polygon_edges(from_.face_wedges(f), [&](Index a, Index b) {
                kept.mesh.corners.push_back(a);
                if (!inserted_.empty()) insert(kept.mesh, kept.provenance, a, b);
            });
            kept.end_face(f);
        }
        inherit_attributes(kept.mesh, from_, kept.provenance);
        return std::move(kept.mesh);
    }

    /// Inserts a vertex per point and, with seams, a wedge per pair of wedges.
    void insert(Mesh& out, MeshProvenance& provenance, Index a, Index b) {
        const Index va = from_.vertex_of_wedge(a), vb = from_.vertex_of_wedge(b);
        const auto at = inserted_.find({std::min(va, vb), std::max(va, vb)});
        if (at == inserted_.end()) return;
        std::vector<Index> wedges;
        for (const Vec3& p : at->second) {
            const Vec3 &low = from_.positions[at->first.first], &high = from_.positions[at->first.second];
            const double size = dot(high - low, high - low);
            const double t = size > 0 ? std::clamp(dot(p - low, high - low) / size, 0.0, 1.0) : 0.0;
            auto [vertex, fresh] = vertex_at_.try_emplace({p.x, p.y, p.z});
            if (fresh) {
                vertex->second = static_cast<Index>(out.positions.size());
                out.positions.push_back(p);
                provenance.vertices.edges.push_back({at->first.first, at->first.second, t});
            }
            auto [wedge, made] = wedge_at_.try_emplace({std::min(a, b), std::max(a, b), vertex->second});
            if (made) {
                wedge->second =
                    out.has_seams() ? static_cast<Index>(out.wedge_vertex.size()) : vertex->second;
                const Index first = va < vb ? a : b, second = va < vb ? b : a;
                if (out.has_seams()) out.wedge_vertex.push_back(vertex->second);
                if (out.has_seams() || fresh) provenance.wedges.edges.push_back({first, second, t});
            }
            wedges.push_back(wedge->second);
        }
        if (va > vb) std::reverse(wedges.begin(), wedges.end());
        out.corners.insert(out.corners.end(), wedges.begin(), wedges.end());
    }

    void append_caps(Mesh& walls) {
        const Mesh caps = turned_caps();
        if (caps.face_count() == 0) return;
        const auto first_wedge = static_cast<Index>(walls.wedge_count());
        const std::size_t first_corner = walls.corner_count();
        const bool own = caps_have_own_wedges(walls);
        append(walls, caps);
        if (own && !walls.has_seams()) {
            walls.wedge_vertex.resize(walls.vertex_count());
            for (Index i = 0; i < walls.wedge_vertex.size(); ++i) walls.wedge_vertex[i] = i;
        }
        // Caps use the walls' vertices where they meet.
        const auto vertex_numbers = numbers_of(caps, Domain::vertex),
                   wedge_numbers = numbers_of(caps, Domain::wedge);
        for (std::size_t c = first_corner; c < walls.corner_count(); ++c) {
            Index& w = walls.corners[c];
            const Index wedge = w - first_wedge, vertex = caps.vertex_of_wedge(wedge);
            const Index shared = shared_vertex(walls, caps, vertex, vertex_numbers[vertex]);
            if (shared == none) continue;
            if (own)
                walls.wedge_vertex[w] = shared;
            else if (!walls.has_seams())
                w = shared;
            else if (wedge_numbers[wedge] < from_.wedge_count() &&
                     from_.vertex_of_wedge(wedge_numbers[wedge]) == shared)
                w = wedge_numbers[wedge];
            else
                walls.wedge_vertex[w] = shared;
        }
    }
    Index shared_vertex(const Mesh& walls, const Mesh& caps, Index vertex, Index numbered) const {
        const Vec3& p = caps.positions[vertex];
        if (numbered < from_.vertex_count() && walls.positions[numbered] == p) return numbered;
        const auto at = vertex_at_.find({p.x, p.y, p.z});
        return at == vertex_at_.end() ? none : at->second;
    }

    /// The reversed caps of the front.
    Mesh turned_caps() const {
        RedrawnFaces caps(front_);
        Mesh& out = caps.mesh;
        for (Index f = 0; f < front_.face_count(); ++f) {
            if (numbers_of(front_, Domain::face)[f] != 0) continue;
            const auto wedges = front_.face_wedges(f);
            out.corners.insert(out.corners.end(), wedges.rbegin(), wedges.rend());
            caps.end_face(f);
        }
        inherit_attributes(out, front_, caps.provenance);
        drop_unused(out);
        turn(out);
        return std::move(caps.mesh);
    }
    /// Normals are reversed; textures are not mirrored.
    static void turn(Mesh& caps) {
        for (Attribute& a : caps.attributes) {
            if (a.domain != Domain::wedge) continue;
            const bool vector = a.role == Role::normal || a.role == Role::tangent;
            for (std::size_t w = 0; w < a.size(); ++w) {
                for (int c = 0; vector && c < 3; ++c) a.set_value(w, c, -a.value(w, c));
                if (a.role == Role::uv && a.name == "TEXCOORD_0") a.set_value(w, 0, 1 - a.value(w, 0));
            }
        }
    }

    const Mesh &from_, &front_;
    std::vector<std::uint8_t> taken_; ///< [faces of from_] 1 for faces in the front
    std::map<std::pair<Index, Index>, std::vector<Vec3>> inserted_; ///< by edge, in order from its low vertex
    std::map<std::array<double, 3>, Index> vertex_at_;              ///< vertices of inserted points
    std::map<std::array<Index, 3>, Index> wedge_at_; ///< wedges by (wedges of the edge, vertex)
};

FlatSide flat_side(const Mesh& mesh, const ClipSettings& settings) {
    if (is_closed(mesh)) return FlatSide::by_normal;
    return settings.coplanar == Coplanar::keep ? FlatSide::front : FlatSide::back;
}

/// Clips by one plane after the other.
class Clipper {
  public:
    explicit Clipper(const ClipSettings& settings) : settings_(settings) {}

    ClipResult run(Mesh mesh) {
        result_.memory = settings_.memory;
        if (settings_.snap) snap_ = rounding_of(mesh);
        if (settings_.cap && settings_.cap_numbers) {
            last_cut_ = largest_number(mesh, cut_id_attribute);
            last_group_ = largest_number(mesh, group_attribute);
        }
        for (std::size_t i = 0; i < settings_.planes.size(); ++i) cut(mesh, i);
        if (settings_.keep != Keep::both)
            (settings_.keep == Keep::front ? result_.front : result_.back) = std::move(mesh);
        return std::move(result_);
    }
    /// Whether caps touch faces that end in their planes, of a manifold mesh.
    bool solids_touch() const { return touches_ && !overlaps_; }
    /// Whether the mesh intersects itself in a cap. Its caps are not manifold then, and stay so.
    bool overlaps() const { return overlaps_; }

  private:
    void cut(Mesh& mesh, std::size_t number) {
        PlaneCut cut = cut_by_plane(mesh, settings_.planes[number], {snap_, &result_.memory});
        result_.cut_faces += cut.cut_faces.size();
        result_.on_plane += cut.on_count;
        result_.snapped += cut.snapped_count;
        result_.snapped_by = std::max(result_.snapped_by, cut.snapped_by);
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

    /// Keeps or drops a mesh that the plane misses.
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
        const bool keep = settings_.coplanar == Coplanar::keep;
        if (is_closed(*cut.mesh) || (settings_.keep == Keep::both && keep)) return settle_flat_by_normal(cut);
        const int kept = settings_.keep == Keep::front ? 1 : -1;
        settle_flat(cut, keep ? kept : 0);
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
        overlaps_ |= cap.overlaps;
        if (settings_.cap && cut.on_count > 0 && !overlaps_ && !touches_)
            touches_ = !connectivity_of(made.mesh).is_manifold() && connectivity_of(*cut.mesh).is_manifold();
        return std::move(made.mesh);
    }

    const ClipSettings& settings_;
    ClipResult result_;
    CoordinateErrors snap_;
    bool touches_ = false, overlaps_ = false;
    Index last_cut_ = 0, last_group_ = 0; ///< existing numbers
    std::vector<Vec3> made_;              ///< by the caps of a plane
};

/// Points added on edges count as on the planes that contain both ends.
void remember_middles(CutMemory& memory, const DividedEdges& divided, const Mesh& before) {
    std::vector<Vec3> ends;
    ends.reserve(2 * divided.edges.size());
    for (const auto& e : divided.edges)
        ends.insert(ends.end(), {before.positions[e.low], before.positions[e.high]});
    const auto at = memory.entries_at(ends);
    std::vector<std::vector<Vec3>> on(memory.entries.size());
    for (std::size_t i = 0; i < divided.edges.size(); ++i)
        for (const auto entry : at[2 * i])
            if (std::binary_search(at[2 * i + 1].begin(), at[2 * i + 1].end(), entry))
                on[entry].push_back(divided.edges[i].point);
    for (std::size_t entry = 0; entry < on.size(); ++entry)
        if (!on[entry].empty()) memory.add_to(entry, std::move(on[entry]));
}

/// A cap may touch faces that end in the plane. At such an edge or vertex, the solids on both sides are
/// separated, as in combine. The separation waits until all planes have cut, because clip_body copies the
/// caps of the front to the back.
void separate_solids(ClipResult& result) {
    for (Mesh* mesh : {&result.front, &result.back}) {
        if (connectivity_of(*mesh).is_manifold()) continue;
        std::size_t parted = 0;
        const EdgeTable edges = part_fans(*mesh, parted);
        DividedEdges divided = divide_crowded_edges(*mesh, edges, {});
        if (divided.edges.empty()) continue;
        remember_middles(result.memory, divided, *mesh);
        merge_changes(result.changes, divided.changes);
        *mesh = std::move(divided.mesh);
    }
}

/// Clips by all planes at once. The front is in front of every plane, as after successive cuts; the back is
/// the rest. The mesh is first scored along the body's faces. The back gets the reversed caps of the front,
/// so both fit exactly, and with caps a closed mesh gives two closed meshes. settings.keep must be back or
/// both.
ClipResult clip_body(Mesh mesh, const ClipSettings& settings) {
    ClipResult all;
    ClipSettings inner = settings;
    inner.keep = Keep::front;
    inner.convex = false;
    inner.triangulate = false;
    const CoordinateErrors snap = settings.snap ? rounding_of(mesh) : CoordinateErrors{};
    const FlatSide flat = flat_side(mesh, settings);
    std::vector<std::uint8_t> inside(mesh.face_count(), 1);
    for (const Plane& plane : settings.planes) {
        ScoreResult scored = score(mesh, {plane, inside, flat, snap}, inner.memory);
        std::vector<std::uint8_t> still(scored.source.size());
        for (std::size_t f = 0; f < still.size(); ++f)
            still[f] = inside[scored.source[f]] != 0 && scored.sides[f] > 0;
        inside = std::move(still);
        mesh = std::move(scored.mesh);
        all.cut_faces += scored.cut_faces;
    }
    number(mesh, Domain::vertex, 0);
    number(mesh, Domain::wedge, 0);
    number(mesh, Domain::face, 1);
    Clipper clipper(inner);
    ClipResult front = clipper.run(mesh);
    const std::size_t cut = all.cut_faces;
    all = std::move(front);
    all.cut_faces = cut;
    forget_change(all.changes, trace);
    // The whole mesh is inside the body.
    all.back = Rest(mesh, all.front).run();
    forget(all.front);
    if (settings.keep == Keep::back) all.front = {};
    if (settings.cap && !clipper.overlaps() && connectivity_of(mesh).is_manifold()) separate_solids(all);
    return all;
}

ClipResult clip_by_planes(Mesh mesh, const ClipSettings& settings) {
    Clipper clipper(settings);
    ClipResult all = clipper.run(std::move(mesh));
    if (clipper.solids_touch()) separate_solids(all);
    return all;
}

/// The same for a point cloud: the back has all points that are not in the front.
ClipResult clip_cloud(Mesh mesh, const ClipSettings& settings) {
    ClipSettings inner = settings;
    inner.keep = Keep::front;
    inner.convex = false;
    number(mesh, Domain::vertex, 0);
    Mesh rest = mesh;
    ClipResult all = clip(std::move(mesh), inner);
    std::vector<std::uint8_t> goes(rest.vertex_count());
    for (const Index v : numbers_of(all.front, Domain::vertex)) goes[v] = 1;
    drop_unused(rest, goes);
    forget_change(all.changes, trace);
    forget(all.front);
    forget(rest);
    all.changed = settings.keep == Keep::both ? rest.vertex_count() > 0 : all.front.vertex_count() > 0;
    all.back = std::move(rest);
    if (settings.keep == Keep::back) all.front = {};
    return all;
}

void make_triangles(ClipResult& result) {
    for (Mesh* m : {&result.front, &result.back})
        if (!m->all_triangles()) *m = triangulated(*m);
}

} // namespace

ClipResult clip(Mesh mesh, const ClipSettings& settings) {
    for (const Plane& plane : settings.planes) check_plane(plane);
    const bool body = settings.convex && settings.keep != Keep::front && settings.planes.size() > 1;
    if (!body && settings.keep == Keep::both && settings.planes.size() != 1)
        throw_refusal("clip", Refusal{"keep", "'keep: both' takes exactly one plane",
                                      "clip once for every plane, or keep the front or the back"});
    ClipResult result = !body                      ? clip_by_planes(std::move(mesh), settings)
                        : mesh.corner_count() == 0 ? clip_cloud(std::move(mesh), settings)
                                                   : clip_body(std::move(mesh), settings);
    if (settings.triangulate) make_triangles(result);
    return result;
}

} // namespace facetmill
