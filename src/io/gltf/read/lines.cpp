#include "io/gltf/read/lines.hpp"

#include <fmt/format.h>
#include <optional>

namespace facetmill::io::gltf {

namespace {

/// Appends the lines of a primitive in world space.
void add_lines(Source& source, const JsonCursor& primitive, const Transform& world, std::size_t max_vertices,
               Lines& lines) {
    const Accessor positions = accessor(source, primitive.at("attributes").at("POSITION"));
    if (positions.components != 3) positions.place.fail("POSITION must be VEC3");
    if (positions.count > max_vertices - std::min(max_vertices, lines.points.size()))
        throw Error(ErrorKind::limit, "E-LIMIT",
                    fmt::format("{}: more than {} vertices", primitive.path(), max_vertices));
    const Attribute values{"POSITION", Domain::vertex,       Role::generic,
                           3,          positions.normalised, decode(source, positions)};
    std::vector<Index> order;
    if (const auto reference = primitive.find("indices"))
        order = decode_indices(source, *reference, positions.count);
    else
        for (Index i = 0; i < positions.count; ++i) order.push_back(i);
    Index material = none;
    if (const auto place = primitive.find("material"))
        material = static_cast<Index>(place->index(count_of(source.json(), "materials"), "material"));
    source.need(static_cast<double>(sizeof(Vec3) * positions.count + sizeof(Lines::Segment) * order.size()));
    const std::vector<Index> ends = ends_of_lines(order, primitive.natural_or("mode", 4));
    const auto base = static_cast<Index>(lines.points.size());
    for (std::size_t i = 0; i < positions.count; ++i) {
        const Vec3 p = world.point({values.value(i, 0), values.value(i, 1), values.value(i, 2)});
        if (!is_finite(p)) positions.place.fail(fmt::format("point {} of a line is not finite", i), "E-NAN");
        lines.points.push_back(p);
    }
    for (std::size_t i = 0; i < ends.size(); i += 2)
        lines.segments.push_back({base + ends[i], base + ends[i + 1], material});
}

} // namespace

std::vector<Index> ends_of_lines(const std::vector<Index>& indices, std::uint64_t mode) {
    enum Mode : std::uint64_t { list = 1, loop = 2 };
    std::vector<Index> ends;
    for (std::size_t i = 0; i + 1 < indices.size(); i += mode == list ? 2 : 1)
        ends.insert(ends.end(), {indices[i], indices[i + 1]});
    if (mode == loop && indices.size() > 1) ends.insert(ends.end(), {indices.back(), indices.front()});
    return ends;
}

std::vector<Lines> decode_lines(Source& source, const std::vector<NodeFrame>& frames,
                                std::size_t max_vertices) {
    std::vector<Lines> all;
    std::size_t left = std::min<std::size_t>(max_vertices, none - 1);
    for (std::size_t n = 0; n < frames.size(); ++n) {
        if (frames[n].mesh < 0) continue;
        const JsonCursor mesh = item(source.json(), "meshes", static_cast<std::size_t>(frames[n].mesh));
        if (!has_triangles(mesh)) continue;
        const JsonCursor primitives = mesh.at("primitives");
        Lines lines;
        for (std::size_t i = 0; i < primitives.size(); ++i)
            if (makes_lines(primitives.at(i)))
                add_lines(source, primitives.at(i), frames[n].world, left, lines);
        if (lines.segments.empty()) continue;
        lines.name = item(source.json(), "nodes", n).text_or("name", mesh.text_or("name", ""));
        left -= lines.points.size();
        all.push_back(std::move(lines));
    }
    return all;
}

} // namespace facetmill::io::gltf
