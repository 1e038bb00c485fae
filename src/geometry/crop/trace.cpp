#include "geometry/crop/trace.hpp"

#include <algorithm>

namespace facetmill {

namespace {

void number(Mesh& mesh, Domain domain, std::string_view attribute) {
    std::vector<std::uint32_t> numbers(mesh.count(domain));
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<Index>(i);
    mesh.attributes.push_back({std::string(attribute), domain, Role::index, 1, false, std::move(numbers)});
}

const std::vector<std::uint32_t>& numbers_of(const Mesh& mesh, Domain domain, std::string_view attribute) {
    return std::get<std::vector<std::uint32_t>>(mesh.find(attribute, domain)->data);
}

/// Maps numbers to elements. If elements have equal numbers, the last one is used.
std::vector<Index> inverted(const std::vector<std::uint32_t>& numbers) {
    std::vector<Index> element;
    for (Index i = 0; i < numbers.size(); ++i) {
        if (numbers[i] >= element.size()) element.resize(numbers[i] + std::size_t{1}, none);
        element[numbers[i]] = i;
    }
    return element;
}

} // namespace

void trace(Mesh& mesh, std::string_view attribute) {
    number(mesh, Domain::vertex, attribute);
    number(mesh, Domain::wedge, attribute);
}

void untrace(Mesh& mesh, std::string_view attribute) {
    mesh.drop(attribute, Domain::vertex);
    mesh.drop(attribute, Domain::wedge);
}

Mesh select_faces(const Mesh& mesh, std::span<const Index> faces) {
    Mesh out;
    out.positions = mesh.positions;
    out.wedge_vertex = mesh.wedge_vertex;
    if (!mesh.all_triangles()) out.face_offsets.push_back(0);
    for (const Index f : faces) {
        const auto wedges = mesh.face_wedges(f);
        out.corners.insert(out.corners.end(), wedges.begin(), wedges.end());
        if (!mesh.all_triangles()) out.face_offsets.push_back(static_cast<Index>(out.corners.size()));
    }
    normalise_offsets(out);
    MeshProvenance provenance;
    provenance.vertices.identity = provenance.wedges.identity = true;
    provenance.faces.assign(faces.begin(), faces.end());
    inherit_attributes(out, mesh, provenance);
    drop_unused(out);
    return out;
}

Mesh join_traced(Mesh a, const Mesh& b, std::string_view attribute) {
    const auto vertex_at = inverted(numbers_of(a, Domain::vertex, attribute)),
               wedge_at = inverted(numbers_of(a, Domain::wedge, attribute));
    const auto first_wedge = static_cast<Index>(a.wedge_count());
    const std::size_t first_corner = a.corner_count();
    const auto united_vertex = [&](Index v) {
        const Index n = numbers_of(b, Domain::vertex, attribute)[v];
        const Index at = n < vertex_at.size() ? vertex_at[n] : none;
        return at != none && a.positions[at] == b.positions[v] ? at : none;
    };
    std::vector<Index> vertex(b.vertex_count()), wedge(b.wedge_count(), none);
    for (Index v = 0; v < vertex.size(); ++v) vertex[v] = united_vertex(v);
    for (Index w = 0; w < wedge.size(); ++w) {
        const Index n = numbers_of(b, Domain::wedge, attribute)[w], v = vertex[b.vertex_of_wedge(w)];
        const Index at = n < wedge_at.size() ? wedge_at[n] : none;
        if (v != none && at != none && a.vertex_of_wedge(at) == v) wedge[w] = at;
    }
    append(a, b);
    for (std::size_t c = first_corner; c < a.corner_count(); ++c) {
        Index& w = a.corners[c];
        const Index old = w - first_wedge, v = vertex[b.vertex_of_wedge(old)];
        if (wedge[old] != none)
            w = wedge[old];
        else if (v != none && a.has_seams())
            a.wedge_vertex[w] = v;
    }
    drop_unused(a);
    return a;
}

} // namespace facetmill
