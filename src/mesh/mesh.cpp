#include "mesh/mesh.hpp"

#include "mesh/wedges.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>

namespace facetmill {

std::size_t Mesh::count(Domain domain) const {
    switch (domain) {
    case Domain::vertex:
        return vertex_count();
    case Domain::wedge:
        return wedge_count();
    case Domain::face:
        break;
    }
    return face_count();
}

const Attribute* Mesh::find(std::string_view name, Domain domain) const {
    for (const auto& a : attributes)
        if (a.domain == domain && a.name == name) return &a;
    return nullptr;
}

Attribute* Mesh::find(std::string_view name, Domain domain) {
    return const_cast<Attribute*>(std::as_const(*this).find(name, domain));
}

bool Mesh::drop(std::string_view name, Domain domain) {
    return std::erase_if(attributes,
                         [&](const Attribute& a) { return a.domain == domain && a.name == name; }) > 0;
}

Index Mesh::primitive_of(Index f) const {
    const Attribute* a = find(primitive_attribute, Domain::face);
    const auto* indices = a ? std::get_if<std::vector<std::uint32_t>>(&a->data) : nullptr;
    return indices ? (*indices)[f] : 0;
}

Box box_of(std::span<const Vec3> points) {
    return parallel_reduce(
        points.size(), Box{},
        [&](std::size_t begin, std::size_t end) {
            Box box;
            for (std::size_t i = begin; i < end; ++i) box.add(points[i]);
            return box;
        },
        [](Box a, const Box& b) {
            a.add(b);
            return a;
        });
}

Box Mesh::bounds() const { return box_of(positions); }

void add_face(Mesh& mesh, std::span<const Index> wedges) {
    if (mesh.face_offsets.empty() && wedges.size() != 3) mesh.face_offsets = explicit_offsets(mesh);
    mesh.corners.insert(mesh.corners.end(), wedges.begin(), wedges.end());
    if (!mesh.face_offsets.empty()) mesh.face_offsets.push_back(static_cast<Index>(mesh.corners.size()));
}

void normalise_offsets(Mesh& mesh) {
    for (std::size_t f = 0; f < mesh.face_offsets.size(); ++f)
        if (mesh.face_offsets[f] != 3 * f) return;
    mesh.face_offsets = {};
}

void normalise_wedges(Mesh& mesh) {
    if (mesh.wedge_vertex.size() != mesh.positions.size()) return;
    for (std::size_t w = 0; w < mesh.wedge_vertex.size(); ++w)
        if (mesh.wedge_vertex[w] != w) return;
    mesh.wedge_vertex = {};
}

namespace {

/// The transpose of the inverse of t's linear part, up to a positive factor: it transforms normals.
Transform normal_transform(const Transform& t) {
    const Vec3 x{t.m[0][0], t.m[0][1], t.m[0][2]}, y{t.m[1][0], t.m[1][1], t.m[1][2]},
        z{t.m[2][0], t.m[2][1], t.m[2][2]};
    const double sign = t.determinant() < 0 ? -1 : 1;
    const Vec3 rows[3] = {cross(y, z) * sign, cross(z, x) * sign, cross(x, y) * sign};
    Transform r;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = rows[i][j];
    return r;
}

Vec3 vector_of(const Attribute& a, std::size_t i) { return {a.value(i, 0), a.value(i, 1), a.value(i, 2)}; }

void set_vector(Attribute& a, std::size_t i, const Vec3& v) {
    for (int c = 0; c < 3; ++c) a.set_value(i, c, v[static_cast<std::size_t>(c)]);
}

void apply_to(Attribute& a, const Transform& t, bool mirrors) {
    const Transform normals = normal_transform(t);
    const bool normal = a.role == Role::normal, tangent = a.role == Role::tangent;
    if (a.components < 3 || !(normal || tangent || a.role == Role::morph_vector)) return;
    parallel_for(a.size(), [&](std::size_t i) {
        const Vec3 v = vector_of(a, i), moved = (normal ? normals : t).vector(v);
        set_vector(a, i, normal || tangent ? normalised(moved) : moved);
        if (tangent && mirrors && a.components == 4) a.set_value(i, 3, -a.value(i, 3));
    });
}

} // namespace

void apply(Mesh& mesh, const Transform& t) {
    if (t.identity()) return;
    const bool mirrors = t.determinant() < 0;
    parallel_for(mesh.positions.size(),
                 [&](std::size_t v) { mesh.positions[v] = t.point(mesh.positions[v]); });
    for (auto& a : mesh.attributes) apply_to(a, t, mirrors);
    if (!mirrors) return;
    parallel_for(mesh.face_count(), [&](std::size_t f) {
        Index* const corners = mesh.corners.data();
        std::reverse(corners + mesh.face_begin(static_cast<Index>(f)) + 1,
                     corners + mesh.face_end(static_cast<Index>(f)));
    });
}

} // namespace facetmill
