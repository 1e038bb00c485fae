#include "geometry/crop/wall_faces.hpp"

#include "geometry/cut/cap_paint.hpp"

#include <algorithm>

namespace facetmill {

namespace {

class Appender {
  public:
    Appender(const Mesh& from, const WallFaces& faces)
        : from_(from), faces_(faces), own_(caps_have_own_wedges(from)), added_(faces.first_added) {}

    Mesh run(AttributeChanges& changes) {
        start();
        for (const WallPanel& panel : faces_.panels) add(panel);
        descent_.faces.resize(out_.face_count()); // walls copy the first face's and are painted
        for (Index f = 0; f < from_.face_count(); ++f) descent_.faces[f] = f;
        changes = inherit_attributes(out_, from_, descent_);
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
        descent_.vertices.identity = true;
        descent_.wedges.copies.resize(from_.wedge_count());
        for (Index w = 0; w < from_.wedge_count(); ++w) descent_.wedges.copies[w] = w;
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
    /// With normals or coordinates of its own a wall has wedges of its own, made of the lowest there.
    Index wedge(const WallPanel& panel, Index point) {
        const auto points = static_cast<Index>(panel.points().size());
        const Index v = point < points ? panel.points()[point] : added_ + point - points;
        if (!own_) return lowest_[v];
        const auto [at, fresh] = wedge_at_.try_emplace(v, static_cast<Index>(descent_.wedges.copies.size()));
        if (fresh) {
            descent_.wedges.copies.push_back(lowest_[v]);
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
    Descent descent_;
    std::vector<Index> lowest_; ///< [vertices] wedge
    std::map<Index, Index> wedge_at_;
    std::vector<FaceRange> ranges_;              ///< [panels]
    std::vector<std::vector<Index>> own_wedges_; ///< [panels]
};

} // namespace

AttributeChanges append_walls(Mesh& mesh, const WallFaces& faces) {
    AttributeChanges changes;
    mesh = Appender(mesh, faces).run(changes);
    return changes;
}

} // namespace facetmill
