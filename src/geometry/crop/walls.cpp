#include "geometry/crop/walls.hpp"

#include "base/error.hpp"
#include "base/text/readable_numbers.hpp"
#include "geometry/crop/crop.hpp"
#include "geometry/crop/wall_panel.hpp"
#include "geometry/cut/cap_paint.hpp"
#include "geometry/edit/surgery.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

// The faces of a crop's walls, and their attributes.

struct WallFaces {
    std::span<const WallPanel> panels; ///< the filled panels; their points are vertices of the mesh
    const Walls& walls;
    const WallSettings& settings;
    Index first_added = 0; ///< the first vertex that the panels added
};

class Appender {
  public:
    Appender(const Mesh& from, const WallFaces& faces)
        : from_(from), faces_(faces), own_(caps_have_own_wedges(from)), added_(faces.first_added) {}

    Mesh run(AttributeChanges& changes) {
        start();
        for (const WallPanel& panel : faces_.panels) add(panel);
        provenance_.faces.resize(out_.face_count()); // walls copy the first face, then get their own values
        for (Index f = 0; f < from_.face_count(); ++f) provenance_.faces[f] = f;
        changes = inherit_attributes(out_, from_, provenance_);
        for (std::size_t i = 0; i < ranges_.size(); ++i) paint(i);
        return std::move(out_);
    }

  private:
    void start() {
        out_.positions = from_.positions;
        out_.wedge_vertex = from_.wedge_vertex;
        out_.corners = from_.corners;
        out_.face_offsets = from_.face_offsets;
        if (own_ && out_.wedge_vertex.empty())
            for (Index v = 0; v < out_.vertex_count(); ++v) out_.wedge_vertex.push_back(v);
        provenance_.vertices.identity = true;
        provenance_.wedges.copies.resize(from_.wedge_count());
        for (Index w = 0; w < from_.wedge_count(); ++w) provenance_.wedges.copies[w] = w;
        lowest_.assign(from_.vertex_count(), none);
        for (const Index w : from_.corners) {
            Index& at = lowest_[from_.vertex_of_wedge(w)];
            at = std::min(at, w);
        }
    }

    void add(const WallPanel& panel) {
        const std::size_t first = out_.face_count();
        wedge_at_.clear();
        own_wedges_.emplace_back();
        for (const auto& t : panel.filling().triangles) {
            const std::array<Index, 3> corners{wedge(panel, t[0]), wedge(panel, t[1]), wedge(panel, t[2])};
            add_face(out_, corners);
        }
        added_ += static_cast<Index>(panel.filling().added.size());
        ranges_.push_back({first, out_.face_count()});
    }
    /// Creates a wedge if the wall needs its own normals or coordinates; it copies the lowest wedge at the
    /// vertex.
    Index wedge(const WallPanel& panel, Index point) {
        const auto points = static_cast<Index>(panel.points().size());
        const Index v = point < points ? panel.points()[point] : added_ + point - points;
        if (!own_) return lowest_[v];
        const auto [at, fresh] =
            wedge_at_.try_emplace(v, static_cast<Index>(provenance_.wedges.copies.size()));
        if (fresh) {
            provenance_.wedges.copies.push_back(lowest_[v]);
            out_.wedge_vertex.push_back(v);
            own_wedges_.back().push_back(at->second);
        }
        return at->second;
    }

    void paint(std::size_t i) {
        const FaceRange faces = ranges_[i];
        if (faces.first == faces.last) return;
        const WallSettings& s = faces_.settings;
        const Index wall = faces_.panels[i].wall();
        const auto& e = faces_.walls.edges()[wall];
        CapPaint paint{s.primitive, 0, 0};
        if (s.last_cut) paint.cut_id = *s.last_cut + 1 + wall;
        if (s.last_group) paint.group = *s.last_group + 1 + e.ring;
        Plane plane = pulled_back(upright_plane(s.axis, e.a, e.b), s.to_world);
        const Vec3 looks = area_of_triangles(out_, out_.face_begin(static_cast<Index>(faces.first)),
                                             out_.face_end(static_cast<Index>(faces.last - 1)));
        if (dot(looks, plane.normal) < 0) plane.normal = -plane.normal;
        paint_cap(out_, faces, own_wedges_[i], plane, paint);
    }

    const Mesh& from_;
    const WallFaces& faces_;
    bool own_;
    Index added_; ///< the vertex of the next panel's first added point
    Mesh out_;
    MeshProvenance provenance_;
    std::vector<Index> lowest_; ///< [panels] face ranges
    std::map<Index, Index> wedge_at_;
    std::vector<FaceRange> ranges_;              ///< [panels] wedges of their own
    std::vector<std::vector<Index>> own_wedges_; ///< [panels]
};

/// Appends the walls to the kept faces, panel by panel.
AttributeChanges append_walls(Mesh& mesh, const WallFaces& faces) {
    AttributeChanges changes;
    mesh = Appender(mesh, faces).run(changes);
    return changes;
}

[[noreturn]] void refuse(const Walls& walls, Index wall) {
    const auto& e = walls.edges()[wall];
    throw UnclosedWalls(ErrorKind::stage, "E-CROP-CAP",
                        fmt::format("the cut along the outline from ({}) to ({}) cannot be closed",
                                    readable_pair(e.a.x, e.a.y), readable_pair(e.b.x, e.b.y)),
                        "crop without cap, or move the outline a little");
}

/// The walls of the boundary edges at each vertex.
class WallsAtVertices {
  public:
    WallsAtVertices(std::span<const WallEdge> edges, std::size_t vertices) : begins_(vertices + 1) {
        for (const WallEdge& e : edges)
            for (const Index v : {e.low, e.high}) ++begins_[v];
        walls_.resize(exclusive_scan(begins_));
        std::vector<std::size_t> ends = begins_;
        for (const WallEdge& e : edges)
            for (const Index v : {e.low, e.high}) walls_[ends[v]++] = e.wall;
    }
    bool has(Index vertex, Index wall) const {
        const std::span<const Index> walls(walls_.data() + begins_[vertex],
                                           walls_.data() + begins_[vertex + 1]);
        return std::find(walls.begin(), walls.end(), wall) != walls.end();
    }

  private:
    std::vector<std::size_t> begins_; ///< [vertices + 1] offsets
    std::vector<Index> walls_;
};

class Closer {
  public:
    Closer(Mesh kept, const Footprint& footprint, const WallSettings& settings)
        : mesh_(std::move(kept)), settings_(settings),
          walls_(footprint, rounding_of(footprint, settings)), view_{walls_, {}, {}, {}, {}} {}

    WalledCrop run() {
        find_boundary();
        if (split_at_posts()) find_boundary();
        if (!settings_.closed) drop_open();
        make_panels();
        insert_points();
        add_walls();
        result_.mesh = std::move(mesh_);
        return std::move(result_);
    }

  private:
    /// 64 units in the last place of the largest coordinate across the axis.
    static double rounding_of(const Footprint& footprint, const WallSettings& settings) {
        double largest = settings.reach;
        for (const auto& e : footprint.tree().edges())
            largest = std::max({largest, std::fabs(e.a.x), std::fabs(e.a.y)});
        return std::max(64 * 2.220446049250313e-16 * largest, 1e-300);
    }

    void look() {
        view_.seen.resize(mesh_.vertex_count());
        view_.heights.resize(mesh_.vertex_count());
        parallel_for(mesh_.vertex_count(), [&](std::size_t v) {
            const Vec3 p = settings_.to_world.point(mesh_.positions[v]);
            view_.seen[v] = seen_along(settings_.axis, p);
            view_.heights[v] = p[settings_.axis];
        });
    }

    /// The boundary by wall: edges at which the directions of the kept faces do not cancel.
    void find_boundary() {
        look();
        edges_.clear();
        table_ = build_edges(mesh_);
        for (Index e = 0; e < table_.size(); ++e) {
            const auto [low, high] = table_.edges[e];
            int count = 0;
            for (const Index c : table_.corners_of(e)) count += mesh_.vertex(c) == low ? 1 : -1;
            if (count == 0) continue;
            const Vec2 &p = view_.seen[low], &q = view_.seen[high];
            const Index wall = walls_.nearest(p, q);
            if (settings_.closed || walls_.is_on(wall, p, q)) edges_.push_back({low, high, e, count, wall});
        }
        std::stable_sort(edges_.begin(), edges_.end(),
                         [](const WallEdge& a, const WallEdge& b) { return a.wall < b.wall; });
    }

    /// Inserts vertices into edges that pass a corner of the outline. If the outline is straight or almost
    /// straight at the corner, faces were cut only once. Returns true if any were inserted.
    bool split_at_posts() {
        std::vector<Insertion> insertions;
        std::vector<Provenance::Edge> added;
        const double rounding = walls_.rounding();
        const WallsAtVertices around(edges_, mesh_.vertex_count());
        for (const WallEdge& e : edges_) {
            const double a = walls_.along(e.wall, view_.seen[e.low]),
                         b = walls_.along(e.wall, view_.seen[e.high]);
            for (const auto& stand : walls_.stands(e.wall)) {
                if (!(stand.at > std::min(a, b) + rounding && stand.at < std::max(a, b) - rounding)) continue;
                const bool at_low = std::fabs(stand.at - a) < std::fabs(stand.at - b);
                if (is_corner(around, e.wall, stand, at_low ? e.low : e.high, at_low ? a : b)) continue;
                const auto vertex = static_cast<Index>(mesh_.vertex_count() + added.size());
                added.push_back(a < b ? Provenance::Edge{e.low, e.high, (stand.at - a) / (b - a)}
                                      : Provenance::Edge{e.high, e.low, (stand.at - b) / (a - b)});
                insert(insertions, e, added.back(), vertex);
                made(e.wall, added.back());
            }
        }
        if (added.empty()) return false;
        insert_all(std::move(insertions), added);
        return true;
    }
    /// True if a vertex counts as the corner. The boundary passes to the wall's neighbour at this vertex,
    /// and the vertex is past the corner by no more than rounding. Another point at the corner would create
    /// a sliver, and the wall might use the wrong side of it.
    bool is_corner(const WallsAtVertices& around, Index wall, const Walls::Stand& stand, Index vertex,
                   double at) const {
        const auto& e = walls_.edges()[wall];
        const bool ends = stand.at == walls_.length_of(wall);
        if (!ends && stand.at != 0) return false;
        return std::fabs(at - stand.at) <= walls_.spread_of_corner(ends ? wall : e.previous) &&
               around.has(vertex, ends ? e.next : e.previous);
    }
    /// Inserts a vertex into an edge of the boundary, at the position `at`.
    void insert(std::vector<Insertion>& insertions, const WallEdge& e, const Provenance::Edge& at,
                Index vertex) const {
        for (const Index c : table_.corners_of(e.edge))
            insertions.push_back({c, mesh_.vertex(c) == at.a ? at.t : 1 - at.t, vertex});
    }
    void made(Index wall, const Provenance::Edge& at) {
        result_.made.emplace_back(wall, mix(mesh_.positions[at.a], mesh_.positions[at.b], at.t));
    }
    void insert_all(std::vector<Insertion> insertions, const std::vector<Provenance::Edge>& added) {
        AttributeChanges changes;
        mesh_ = insert_on_edges(mesh_, std::move(insertions), added, &changes);
        merge_changes(result_.changes, changes);
    }

    /// For an open input mesh: drops contours that do not close, and the unbalanced parts at posts.
    void drop_open() {
        DisjointSets contours(mesh_.vertex_count());
        for (const WallEdge& e : edges_) contours.join(e.low, e.high);
        std::set<Index> open;
        for (bool more = true; more;) {
            const std::size_t before = open.size();
            find_open(contours, open);
            more = open.size() > before;
        }
        std::map<Index, OpenContour> found;
        for (const WallEdge& e : edges_) {
            const Index root = contours.find(e.low);
            if (!open.contains(root)) continue;
            const auto [at, fresh] = found.try_emplace(root, OpenContour{e.wall, 0, mesh_.positions[e.low]});
            ++at->second.edges;
        }
        for (const auto& [root, contour] : found) result_.open.push_back(contour);
        std::erase_if(edges_, [&](const WallEdge& e) { return open.contains(contours.find(e.low)); });
    }
    void find_open(DisjointSets& contours, std::set<Index>& open) const {
        std::map<Index, int> balance; // [vertices] balance
        std::map<std::pair<Index, Index>, std::pair<int, std::set<Index>>>
            post; // the balance and its vertices, by wall and post
        for (const WallEdge& e : edges_) {
            if (open.contains(contours.find(e.low))) continue;
            balance[e.low] += e.count;
            balance[e.high] -= e.count;
        }
        for (const auto& [v, count] : balance)
            if (count != 0) open.insert(contours.find(v));
        for (const WallPanel& panel : panels_of_wall()) {
            for (const auto& [v, count] : panel.balance()) {
                if (open.contains(contours.find(v))) continue;
                const auto& stand = walls_.nearest_stand(panel.wall(), view_.seen[v]);
                auto& [sum, roots] = post[{panel.wall(), stand.post}];
                sum += count;
                roots.insert(contours.find(v));
            }
        }
        for (const auto& [key, at] : post)
            if (at.first != 0) open.insert(at.second.begin(), at.second.end());
    }

    std::vector<WallPanel> panels_of_wall() const {
        std::vector<WallPanel> panels;
        for (std::size_t i = 0; i < edges_.size();) {
            std::size_t end = i;
            while (end < edges_.size() && edges_[end].wall == edges_[i].wall) ++end;
            panels.emplace_back(edges_[i].wall, std::span(edges_).subspan(i, end - i));
            i = end;
        }
        return panels;
    }

    /// Builds panels whose upright edges match. If a vertex is found on an upright edge, it is assigned to
    /// the post, and all panels are built again.
    void make_panels() {
        panels_ = panels_of_wall();
        for (const WallPanel& panel : panels_) panel.stand_at_posts(view_);
        for (bool again = true; again;) {
            again = false;
            std::vector<std::uint8_t> good(panels_.size());
            parallel_for(
                panels_.size(), [&](std::size_t i) { good[i] = panels_[i].complete(view_); }, 1);
            for (std::size_t i = 0; i < panels_.size(); ++i) {
                if (!good[i]) refuse(walls_, panels_[i].wall());
                for (const auto& [post, vertex] : panels_[i].missed())
                    again |= view_.at_post[post].insert(vertex).second;
                if (!again && !panels_[i].missed().empty()) refuse(walls_, panels_[i].wall());
            }
        }
        std::map<std::pair<Index, Index>, int> upright;
        for (const WallPanel& panel : panels_)
            for (const auto& [ends, count] : panel.upright()) upright[ends] += count;
        for (const auto& [ends, count] : upright)
            if (count != 0) refuse(walls_, walls_.nearest(view_.seen[ends.first], view_.seen[ends.second]));
    }

    /// Inserts the walls' edge points into the kept faces. New points are numbered from first_added_, panel
    /// by panel.
    void insert_points() {
        first_added_ = static_cast<Index>(mesh_.vertex_count());
        std::vector<Insertion> insertions;
        std::vector<Provenance::Edge> added;
        std::size_t edge = 0; // the first edge of the panel
        for (const WallPanel& panel : panels_) {
            const auto points = static_cast<Index>(panel.points().size());
            const std::size_t first = added.size();
            added.resize(first + panel.filling().added.size());
            for (const auto& on : panel.on_edges()) {
                const WallEdge& e = edges_[edge + on.edge];
                const Provenance::Edge at{on.from, on.from == e.low ? e.high : e.low, on.t};
                if (on.point < points) {
                    insert(insertions, e, at, panel.points()[on.point]);
                    continue;
                }
                const std::size_t i = first + on.point - points;
                if (added[i].a == added[i].b) added[i] = at; // the first edge through it sets its position
                insert(insertions, e, at, static_cast<Index>(first_added_ + i));
            }
            for (std::size_t i = first; i < added.size(); ++i) made(panel.wall(), added[i]);
            while (edge < edges_.size() && edges_[edge].wall == panel.wall()) ++edge;
        }
        if (!insertions.empty()) insert_all(std::move(insertions), added);
    }

    void add_walls() {
        const std::size_t faces = mesh_.face_count();
        if (panels_.empty()) return;
        merge_changes(result_.changes, append_walls(mesh_, {panels_, walls_, settings_, first_added_}));
        result_.wall_faces = mesh_.face_count() - faces;
    }

    Mesh mesh_;
    const WallSettings& settings_;
    Walls walls_;
    PostView view_;
    EdgeTable table_;
    std::vector<WallEdge> edges_; ///< sorted by wall
    std::vector<WallPanel> panels_;
    Index first_added_ = 0;
    WalledCrop result_;
};

} // namespace

WalledCrop close_crop(Mesh kept, const Footprint& footprint, const WallSettings& settings) {
    return Closer(std::move(kept), footprint, settings).run();
}

} // namespace facetmill
