#include "mesh/lines.hpp"

#include "mesh/placement.hpp"

namespace facetmill {

Lines lines_of(const Part& part) {
    const Mesh& mesh = part.mesh;
    Lines lines;
    lines.name = part.name;
    for (const Vec3& p : mesh.positions) lines.points.push_back(in_world(part, p));
    for (std::size_t l = 0; l < mesh.line_count(); ++l) {
        const Index primitive = mesh.primitive_of_line(l);
        lines.segments.push_back(
            {mesh.vertex_of_wedge(mesh.lines[2 * l]), mesh.vertex_of_wedge(mesh.lines[2 * l + 1]),
             primitive < mesh.primitives.size() ? mesh.primitives[primitive].material : none});
    }
    return lines;
}

std::vector<std::uint8_t> marked_ends_of_lines(const Mesh& mesh) {
    std::vector<std::uint8_t> marked(mesh.vertex_count());
    for (const Index w : mesh.lines) marked[mesh.vertex_of_wedge(w)] = 1;
    return marked;
}

Mesh split_lines(Mesh& mesh) {
    Mesh apart;
    apart.positions = mesh.positions;
    apart.wedge_vertex = mesh.wedge_vertex;
    for (const Attribute& a : mesh.attributes)
        if (a.domain != Domain::face) apart.attributes.push_back(a);
    const std::vector<std::uint8_t> of_lines = marked_ends_of_lines(mesh);
    apart.lines = std::move(mesh.lines);
    mesh.lines = {};
    mesh.line_primitive = {};
    drop_unused(mesh, of_lines);
    drop_unused(apart);
    return apart;
}

} // namespace facetmill
