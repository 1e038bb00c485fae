#include "geometry/edit/surgery.hpp"

#include "mesh/face.hpp"
#include "mesh/indices_where.hpp"
#include "mesh/wedges.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

namespace facetmill {

namespace {

constexpr Index gone = none;

bool has_wedge_attributes(const Mesh& mesh) {
    return std::any_of(mesh.attributes.begin(), mesh.attributes.end(),
                       [](const Attribute& a) { return a.domain == Domain::wedge; });
}

void forget_plain_wedges(Mesh& mesh) {
    if (mesh.wedge_vertex.size() != mesh.positions.size()) return;
    for (Index w = 0; w < mesh.wedge_vertex.size(); ++w)
        if (mesh.wedge_vertex[w] != w) return;
    mesh.wedge_vertex = {};
}

/// The remaining elements, and the new number of each old element (`gone` if removed).
struct Numbering {
    std::vector<Index> old, renumbered;
    explicit Numbering(const std::vector<std::uint8_t>& stays) : renumbered(stays.size(), gone) {
        for (Index i = 0; i < stays.size(); ++i)
            if (stays[i]) {
                renumbered[i] = static_cast<Index>(old.size());
                old.push_back(i);
            }
    }
};

/// All old elements, unchanged.
Provenance all_of() {
    Provenance l;
    l.identity = true;
    return l;
}

} // namespace

std::vector<Index> faces_without(const std::vector<std::uint8_t>& flags) {
    return indices_where(flags.size(), [&](Index f) { return !flags[f]; });
}

Mesh keep_faces(const Mesh& mesh, const std::vector<Index>& faces) {
    enum : std::uint8_t { unused = 0, kept = 1, lost = 2 };
    std::vector<std::uint8_t> wedges(mesh.wedge_count(), unused), vertices(mesh.vertex_count(), unused);
    for (Index c = 0; c < mesh.corner_count(); ++c) {
        wedges[mesh.corners[c]] = lost;
        vertices[mesh.vertex(c)] = lost;
    }
    for (const Index f : faces)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) {
            wedges[mesh.corners[c]] = kept;
            vertices[mesh.vertex(c)] = kept;
        }
    for (auto& w : wedges) w = w != lost;
    for (auto& v : vertices) v = v != lost;
    const Numbering of_wedges(wedges), of_vertices(vertices);
    Mesh result;
    MeshProvenance provenance;
    for (const Index v : of_vertices.old) result.positions.push_back(mesh.positions[v]);
    if (mesh.has_seams())
        for (const Index w : of_wedges.old)
            result.wedge_vertex.push_back(of_vertices.renumbered[mesh.wedge_vertex[w]]);
    if (!mesh.all_triangles()) result.face_offsets.push_back(0);
    for (const Index f : faces) {
        for (const Index w : mesh.face_wedges(f)) result.corners.push_back(of_wedges.renumbered[w]);
        if (!mesh.all_triangles()) result.face_offsets.push_back(static_cast<Index>(result.corners.size()));
    }
    provenance.faces = faces;
    provenance.vertices.copies = of_vertices.old;
    provenance.wedges.copies = of_wedges.old;
    inherit_attributes(result, mesh, provenance);
    normalise_offsets(result);
    forget_plain_wedges(result);
    return result;
}

std::vector<Mesh> separated(const Mesh& mesh, const std::vector<Index>& label_of_face, std::size_t count) {
    std::vector<std::vector<Index>> faces(count);
    for (Index f = 0; f < mesh.face_count(); ++f) faces[label_of_face[f]].push_back(f);
    std::vector<Index> new_wedge(mesh.wedge_count(), gone), new_vertex(mesh.vertex_count(), gone);
    std::vector<Mesh> pieces(count);
    for (std::size_t p = 0; p < count; ++p) {
        Mesh& piece = pieces[p];
        MeshProvenance provenance;
        provenance.faces = std::move(faces[p]);
        if (!mesh.all_triangles()) piece.face_offsets.push_back(0);
        for (const Index f : provenance.faces) {
            for (const Index w : mesh.face_wedges(f)) {
                const Index v = mesh.vertex_of_wedge(w);
                if (new_vertex[v] == gone) {
                    new_vertex[v] = static_cast<Index>(piece.positions.size());
                    piece.positions.push_back(mesh.positions[v]);
                    provenance.vertices.copies.push_back(v);
                }
                if (new_wedge[w] == gone) {
                    new_wedge[w] = static_cast<Index>(provenance.wedges.copies.size());
                    provenance.wedges.copies.push_back(w);
                    if (mesh.has_seams()) piece.wedge_vertex.push_back(new_vertex[v]);
                }
                piece.corners.push_back(new_wedge[w]);
            }
            if (!mesh.all_triangles()) piece.face_offsets.push_back(static_cast<Index>(piece.corners.size()));
        }
        inherit_attributes(piece, mesh, provenance);
        for (const Index w : provenance.wedges.copies)
            new_wedge[w] = gone; // a vertex may belong to several pieces
        for (const Index v : provenance.vertices.copies) new_vertex[v] = gone;
        normalise_offsets(piece);
        forget_plain_wedges(piece);
    }
    return pieces;
}

std::vector<Mesh> separated_with_primitives(Mesh mesh, const std::vector<Index>& label_of_face,
                                            std::size_t count) {
    const std::vector<Primitive> table = std::exchange(mesh.primitives, {});
    std::vector<Mesh> pieces = separated(mesh, label_of_face, count);
    for (Mesh& piece : pieces) {
        Attribute* attribute = piece.find(primitive_attribute, Domain::face);
        if (!attribute) {
            piece.primitives = table;
            continue;
        }
        auto& of_face = std::get<std::vector<std::uint32_t>>(attribute->data);
        std::map<std::uint32_t, std::uint32_t> renumbered;
        for (const auto p : of_face) renumbered.emplace(p, 0);
        for (auto& [old, number] : renumbered) {
            number = static_cast<std::uint32_t>(piece.primitives.size());
            piece.primitives.push_back(old < table.size() ? table[old] : Primitive{});
        }
        for (auto& p : of_face) p = renumbered.at(p);
    }
    return pieces;
}

std::size_t merge_vertices(Mesh& mesh, const std::vector<Index>& target) {
    const std::size_t before = mesh.vertex_count();
    std::vector<std::uint8_t> stays(before);
    for (Index v = 0; v < before; ++v) stays[v] = target[v] == v;
    const Numbering numbering(stays);
    if (numbering.old.size() == before) return 0;
    const auto moved = [&](Index v) { return numbering.renumbered[target[v]]; };
    auto wedges = explicit_wedges(mesh);
    for (auto& v : wedges) v = moved(v);
    if (has_wedge_attributes(mesh)) {
        mesh.wedge_vertex = std::move(wedges);
    } else {
        for (auto& c : mesh.corners) c = wedges[c];
        mesh.wedge_vertex = {};
    }
    std::vector<Vec3> positions;
    for (const Index v : numbering.old) positions.push_back(mesh.positions[v]);
    mesh.positions = std::move(positions);
    for (auto& a : mesh.attributes)
        if (a.domain == Domain::vertex) a.select(numbering.old);
    forget_plain_wedges(mesh);
    return before - numbering.old.size();
}

Mesh part_corners(const Mesh& mesh, const std::vector<Index>& vertex_of_corner,
                  const std::vector<Index>& copies) {
    Mesh result;
    MeshProvenance provenance;
    provenance.faces_identity = true;
    provenance.vertices.copies.resize(mesh.vertex_count());
    for (Index v = 0; v < mesh.vertex_count(); ++v) provenance.vertices.copies[v] = v;
    provenance.vertices.copies.insert(provenance.vertices.copies.end(), copies.begin(), copies.end());
    for (const Index v : provenance.vertices.copies) result.positions.push_back(mesh.positions[v]);
    result.face_offsets = mesh.face_offsets;
    if (!mesh.has_seams()) { // every vertex is its own wedge, including new vertices
        result.corners = vertex_of_corner;
        provenance.wedges = provenance.vertices;
    } else {
        result.corners = mesh.corners;
        result.wedge_vertex.assign(mesh.wedge_count(), gone);
        provenance.wedges.copies.resize(mesh.wedge_count());
        for (Index w = 0; w < mesh.wedge_count(); ++w) provenance.wedges.copies[w] = w;
        std::map<std::pair<Index, Index>, Index> copies;
        for (Index c = 0; c < mesh.corner_count(); ++c) {
            const Index w = mesh.corners[c], v = vertex_of_corner[c];
            if (result.wedge_vertex[w] == gone) result.wedge_vertex[w] = v;
            if (result.wedge_vertex[w] == v) continue;
            const auto [at, fresh] =
                copies.try_emplace({w, v}, static_cast<Index>(result.wedge_vertex.size()));
            if (fresh) {
                result.wedge_vertex.push_back(v);
                provenance.wedges.copies.push_back(w);
            }
            result.corners[c] = at->second;
        }
        for (Index w = 0; w < mesh.wedge_count(); ++w)
            if (result.wedge_vertex[w] == gone) result.wedge_vertex[w] = mesh.wedge_vertex[w];
    }
    inherit_attributes(result, mesh, provenance);
    return result;
}

namespace {

/// Rebuilds faces from old faces, corner by corner.
class Inserter {
  public:
    Inserter(const Mesh& mesh, std::vector<Insertion> insertions, const std::vector<Provenance::Edge>& added)
        : mesh_(mesh), insertions_(std::move(insertions)), added_(added),
          plain_(!mesh.has_seams() && !has_wedge_attributes(mesh)), wedges_(explicit_wedges(mesh)) {
        std::sort(insertions_.begin(), insertions_.end(), [](const Insertion& a, const Insertion& b) {
            return std::tie(a.corner, a.t, a.vertex) < std::tie(b.corner, b.t, b.vertex);
        });
        result_.positions = mesh.positions;
        for (const auto& e : added)
            result_.positions.push_back(mix(mesh.positions[e.a], mesh.positions[e.b], e.t));
        if (plain_)
            for (std::size_t i = 0; i < added.size(); ++i)
                wedges_.push_back(static_cast<Index>(mesh.vertex_count() + i));
    }

    Mesh run(AttributeChanges* changes) {
        offsets_.push_back(0);
        std::size_t next = 0;
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            const Index begin = mesh_.face_begin(f), end = mesh_.face_end(f);
            ring_.clear();
            for (Index c = begin; c < end; ++c) {
                ring_.push_back({mesh_.corners[c], true});
                for (; next < insertions_.size() && insertions_[next].corner == c; ++next)
                    ring_.push_back({wedge_for(insertions_[next], f), false});
            }
            if (end - begin == 3)
                emit_triangles(f);
            else
                emit(f, ring_);
        }
        return finish(changes);
    }

  private:
    struct RingCorner {
        Index wedge;
        bool original;
    };

    Index wedge_for(const Insertion& i, Index f) {
        if (plain_) return i.vertex;
        const Index to = next_corner(mesh_, f, i.corner);
        Index a = mesh_.corners[i.corner], b = mesh_.corners[to];
        double t = i.t;
        if (a > b) {
            std::swap(a, b);
            t = 1 - t;
        }
        const auto [at, fresh] = made_.try_emplace({a, b, i.vertex}, static_cast<Index>(wedges_.size()));
        if (fresh) {
            wedges_.push_back(i.vertex);
            edges_.push_back({a, b, t});
        }
        return at->second;
    }

    void emit(Index f, const std::vector<RingCorner>& ring) {
        for (const auto& corner : ring) corners_.push_back(corner.wedge);
        offsets_.push_back(static_cast<Index>(corners_.size()));
        sources_.push_back(f);
    }

    /// Cuts a triangle with points on its sides: first from a point to the opposite corner, then each part
    /// further. No piece has three points on the same side.
    void emit_triangles(Index f) {
        std::vector<std::vector<RingCorner>> stack{ring_};
        while (!stack.empty()) {
            auto ring = std::move(stack.back());
            stack.pop_back();
            if (ring.size() == 3) {
                emit(f, ring);
                continue;
            }
            std::size_t at = 0;
            while (ring[at].original) ++at;
            // After the point, the ring has the end of its side, then the opposite corner.
            std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(at), ring.end());
            std::size_t opposite = 1, corners = 0;
            for (; corners < 2; ++opposite) corners += ring[opposite].original;
            --opposite;
            ring[0].original = true;
            std::vector<RingCorner> first(ring.begin(),
                                          ring.begin() + static_cast<std::ptrdiff_t>(opposite) + 1),
                second(ring.begin() + static_cast<std::ptrdiff_t>(opposite), ring.end());
            second.push_back(ring[0]);
            stack.push_back(std::move(second));
            stack.push_back(std::move(first));
        }
    }

    Mesh finish(AttributeChanges* changes) {
        result_.corners = std::move(corners_);
        result_.face_offsets = std::move(offsets_);
        MeshProvenance provenance;
        provenance.faces = std::move(sources_);
        provenance.vertices = all_of();
        provenance.vertices.edges = added_;
        provenance.wedges = all_of();
        provenance.wedges.edges = plain_ ? added_ : edges_;
        if (!plain_) result_.wedge_vertex = std::move(wedges_);
        AttributeChanges found = inherit_attributes(result_, mesh_, provenance);
        if (changes) *changes = std::move(found);
        normalise_offsets(result_);
        forget_plain_wedges(result_);
        return std::move(result_);
    }

    const Mesh& mesh_;
    std::vector<Insertion> insertions_;
    const std::vector<Provenance::Edge>& added_;
    bool plain_; ///< wedges are the vertices
    std::vector<Index> wedges_;
    std::vector<Provenance::Edge> edges_;
    std::map<std::tuple<Index, Index, Index>, Index> made_;
    std::vector<RingCorner> ring_;
    std::vector<Index> corners_, offsets_, sources_;
    Mesh result_;
};

} // namespace

Mesh insert_on_edges(const Mesh& mesh, std::vector<Insertion> insertions,
                     const std::vector<Provenance::Edge>& added, AttributeChanges* changes) {
    return Inserter(mesh, std::move(insertions), added).run(changes);
}

void Patches::add_face(std::span<const Index> wedges, Index source) {
    corners.insert(corners.end(), wedges.begin(), wedges.end());
    offsets.push_back(static_cast<Index>(corners.size()));
    sources.push_back(source);
}

Mesh with_patches(const Mesh& mesh, const Patches& patches, AttributeChanges* changes) {
    Mesh result;
    result.positions = mesh.positions;
    result.positions.insert(result.positions.end(), patches.points.begin(), patches.points.end());
    if (mesh.has_seams()) {
        result.wedge_vertex = mesh.wedge_vertex;
        for (Index i = 0; i < patches.points.size(); ++i)
            result.wedge_vertex.push_back(static_cast<Index>(mesh.vertex_count()) + i);
    }
    result.corners = mesh.corners;
    result.face_offsets = mesh.face_offsets;
    for (Index f = 0; f + 1 < patches.offsets.size(); ++f)
        add_face(result, {patches.corners.data() + patches.offsets[f],
                          patches.corners.data() + patches.offsets[f + 1]});
    MeshProvenance provenance;
    for (Index f = 0; f < mesh.face_count(); ++f) provenance.faces.push_back(f);
    provenance.faces.insert(provenance.faces.end(), patches.sources.begin(), patches.sources.end());
    provenance.wedges = all_of();
    provenance.wedges.mix_offsets = patches.mix_offsets;
    provenance.wedges.mix_sources = patches.mix_wedges;
    provenance.wedges.mix_weights = patches.mix_weights;
    provenance.vertices = provenance.wedges;
    for (auto& w : provenance.vertices.mix_sources) w = mesh.vertex_of_wedge(w);
    AttributeChanges found = inherit_attributes(result, mesh, provenance);
    if (changes) *changes = std::move(found);
    return result;
}

} // namespace facetmill
