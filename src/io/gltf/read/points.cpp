#include "io/gltf/read/points.hpp"

#include "io/attributes.hpp"
#include "io/gltf/read/mesh.hpp"

#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

/// The primitive's material and extras; empty if it has neither.
std::vector<Primitive> primitive_of(const Source& source, const JsonCursor& place) {
    Primitive primitive;
    if (const auto material = place.find("material"))
        primitive.material =
            static_cast<Index>(material->index(count_of(source.json(), "materials"), "material"));
    if (const auto extras = place.find("extras"))
        primitive.json = to_string(Json{{"extras", extras->json()}});
    if (primitive == Primitive{}) return {};
    return {std::move(primitive)};
}

Mesh points_of(Source& source, const JsonCursor& primitive, std::size_t max_vertices) {
    const Accessor positions = accessor(source, primitive.at("attributes").at("POSITION"));
    if (positions.components != 3) positions.place.fail("POSITION must be VEC3");
    if (positions.count > std::min<std::size_t>(max_vertices, none - 1))
        throw Error(ErrorKind::limit, "E-LIMIT",
                    fmt::format("{}: more than {} vertices", primitive.path(), max_vertices));
    source.need(static_cast<double>(sizeof(Vec3) * positions.count));
    std::optional<std::vector<Index>> order;
    if (const auto reference = primitive.find("indices"))
        order = decode_indices(source, *reference, positions.count);
    Mesh mesh;
    const JsonCursor attributes = primitive.at("attributes");
    for (const auto& [name, json] : attributes.json().items()) {
        const Accessor a = accessor(source, JsonCursor(json, attributes.path() + "." + name));
        if (a.count != positions.count)
            a.place.fail(
                fmt::format("{} has {} elements, but POSITION has {}", name, a.count, positions.count));
        Attribute all{name, Domain::wedge, role_of(name), a.components, a.normalised, decode(source, a)};
        if (order) all = selected(all, *order);
        if (name != "POSITION") {
            mesh.attributes.push_back(std::move(all));
            continue;
        }
        for (std::size_t i = 0; i < all.size(); ++i)
            mesh.positions.push_back({all.value(i, 0), all.value(i, 1), all.value(i, 2)});
    }
    mesh.primitives = primitive_of(source, primitive);
    return mesh;
}

} // namespace

std::vector<Part> decode_points(Source& source, const std::vector<NodeFrame>& frames,
                                std::size_t max_vertices) {
    std::vector<Part> parts;
    std::size_t left = max_vertices;
    for (std::size_t n = 0; n < frames.size(); ++n) {
        if (frames[n].mesh < 0) continue;
        const JsonCursor mesh = item(source.json(), "meshes", static_cast<std::size_t>(frames[n].mesh));
        const JsonCursor primitives = mesh.at("primitives");
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            if (!makes_points(primitives.at(i))) continue;
            Part part;
            part.mesh = points_of(source, primitives.at(i), left);
            left -= part.mesh.vertex_count();
            part.name = item(source.json(), "nodes", n).text_or("name", mesh.text_or("name", ""));
            part.transform = frames[n].world;
            if (part.mesh.vertex_count() > 0) parts.push_back(std::move(part));
        }
    }
    return parts;
}

} // namespace facetmill::io::gltf
