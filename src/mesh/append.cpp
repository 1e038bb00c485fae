#include "mesh/placement.hpp"
#include "mesh/wedges.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace facetmill {

namespace {

/// An attribute of the same kind for n elements, all zero.
Attribute zeros(const Attribute& like, std::size_t n) {
    Attribute a = like;
    std::visit([](auto& v) { v.clear(); }, a.data);
    a.resize(n);
    return a;
}

/// Makes the attribute for a mesh that lacks it, with neutral values. Colours are white and opaque, normals
/// are the faces' normals, tangents have length 1. Values without a neutral number are NaN if the type
/// allows it; all other values are zero.
Attribute stand_in(const Attribute& like, const Mesh& mesh) {
    Attribute a = zeros(like, mesh.count(like.domain));
    if (a.name == "NORMAL" && a.domain == Domain::wedge && a.components == 3) {
        Mesh alone = bare(mesh);
        alone.attributes.push_back(std::move(a));
        recompute_normals(alone);
        return std::move(alone.attributes[0]);
    }
    if (a.role == Role::colour)
        parallel_for(a.size(), [&](std::size_t i) {
            for (int c = 0; c < a.components; ++c) a.set_value(i, c, 1);
        });
    if (a.role == Role::generic)
        std::visit(
            [](auto& values) {
                using T = typename std::decay_t<decltype(values)>::value_type;
                if constexpr (std::is_floating_point_v<T>)
                    std::fill(values.begin(), values.end(), std::numeric_limits<T>::quiet_NaN());
            },
            a.data);
    if (a.role == Role::tangent)
        parallel_for(a.size(), [&](std::size_t i) {
            a.set_value(i, 0, 1);
            a.set_value(i, 3, 1);
        });
    return a;
}

bool same_layout(const Attribute& a, const Attribute& b) {
    return a.data.index() == b.data.index() && a.components == b.components && a.normalised == b.normalised;
}

/// The attribute as doubles with this many components: the common layout if two attributes differ.
Attribute widened(const Attribute& a, int components) {
    Attribute wide{a.name, a.domain, a.role, components, false, std::vector<double>{}};
    wide.resize(a.size());
    parallel_for(a.size(), [&](std::size_t i) {
        for (int c = 0; c < a.components; ++c) wide.set_value(i, c, a.value(i, c));
    });
    return wide;
}

void concatenate(Attribute& a, const Attribute& b) {
    if (!same_layout(a, b)) {
        const int components = std::max(a.components, b.components);
        a = widened(a, components);
        return concatenate(a, widened(b, components));
    }
    std::visit(
        [&](auto& to) {
            const auto& from = std::get<std::decay_t<decltype(to)>>(b.data);
            to.insert(to.end(), from.begin(), from.end());
        },
        a.data);
}

void append_attributes(Mesh& a, const Mesh& b) {
    for (auto& own : a.attributes) {
        const Attribute* other = b.find(own.name, own.domain);
        concatenate(own, other ? *other : stand_in(own, b));
    }
    for (const auto& other : b.attributes) {
        if (a.find(other.name, other.domain)) continue;
        Attribute own = stand_in(other, a);
        concatenate(own, other);
        a.attributes.push_back(std::move(own));
    }
}

std::vector<std::string> wedge_attribute_names(const Mesh& mesh) {
    std::vector<std::string> names;
    for (const auto& a : mesh.attributes)
        if (a.domain == Domain::wedge) names.push_back(a.name);
    return names;
}

/// Never empty, because empty would mean all attributes: every wedge has a position.
std::vector<std::string> attribute_names(const Mesh& mesh) {
    auto names = wedge_attribute_names(mesh);
    if (names.empty()) names.emplace_back("POSITION");
    return names;
}

/// The table of primitives with every "all attributes" spelled out.
std::vector<Primitive> primitives_of(const Mesh& mesh, bool explicit_names) {
    auto table = mesh.primitives.empty() ? std::vector<Primitive>(1) : mesh.primitives;
    if (explicit_names)
        for (auto& p : table)
            if (p.attributes.empty()) p.attributes = attribute_names(mesh);
    return table;
}

std::vector<std::uint32_t> primitive_indices(const Mesh& mesh) {
    const Attribute* a = mesh.find(primitive_attribute, Domain::face);
    return a ? std::get<std::vector<std::uint32_t>>(a->data)
             : std::vector<std::uint32_t>(mesh.face_count(), 0);
}

Attribute& primitive_indices_for_writing(Mesh& mesh) {
    if (Attribute* a = mesh.find(primitive_attribute, Domain::face)) return *a;
    return mesh.attributes.emplace_back(Attribute{std::string(primitive_attribute), Domain::face, Role::index,
                                                  1, false,
                                                  std::vector<std::uint32_t>(mesh.face_count(), 0)});
}

/// Both tables joined, with equal entries once, and the new indices of b's entries.
struct JoinedPrimitives {
    std::vector<Primitive> table;
    std::vector<Index> of_b;
};

JoinedPrimitives join_primitives(const Mesh& a, const Mesh& b) {
    const bool differ = wedge_attribute_names(a) != wedge_attribute_names(b);
    JoinedPrimitives joined{primitives_of(a, differ), {}};
    for (const auto& p : primitives_of(b, differ)) {
        const auto at = std::find(joined.table.begin(), joined.table.end(), p);
        joined.of_b.push_back(static_cast<Index>(at - joined.table.begin()));
        if (at == joined.table.end()) joined.table.push_back(p);
    }
    return joined;
}

template <class T>
void append_shifted(std::vector<T>& to, const std::vector<T>& from, std::size_t shift) {
    const std::size_t before = to.size();
    to.resize(before + from.size());
    parallel_for(from.size(), [&](std::size_t i) { to[before + i] = from[i] + static_cast<T>(shift); });
}

void append_arrays(Mesh& a, const Mesh& b) {
    const std::size_t vertices = a.vertex_count(), wedges = a.wedge_count(), corners = a.corner_count();
    if (a.has_seams() || b.has_seams()) {
        a.wedge_vertex = explicit_wedges(a);
        append_shifted(a.wedge_vertex, explicit_wedges(b), vertices);
    }
    if (!a.all_triangles() || !b.all_triangles()) {
        a.face_offsets = explicit_offsets(a);
        a.face_offsets.pop_back();
        append_shifted(a.face_offsets, explicit_offsets(b), corners);
    }
    append_shifted(a.corners, b.corners, wedges);
    append_shifted(a.lines, b.lines, wedges);
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
}

/// The primitive of each line of both meshes; empty if all use the first primitive.
std::vector<Index> joined_line_primitives(const Mesh& a, const Mesh& b, const std::vector<Index>& of_b) {
    std::vector<Index> all;
    for (std::size_t l = 0; l < a.line_count(); ++l) all.push_back(a.primitive_of_line(l));
    for (std::size_t l = 0; l < b.line_count(); ++l) {
        const Index p = b.primitive_of_line(l);
        all.push_back(p < of_b.size() ? of_b[p] : 0);
    }
    if (std::all_of(all.begin(), all.end(), [](Index p) { return p == 0; })) all.clear();
    return all;
}

} // namespace

void append(Mesh& a, const Mesh& b) {
    if (&a == &b) return append(a, Mesh(b));
    if (a.positions.empty() && a.corners.empty()) {
        a = b;
        return;
    }
    auto joined = join_primitives(a, b);
    const bool one_plain = joined.table.size() == 1 && joined.table[0] == Primitive{};
    a.line_primitive = joined_line_primitives(a, b, joined.of_b);
    if (!one_plain) {
        auto indices = primitive_indices(a);
        for (const auto p : primitive_indices(b))
            indices.push_back(p < joined.of_b.size() ? joined.of_b[p] : 0);
        append_attributes(a, b);
        append_arrays(a, b);
        primitive_indices_for_writing(a).data = std::move(indices);
    } else {
        append_attributes(a, b);
        append_arrays(a, b);
        a.drop(primitive_attribute, Domain::face); // a table of several equal entries now has a single entry
    }
    a.primitives = one_plain ? std::vector<Primitive>{} : std::move(joined.table);
}

} // namespace facetmill
