#include "geometry/crop/cut.hpp"

#include "geometry/crop/segment_cutter.hpp"
#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <utility>

namespace facetmill {

namespace {

/// The faces that each segment enters, ascending.
std::vector<std::vector<Index>> faces_by_segment(const Mesh& mesh, const CropView& view) {
    using Entries = std::vector<std::pair<Index, Index>>; // segment, face
    const Entries entries = parallel_reduce(
        mesh.face_count(), Entries{},
        [&](std::size_t begin, std::size_t end) {
            Entries some;
            std::vector<Vec2> face;
            for (auto f = static_cast<Index>(begin); f < end; ++f) {
                view.gather(mesh, f, face);
                view.meetings(face, [&](Index s, OutlineMeeting meets) {
                    if (meets == OutlineMeeting::crossing) some.emplace_back(s, f);
                    return true;
                });
            }
            return some;
        },
        [](Entries a, const Entries& b) {
            a.insert(a.end(), b.begin(), b.end());
            return a;
        },
        1024);
    std::vector<std::vector<Index>> lists(view.footprint().tree().edges().size());
    for (const auto& [s, f] : entries) lists[s].push_back(f);
    return lists;
}

/// Faces that successive cuts may reach, as a separate mesh in the same order.
struct CutRegion {
    std::vector<Index> faces, vertices, wedges; ///< elements of the whole mesh; wedges: empty without seams
    EnteredFaces entered;
    Mesh mesh;
    CutFaces cut;
    std::vector<Index> new_vertices, new_wedges; ///< [new elements] numbers in the whole mesh
};

/// Entered faces and their neighbours, in regions without common vertices, so that cuts in different regions
/// are independent.
class CutRegions {
  public:
    explicit CutRegions(const Mesh& mesh) : mesh_(mesh), region_of_(mesh.face_count(), none) {}

    std::vector<CutRegion> find(const std::vector<std::vector<Index>>& lists) {
        join_faces(lists);
        std::vector<CutRegion> regions(number_regions());
        std::vector<Index> place(mesh_.face_count());
        for (Index f = 0; f < region_of_.size(); ++f) {
            if (region_of_[f] == none) continue;
            auto& faces = regions[region_of_[f]].faces;
            place[f] = static_cast<Index>(faces.size());
            faces.push_back(f);
        }
        for (Index s = 0; s < lists.size(); ++s)
            for (const Index f : lists[s]) regions[region_of_[f]].entered.add(s, place[f]);
        std::vector<Index> vertex_place(mesh_.vertex_count()), wedge_place(mesh_.wedge_vertex.size());
        parallel_for(
            regions.size(), [&](std::size_t r) { make_mesh(regions[r], vertex_place, wedge_place); }, 1);
        return regions;
    }
    /// [faces] The region of each face, or none.
    const std::vector<Index>& region_of() const { return region_of_; }

  private:
    /// Marks the faces with 0, and merges the sets of their vertices.
    void join_faces(const std::vector<std::vector<Index>>& lists) {
        const EdgeTable edges = build_edges(mesh_);
        const auto corner_face = corner_faces(mesh_);
        sets_ = DisjointSets(mesh_.vertex_count());
        std::vector<std::uint8_t> entered(mesh_.face_count());
        const auto add = [&](Index f) {
            region_of_[f] = 0;
            const Index first = mesh_.vertex(mesh_.face_begin(f));
            for (Index c = mesh_.face_begin(f) + 1; c < mesh_.face_end(f); ++c)
                sets_.join(first, mesh_.vertex(c));
        };
        for (const auto& list : lists)
            for (const Index f : list) {
                if (std::exchange(entered[f], 1) != 0) continue;
                add(f);
                for (Index c = mesh_.face_begin(f); c < mesh_.face_end(f); ++c)
                    if (edges.corner_edge[c] != none)
                        for (const Index other : edges.corners_of(edges.corner_edge[c]))
                            if (region_of_[corner_face[other]] == none) add(corner_face[other]);
            }
    }
    std::size_t number_regions() {
        std::size_t count = 0;
        std::vector<Index> number(mesh_.vertex_count(), none); // [sets] region numbers
        for (Index f = 0; f < region_of_.size(); ++f) {
            if (region_of_[f] == none) continue;
            Index& n = number[sets_.find(mesh_.vertex(mesh_.face_begin(f)))];
            if (n == none) n = static_cast<Index>(count++);
            region_of_[f] = n;
        }
        return count;
    }
    /// vertex_place, wedge_place: map to the region's numbers; no other region uses the same entries.
    void make_mesh(CutRegion& region, std::vector<Index>& vertex_place,
                   std::vector<Index>& wedge_place) const {
        const auto numbered = [](std::vector<Index>& all, std::vector<Index>& place) {
            std::sort(all.begin(), all.end());
            all.erase(std::unique(all.begin(), all.end()), all.end());
            for (Index i = 0; i < all.size(); ++i) place[all[i]] = i;
        };
        const bool seams = mesh_.has_seams();
        for (const Index f : region.faces)
            for (const Index w : mesh_.face_wedges(f)) {
                region.vertices.push_back(mesh_.vertex_of_wedge(w));
                if (seams) region.wedges.push_back(w);
            }
        numbered(region.vertices, vertex_place);
        numbered(region.wedges, wedge_place);
        Mesh& out = region.mesh;
        for (const Index v : region.vertices) out.positions.push_back(mesh_.positions[v]);
        for (const Index w : region.wedges)
            out.wedge_vertex.push_back(vertex_place[mesh_.vertex_of_wedge(w)]);
        out.face_offsets.push_back(0);
        for (const Index f : region.faces) {
            for (const Index w : mesh_.face_wedges(f))
                out.corners.push_back(seams ? wedge_place[w] : vertex_place[w]);
            out.face_offsets.push_back(static_cast<Index>(out.corners.size()));
        }
        normalise_offsets(out);
    }

    const Mesh& mesh_;
    std::vector<Index> region_of_;
    DisjointSets sets_; ///< sets of vertices
};

/// A new vertex or wedge of a region.
struct MadeInRegion {
    Index region, number;
};

/// Numbers the new elements of all regions in the whole mesh, starting at `first`. The order is by segment,
/// then by edge, as if all regions had been cut together. Returns the edges in that order.
template <class Segments, class Edges, class Old, class Numbers>
std::vector<Provenance::Edge> number_made(std::vector<CutRegion>& regions, std::size_t segments, Index first,
                                          const Segments& segments_of, const Edges& edges_of, const Old& old,
                                          const Numbers& numbers_of) {
    std::vector<std::size_t> begins(segments + 1);
    for (CutRegion& region : regions) {
        for (const Index s : segments_of(region)) ++begins[s];
        numbers_of(region).resize(segments_of(region).size());
    }
    std::vector<MadeInRegion> made(exclusive_scan(begins));
    std::vector<std::size_t> ends = begins;
    for (Index r = 0; r < regions.size(); ++r)
        for (Index i = 0; i < segments_of(regions[r]).size(); ++i)
            made[ends[segments_of(regions[r])[i]]++] = {r, i};
    const auto in_whole = [&](const MadeInRegion& m) {
        CutRegion& region = regions[m.region];
        const auto whole = [&](Index i) {
            const auto& known = old(region);
            return i < known.size() ? known[i] : numbers_of(region)[i - known.size()];
        };
        const Provenance::Edge& e = edges_of(region)[m.number];
        return Provenance::Edge{whole(e.a), whole(e.b), e.t};
    };
    const auto comes_before = [&](const MadeInRegion& x, const MadeInRegion& y) {
        const Provenance::Edge e = in_whole(x), f = in_whole(y);
        return e.a != f.a ? e.a < f.a : e.b < f.b;
    };
    std::vector<Provenance::Edge> edges;
    for (std::size_t s = 0; s < segments; ++s) {
        const auto begin = made.begin() + static_cast<std::ptrdiff_t>(begins[s]),
                   end = made.begin() + static_cast<std::ptrdiff_t>(begins[s + 1]);
        if (begin != end && begin->region != std::prev(end)->region) std::sort(begin, end, comes_before);
        for (auto m = begin; m != end; ++m) {
            numbers_of(regions[m->region])[m->number] = first + static_cast<Index>(edges.size());
            edges.push_back(in_whole(*m));
        }
    }
    return edges;
}

class OutlineCutter {
  public:
    OutlineCutter(const Mesh& mesh, const CropView& view, CutMemory& memory)
        : mesh_(mesh), view_(view), memory_(memory), segments_(view, memory) {}

    OutlineCut run() {
        CutRegions finder(mesh_);
        regions_ = finder.find(faces_by_segment(mesh_, view_));
        if (!memory_.entries.empty()) known_ = memory_.entries_at(mesh_.positions);
        parallel_for(
            regions_.size(), [&](std::size_t r) { cut(regions_[r]); }, 1);
        number_all();
        make_mesh(finder.region_of());
        remember_points();
        for (const CutRegion& region : regions_) result_.cut_faces += region.cut.cut_faces;
        decide();
        return std::move(result_);
    }

  private:
    void cut(CutRegion& region) const {
        OnPlanes on;
        on.grow(region.vertices.size());
        for (Index v = 0; !known_.empty() && v < region.vertices.size(); ++v)
            for (const auto plane : known_[region.vertices[v]]) on.add(v, plane);
        region.cut = cut_along_segments(region.mesh, region.entered, view_, segments_, std::move(on));
    }

    void number_all() {
        vertices_ = number_made(
            regions_, segments_.planes.size(), static_cast<Index>(mesh_.vertex_count()),
            [](const CutRegion& r) -> auto& { return r.cut.vertex_segments; },
            [](const CutRegion& r) -> auto& { return r.cut.vertices; },
            [](const CutRegion& r) -> auto& { return r.vertices; },
            [](CutRegion & r) -> auto& { return r.new_vertices; });
        wedges_ = number_made(
            regions_, segments_.planes.size(), static_cast<Index>(mesh_.wedge_count()),
            [](const CutRegion& r) -> auto& { return r.cut.wedge_segments; },
            [](const CutRegion& r) -> auto& { return r.cut.wedges; },
            [](const CutRegion& r) -> auto& { return r.wedges; },
            [](CutRegion & r) -> auto& { return r.new_wedges; });
    }
    static Index vertex_in_whole(const CutRegion& region, Index v) {
        const auto old = static_cast<Index>(region.vertices.size());
        return v < old ? region.vertices[v] : region.new_vertices[v - old];
    }
    Index wedge_in_whole(const CutRegion& region, Index w) const {
        if (!mesh_.has_seams()) return vertex_in_whole(region, w);
        const auto old = static_cast<Index>(region.wedges.size());
        return w < old ? region.wedges[w] : region.new_wedges[w - old];
    }

    void make_mesh(const std::vector<Index>& region_of) {
        Mesh& out = result_.mesh;
        MeshProvenance provenance;
        out.face_offsets.push_back(0);
        std::vector<std::size_t> next(regions_.size()),
            face(regions_.size()); // the piece, and the region's face
        const auto add = [&](Index f) {
            out.face_offsets.push_back(static_cast<Index>(out.corners.size()));
            provenance.faces.push_back(f);
        };
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            const Index r = region_of[f];
            if (r == none) {
                const auto wedges = mesh_.face_wedges(f);
                out.corners.insert(out.corners.end(), wedges.begin(), wedges.end());
                add(f);
                continue;
            }
            const CutRegion& region = regions_[r];
            const Pieces& pieces = region.cut.pieces;
            for (; next[r] < pieces.size() && pieces.source[next[r]] == face[r]; ++next[r]) {
                for (const Index w : pieces.of(next[r])) out.corners.push_back(wedge_in_whole(region, w));
                add(f);
            }
            ++face[r];
        }
        normalise_offsets(out);
        place_new(out);
        origin_ = provenance.faces;
        provenance.vertices.identity = provenance.wedges.identity = true;
        provenance.vertices.chained = provenance.wedges.chained = true;
        provenance.vertices.edges = std::move(vertices_);
        provenance.wedges.edges = std::move(wedges_);
        provenance.wedges_as_vertices = !mesh_.has_seams();
        result_.changes = inherit_attributes(out, mesh_, provenance);
    }
    void place_new(Mesh& out) const {
        out.positions = mesh_.positions;
        out.wedge_vertex = mesh_.wedge_vertex;
        out.positions.resize(mesh_.vertex_count() + vertices_.size());
        if (mesh_.has_seams()) out.wedge_vertex.resize(mesh_.wedge_count() + wedges_.size());
        for (const CutRegion& region : regions_) {
            for (std::size_t i = 0; i < region.new_vertices.size(); ++i)
                out.positions[region.new_vertices[i]] = region.cut.points[i];
            for (std::size_t i = 0; i < region.new_wedges.size(); ++i)
                out.wedge_vertex[region.new_wedges[i]] = vertex_in_whole(region, region.cut.wedge_vertex[i]);
        }
    }

    void remember_points() {
        const auto known = static_cast<Index>(memory_.entries.size());
        std::vector<std::vector<Vec3>> made(segments_.sharing.size()); // [planes] new points
        std::vector<std::uint8_t> met(made.size());
        for (const CutRegion& region : regions_) {
            for (const Index plane : region.cut.met) met[plane] = 1;
            const auto old = static_cast<Index>(region.vertices.size());
            for (const auto& [v, plane] : region.cut.on) made[plane].push_back(region.cut.points[v - old]);
        }
        for (Index plane = 0; plane < made.size(); ++plane) {
            if (made[plane].empty() && !met[plane]) continue;
            std::size_t entry = plane;
            if (plane >= known) {
                entry = memory_.entries.size();
                memory_.entries.push_back({segments_.planes[segments_.first[plane - known]], 0, {}});
            }
            memory_.add_to(entry, std::move(made[plane]));
        }
    }

    /// Decides which pieces stay.
    void decide() {
        std::vector<std::uint8_t> convex(mesh_.face_count());
        parallel_chunks(
            convex.size(),
            [&](std::size_t begin, std::size_t end) {
                std::vector<Vec2> face;
                for (std::size_t f = begin; f < end; ++f) {
                    view_.gather(mesh_, static_cast<Index>(f), face);
                    convex[f] = polygon::is_convex(face);
                }
            },
            1024);
        result_.stays.resize(result_.mesh.face_count());
        parallel_for(
            result_.stays.size(),
            [&](std::size_t f) {
                const bool is_convex = convex[origin_[f]] != 0;
                result_.stays[f] = view_.kept(view_.middle(result_.mesh, static_cast<Index>(f), is_convex));
            },
            256);
    }

    const Mesh& mesh_;
    const CropView& view_;
    CutMemory& memory_;
    SegmentPlanes segments_;
    std::vector<std::vector<std::uint32_t>>
        known_; ///< [vertices] entries of the memory; may be an empty list
    std::vector<CutRegion> regions_;
    std::vector<Provenance::Edge> vertices_, wedges_; ///< the new vertices and wedges
    OutlineCut result_;
    std::vector<Index> origin_; ///< [faces of the result] source face
};

} // namespace

OutlineCut cut_at_outline(const Mesh& mesh, const CropView& view, CutMemory& memory) {
    return OutlineCutter(mesh, view, memory).run();
}

} // namespace facetmill
