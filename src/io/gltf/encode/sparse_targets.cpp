// Morph targets that displace few vertices, as sparse accessors (glTF 2.0, section 3.6.2.3).

#include "io/gltf/document/accessor.hpp"
#include "io/gltf/write/patch.hpp"

#include <algorithm>
#include <map>

namespace facetmill::io::gltf {

namespace {

/// The elements of an accessor that are not zero, without gaps between them.
struct Nonzero {
    std::vector<std::uint32_t> places;
    Bytes values;
};

Nonzero nonzero_elements(const AttributeData& data, std::size_t components) {
    Nonzero out;
    std::visit(
        [&](const auto& numbers) {
            const std::size_t size = sizeof(numbers[0]) * components;
            const auto* bytes = reinterpret_cast<const std::byte*>(numbers.data());
            for (std::size_t i = 0; i < numbers.size() / components; ++i) {
                const auto* element = bytes + i * size;
                if (std::all_of(element, element + size, [](std::byte b) { return b == std::byte{0}; }))
                    continue;
                out.places.push_back(static_cast<std::uint32_t>(i));
                out.values.insert(out.values.end(), element, element + size);
            }
        },
        data);
    return out;
}

/// The places in the narrowest type that holds them all.
Bytes narrow(const std::vector<std::uint32_t>& places, std::size_t width) {
    Bytes bytes(places.size() * width);
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t b = 0; b < width; ++b)
            bytes[i * width + b] = static_cast<std::byte>(places[i] >> (8 * b) & 0xff);
    return bytes;
}

/// The sparse form of an accessor; the same accessor if that is not smaller.
std::size_t sparse_of(Builder& builder, std::size_t index) {
    constexpr std::size_t json = 160; // bytes that a sparse accessor adds to the JSON, with its second view
    Json given = builder.json()["accessors"][index];
    if (!given.contains("bufferView") || given.contains("sparse") ||
        builder.current().without_bytes(given["bufferView"].get<std::size_t>()))
        return index;
    const Json reference = index;
    const Accessor a = accessor(builder.current(), JsonCursor(reference, "accessors"));
    const auto components = static_cast<std::size_t>(a.components);
    const Nonzero kept = nonzero_elements(decode(builder.current(), a), components);
    const std::size_t width = a.count <= 256 ? 1 : a.count <= 65536 ? 2 : 4;
    const std::size_t element = size_of(a.component_type) * components, padded = (element + 3) / 4 * 4;
    if (kept.places.empty() || kept.places.size() * (width + element) + json >= a.count * padded)
        return index;
    const int type = width == 1 ? uint8 : width == 2 ? uint16 : uint32;
    const std::size_t places = builder.add_view(narrow(kept.places, width));
    const std::size_t values = builder.add_view(kept.values);
    for (const char* member : {"bufferView", "byteOffset"}) given.erase(member);
    given["sparse"] = {{"count", kept.places.size()},
                       {"indices", {{"bufferView", places}, {"componentType", type}}},
                       {"values", {{"bufferView", values}}}};
    builder.release({{"attributes", {{"dense", index}}}});
    return builder.add_accessor(std::move(given));
}

} // namespace

void store_sparse_targets(Patch& patch, const StoredMeshes&) {
    if (patch.settings.meshopt.on) return; // it stores zeros in almost no bytes
    Json& document = patch.builder.json();
    std::map<std::size_t, std::size_t> stored; // by dense accessor
    for (std::size_t m = 0; m < count_of(document, "meshes"); ++m)
        for (std::size_t p = 0; p < count_of(document["meshes"][m], "primitives"); ++p) {
            const Json targets = document["meshes"][m]["primitives"][p].value("targets", Json::array());
            for (std::size_t t = 0; t < targets.size(); ++t)
                for (const auto& [name, reference] : targets[t].items()) {
                    const auto index = reference.get<std::size_t>();
                    const auto [at, is_new] = stored.try_emplace(index, index);
                    if (is_new) at->second = sparse_of(patch.builder, index);
                    document["meshes"][m]["primitives"][p]["targets"][t][name] = at->second;
                }
        }
}

} // namespace facetmill::io::gltf
