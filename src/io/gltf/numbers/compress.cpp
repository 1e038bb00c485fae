#include "io/gltf/numbers/compress.hpp"

#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/builder.hpp"
#include "io/gltf/encode/encode.hpp"
#include "io/gltf/numbers/attribute_stream.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <meshoptimizer.h>
#include <numeric>
#include <set>

namespace facetmill::io::gltf {

namespace {

/// The accessors used as indices, and their kind.
struct IndexUse {
    bool triangles = true;      ///< true if used only for lists of triangles
    bool corners_count = false; ///< true if something refers to corners by index
};

std::map<std::size_t, IndexUse> index_uses(const Json& document) {
    std::map<std::size_t, IndexUse> uses;
    for (std::size_t m = 0; m < count_of(document, "meshes"); ++m) {
        const Json& mesh = document["meshes"][m];
        const Json::json_pointer manifold("/extensions/EXT_mesh_manifold/manifoldPrimitive/indices");
        for (const Json& primitive : mesh["primitives"]) {
            if (!primitive.contains("indices")) continue;
            IndexUse& use = uses[primitive["indices"].get<std::size_t>()];
            use.triangles = use.triangles && primitive.value("mode", 4) == 4;
        }
        if (mesh.contains(manifold)) uses[mesh[manifold].get<std::size_t>()].corners_count = true;
    }
    return uses;
}

/// The users of each view: accessors as data, integers of sparse accessors by their size, and the total.
struct ViewUse {
    std::vector<std::size_t> accessors;
    std::vector<std::size_t> sparse_integers;
    std::size_t references = 0;
};

std::vector<ViewUse> view_uses(const Json& document) {
    std::vector<ViewUse> uses(count_of(document, "bufferViews"));
    for (std::size_t a = 0; a < count_of(document, "accessors"); ++a) {
        const Json& accessor = document["accessors"][a];
        if (accessor.contains("bufferView"))
            uses.at(accessor["bufferView"].get<std::size_t>()).accessors.push_back(a);
        if (!accessor.contains("sparse")) continue;
        const auto integers = [&](const Json& part, int type) {
            if (type == int(uint16) || type == int(uint32))
                uses.at(part["bufferView"].get<std::size_t>()).sparse_integers.push_back(size_of(type));
        };
        const Json& sparse = accessor["sparse"];
        integers(sparse["indices"], sparse["indices"]["componentType"].get<int>());
        if (accessor["type"] == "SCALAR") integers(sparse["values"], accessor["componentType"].get<int>());
    }
    see_view_references(document, [&](const Json& r) { ++uses.at(r.get<std::size_t>()).references; });
    return uses;
}

std::optional<Packing> index_packing(const Json& document, const ViewUse& use, std::size_t bytes,
                                     const std::map<std::size_t, IndexUse>& indices) {
    Packing packing{"TRIANGLES"};
    for (const std::size_t a : use.accessors) {
        const auto found = indices.find(a);
        if (found == indices.end()) return {};
        const Json& accessor = document["accessors"][a];
        const std::size_t size = size_of(accessor["componentType"].get<int>());
        if ((size != 2 && size != 4) || (packing.stride != 0 && packing.stride != size)) return {};
        packing.stride = size;
        const std::size_t triangle = 3 * size;
        if (!found->second.triangles || found->second.corners_count ||
            accessor.value("byteOffset", std::size_t{0}) % triangle != 0)
            packing.mode = "INDICES";
    }
    packing.count = bytes / packing.stride;
    if (bytes % packing.stride != 0) return {};
    if (packing.count % 3 != 0) packing.mode = "INDICES";
    if (packing.mode == "TRIANGLES") packing.kind = fmt::format("indices {}", packing.stride);
    return packing;
}

/// Packs integers without gaps that give the positions of corners in sparse accessors and EXT_mesh_manifold;
/// none if their sizes differ.
std::optional<Packing> integer_packing(const Json& document, const ViewUse& use, std::size_t bytes) {
    Packing packing{"INDICES", "", use.sparse_integers.front()};
    bool same = true;
    for (const std::size_t size : use.sparse_integers) same = same && size == packing.stride;
    for (const std::size_t a : use.accessors) {
        const Json& accessor = document["accessors"][a];
        const int type = accessor["componentType"].get<int>();
        same = same && accessor["type"] == "SCALAR" && (type == int(uint16) || type == int(uint32)) &&
               size_of(type) == packing.stride;
    }
    if (!same || bytes % packing.stride != 0) return {};
    packing.count = bytes / packing.stride;
    return packing;
}

std::optional<Packing> attribute_packing(const Json& document, const Json& view, const ViewUse& use,
                                         const std::string& filter) {
    Packing packing{"ATTRIBUTES", filter, view.value("byteStride", std::size_t{0})};
    std::string type;
    for (const std::size_t a : use.accessors) {
        const Json& accessor = document["accessors"][a];
        const int component = accessor["componentType"].get<int>();
        type = fmt::format("{} {}", component, accessor["type"].get<std::string>());
        const auto components = static_cast<std::size_t>(components_of(accessor["type"].get<std::string>()));
        const std::size_t size = size_of(component) * components;
        if (packing.stride == 0) packing.stride = size;
        if (!view.contains("byteStride") && packing.stride != size) return {};
    }
    const auto bytes = view["byteLength"].get<std::size_t>();
    const bool fits =
        packing.stride > 0 && packing.stride % 4 == 0 && packing.stride <= 256 && bytes % packing.stride == 0;
    if (!fits) return {};
    packing.count = bytes / packing.stride;
    // Vertex data of the same width may be joined regardless of type; other data only with the same type.
    const int target = view.value("target", 0);
    packing.kind =
        fmt::format("{} {} {} {}", target == array_buffer ? "" : type, packing.stride, filter, target);
    return packing;
}

/// Indices of 2 or 4 bytes.
std::vector<unsigned> indices_in(Span bytes, std::size_t size) {
    std::vector<unsigned> indices(bytes.size() / size);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        std::uint16_t narrow = 0;
        if (size == 4)
            std::memcpy(&indices[i], bytes.data() + 4 * i, 4);
        else
            std::memcpy(&narrow, bytes.data() + 2 * i, 2);
        if (size == 2) indices[i] = narrow;
    }
    return indices;
}

/// Sets the library's stream versions, which are global variables, once to values that both extensions
/// support.
void choose_versions() {
    static const bool chosen = [] {
        meshopt_encodeVertexVersion(0);
        meshopt_encodeIndexVersion(1);
        return true;
    }();
    static_cast<void>(chosen);
}

} // namespace

std::vector<std::optional<Packing>> packings(const Json& document,
                                             const std::map<std::size_t, std::string>& filters) {
    const auto uses = view_uses(document);
    const auto indices = index_uses(document);
    std::vector<std::optional<Packing>> all(uses.size());
    for (std::size_t v = 0; v < uses.size(); ++v) {
        const ViewUse& use = uses[v];
        const Json& view = document["bufferViews"][v];
        if (use.references != use.accessors.size() + use.sparse_integers.size()) continue;
        if (!use.sparse_integers.empty()) {
            all[v] = integer_packing(document, use, view["byteLength"].get<std::size_t>());
            continue;
        }
        if (use.accessors.empty()) continue;
        const bool index = std::any_of(use.accessors.begin(), use.accessors.end(),
                                       [&](std::size_t a) { return indices.count(a) > 0; });
        const auto filter = filters.find(v);
        all[v] = index ? index_packing(document, use, view["byteLength"].get<std::size_t>(), indices)
                       : attribute_packing(document, view, use,
                                           filter == filters.end() ? std::string() : filter->second);
    }
    return all;
}

Bytes encode_meshopt(Span bytes, const Packing& packing, int version) {
    if (packing.mode == "ATTRIBUTES" && version == 1)
        return encode_attribute_stream(bytes, packing.count, packing.stride);
    choose_versions();
    Bytes out;
    const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
    const auto into = [&] { return reinterpret_cast<unsigned char*>(out.data()); };
    if (packing.mode == "ATTRIBUTES") {
        out.resize(meshopt_encodeVertexBufferBound(packing.count, packing.stride));
        out.resize(meshopt_encodeVertexBuffer(into(), out.size(), from, packing.count, packing.stride));
        return out;
    }
    const std::vector<unsigned> indices = indices_in(bytes, packing.stride);
    const std::size_t vertices =
        indices.empty() ? 0 : std::size_t{*std::max_element(indices.begin(), indices.end())} + 1;
    if (packing.mode == "TRIANGLES") {
        out.resize(meshopt_encodeIndexBufferBound(indices.size(), vertices));
        out.resize(meshopt_encodeIndexBuffer(into(), out.size(), indices.data(), indices.size()));
    } else {
        out.resize(meshopt_encodeIndexSequenceBound(indices.size(), vertices));
        out.resize(meshopt_encodeIndexSequence(into(), out.size(), indices.data(), indices.size()));
    }
    return out;
}

const Json* compression_of(const Json& view) {
    const auto extensions = view.find("extensions");
    if (extensions == view.end()) return nullptr;
    for (const char* name : meshopt_names)
        if (const auto found = extensions->find(name); found != extensions->end()) return &*found;
    return nullptr;
}

} // namespace facetmill::io::gltf
