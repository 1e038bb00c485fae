#include "geometry/crop/segment_cutter.hpp"

#include "base/sort_unique.hpp"
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

/// The pieces of all faces, and their points.
struct CutState {
    using Bounds = PieceTree::Bounds;

    CutState(const Mesh& of, const EnteredFaces& entered, const CropView& from, const SegmentPlanes& planes,
             OnPlanes known)
        : mesh(of), view(from), segments(planes), on(std::move(known)), points(of.positions),
          wedge_vertex(of.wedge_vertex) {
        see_new_points();
        find_frames(entered);
        for (Index f = 0; f < mesh.face_count(); ++f) {
            const auto wedges = mesh.face_wedges(f);
            pieces.add_face({wedges.begin(), wedges.end()}, bounds(f, wedges));
        }
    }

    Index vertex_of(Index wedge) const { return wedge_vertex.empty() ? wedge : wedge_vertex[wedge]; }
    /// The bounds of a piece in the frame of the face.
    Bounds bounds(Index face, std::span<const Index> wedges) const {
        Bounds box;
        for (const Index w : wedges) box.add(frames[face](seen[vertex_of(w)]));
        return box;
    }
    /// The bounds of an edge in the frame of the face, enlarged by the rounding of points.
    Bounds bounds(Index face, const polygon::RingTree::Edge& e) const {
        Bounds box;
        for (const Vec2& p : {e.a, e.b}) box.add(frames[face](p));
        const double wider =
            std::max(rounding_of({size, length(e.a), length(e.b)}), std::numeric_limits<double>::min());
        if (!std::isfinite(wider)) return {-HUGE_VAL, -HUGE_VAL, HUGE_VAL, HUGE_VAL};
        return {box.x0 - wider, box.y0 - wider, box.x1 + wider, box.y1 + wider};
    }
    /// Chooses the frames. Concave and edge-on faces keep the default frame, because their intersection tests
    /// are not exact. With a frame, their pieces would depend on which segment is the longest.
    void find_frames(const EnteredFaces& entered) {
        for (const Vec2& p : seen) size = std::max(size, length(p));
        frames.resize(mesh.face_count());
        std::vector<double> longest(mesh.face_count());
        for (std::size_t i = 0; i < entered.segments.size(); ++i) {
            const auto& e = segment(entered.segments[i]);
            for (const Index f : entered.of(i))
                if (const double reach = length(e.b - e.a); reach > longest[f]) {
                    longest[f] = reach;
                    frames[f] = Frame(e.b - e.a);
                }
        }
        for (Index f = 0; f < mesh.face_count(); ++f) {
            if (!(longest[f] > 0)) continue;
            view.gather(mesh, f, face);
            if (!polygon::is_convex(face) || polygon::orientation(face) == 0) frames[f] = {};
        }
    }
    const polygon::RingTree::Edge& segment(Index s) const { return view.footprint().tree().edges()[s]; }
    void see_new_points() {
        for (std::size_t v = seen.size(); v < points.size(); ++v) seen.push_back(view.seen(points[v]));
        on.grow(points.size());
        signs.resize(points.size());
        sides.resize(points.size());
        signed_for.resize(points.size(), none);
    }
    std::int8_t sign_at(Index s, Index vertex) {
        if (signed_for[vertex] == s) return signs[vertex];
        signed_for[vertex] = s;
        const double at = side(segments.planes[s], points[vertex]);
        const bool is_on = at == 0 || on.has(vertex, segments.numbers[s]);
        if (is_on) on.add(vertex, segments.numbers[s]);
        sides[vertex] = at;
        return signs[vertex] = static_cast<std::int8_t>(is_on ? 0 : at > 0 ? 1 : -1);
    }
    /// Fills face with the corners of a piece.
    void gather(Index piece) {
        face.clear();
        for (const Index w : pieces[piece].wedges) face.push_back(seen[vertex_of(w)]);
    }
    /// True if the line along an edge separates a piece from a segment, within the rounding of points. This
    /// is usual after a cut: because of rounded corners, the next segment may seem to enter the piece.
    /// Pieces entirely on that line, such as edge-on faces, are not separated. The edge that separated the
    /// piece from the previous segment is tested first.
    bool is_parted(Index piece, const polygon::RingTree::Edge& e) {
        PieceShape& shape = shape_of(piece);
        const double rounding =
            rounding_of({std::sqrt(std::max({shape.square, dot(e.a, e.a), dot(e.b, e.b)}))});
        const std::size_t n = pieces[piece].wedges.size();
        for (std::size_t i = 0; i < n; ++i)
            if (parts(piece, shape, (shape.parting + i) % n, rounding, e)) return true;
        return false;
    }
    /// True if this edge separates them; records it.
    bool parts(Index piece, PieceShape& shape, std::size_t edge, double rounding,
               const polygon::RingTree::Edge& e) {
        const auto& wedges = pieces[piece].wedges;
        const auto corner = [&](std::size_t i) -> const Vec2& { return seen[vertex_of(wedges[i])]; };
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
        if (shapes.size() <= piece) shapes.resize(pieces.numbers());
        PieceShape& shape = shapes[piece];
        if (shape.square >= 0) return shape;
        gather(piece);
        for (const Vec2& p : face) shape.square = std::max(shape.square, dot(p, p));
        shape.way = polygon::signed_area(face) > 0 ? 1 : -1;
        return shape;
    }
    /// Call it when a piece gets other corners. The separating edge may still exist.
    void forget_shape(Index piece) {
        if (piece < shapes.size()) shapes[piece].square = shapes[piece].high = -1;
    }
    /// Records the edges of a piece. With first_new, records only edges with an end that is this vertex or
    /// later.
    void note_edges(Index piece, Index first_new = 0) {
        for_polygon_edges(pieces[piece].wedges, [&](Index a, Index b) {
            const Index u = vertex_of(a), v = vertex_of(b);
            if (std::max(u, v) >= first_new) at_edges.add(u, v, piece);
        });
    }
    /// Calls visit(wedge, next wedge) for the edges of a piece with ends on both sides.
    template <class Visit>
    void for_crossed(Index s, Index piece, Visit&& visit) {
        for_polygon_edges(pieces[piece].wedges, [&](Index a, Index b) {
            if (sign_at(s, vertex_of(a)) * sign_at(s, vertex_of(b)) < 0) visit(a, b);
        });
    }
    /// Replaces a piece, and records the edges of parts with new numbers.
    void replace(Index piece, std::span<std::vector<Index>> parts, std::span<const Bounds> boxes) {
        const Index first = pieces.numbers();
        pieces.replace(piece, parts, boxes);
        forget_shape(piece);
        for (Index part = first; part < pieces.numbers(); ++part) note_edges(part);
    }
    void reshape(Index piece, std::vector<Index> wedges, Index first_new) {
        const Bounds box = bounds(pieces[piece].face, wedges);
        pieces.reshape(piece, std::move(wedges), box);
        forget_shape(piece);
        note_edges(piece, first_new);
    }
    std::size_t wedge_count() const { return wedge_vertex.empty() ? points.size() : wedge_vertex.size(); }
    /// A point made on an edge from a to b is on the segment's plane, and on all planes that contain both
    /// ends.
    void put_on_planes(Index s, Index v, Index a, Index b) {
        on.add(v, segments.numbers[s]);
        on.for_planes(a, [&](Index plane) {
            if (on.has(b, plane)) shared.push_back(plane);
        });
        for (const Index plane : shared) on.add(v, plane);
        shared.clear();
    }
    /// Treats new points within rounding of a corner of the outline as on the next segment's plane too.
    /// Otherwise an edge that passes the corner would be cut twice.
    void remember_corners(Index s, Index first_vertex) {
        const auto& e = segment(s);
        for (Index v = first_vertex; v < points.size(); ++v) {
            const double rounding =
                rounding_of({length(points[v]), length(seen[v]), length(e.a), length(e.b)});
            if (length(seen[v] - e.a) <= rounding) on.add(v, segments.numbers[e.previous]);
            if (length(seen[v] - e.b) <= rounding) on.add(v, segments.numbers[e.next]);
        }
    }

    const Mesh& mesh;
    const CropView& view;
    const SegmentPlanes& segments;
    OnPlanes on;
    double size = 0;                 ///< distance of the farthest projected vertex
    std::vector<Frame> frames;       ///< [faces]
    PieceTree pieces;                ///< boxes in the frames
    PiecesAtEdges at_edges;          ///< does not contain untouched faces
    std::vector<Vec3> points;        ///< [vertices] old and new positions
    std::vector<Index> wedge_vertex; ///< [wedges] empty without seams
    std::vector<Vec2> seen;          ///< [vertices] projected positions
    std::vector<std::int8_t> signs;  ///< [vertices] sign relative to signed_for
    std::vector<double> sides;       ///< [vertices] value of side() for signed_for
    std::vector<Index> signed_for;   ///< [vertices] segment for which signs and sides are valid
    std::vector<PieceShape> shapes;  ///< [pieces] cached shapes, filled on demand
    CutFaces made;
    std::vector<Index> shared; ///< scratch of put_on_planes
    std::vector<Vec2> face;    ///< scratch of gather
};

/// The usual cut, which passes between vertices and divides each piece in two.
class PlainCut {
  public:
    explicit PlainCut(CutState& state) : c_(state) {}

    /// Cuts the first to_cut touched pieces. The others get the new points on their edges.
    void run(Index s, std::span<const Index> touched, std::size_t to_cut) {
        const auto first_vertex = static_cast<Index>(c_.points.size()),
                   first_made = static_cast<Index>(c_.wedge_count());
        find_cut_edges(s, touched, to_cut);
        make_points(s);
        for (std::size_t i = 0; i < to_cut; ++i) {
            halve(s, touched[i], first_made);
            c_.note_edges(touched[i], first_vertex); // the larger part, which keeps the number
        }
        for (std::size_t i = to_cut; i < touched.size(); ++i)
            c_.reshape(touched[i], with_points(s, touched[i], first_made), first_vertex);
        c_.remember_corners(s, first_vertex);
    }

  private:
    using Bounds = CutState::Bounds;

    /// A cut edge by its vertices or wedges; the end at the lower vertex comes first.
    struct Ends {
        Index low, high;
        auto operator<=>(const Ends&) const = default;
    };
    Ends ends_of(Index a, Index b) const {
        return c_.vertex_of(a) < c_.vertex_of(b) ? Ends{a, b} : Ends{b, a};
    }
    Ends vertices_of(const Ends& wedges) const {
        return {c_.vertex_of(wedges.low), c_.vertex_of(wedges.high)};
    }
    static Index number_of(const std::vector<Ends>& all, const Ends& ends) {
        return static_cast<Index>(std::lower_bound(all.begin(), all.end(), ends) - all.begin());
    }
    static bool has(const std::vector<Ends>& all, const Ends& ends) {
        return std::binary_search(all.begin(), all.end(), ends);
    }
    void find_cut_edges(Index s, std::span<const Index> touched, std::size_t to_cut) {
        cut_edges_.clear();
        cut_wedges_.clear();
        for (std::size_t i = 0; i < to_cut; ++i)
            c_.for_crossed(s, touched[i], [&](Index a, Index b) {
                cut_edges_.push_back(vertices_of(ends_of(a, b)));
                if (!c_.wedge_vertex.empty()) cut_wedges_.push_back(ends_of(a, b));
            });
        sort_unique(cut_edges_);
        for (std::size_t i = to_cut; i < touched.size() && !c_.wedge_vertex.empty(); ++i)
            c_.for_crossed(s, touched[i], [&](Index a, Index b) {
                if (has(cut_edges_, vertices_of(ends_of(a, b)))) cut_wedges_.push_back(ends_of(a, b));
            });
        sort_unique(cut_wedges_);
    }
    void make_points(Index s) {
        const CrossingPoints point(c_.segments.planes[s]);
        const auto first = static_cast<Index>(c_.points.size());
        const auto parameter = [&](const Ends& vertices) {
            return CrossingPoints::parameter(c_.sides[vertices.low], c_.sides[vertices.high]);
        };
        for (const Ends& e : cut_edges_) {
            const double t = parameter(e);
            c_.points.push_back(point(c_.points[e.low], c_.points[e.high], t));
            c_.made.vertices.push_back({e.low, e.high, t});
        }
        for (const Ends& e : cut_wedges_) {
            c_.made.wedges.push_back({e.low, e.high, parameter(vertices_of(e))});
            c_.wedge_vertex.push_back(first + number_of(cut_edges_, vertices_of(e)));
        }
        c_.made.vertex_segments.resize(c_.made.vertices.size(), s);
        c_.made.wedge_segments.resize(c_.made.wedges.size(), s);
        c_.see_new_points();
        for (Index i = 0; i < cut_edges_.size(); ++i)
            c_.put_on_planes(s, first + i, cut_edges_[i].low, cut_edges_[i].high);
    }
    Index wedge_on(Index a, Index b, Index first_made) const {
        return first_made + (c_.wedge_vertex.empty() ? number_of(cut_edges_, ends_of(a, b))
                                                     : number_of(cut_wedges_, ends_of(a, b)));
    }
    /// Divides a piece in two. Each part begins and ends with a point of the cut.
    void halve(Index s, Index piece, Index first_made) {
        const auto& wedges = c_.pieces[piece].wedges;
        const std::size_t n = wedges.size();
        const auto sign = [&](std::size_t i) { return c_.sign_at(s, c_.vertex_of(wedges[i % n])); };
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
            boxes[part] = c_.bounds(c_.pieces[piece].face, some);
        }
        c_.replace(piece, parts, boxes);
    }
    std::vector<Index> with_points(Index s, Index piece, Index first_made) {
        std::vector<Index> wedges;
        wedges.reserve(c_.pieces[piece].wedges.size() + 1); // usually one point is added
        for_polygon_edges(c_.pieces[piece].wedges, [&](Index a, Index b) {
            wedges.push_back(a);
            if (c_.sign_at(s, c_.vertex_of(a)) * c_.sign_at(s, c_.vertex_of(b)) < 0 &&
                has(cut_edges_, vertices_of(ends_of(a, b))))
                wedges.push_back(wedge_on(a, b, first_made));
        });
        return wedges;
    }

    CutState& c_;
    /// Ascending; an edge is its vertices; wedges: empty without seams.
    std::vector<Ends> cut_edges_, cut_wedges_;
};

/// Any other cut.
class SignedCut {
  public:
    explicit SignedCut(CutState& state) : c_(state) {}

    /// Cuts the first to_cut touched pieces. The others get the new points on their edges.
    void run(Index s, std::span<const Index> touched, std::size_t to_cut) {
        make_local(touched);
        std::vector<std::int8_t> signs;
        for (const Index v : vertices_) signs.push_back(c_.sign_at(s, v));
        std::vector<std::uint8_t> wanted(touched.size());
        std::fill_n(wanted.begin(), to_cut, 1);
        const PlaneCut cut = cut_by_signs(part_, c_.segments.planes[s], std::move(signs), wanted);
        const auto first_vertex = static_cast<Index>(c_.points.size()),
                   first_wedge = static_cast<Index>(c_.wedge_count());
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
            for (const auto& wedges : parts) boxes.push_back(c_.bounds(c_.pieces[touched[f]].face, wedges));
            c_.replace(touched[f], parts, boxes);
            c_.note_edges(touched[f]);
        }
        std::vector<Index> polygon;
        for (std::size_t i = 0; i < cut.passing.size(); ++i) {
            passing_with_points(cut, i, polygon);
            c_.reshape(touched[cut.passing[i]], global(polygon), first_vertex);
        }
        c_.remember_corners(s, first_vertex);
    }

  private:
    using Bounds = CutState::Bounds;

    /// Builds a mesh of the touched pieces. Vertices and wedges keep their order.
    void make_local(std::span<const Index> touched) {
        local_.resize(std::max(c_.points.size(), c_.wedge_vertex.size()));
        vertices_.clear();
        wedges_.clear();
        for (const Index piece : touched)
            for (const Index w : c_.pieces[piece].wedges) {
                vertices_.push_back(c_.vertex_of(w));
                if (!c_.wedge_vertex.empty()) wedges_.push_back(w);
            }
        sort_unique(vertices_);
        sort_unique(wedges_);
        part_.positions.clear();
        part_.wedge_vertex.clear();
        part_.corners.clear();
        part_.face_offsets.assign(1, 0);
        for (Index i = 0; i < vertices_.size(); ++i) {
            part_.positions.push_back(c_.points[vertices_[i]]);
            local_[vertices_[i]] = i;
        }
        for (const Index w : wedges_) part_.wedge_vertex.push_back(local_[c_.vertex_of(w)]);
        for (Index i = 0; i < wedges_.size(); ++i) local_[wedges_[i]] = i;
        for (const Index piece : touched) {
            for (const Index w : c_.pieces[piece].wedges) part_.corners.push_back(local_[w]);
            part_.face_offsets.push_back(static_cast<Index>(part_.corners.size()));
        }
    }
    void add_points(Index s, const PlaneCut& cut) {
        const auto first = static_cast<Index>(c_.points.size());
        c_.points.insert(c_.points.end(), cut.points.begin(), cut.points.end());
        for (const auto& e : cut.vertices) c_.made.vertices.push_back({vertices_[e.a], vertices_[e.b], e.t});
        c_.made.vertex_segments.resize(c_.made.vertices.size(), s);
        if (!c_.wedge_vertex.empty()) {
            for (const auto& e : cut.wedges) c_.made.wedges.push_back({wedges_[e.a], wedges_[e.b], e.t});
            c_.made.wedge_segments.resize(c_.made.wedges.size(), s);
            for (const Index v : cut.wedge_vertex)
                c_.wedge_vertex.push_back(first + (v - static_cast<Index>(part_.vertex_count())));
        }
        c_.see_new_points();
        for (std::size_t i = 0; i < cut.vertices.size(); ++i)
            c_.put_on_planes(s, static_cast<Index>(first + i), vertices_[cut.vertices[i].a],
                             vertices_[cut.vertices[i].b]);
    }

    CutState& c_;
    Mesh part_;
    std::vector<Index> vertices_, wedges_; ///< [vertices and wedges of part_] wedges: empty without seams
    std::vector<Index> local_;             ///< inverse of vertices_ and wedges_
};

/// Cuts one segment after the other. A cut visits only the pieces that its segment enters, and pieces that
/// share a cut edge with them.
class SegmentCutter {
  public:
    SegmentCutter(const Mesh& mesh, const EnteredFaces& entered, const CropView& view,
                  const SegmentPlanes& segments, OnPlanes on)
        : c_(mesh, entered, view, segments, std::move(on)), edges_(build_edges(mesh)),
          corner_face_(corner_faces(mesh)), was_cut_(mesh.face_count()) {}

    CutFaces run(const EnteredFaces& entered) {
        remember_shared(entered);
        for (std::size_t i = 0; i < entered.segments.size(); ++i)
            cut_along(entered.segments[i], entered.of(i));
        return finished();
    }

  private:
    /// If several cuts share a plane, records the vertices on it. Then new points between such vertices also
    /// count as on the plane.
    void remember_shared(const EnteredFaces& entered) {
        for (std::size_t i = 0; i < entered.segments.size(); ++i) {
            const Index s = entered.segments[i];
            if (c_.segments.sharing[c_.segments.numbers[s]] < 2) continue;
            for (const Index f : entered.of(i))
                for (const Index w : c_.mesh.face_wedges(f))
                    if (side(c_.segments.planes[s], c_.points[c_.vertex_of(w)]) == 0)
                        c_.on.add(c_.vertex_of(w), c_.segments.numbers[s]);
        }
    }
    /// Cuts the pieces of these faces that the segment still enters.
    void cut_along(Index s, std::span<const Index> faces) {
        find_entered(s, faces);
        if (touched_.empty()) return;
        c_.made.met.push_back(c_.segments.numbers[s]);
        std::erase_if(touched_, [&](Index piece) {
            bool above = false, below = false;
            for (const Index w : c_.pieces[piece].wedges) {
                const std::int8_t sign = c_.sign_at(s, c_.vertex_of(w));
                above |= sign > 0;
                below |= sign < 0;
            }
            return !(above && below);
        });
        if (touched_.empty()) return;
        const std::size_t to_cut = touched_.size();
        touched_for_.resize(c_.pieces.numbers(), none);
        for (const Index piece : touched_) touched_for_[piece] = s;
        for (std::size_t i = 0; i < to_cut; ++i) find_neighbours(s, touched_[i]);
        if (is_plain(s, to_cut))
            plain_.run(s, touched_, to_cut);
        else
            other_.run(s, touched_, to_cut);
    }
    void find_entered(Index s, std::span<const Index> faces) {
        touched_.clear();
        const auto& e = c_.segment(s);
        for (const Index f : faces)
            c_.pieces.query(f, c_.bounds(f, e), [&](Index piece) {
                if (c_.is_parted(piece, e)) return;
                c_.gather(piece);
                if (meeting(c_.face, e.a, e.b) != OutlineMeeting::crossing) return;
                was_cut_[f] = 1;
                touched_.push_back(piece);
            });
    }
    /// Adds the neighbours at cut edges to the touched pieces. These are whole faces, and pieces of earlier
    /// cuts.
    void find_neighbours(Index s, Index piece) {
        look_around(c_.pieces[piece].face);
        for_polygon_edges(c_.pieces[piece].wedges, [&](Index a, Index b) {
            const Index u = c_.vertex_of(a), v = c_.vertex_of(b);
            if (c_.sign_at(s, u) * c_.sign_at(s, v) >= 0) return;
            // A whole face is the piece with its own number; at_edges does not contain it.
            if (std::max(u, v) < c_.mesh.vertex_count())
                for (const Index f : around_) touch(f, s, u, v);
            c_.at_edges.visit(u, v, [&](Index other) {
                if (std::find(around_.begin(), around_.end(), c_.pieces[other].face) != around_.end())
                    touch(other, s, u, v);
            });
        });
    }
    /// Collects a face and the faces that share an edge with it, once each.
    void look_around(Index face) {
        if (!around_.empty() && around_[0] == face) return;
        around_.assign(1, face);
        for (Index c = c_.mesh.face_begin(face); c < c_.mesh.face_end(face); ++c)
            if (edges_.corner_edge[c] != none)
                for (const Index other : edges_.corners_of(edges_.corner_edge[c]))
                    if (std::find(around_.begin(), around_.end(), corner_face_[other]) == around_.end())
                        around_.push_back(corner_face_[other]);
    }
    void touch(Index piece, Index s, Index u, Index v) {
        if (touched_for_[piece] == s) return;
        const auto& wedges = c_.pieces[piece].wedges;
        for (std::size_t i = 0, n = wedges.size(); i < n; ++i) {
            const Index from = c_.vertex_of(wedges[i]), to = c_.vertex_of(wedges[i + 1 == n ? 0 : i + 1]);
            if ((from != u || to != v) && (from != v || to != u)) continue;
            touched_for_[piece] = s;
            touched_.push_back(piece);
            return;
        }
    }
    bool is_plain(Index s, std::size_t to_cut) {
        return std::all_of(
            touched_.begin(), touched_.begin() + static_cast<std::ptrdiff_t>(to_cut), [&](Index piece) {
                std::size_t crossed = 0;
                c_.for_crossed(s, piece, [&](Index, Index) { ++crossed; });
                const auto& wedges = c_.pieces[piece].wedges;
                return crossed == 2 && std::none_of(wedges.begin(), wedges.end(), [&](Index w) {
                           return c_.sign_at(s, c_.vertex_of(w)) == 0;
                       });
            });
    }
    /// The pieces of all faces.
    CutFaces finished() {
        const auto old_vertices = static_cast<Index>(c_.mesh.vertex_count());
        for (Index f = 0; f < c_.mesh.face_count(); ++f)
            c_.pieces.for_pieces(f, [&](Index piece) { c_.made.pieces.add(f, c_.pieces[piece].wedges); });
        for (Index v = old_vertices; v < c_.points.size(); ++v)
            c_.on.for_planes(v, [&](Index plane) { c_.made.on.emplace_back(v, plane); });
        c_.made.points.assign(c_.points.begin() + old_vertices, c_.points.end());
        if (!c_.wedge_vertex.empty())
            c_.made.wedge_vertex.assign(c_.wedge_vertex.begin() +
                                            static_cast<std::ptrdiff_t>(c_.mesh.wedge_count()),
                                        c_.wedge_vertex.end());
        c_.made.cut_faces = static_cast<std::size_t>(std::count(was_cut_.begin(), was_cut_.end(), 1));
        return std::move(c_.made);
    }

    CutState c_;
    PlainCut plain_{c_};
    SignedCut other_{c_};
    EdgeTable edges_;
    std::vector<Index> corner_face_;
    std::vector<std::uint8_t> was_cut_; ///< [faces] 1 for cut faces
    std::vector<Index> touched_for_; ///< [pieces] the last segment that touched the piece, filled on demand
    std::vector<Index> touched_;     ///< first pieces to cut, then pieces that share a cut edge
    std::vector<Index> around_;
};

} // namespace

CutFaces cut_along_segments(const Mesh& mesh, const EnteredFaces& entered, const CropView& view,
                            const SegmentPlanes& segments, OnPlanes on) {
    return SegmentCutter(mesh, entered, view, segments, std::move(on)).run(entered);
}

} // namespace facetmill
