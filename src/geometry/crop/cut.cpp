#include "geometry/crop/cut.hpp"

#include "base/parallel.hpp"
#include "geometry/crop/outline_walls.hpp"
#include "geometry/crop/piece_tree.hpp"
#include "geometry/cut/cut.hpp"
#include "mesh/topology.hpp"

#include <algorithm>

namespace facetmill {

namespace {

/// Which vertices count as on which planes.
class OnPlanes {
  public:
    /// Of the planes those of the memory come first, and what it knows of the points; no other knows any yet.
    OnPlanes(const CutMemory& memory, std::span<const Vec3> points) {
        grow(points.size());
        if (memory.entries.empty()) return;
        const auto at = memory.entries_at(points);
        for (std::size_t v = 0; v < at.size(); ++v)
            for (const auto plane : at[v]) add(static_cast<Index>(v), plane);
    }
    void grow(std::size_t vertices) { last_.resize(vertices, none); }
    bool has(Index vertex, Index plane) const {
        for (Index i = last_[vertex]; i != none; i = list_[i].next)
            if (list_[i].plane == plane) return true;
        return false;
    }
    void add(Index vertex, Index plane) {
        if (has(vertex, plane)) return;
        list_.push_back({plane, last_[vertex]});
        last_[vertex] = static_cast<Index>(list_.size() - 1);
    }
    template <class Visit>
    void for_planes(Index vertex, Visit&& visit) const {
        for (Index i = last_[vertex]; i != none; i = list_[i].next) visit(list_[i].plane);
    }

  private:
    struct Item {
        Index plane, next;
    };
    std::vector<Index> last_; ///< [vertices] into list_
    std::vector<Item> list_;
};

/// The planes of the outline's segments, numbered behind those of a memory; those that are one have one
/// number.
struct SegmentPlanes {
    std::vector<Plane> planes;  ///< [segments]
    std::vector<Index> numbers; ///< [segments]
    std::vector<Index> first;   ///< [numbers, beyond those of the memory] the segment whose plane it is
    std::vector<Index> sharing; ///< [numbers] segments and entries of the memory

    SegmentPlanes(const CropView& view, const CutMemory& memory) {
        for (const auto& e : view.footprint().tree().edges())
            planes.push_back(
                pulled_back(upright_plane(view.settings().axis, e.a, e.b), view.settings().to_world));
        std::vector<Plane> all;
        for (const auto& entry : memory.entries) all.push_back(entry.plane);
        const std::size_t known = all.size();
        all.insert(all.end(), planes.begin(), planes.end());
        const auto same = first_same_planes(all);
        std::vector<Index> number(all.size());
        sharing.assign(known, 1);
        for (std::size_t i = 0; i < all.size(); ++i) {
            number[i] = i < known ? static_cast<Index>(i) : number[same[i]];
            if (i < known) continue;
            if (same[i] == i) {
                number[i] = static_cast<Index>(sharing.size());
                first.push_back(static_cast<Index>(i - known));
                sharing.push_back(0);
            }
            ++sharing[number[i]];
            numbers.push_back(number[i]);
        }
    }
};

/// 16 units in the last place of the largest of these.
double rounding_of(std::initializer_list<double> sizes) {
    return 16 * 2.220446049250313e-16 * std::max(sizes);
}

/// Whether the line along an edge of a piece parts it from a segment, but for the rounding of points: as it
/// does from the next segment behind the last cut, which by its rounded corners may seem to enter. Not said
/// of pieces that are all on that line, such as faces seen edge-on. way: 1 for an anticlockwise piece, else
/// -1.
bool parts(const std::vector<Vec2>& piece, std::size_t edge, double way, double rounding,
           const polygon::RingTree::Edge& e) {
    const Vec2 &p = piece[edge], along = (piece[edge + 1 == piece.size() ? 0 : edge + 1] - p) * way;
    const double most = rounding * length(along);
    if (std::max(cross(along, e.a - p), cross(along, e.b - p)) > most) return false;
    double low = 0, high = 0;
    for (const Vec2& q : piece) {
        const double off = cross(along, q - p);
        low = std::min(low, off);
        high = std::max(high, off);
    }
    return low >= -most && high > most;
}

/// Cuts segment by segment, in their order. A cut touches the pieces that its segment enters and those that
/// share a cut edge with them, and looks at no others.
class Cutter {
  public:
    Cutter(const Mesh& mesh, const CropView& view, CutMemory& memory)
        : mesh_(mesh), view_(view), memory_(memory), segments_(view, memory), on_(memory, mesh.positions),
          edges_(build_edges(mesh)), corner_face_(corner_faces(mesh)), points_(mesh.positions),
          wedge_vertex_(mesh.wedge_vertex) {
        see_new_points();
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const auto wedges = mesh.face_wedges(f);
            pieces_.add_face({wedges.begin(), wedges.end()}, bounds(wedges));
            view.gather(mesh, f, face_);
            convex_.push_back(polygon::is_convex(face_));
        }
        was_cut_.resize(mesh.face_count());
        met_.resize(segments_.sharing.size());
    }

    OutlineCut run() {
        const auto lists = faces_by_segment();
        remember_shared(lists);
        for (Index s = 0; s < lists.size(); ++s)
            if (!lists[s].empty()) cut_along(s, lists[s]);
        make_mesh();
        remember_points();
        result_.cut_faces = static_cast<std::size_t>(std::count(was_cut_.begin(), was_cut_.end(), 1));
        result_.stays.resize(result_.mesh.face_count());
        parallel_for(
            result_.stays.size(),
            [&](std::size_t f) {
                const bool convex = convex_[origin_[f]] != 0;
                result_.stays[f] = view_.kept(view_.middle(result_.mesh, static_cast<Index>(f), convex));
            },
            256);
        return std::move(result_);
    }

  private:
    using Bounds = PieceTree::Bounds;
    using Lists = std::vector<std::vector<Index>>; ///< by segment: faces, ascending

    Index vertex_of(Index wedge) const { return wedge_vertex_.empty() ? wedge : wedge_vertex_[wedge]; }
    Bounds bounds(std::span<const Index> wedges) const {
        Bounds box;
        for (const Index w : wedges) box.add(seen_[vertex_of(w)]);
        return box;
    }
    const polygon::RingTree::Edge& segment(Index s) const { return view_.footprint().tree().edges()[s]; }
    void see_new_points() {
        for (std::size_t v = seen_.size(); v < points_.size(); ++v) seen_.push_back(view_.seen(points_[v]));
        on_.grow(points_.size());
        local_.resize(std::max(points_.size(), wedge_vertex_.size()));
        signs_.resize(points_.size());
        signed_for_.resize(points_.size(), none);
    }

    /// For each segment the faces that it enters.
    Lists faces_by_segment() const {
        Lists lists(segments_.planes.size());
        std::vector<Vec2> face;
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            view_.gather(mesh_, f, face);
            view_.meetings(face, [&](Index s, OutlineMeeting meets) {
                if (meets == OutlineMeeting::crossing) lists[s].push_back(f);
                return true;
            });
        }
        return lists;
    }
    /// Where several cuts are along one plane, points that an earlier one or another makes between vertices
    /// on that plane are to count as on it, too.
    void remember_shared(const Lists& lists) {
        for (Index s = 0; s < lists.size(); ++s) {
            if (segments_.sharing[segments_.numbers[s]] < 2) continue;
            for (const Index f : lists[s])
                for (const Index w : mesh_.face_wedges(f))
                    if (side(segments_.planes[s], points_[vertex_of(w)]) == 0)
                        on_.add(vertex_of(w), segments_.numbers[s]);
        }
    }

    std::int8_t sign_at(Index s, Index vertex) {
        if (signed_for_[vertex] == s) return signs_[vertex];
        signed_for_[vertex] = s;
        const double at = side(segments_.planes[s], points_[vertex]);
        const bool on = at == 0 || on_.has(vertex, segments_.numbers[s]);
        if (on) on_.add(vertex, segments_.numbers[s]);
        return signs_[vertex] = static_cast<std::int8_t>(on ? 0 : at > 0 ? 1 : -1);
    }

    /// Cuts the pieces of these faces that the segment still enters.
    void cut_along(Index s, const std::vector<Index>& faces) {
        find_entered(s, faces);
        if (touched_.empty()) return;
        met_[segments_.numbers[s]] = 1;
        std::erase_if(touched_, [&](Index piece) {
            bool above = false, below = false;
            for (const Index w : pieces_[piece].wedges) {
                const std::int8_t sign = sign_at(s, vertex_of(w));
                above |= sign > 0;
                below |= sign < 0;
            }
            return !(above && below);
        });
        if (touched_.empty()) return;
        const std::size_t to_cut = touched_.size();
        for (std::size_t i = 0; i < to_cut; ++i) find_neighbours(s, touched_[i]);
        cut(s, to_cut);
    }
    void find_entered(Index s, const std::vector<Index>& faces) {
        touched_.clear();
        const auto& e = segment(s);
        for (const Index f : faces)
            pieces_.query(f, polygon::RingTree::bounds(e), [&](Index piece) {
                face_.clear();
                for (const Index w : pieces_[piece].wedges) face_.push_back(seen_[vertex_of(w)]);
                if (is_parted(piece, e) || meeting(face_, e.a, e.b) != OutlineMeeting::crossing) return;
                was_cut_[f] = 1;
                touched_.push_back(piece);
            });
    }

    /// Whether an edge parts the piece, seen as face_, from the segment: most often the one that parted it
    /// from the last.
    bool is_parted(Index piece, const polygon::RingTree::Edge& e) {
        double size = std::max(length(e.a), length(e.b));
        for (const Vec2& p : face_) size = std::max(size, length(p));
        const double rounding = rounding_of({size}), way = polygon::signed_area(face_) > 0 ? 1 : -1;
        parting_.resize(std::max<std::size_t>(parting_.size(), piece + 1), 0);
        const std::size_t n = face_.size();
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t edge = (parting_[piece] + i) % n;
            if (!parts(face_, edge, way, rounding, e)) continue;
            parting_[piece] = static_cast<Index>(edge);
            return true;
        }
        return false;
    }

    /// Adds to what is touched the pieces that share an edge with this one at which that is cut.
    void find_neighbours(Index s, Index piece) {
        around_.assign(1, pieces_[piece].face);
        for (Index c = mesh_.face_begin(around_[0]); c < mesh_.face_end(around_[0]); ++c)
            if (edges_.corner_edge[c] != none)
                for (const Index other : edges_.corners_of(edges_.corner_edge[c]))
                    around_.push_back(corner_face_[other]);
        std::sort(around_.begin() + 1, around_.end());
        around_.erase(std::unique(around_.begin() + 1, around_.end()), around_.end());
        for_polygon_edges(pieces_[piece].wedges, [&](Index a, Index b) {
            const Index u = vertex_of(a), v = vertex_of(b);
            if (sign_at(s, u) * sign_at(s, v) >= 0) return;
            Bounds box;
            box.add(seen_[u]);
            box.add(seen_[v]);
            for (std::size_t i = 0; i < around_.size(); ++i)
                if (i == 0 || around_[i] != around_[0])
                    pieces_.query(around_[i], box, [&](Index other) { touch(other, u, v); });
        });
    }
    void touch(Index piece, Index u, Index v) {
        bool shares = false;
        for_polygon_edges(pieces_[piece].wedges, [&](Index a, Index b) {
            const Index from = vertex_of(a), to = vertex_of(b);
            shares |= (from == u && to == v) || (from == v && to == u);
        });
        if (shares && std::find(touched_.begin(), touched_.end(), piece) == touched_.end())
            touched_.push_back(piece);
    }

    /// Cuts the first of what is touched; the others get the points on their edges.
    void cut(Index s, std::size_t to_cut) {
        make_local();
        std::vector<std::int8_t> signs;
        for (const Index v : vertices_) signs.push_back(sign_at(s, v));
        std::vector<std::uint8_t> wanted(touched_.size());
        std::fill_n(wanted.begin(), to_cut, 1);
        const PlaneCut cut = cut_by_signs(part_, segments_.planes[s], std::move(signs), wanted);
        const auto first_vertex = static_cast<Index>(points_.size()),
                   first_wedge = static_cast<Index>(wedge_count());
        add_points(s, cut);
        const auto global = [&](std::span<const Index> wedges) {
            std::vector<Index> out;
            const auto old = static_cast<Index>(part_.wedge_count());
            for (const Index w : wedges)
                out.push_back(w >= old          ? first_wedge + (w - old)
                              : wedges_.empty() ? vertices_[w]
                                                : wedges_[w]);
            return out;
        };
        const Pieces front = pieces_on_side(cut, 1), back = pieces_on_side(cut, -1);
        std::size_t next_front = 0, next_back = 0;
        for (const Index f : cut.cut_faces) {
            std::vector<std::vector<Index>> parts;
            for (; next_front < front.size() && front.source[next_front] == f; ++next_front)
                parts.push_back(global(front.of(next_front)));
            for (; next_back < back.size() && back.source[next_back] == f; ++next_back)
                parts.push_back(global(back.of(next_back)));
            std::vector<Bounds> boxes;
            boxes.reserve(parts.size());
            for (const auto& wedges : parts) boxes.push_back(bounds(wedges));
            pieces_.replace(touched_[f], std::move(parts), boxes);
        }
        std::vector<Index> polygon;
        for (std::size_t i = 0; i < cut.passing.size(); ++i) {
            passing_with_points(cut, i, polygon);
            auto wedges = global(polygon);
            const Bounds box = bounds(wedges);
            pieces_.reshape(touched_[cut.passing[i]], std::move(wedges), box);
        }
        remember_corners(s, first_vertex);
    }
    /// What is touched as a mesh of its own, vertices and wedges in their order.
    void make_local() {
        const auto numbered = [&](std::vector<Index>& all) {
            std::sort(all.begin(), all.end());
            all.erase(std::unique(all.begin(), all.end()), all.end());
        };
        vertices_.clear();
        wedges_.clear();
        for (const Index piece : touched_)
            for (const Index w : pieces_[piece].wedges) {
                vertices_.push_back(vertex_of(w));
                if (!wedge_vertex_.empty()) wedges_.push_back(w);
            }
        numbered(vertices_);
        numbered(wedges_);
        part_.positions.clear();
        part_.wedge_vertex.clear();
        part_.corners.clear();
        part_.face_offsets.assign(1, 0);
        for (Index i = 0; i < vertices_.size(); ++i) {
            part_.positions.push_back(points_[vertices_[i]]);
            local_[vertices_[i]] = i;
        }
        for (const Index w : wedges_) part_.wedge_vertex.push_back(local_[vertex_of(w)]);
        for (Index i = 0; i < wedges_.size(); ++i) local_[wedges_[i]] = i;
        for (const Index piece : touched_) {
            for (const Index w : pieces_[piece].wedges) part_.corners.push_back(local_[w]);
            part_.face_offsets.push_back(static_cast<Index>(part_.corners.size()));
        }
    }
    std::size_t wedge_count() const { return wedge_vertex_.empty() ? points_.size() : wedge_vertex_.size(); }
    /// A point made on an edge is on the segment's plane and on all that both its ends are on.
    void add_points(Index s, const PlaneCut& cut) {
        const auto first = static_cast<Index>(points_.size());
        points_.insert(points_.end(), cut.points.begin(), cut.points.end());
        for (const auto& e : cut.vertices) new_vertices_.push_back({vertices_[e.a], vertices_[e.b], e.t});
        if (!wedge_vertex_.empty()) {
            for (const auto& e : cut.wedges) new_wedges_.push_back({wedges_[e.a], wedges_[e.b], e.t});
            for (const Index v : cut.wedge_vertex)
                wedge_vertex_.push_back(first + (v - static_cast<Index>(part_.vertex_count())));
        }
        see_new_points();
        for (std::size_t i = 0; i < cut.vertices.size(); ++i) {
            const auto v = static_cast<Index>(first + i);
            const Index a = vertices_[cut.vertices[i].a], b = vertices_[cut.vertices[i].b];
            on_.add(v, segments_.numbers[s]);
            on_.for_planes(a, [&](Index plane) {
                if (on_.has(b, plane)) shared_.push_back(plane);
            });
            for (const Index plane : shared_) on_.add(v, plane);
            shared_.clear();
        }
    }
    /// New points at a corner of the outline, but for rounding, are on the next segment's plane, too: else an
    /// edge that passes the corner would be cut twice there.
    void remember_corners(Index s, Index first_vertex) {
        const auto& e = segment(s);
        for (Index v = first_vertex; v < points_.size(); ++v) {
            const double rounding =
                rounding_of({length(points_[v]), length(seen_[v]), length(e.a), length(e.b)});
            if (length(seen_[v] - e.a) <= rounding) on_.add(v, segments_.numbers[e.previous]);
            if (length(seen_[v] - e.b) <= rounding) on_.add(v, segments_.numbers[e.next]);
        }
    }

    void make_mesh() {
        Mesh& out = result_.mesh;
        Descent descent;
        out.face_offsets.push_back(0);
        for (Index f = 0; f < mesh_.face_count(); ++f)
            pieces_.for_pieces(f, [&](Index piece) {
                const auto& wedges = pieces_[piece].wedges;
                out.corners.insert(out.corners.end(), wedges.begin(), wedges.end());
                out.face_offsets.push_back(static_cast<Index>(out.corners.size()));
                descent.faces.push_back(f);
            });
        normalise_offsets(out);
        out.positions = points_;
        out.wedge_vertex = wedge_vertex_;
        descent.vertices.identity = descent.wedges.identity = true;
        descent.vertices.chained = descent.wedges.chained = true;
        descent.vertices.edges = std::move(new_vertices_);
        descent.wedges.edges = std::move(new_wedges_);
        descent.wedges_as_vertices = wedge_vertex_.empty();
        result_.changes = inherit_attributes(out, mesh_, descent);
        origin_ = std::move(descent.faces);
    }
    void remember_points() {
        const auto known = static_cast<Index>(memory_.entries.size());
        std::vector<std::vector<Vec3>> made(met_.size()); // by plane
        for (auto v = static_cast<Index>(mesh_.vertex_count()); v < points_.size(); ++v)
            on_.for_planes(v, [&](Index plane) { made[plane].push_back(points_[v]); });
        for (Index plane = 0; plane < made.size(); ++plane) {
            if (made[plane].empty() && !met_[plane]) continue;
            std::size_t entry = plane;
            if (plane >= known) {
                entry = memory_.entries.size();
                memory_.entries.push_back({segments_.planes[segments_.first[plane - known]], 0, {}});
            }
            memory_.add_to(entry, std::move(made[plane]));
        }
    }

    const Mesh& mesh_;
    const CropView& view_;
    CutMemory& memory_;
    SegmentPlanes segments_;
    OnPlanes on_;
    EdgeTable edges_;
    std::vector<Index> corner_face_;
    PieceTree pieces_;
    std::vector<Vec3> points_;                             ///< [vertices] those of the mesh, and new ones
    std::vector<Index> wedge_vertex_;                      ///< [wedges] empty without seams
    std::vector<Lineage::Edge> new_vertices_, new_wedges_; ///< on which edge each was made
    std::vector<Vec2> seen_;                               ///< [vertices]
    std::vector<std::int8_t> signs_;                       ///< [vertices] by the segment that
    std::vector<Index> signed_for_;                        ///< [vertices] this says
    std::vector<std::uint8_t> was_cut_, convex_;           ///< [faces]
    std::vector<Index> parting_;    ///< [pieces, as far as asked for] an edge that parted it from a segment
    std::vector<std::uint8_t> met_; ///< [planes] a segment of it entered a piece
    OutlineCut result_;
    std::vector<Index> origin_; ///< [faces of the result]
    // Of the cut that is being made:
    std::vector<Index> touched_; ///< pieces: those to be cut, then those that share a cut edge
    Mesh part_;
    std::vector<Index> vertices_, wedges_; ///< [vertices and wedges of part_] wedges: empty without seams
    std::vector<Index> local_;             ///< back from these
    std::vector<Index> around_, shared_;
    std::vector<Vec2> face_;
};

} // namespace

OutlineCut cut_at_outline(const Mesh& mesh, const CropView& view, CutMemory& memory) {
    return Cutter(mesh, view, memory).run();
}

} // namespace facetmill
