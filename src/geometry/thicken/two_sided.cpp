#include "geometry/clean/steps.hpp"
#include "geometry/thicken/doubled.hpp"
#include "geometry/inspect/evidence.hpp"
#include "geometry/edit/surgery.hpp"
#include "geometry/thicken/thicken.hpp"

#include <algorithm>
#include <map>

namespace facetmill {

namespace {

/// The places around a face from the lowest on, as it runs or backward.
std::vector<Index> ring_of(const Mesh& mesh, const std::vector<Index>& place, Index f, bool backward) {
    std::vector<Index> ring;
    for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c) ring.push_back(place[mesh.vertex(c)]);
    if (backward) std::reverse(ring.begin(), ring.end());
    std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
    return ring;
}

/// Flags the faces that have a face of their own at the same places the other way round.
std::vector<std::uint8_t> faces_with_back(const Mesh& mesh) {
    const auto place = clean_steps::lowest_at_place(mesh);
    std::vector<std::uint8_t> flags(mesh.face_count(), 0);
    Mesh plain; // to see fast that there are none, as mostly
    plain.positions = mesh.positions;
    plain.corners = mesh.corners;
    plain.face_offsets = mesh.face_offsets;
    for (Index w = 0; w < mesh.wedge_count(); ++w)
        plain.wedge_vertex.push_back(place[mesh.vertex_of_wedge(w)]);
    if (duplicate_faces(plain).empty()) return flags;
    std::map<std::vector<Index>, std::size_t> left; // faces of each ring that are not a back yet
    for (Index f = 0; f < mesh.face_count(); ++f) ++left[ring_of(mesh, place, f, false)];
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto back = left.find(ring_of(mesh, place, f, true));
        if (back != left.end() && back->second > 0) {
            --back->second;
            flags[f] = 1;
        }
    }
    return flags;
}

} // namespace

TwoSidedResult two_sided(const Mesh& mesh) {
    const auto done = faces_with_back(mesh);
    if (mesh.face_count() > 0 && std::count(done.begin(), done.end(), 0) == 0)
        return {mesh, kept_changes(mesh.attributes)};
    std::vector<std::uint8_t> open(mesh.vertex_count(), 0);
    for (const OpenEdge& e : open_edges(mesh)) open[mesh.vertex(e.corner)] = open[mesh.vertex(e.next)] = 1;
    std::vector<Index> back(mesh.vertex_count()), copies;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        back[v] = open[v] ? v : static_cast<Index>(mesh.vertex_count() + copies.size());
        if (!open[v]) copies.push_back(v);
    }
    Doubled d = doubled(mesh, back, copies);
    TwoSidedResult r;
    const bool plain =
        !mesh.has_seams() && std::none_of(mesh.attributes.begin(), mesh.attributes.end(),
                                          [](const auto& a) { return a.domain == Domain::wedge; });
    if (plain) { // a vertex is all there is to a wedge
        for (Index& c : d.mesh.corners) c = d.mesh.wedge_vertex[c];
        d.mesh.wedge_vertex = {};
        d.descent.wedges = d.descent.vertices;
    }
    r.changes = inherit_attributes(d.mesh, mesh, d.descent);
    if (!plain) turn_wedges(d.mesh, mesh.wedge_count(), r.changes);
    std::vector<std::uint8_t> gone(mesh.face_count(), 0); // backs that are there already
    gone.insert(gone.end(), done.begin(), done.end());
    r.mesh = std::count(gone.begin(), gone.end(), 1) > 0 ? keep_faces(d.mesh, faces_without(gone))
                                                         : std::move(d.mesh);
    return r;
}

} // namespace facetmill
