#include "base/parallel.hpp"
#include "geometry/orient/orient.hpp"
#include "mesh/face.hpp"
#include "mesh/topology.hpp"

#include <algorithm>

namespace facetmill {

namespace {

Vec3 vector_of(const Attribute& a, std::size_t i) { return {a.value(i, 0), a.value(i, 1), a.value(i, 2)}; }

/// The sum of the area vectors of the faces at each wedge that a flagged face uses; zero at the others.
std::vector<Vec3> faces_at_wedges(const Mesh& mesh, const std::vector<std::uint8_t>& flags) {
    std::vector<std::uint8_t> touched(mesh.wedge_count(), 0);
    for (Index f = 0; f < flags.size(); ++f)
        if (flags[f])
            for (const Index w : mesh.face_wedges(f)) touched[w] = 1;
    std::vector<Vec3> sums(mesh.wedge_count());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Vec3 area = area_vector(mesh, f);
        for (const Index w : mesh.face_wedges(f))
            if (touched[w]) sums[w] += area;
    }
    return sums;
}

/// Turns the normals that point against their faces, and the handedness of the tangents there.
void turn_normals(Mesh& mesh, const std::vector<Vec3>& faces) {
    Attribute& normals = *mesh.find("NORMAL", Domain::wedge);
    Attribute* tangents = mesh.find("TANGENT", Domain::wedge);
    parallel_for(mesh.wedge_count(), [&](std::size_t w) {
        const Vec3 n = vector_of(normals, w);
        if (!(dot(n, faces[w]) < 0)) return;
        for (int c = 0; c < 3; ++c) normals.set_value(w, c, -n[static_cast<std::size_t>(c)]);
        if (tangents && tangents->components == 4) tangents->set_value(w, 3, -tangents->value(w, 3));
    });
}

} // namespace

AttributeChanges flip_faces(Mesh& mesh, const std::vector<std::uint8_t>& flags) {
    const bool any = std::find(flags.begin(), flags.end(), std::uint8_t{1}) != flags.end();
    AttributeChanges changes;
    for (const auto& a : mesh.attributes) {
        const bool turns = any && (a.role == Role::normal || a.role == Role::tangent);
        changes.push_back({a.name, a.domain, turns ? AttributeChange::Kind::recomputed : AttributeChange::Kind::kept,
                         turns ? "reversed where it pointed against its faces" : ""});
    }
    if (!any) return changes;
    parallel_for(mesh.face_count(), [&](std::size_t f) {
        if (!flags[f]) return;
        const auto corners = mesh.corners.begin();
        std::reverse(corners + mesh.face_begin(static_cast<Index>(f)) + 1,
                     corners + mesh.face_end(static_cast<Index>(f)));
    });
    const Attribute* normals = mesh.find("NORMAL", Domain::wedge);
    if (normals && normals->components == 3) turn_normals(mesh, faces_at_wedges(mesh, flags));
    return changes;
}

} // namespace facetmill
