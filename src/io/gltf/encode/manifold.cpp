// EXT_mesh_manifold: the primitives of a mesh as one closed surface, with merged seams.
#include "io/gltf/encode/encode.hpp"

#include "parallel/parallel.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

/// True when every directed edge exists once, and so does its opposite: the extension's definition of
/// manifold.
bool is_manifold(const Mesh& mesh) {
    std::vector<std::uint64_t> edges, opposite;
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index k = 0; k < 3; ++k) {
            const std::uint64_t a = mesh.vertex(3 * f + k), b = mesh.vertex(3 * f + (k + 1) % 3);
            if (a == b) return false;
            edges.push_back(a << 32 | b);
            opposite.push_back(b << 32 | a);
        }
    radix_sort(edges, [](std::uint64_t e) { return e; });
    radix_sort(opposite, [](std::uint64_t e) { return e; });
    return edges == opposite && std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

std::size_t add_numbers(Builder& builder, std::size_t view, std::size_t offset, std::size_t count) {
    Json accessor = {{"bufferView", view}};
    if (offset > 0) accessor["byteOffset"] = offset;
    accessor.update({{"componentType", int(uint32)}, {"count", count}, {"type", "SCALAR"}});
    return builder.add_accessor(std::move(accessor));
}

} // namespace

Json manifold_extension(Builder& builder, const Mesh& mesh, const std::vector<Index>& wedges,
                        const std::vector<Index>& indices, std::size_t index_view, const Json& position,
                        Written& written, const std::string& name) {
    if (!is_manifold(mesh)) {
        written.warnings.push_back(
            {Severity::warning,
             "W-MANIFOLD",
             fmt::format("part '{}' is not a closed manifold, so EXT_mesh_manifold is not written", name),
             {},
             "clean: {holes: minimal} closes it"});
        return nullptr;
    }
    // The first written wedge of a vertex represents it.
    std::vector<Index> first(mesh.vertex_count(), none), at, to;
    for (Index i = 0; i < wedges.size(); ++i) {
        Index& v = first[mesh.vertex_of_wedge(wedges[i])];
        if (v == none) v = i;
    }
    for (std::size_t c = 0; c < indices.size(); ++c) {
        const Index v = first[mesh.vertex_of_wedge(wedges[indices[c]])];
        if (v != indices[c]) {
            at.push_back(static_cast<Index>(c));
            to.push_back(v);
        }
    }
    const bool wide = wedges.size() > 65535;
    Json accessor = {{"bufferView", index_view},
                     {"componentType", wide ? int(uint32) : int(uint16)},
                     {"count", indices.size()},
                     {"type", "SCALAR"}};
    Json extension = Json::object();
    if (!at.empty()) {
        Bytes places(4 * at.size()), values(at.size() * (wide ? 4 : 2)), wide_values(4 * at.size());
        std::memcpy(places.data(), at.data(), places.size());
        std::memcpy(wide_values.data(), to.data(), wide_values.size());
        for (std::size_t i = 0; i < to.size(); ++i) {
            const auto narrow = static_cast<std::uint16_t>(to[i]);
            std::memcpy(&values[i * (wide ? 4 : 2)], wide ? static_cast<const void*>(&to[i]) : &narrow,
                        wide ? 4 : 2);
        }
        const std::size_t places_view = builder.add_view(std::move(places));
        const std::size_t values_view = builder.add_view(std::move(values));
        accessor["sparse"] = {{"count", at.size()},
                              {"indices", {{"bufferView", places_view}, {"componentType", int(uint32)}}},
                              {"values", {{"bufferView", values_view}}}};
        extension["mergeIndices"] = add_numbers(builder, places_view, 0, at.size());
        extension["mergeValues"] =
            add_numbers(builder, wide ? values_view : builder.add_view(std::move(wide_values)), 0, at.size());
    }
    extension["manifoldPrimitive"] = {{"indices", builder.add_accessor(std::move(accessor))},
                                      {"mode", 4},
                                      {"attributes", {{"POSITION", position}}}};
    builder.use_extension("EXT_mesh_manifold", false);
    return extension;
}

} // namespace facetmill::io::gltf
