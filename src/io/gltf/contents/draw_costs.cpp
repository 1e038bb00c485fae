#include "io/gltf/contents/draw_costs.hpp"

#include "base/json.hpp"
#include "io/gltf/document/container.hpp"
#include "io/images/pixels.hpp"

#include <algorithm>
#include <optional>

namespace facetmill::io {

namespace {

/// The items of an optional list.
const Json& list_of(const Json& object, const char* list) {
    static const Json nothing = Json::array();
    if (!object.is_object()) return nothing;
    const auto found = object.find(list);
    return found != object.end() && found->is_array() ? *found : nothing;
}

std::optional<std::size_t> number_of(const Json& object, const char* name) {
    if (!object.is_object()) return {};
    const auto found = object.find(name);
    if (found == object.end() || !found->is_number_unsigned()) return {};
    return found->get<std::size_t>();
}

/// Each primitive of a node's mesh is a draw call; the instances of a node share it.
std::uint64_t draw_calls_in(const Json& document) {
    const Json& meshes = list_of(document, "meshes");
    std::uint64_t calls = 0;
    for (const Json& node : list_of(document, "nodes"))
        if (const auto mesh = number_of(node, "mesh"); mesh && *mesh < meshes.size())
            calls += list_of(meshes[*mesh], "primitives").size();
    return calls;
}

std::uint64_t pixels_of(Span image) {
    const auto size = image_size(image);
    return size ? std::uint64_t{size->first} * size->second : 0;
}

/// The pixels of the images in the file's own buffer, and in data URIs.
std::uint64_t pixels_in(const Json& document, Span buffer) {
    const Json& views = list_of(document, "bufferViews");
    std::uint64_t pixels = 0;
    for (const Json& image : list_of(document, "images")) {
        const auto uri = image.is_object() ? image.find("uri") : image.end();
        if (image.is_object() && uri != image.end() && uri->is_string()) {
            const auto& text = uri->get_ref<const std::string&>();
            if (gltf::is_data_uri(text)) pixels += pixels_of(gltf::data_uri_bytes(text));
            continue;
        }
        const auto i = number_of(image, "bufferView");
        if (!i || *i >= views.size() || number_of(views[*i], "buffer").value_or(0) != 0) continue;
        const std::size_t begin = std::min(number_of(views[*i], "byteOffset").value_or(0), buffer.size());
        const std::size_t count =
            std::min(number_of(views[*i], "byteLength").value_or(0), buffer.size() - begin);
        pixels += pixels_of(buffer.subspan(begin, count));
    }
    return pixels;
}

DrawCosts costs_of(std::string_view json, Span buffer) {
    const Json document = parse_json(json, Broken::discarded);
    return {draw_calls_in(document), pixels_in(document, buffer)};
}

} // namespace

DrawCosts draw_costs(const std::string& name, Span bytes) {
    try {
        if (gltf::is_glb(bytes)) {
            const auto chunks = gltf::split_glb(bytes);
            return costs_of(chunks.json, chunks.binary.value_or(Span{}));
        }
        if (name.ends_with(".gltf")) return costs_of(as_text(bytes), {});
    } catch (const Error&) { // the file's reader reports its faults
    }
    return {0, pixels_of(bytes)};
}

} // namespace facetmill::io
