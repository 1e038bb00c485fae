#include "io/gltf/contents/byte_kinds.hpp"

#include "base/json.hpp"
#include "io/gltf/document/container.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

namespace facetmill::io {

namespace {

using namespace gltf;

/// The items of an optional list.
const Json& listed(const Json& document, const char* list) {
    static const Json nothing = Json::array();
    const auto found = document.is_object() ? document.find(list) : document.end();
    return document.is_object() && found != document.end() && found->is_array() ? *found : nothing;
}

/// The number of characters in the list's data URIs.
std::uint64_t embedded(const Json& document, const char* list) {
    std::uint64_t bytes = 0;
    for (const Json& item : listed(document, list))
        if (item.is_object() && item.contains("uri") && item["uri"].is_string() &&
            is_data_uri(item["uri"].get_ref<const std::string&>()))
            bytes += item["uri"].get_ref<const std::string&>().size();
    return bytes;
}

/// The bytes of the views that contain images, each view once.
std::uint64_t image_views(const Json& document) {
    const Json& views = listed(document, "bufferViews");
    std::set<std::size_t> of_images;
    for (const Json& image : listed(document, "images"))
        if (image.is_object() && image.contains("bufferView") && image["bufferView"].is_number_unsigned())
            of_images.insert(image["bufferView"].get<std::size_t>());
    std::uint64_t bytes = 0;
    for (const std::size_t i : of_images)
        if (i < views.size() && views[i].is_object() && views[i].contains("byteLength") &&
            views[i]["byteLength"].is_number_unsigned())
            bytes += views[i]["byteLength"].get<std::uint64_t>();
    return bytes;
}

ByteKinds of_document(std::string_view text, std::uint64_t size, bool has_own_buffer) {
    // A fast test: a document with images or data URIs contains these words, or escapes.
    const auto has = [&](std::string_view word) { return text.find(word) != std::string_view::npos; };
    const bool asked = has("\"images\"") || has("\"data:") || has("\\");
    const Json document = asked ? parse_json(text, Broken::discarded) : Json();
    const std::uint64_t images = embedded(document, "images"), buffers = embedded(document, "buffers");
    ByteKinds kinds;
    kinds.textures = std::min(size, images + (has_own_buffer ? image_views(document) : 0));
    kinds.json =
        std::min(size - kinds.textures, text.size() - std::min<std::uint64_t>(text.size(), images + buffers));
    kinds.geometry = size - kinds.textures - kinds.json;
    return kinds;
}

ByteKinds by_name(const std::string& name, std::uint64_t size) {
    std::string suffix = std::filesystem::path(name).extension().generic_string();
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    static constexpr std::array pictures{".png",  ".jpg",   ".jpeg", ".webp", ".avif",
                                         ".ktx2", ".basis", ".dds",  ".tga",  ".bmp"};
    if (std::find(pictures.begin(), pictures.end(), suffix) != pictures.end()) return {0, size, 0};
    return suffix == ".mtl" || suffix == ".json" ? ByteKinds{0, 0, size} : ByteKinds{size, 0, 0};
}

} // namespace

ByteKinds byte_kinds(const std::string& name, std::uint64_t size, Span bytes) {
    try {
        if (is_glb(bytes)) return of_document(split_glb(bytes).json, size, true);
        if (name.ends_with(".gltf") && !bytes.empty()) return of_document(as_text(bytes), size, false);
    } catch (const Error&) { // the file's reader reports its faults
    }
    return by_name(name, size);
}

} // namespace facetmill::io
