#include "geometry/crop/segment_cutter.hpp"

#include "geometry/crop/piece_tree.hpp"
#include "geometry/crop/pieces_at_edges.hpp"
#include "mesh/topology.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <limits>

namespace facetmill {

namespace {

/// 16 units in the last place of the largest value.
double rounding_of(std::initializer_list<double> sizes) {
    return 16 * 2.220446049250313e-16 * std::max(sizes);
}

/// Cached shape of a piece, reused for successive segments.
struct PieceShape {
    double square = -1; ///< squared distance of the farthest corner; negative: unknown
    double way = 1;     ///< 1 for an anticlockwise piece, otherwise -1
    Index parting = 0; ///< the edge that last separated the piece from a segment (modulo the number of edges)
    double low = 0,
           high = -1; ///< extent behind and in front of this edge, times the edge's length; high < 0: unknown
};

/// A frame in which the pieces of a face have narrow boxes. Its first axis follows the longest segment that
/// enters the face, because most of these segments are roughly parallel.
class Frame {
  public:
    Frame() = default;
    explicit Frame(const Vec2& segment) {
        const Vec2 unit = segment * (1 / length(segment));
        if (std::isfinite(unit.x) && std::isfinite(unit.y)) along_ = unit;
    }
    Vec2 operator()(const Vec2& p) const { return {dot(along_, p), cross(along_, p)}; }

  private:
    Vec2 along_{1, 0};
};

/// Cuts one segment after the other. A cut visits only the pieces that its segment enters, and pieces that
/// share a cut edge with them.
class SegmentCutter {
  public:
    SegmentCutter(const Mesh& mesh, const EnteredFaces& entered, const CropView& view,
                  const SegmentPlanes& segments, OnPlanes on)
        : mesh_(mesh), view_(view), segments_(segments), on_(std::move(on)), edges_(build_edges(mesh)),
          corner_face_(corner_faces(mesh)), points_(mesh.positions), wedge_vertex_(mesh.wedge_vertex) {
        see_new_points();
        find_frames(entered);
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const auto wedges = mesh.face_wedges(f);
            pieces_.add_face({wedges.begin(), wedges.end()}, bounds(f, wedges));
        }
        was_cut_.resize(mesh.face_count());
    }

    CutFaces run(const EnteredFaces& entered) {
        remember_shared(entered);
        for (std::size_t i = 0; i < entered.segments.size(); ++i)
            cut_along(entered.segments[i], entered.of(i));
        return finished();
    }

  private:
    using Bounds = PieceTree::Bounds;

    Index vertex_of(Index wedge) const { return wedge_vertex_.empty() ? wedge : wedge_vertex_[wedge]; }
    /// The bounds of a piece in the frame of the face.
    Bounds bounds(Index face, std::span<const Index> wedges) const {
        Bounds box;
        for (const Index w : wedges) box.add(frames_[face](seen_[vertex_of(w)]));
        return box;
    }
    /// The bounds of an edge in the frame of the face, enlarged by the rounding of points.
    Bounds bounds(Index face, const polygon::RingTree::Edge& e) const {
        Bounds box;
        for (const Vec2& p : {e.a, e.b}) box.add(frames_[face](p));
        const double wider =
            std::max(rounding_of({size_, length(e.a), length(e.b)}), std::numeric_limits<double>::min());
        if (!std::isfinite(wider)) return {-HUGE_VAL, -HUGE_VAL, HUGE_VAL, HUGE_VAL};
        return {box.x0 - wider, box.y0 - wider, box.x1 + wider, box.y1 + wider};
    }
    /// Chooses the frames. Concave and edge-on faces keep the default frame, because their intersection tests
    /// are not exact. With a frame, their pieces would depend on which segment is the longest.
    void find_frames(const EnteredFaces& entered) {
        for (const Vec2& p : seen_) size_ = std::max(size_, length(p));
        frames_.resize(mesh_.face_count());
        std::vector<double> longest(mesh_.face_count());
        for (std::size_t i = 0; i < entered.segments.size(); ++i) {
            const auto& e = segment(entered.segments[i]);
            for (const Index f : entered.of(i))
                if (const double size = length(e.b - e.a); size > longest[f]) {
                    longest[f] = size;
                    frames_[f] = Frame(e.b - e.a);
                }
        }
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (!(longest[f] > 0)) continue;
            view_.gather(mesh_, f, face_);
            if (!polygon::is_convex(face_) || polygon::orientation(face_) == 0) frames_[f] = {};
        }
    }
    const polygon::RingTree::Edge& segment(Index s) const { return view_.footprint().tree().edges()[s]; }
    void see_new_points() {
        for (std::size_t v = seen_.size(); v < points_.size(); ++v) seen_.push_back(view_.seen(points_[v]));
        on_.grow(points_.size());
        local_.resize(std::max(points_.size(), wedge_vertex_.size()));
        signs_.resize(points_.size());
        sides_.resize(points_.size());
        signed_for_.resize(points_.size(), none);
    }

    /// If several cuts share a plane, records the vertices on it. Then new points between such vertices also
    /// count as on the plane.
    void remember_shared(const EnteredFaces& entered) {
        for (std::size_t i = 0; i < entered.segments.size(); ++i) {
            const Index s = entered.segments[i];
            if (segments_.sharing[segments_.numbers[s]] < 2) continue;
            for (const Index f : entered.of(i))
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
        sides_[vertex] = at;
        return signs_[vertex] = static_cast<std::int8_t>(on ? 0 : at > 0 ? 1 : -1);
    }

    /// Cuts the pieces of these faces that the segment still enters.
    void cut_along(Index s, std::span<const Index> faces) {
        find_entered(s, faces);
        if (touched_.empty()) return;
        made_.met.push_back(segments_.numbers[s]);
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
        touched_for_.resize(pieces_.numbers(), none);
        for (const Index piece : touched_) touched_for_[piece] = s;
        for (std::size_t i = 0; i < to_cut; ++i) find_neighbours(s, touched_[i]);
        if (is_plain(s, to_cut))
            cut_plain(s, to_cut);
        else
            cut(s, to_cut);
    }
    void find_entered(Index s, std::span<const Index> faces) {
        touched_.clear();
        const auto& e = segment(s);
        for (const Index f : faces)
            pieces_.query(f, bounds(f, e), [&](Index piece) {
                if (is_parted(piece, e)) return;
                gather(piece);
                if (meeting(face_, e.a, e.b) != OutlineMeeting::crossing) return;
                was_cut_[f] = 1;
                touched_.push_back(piece);
            });
    }
    /// Fills face_ with the corners of a piece.
    void gather(Index piece) {
        face_.clear();
        for (const Index w : pieces_[piece].wedges) face_.push_back(seen_[vertex_of(w)]);
    }

    /// True if the line along an edge separates a piece from a segment, within the rounding of points. This
    /// is usual after a cut: because of rounded corners, the next segment may seem to enter the piece.
    /// Pieces entirely on that line, such as edge-on faces, are not separated. The edge that separated the
    /// piece from the previous segment is tested first.
    bool is_parted(Index piece, const polygon::RingTree::Edge& e) {
        PieceShape& shape = shape_of(piece);
        const double rounding =
            rounding_of({std::sqrt(std::max({shape.square, dot(e.a, e.a), dot(e.b, e.b)}))});
        const std::size_t n = pieces_[piece].wedges.size();
        for (std::size_t i = 0; i < n; ++i)
            if (parts(piece, shape, (shape.parting + i) % n, rounding, e)) return true;
        return false;
    }
    /// True if this edge separates them; records it.
    bool parts(Index piece, PieceShape& shape, std::size_t edge, double rounding,
               const polygon::RingTree::Edge& e) {
        const auto& wedges = pieces_[piece].wedges;
        const auto corner = [&](std::size_t i) -> const Vec2& { return seen_[vertex_of(wedges[i])]; };
        const std::size_t n = wedges.size();
        const Vec2 &p = corner(edge), along = (corner(edge + 1 == n ? 0 : edge + 1) - p) * shape.way;
        const double most = rounding * length(along);
        if (std::max(cross(along, e.a - p), cross(along, e.b - p)) > most) return false;
        if (edge == shape.parting && shape.high >= 0) return shape.low >= -most && shape.high > most;
        double low = 0, high = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const double off = cross(along, corner(i) - p);
            low = std::min(low, off);
            high = std::max(high, off);
        }
        if (!(low >= -most && high > most)) return false;
        shape.parting = static_cast<Index>(edge);
        shape.low = low;
        shape.high = high;
        return true;
    }
    PieceShape& shape_of(Index piece) {
        if (shapes_.size() <= piece) shapes_.resize(pieces_.numbers());
        PieceShape& shape = shapes_[piece];
        if (shape.square >= 0) return shape;
        gather(piece);
        for (const Vec2& p : face_) shape.square = std::max(shape.square, dot(p, p));
        shape.way = polygon::signed_area(face_) > 0 ? 1 : -1;
        return shape;
    }
    /// Call it when a piece gets other corners. The separating edge may still exist.
    void forget_shape(Index piece) {
        if (piece < shapes_.size()) shapes_[piece].square = shapes_[piece].high = -1;
    }

    /// Adds the neighbours at cut edges to the touched pieces. These are whole faces, and pieces of earlier
    /// cuts.
    void find_neighbours(Index s, Index piece) {
        look_around(pieces_[piece].face);
        for_polygon_edges(pieces_[piece].wedges, [&](Index a, Index b) {
            const Index u = vertex_of(a), v = vertex_of(b);
            if (sign_at(s, u) * sign_at(s, v) >= 0) return;
            // A whole face is the piece with its own number; at_edges_ does not contain it.
            if (std::max(u, v) < mesh_.vertex_count())
                for (const Index f : around_) touch(f, s, u, v);
            at_edges_.visit(u, v, [&](Index other) {
                if (std::find(around_.begin(), around_.end(), pieces_[other].face) != around_.end())
                    touch(other, s, u, v);
            });
        });
    }
    /// Collects a face and the faces that share an edge with it, once each.
    void look_around(Index face) {
        if (!around_.empty() && around_[0] == face) return;
        around_.assign(1, face);
        for (Index c = mesh_.face_begin(face); c < mesh_.face_end(face); ++c)
            if (edges_.corner_edge[c] != none)
                for (const Index other : edges_.corners_of(edges_.corner_edge[c]))
                    if (std::find(around_.begin(), around_.end(), corner_face_[other]) == around_.end())
                        around_.push_back(corner_face_[other]);
    }
    /// Records the edges of a piece. With first_new, records only edges with an end that is this vertex or
    /// later.
    void note_edges(Index piece, Index first_new = 0) {
        for_polygon_edges(pieces_[piece].wedges, [&](Index a, Index b) {
            const Index u = vertex_of(a), v = vertex_of(b);
            if (std::max(u, v) >= first_new) at_edges_.add(u, v, piece);
        });
    }
    void touch(Index piece, Index s, Index u, Index v) {
        if (touched_for_[piece] == s) return;
        const auto& wedges = pieces_[piece].wedges;
        for (std::size_t i = 0, n = wedges.size(); i < n; ++i) {
            const Index from = vertex_of(wedges[i]), to = vertex_of(wedges[i + 1 == n ? 0 : i + 1]);
            if ((from != u || to != v) && (from != v || to != u)) continue;
            touched_for_[piece] = s;
            touched_.push_back(piece);
            return;
        }
    }

    // --- the usual cut, which passes between vertices and divides each piece in two

    /// A cut edge by its vertices or wedges; the end at the lower vertex comes first.
    struct Ends {
        Index low, high;
        auto operator<=>(const Ends&) const = default;
    };
    Ends ends_of(Index a, Index b) const { return vertex_of(a) < vertex_of(b) ? Ends{a, b} : Ends{b, a}; }
    Ends vertices_of(const Ends& wedges) const { return {vertex_of(wedges.low), vertex_of(wedges.high)}; }
    static Index number_of(const std::vector<Ends>& all, const Ends& ends) {
        return static_cast<Index>(std::lower_bound(all.begin(), all.end(), ends) - all.begin());
    }
    static bool has(const std::vector<Ends>& all, const Ends& ends) {
        return std::binary_search(all.begin(), all.end(), ends);
    }
    static void sort_unique(std::vector<Ends>& all) {
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
    }
    /// Calls visit(wedge, next wedge) for the edges of a piece with ends on both sides.
    template <class Visit>
    void for_crossed(Index s, Index piece, Visit&& visit) {
        for_polygon_edges(pieces_[piece].wedges, [&](Index a, Index b) {
            if (sign_at(s, vertex_of(a)) * sign_at(s, vertex_of(b)) < 0) visit(a, b);
        });
    }

    bool is_plain(Index s, std::size_t to_cut) {
        return std::all_of(
            touched_.begin(), touched_.begin() + static_cast<std::ptrdiff_t>(to_cut), [&](Index piece) {
                std::size_t crossed = 0;
                for_crossed(s, piece, [&](Index, Index) { ++crossed; });
                const auto& wedges = pieces_[piece].wedges;
                return crossed == 2 && std::none_of(wedges.begin(), wedges.end(),
                                                    [&](Index w) { return sign_at(s, vertex_of(w)) == 0; });
            });
    }
    /// Like `cut`, for a cut between vertices that divides each piece in two.
    void cut_plain(Index s, std::size_t to_cut) {
        const auto first_vertex = static_cast<Index>(points_.size()),
                   first_made = static_cast<Index>(wedge_count());
        find_cut_edges(s, to_cut);
        make_points(s);
        for (std::size_t i = 0; i < to_cut; ++i) {
            halve(s, touched_[i], first_made);
            note_edges(touched_[i], first_vertex); // the larger part, which keeps the number
        }
        for (std::size_t i = to_cut; i < touched_.size(); ++i)
            reshape(touched_[i], with_points(s, touched_[i], first_made), first_vertex);
        remember_corners(s, first_vertex);
    }
    void find_cut_edges(Index s, std::size_t to_cut) {
        cut_edges_.clear();
        cut_wedges_.clear();
        for (std::size_t i = 0; i < to_cut; ++i)
            for_crossed(s, touched_[i], [&](Index a, Index b) {
                cut_edges_.push_back(vertices_of(ends_of(a, b)));
                if (!wedge_vertex_.empty()) cut_wedges_.push_back(ends_of(a, b));
            });
        sort_unique(cut_edges_);
        for (std::size_t i = to_cut; i < touched_.size() && !wedge_vertex_.empty(); ++i)
            for_crossed(s, touched_[i], [&](Index a, Index b) {
                if (has(cut_edges_, vertices_of(ends_of(a, b)))) cut_wedges_.push_back(ends_of(a, b));
            });
        sort_unique(cut_wedges_);
    }
    void make_points(Index s) {
        const CrossingPoints point(segments_.planes[s]);
        const auto first = static_cast<Index>(points_.size());
        const auto parameter = [&](const Ends& vertices) {
            return CrossingPoints::parameter(sides_[vertices.low], sides_[vertices.high]);
        };
        for (const Ends& e : cut_edges_) {
            const double t = parameter(e);
            points_.push_back(point(points_[e.low], points_[e.high], t));
            made_.vertices.push_back({e.low, e.high, t});
        }
        for (const Ends& e : cut_wedges_) {
            made_.wedges.push_back({e.low, e.high, parameter(vertices_of(e))});
            wedge_vertex_.push_back(first + number_of(cut_edges_, vertices_of(e)));
        }
        made_.vertex_segments.resize(made_.vertices.size(), s);
        made_.wedge_segments.resize(made_.wedges.size(), s);
        see_new_points();
        for (Index i = 0; i < cut_edges_.size(); ++i)
            put_on_planes(s, first + i, cut_edges_[i].low, cut_edges_[i].high);
    }
    Index wedge_on(Index a, Index b, Index first_made) const {
        return first_made + (wedge_vertex_.empty() ? number_of(cut_edges_, ends_of(a, b))
                                                   : number_of(cut_wedges_, ends_of(a, b)));
    }
    /// Divides a piece in two. Each part begins and ends with a point of the cut.
    void halve(Index s, Index piece, Index first_made) {
        const auto& wedges = pieces_[piece].wedges;
        const std::size_t n = wedges.size();
        const auto sign = [&](std::size_t i) { return sign_at(s, vertex_of(wedges[i % n])); };
        std::size_t begin = 0; // the first corner in front
        while (!(sign(begin) > 0 && sign(begin + n - 1) < 0)) ++begin;
        std::array<std::vector<Index>, 2> parts; // triangles in front and behind
        std::array<Bounds, 2> boxes;
        std::size_t i = begin;
        for (std::size_t part = 0; part < 2; ++part) {
            auto& some = parts[part];
            const int side = sign(i);
            std::size_t end = i;
            while (end < begin + n && sign(end) == side) ++end;
            some.reserve(end - i + 2);
            some.push_back(wedge_on(wedges[(i + n - 1) % n], wedges[i % n], first_made));
            for (; i < end; ++i) some.push_back(wedges[i % n]);
            some.push_back(wedge_on(wedges[(i + n - 1) % n], wedges[i % n], first_made));
            boxes[part] = bounds(pieces_[piece].face, some);
        }
        replace(piece, parts, boxes);
    }
    /// Replaces a piece, and records the edges of parts with new numbers.
    void replace(Index piece, std::span<std::vector<Index>> parts, std::span<const Bounds> boxes) {
        const Index first = pieces_.numbers();
        pieces_.replace(piece, parts, boxes);
        forget_shape(piece);
        for (Index part = first; part < pieces_.numbers(); ++part) note_edges(part);
    }
    std::vector<Index> with_points(Index s, Index piece, Index first_made) {
        std::vector<Index> wedges;
        wedges.reserve(pieces_[piece].wedges.size() + 1); // usually one point is added
        for_polygon_edges(pieces_[piece].wedges, [&](Index a, Index b) {
            wedges.push_back(a);
            if (sign_at(s, vertex_of(a)) * sign_at(s, vertex_of(b)) < 0 &&
                has(cut_edges_, vertices_of(ends_of(a, b))))
                wedges.push_back(wedge_on(a, b, first_made));
        });
        return wedges;
    }
    void reshape(Index piece, std::vector<Index> wedges, Index first_new) {
        const Bounds box = bounds(pieces_[piece].face, wedges);
        pieces_.reshape(piece, std::move(wedges), box);
        forget_shape(piece);
        note_edges(piece, first_new);
    }

    // --- any other cut

    /// Cuts the first to_cut touched pieces. The others get the new points on their edges.
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
            for (const auto& wedges : parts) boxes.push_back(bounds(pieces_[touched_[f]].face, wedges));
            replace(touched_[f], parts, boxes);
            note_edges(touched_[f]);
        }
        std::vector<Index> polygon;
        for (std::size_t i = 0; i < cut.passing.size(); ++i) {
            passing_with_points(cut, i, polygon);
            reshape(touched_[cut.passing[i]], global(polygon), first_vertex);
        }
        remember_corners(s, first_vertex);
    }
    /// Builds a mesh of the touched pieces. Vertices and wedges keep their order.
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
    void add_points(Index s, const PlaneCut& cut) {
        const auto first = static_cast<Index>(points_.size());
        points_.insert(points_.end(), cut.points.begin(), cut.points.end());
        for (const auto& e : cut.vertices) made_.vertices.push_back({vertices_[e.a], vertices_[e.b], e.t});
        made_.vertex_segments.resize(made_.vertices.size(), s);
        if (!wedge_vertex_.empty()) {
            for (const auto& e : cut.wedges) made_.wedges.push_back({wedges_[e.a], wedges_[e.b], e.t});
            made_.wedge_segments.resize(made_.wedges.size(), s);
            for (const Index v : cut.wedge_vertex)
                wedge_vertex_.push_back(first + (v - static_cast<Index>(part_.vertex_count())));
        }
        see_new_points();
        for (std::size_t i = 0; i < cut.vertices.size(); ++i)
            put_on_planes(s, static_cast<Index>(first + i), vertices_[cut.vertices[i].a],
                          vertices_[cut.vertices[i].b]);
    }
    /// A point made on an edge from a to b is on the segment's plane, and on all planes that contain both
    /// ends.
    void put_on_planes(Index s, Index v, Index a, Index b) {
        on_.add(v, segments_.numbers[s]);
        on_.for_planes(a, [&](Index plane) {
            if (on_.has(b, plane)) shared_.push_back(plane);
        });
        for (const Index plane : shared_) on_.add(v, plane);
        shared_.clear();
    }
    /// Treats new points within rounding of a corner of the outline as on the next segment's plane too.
    /// Otherwise an edge that passes the corner would be cut twice.
    void remember_corners(Index s, Index first_vertex) {
        const auto& e = segment(s);
        for (Index v = first_vertex; v < points_.size(); ++v) {
            const double rounding =
                rounding_of({length(points_[v]), length(seen_[v]), length(e.a), length(e.b)});
            if (length(seen_[v] - e.a) <= rounding) on_.add(v, segments_.numbers[e.previous]);
            if (length(seen_[v] - e.b) <= rounding) on_.add(v, segments_.numbers[e.next]);
        }
    }

    /// The pieces of all faces.
    CutFaces finished() {
        const auto old_vertices = static_cast<Index>(mesh_.vertex_count());
        for (Index f = 0; f < mesh_.face_count(); ++f)
            pieces_.for_pieces(f, [&](Index piece) { made_.pieces.add(f, pieces_[piece].wedges); });
        for (Index v = old_vertices; v < points_.size(); ++v)
            on_.for_planes(v, [&](Index plane) { made_.on.emplace_back(v, plane); });
        made_.points.assign(points_.begin() + old_vertices, points_.end());
        if (!wedge_vertex_.empty())
            made_.wedge_vertex.assign(wedge_vertex_.begin() +
                                          static_cast<std::ptrdiff_t>(mesh_.wedge_count()),
                                      wedge_vertex_.end());
        made_.cut_faces = static_cast<std::size_t>(std::count(was_cut_.begin(), was_cut_.end(), 1));
        return std::move(made_);
    }

    const Mesh& mesh_;
    const CropView& view_;
    const SegmentPlanes& segments_;
    OnPlanes on_;
    EdgeTable edges_;
    std::vector<Index> corner_face_;
    double size_ = 0;                   ///< distance of the farthest projected vertex
    std::vector<Frame> frames_;         ///< [faces]
    PieceTree pieces_;                  ///< boxes in the frames
    PiecesAtEdges at_edges_;            ///< does not contain untouched faces
    std::vector<Vec3> points_;          ///< [vertices] old and new positions
    std::vector<Index> wedge_vertex_;   ///< [wedges] empty without seams
    std::vector<Vec2> seen_;            ///< [vertices] projected positions
    std::vector<std::int8_t> signs_;    ///< [vertices] sign relative to signed_for_
    std::vector<double> sides_;         ///< [vertices] value of side() for signed_for_
    std::vector<Index> signed_for_;     ///< [vertices] segment for which signs_ and sides_ are valid
    std::vector<std::uint8_t> was_cut_; ///< [faces] 1 for cut faces
    std::vector<PieceShape> shapes_;    ///< [pieces] cached shapes, filled on demand
    std::vector<Index> touched_for_; ///< [pieces] the last segment that touched the piece, filled on demand
    CutFaces made_;
    // State of the current cut:
    std::vector<Index> touched_; ///< first pieces to cut, then pieces that share a cut edge
    Mesh part_;
    std::vector<Index> vertices_, wedges_; ///< [vertices and wedges of part_] wedges: empty without seams
    std::vector<Index> local_;             ///< inverse of vertices_ and wedges_
    std::vector<Ends> cut_edges_,
        cut_wedges_; ///< ascending; an edge is its vertices; wedges: empty without seams
    std::vector<Index> around_, shared_;
    std::vector<Vec2> face_;
};

} // namespace

CutFaces cut_along_segments(const Mesh& mesh, const EnteredFaces& entered, const CropView& view,
                            const SegmentPlanes& segments, OnPlanes on) {
    return SegmentCutter(mesh, entered, view, segments, std::move(on)).run(entered);
}

} // namespace facetmill
