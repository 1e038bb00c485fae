#include "stages/validate/document_contents.hpp"

#include "base/json.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <span>
#include <utility>

namespace facetmill::validate_stage {

namespace {

using Span = std::span<const std::byte>;

/// Bytes b at i as an unsigned number, the highest first; 0 beyond the end.
std::size_t big_endian(Span b, std::size_t i, std::size_t count) {
    std::size_t value = 0;
    for (std::size_t k = 0; k < count; ++k)
        value = value << 8 | (i + k < b.size() ? std::to_integer<std::size_t>(b[i + k]) : 0);
    return value;
}

/// Width and height of a PNG or JPEG by its header; 0 for others.
std::pair<std::size_t, std::size_t> sides_of(Span b) {
    if (big_endian(b, 0, 4) == 0x89504e47) return {big_endian(b, 16, 4), big_endian(b, 20, 4)};
    if (big_endian(b, 0, 2) != 0xffd8) return {};
    for (std::size_t i = 2; i + 9 < b.size();) { // segments: ff, kind, length
        const std::size_t kind = big_endian(b, i + 1, 1);
        if (big_endian(b, i, 1) != 0xff) return {};
        const bool frame = kind >= 0xc0 && kind <= 0xcf && kind != 0xc4 && kind != 0xc8 && kind != 0xcc;
        if (frame) return {big_endian(b, i + 7, 2), big_endian(b, i + 5, 2)};
        i += 2 + big_endian(b, i + 2, 2);
    }
    return {};
}

DocumentImage image_of(std::string name, Span bytes) {
    const auto [width, height] = sides_of(bytes);
    return {std::move(name), width, height};
}

std::size_t number_at(const Json& j, const char* name) {
    return j.is_object() && j.contains(name) && j[name].is_number_unsigned() ? j[name].get<std::size_t>() : 0;
}

std::string text_at(const Json& j, const char* name) {
    return j.is_object() && j.contains(name) && j[name].is_string() ? j[name].get<std::string>() : "";
}

/// The list of that name; empty when there is none.
Json list_at(const Json& j, const char* name) {
    return j.is_object() && j.contains(name) && j[name].is_array() ? j[name] : Json::array();
}

/// The bytes of an image inside a buffer.
Span bytes_in_buffer(const Document& d, const Json& json, const Json& image) {
    const Json views = list_at(json, "bufferViews");
    const std::size_t v = number_at(image, "bufferView");
    if (v >= views.size()) return {};
    const std::size_t buffer = number_at(views[v], "buffer"), offset = number_at(views[v], "byteOffset"),
                      length = number_at(views[v], "byteLength");
    if (buffer >= d.buffers.size()) return {};
    const Span all(d.buffers[buffer]);
    if (offset > all.size() || length > all.size() - offset) return {};
    return all.subspan(offset, length);
}

void add_images(const Document& d, std::vector<DocumentImage>& images) {
    const Json json = parse_json(d.json, Broken::discarded);
    const Json list = list_at(json, "images");
    std::set<std::string> listed;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string name = text_at(list[i], "name"), uri = text_at(list[i], "uri");
        const auto file = d.files.find(uri);
        const bool inside = list[i].is_object() && list[i].contains("bufferView");
        Span bytes;
        if (inside) bytes = bytes_in_buffer(d, json, list[i]);
        if (!inside && file != d.files.end() && listed.insert(uri).second) bytes = file->second;
        const bool told = !uri.empty() && uri.size() < 200; // no data: uri
        images.push_back(image_of(!name.empty() ? name : told ? uri : fmt::format("image {}", i), bytes));
    }
    for (const auto& [uri, bytes] : d.files)
        if (!listed.contains(uri)) images.push_back(image_of(uri, bytes));
}

} // namespace

std::vector<DocumentImage> images_of(const Scene& scene) {
    std::vector<DocumentImage> images;
    for (const auto& d : scene.documents)
        if (d) add_images(*d, images);
    return images;
}

std::vector<DocumentBytes> bytes_of(const Scene& scene) {
    std::vector<DocumentBytes> all;
    for (const auto& d : scene.documents) {
        if (!d) continue;
        all.push_back({d->name + ": JSON", d->json.size()});
        for (std::size_t i = 0; i < d->buffers.size(); ++i)
            all.push_back({fmt::format("{}: buffer {}", d->name, i), d->buffers[i].size()});
        for (const auto& [uri, bytes] : d->files) all.push_back({uri, bytes.size()});
    }
    return all;
}

std::vector<DocumentExtension> extensions_of(const Scene& scene) {
    std::set<std::pair<std::string, std::string>> used;
    for (const auto& d : scene.documents)
        if (d)
            for (const auto& e : list_at(parse_json(d->json, Broken::discarded), "extensionsUsed"))
                if (e.is_string()) used.emplace(e.get<std::string>(), d->name);
    std::vector<DocumentExtension> all;
    all.reserve(used.size());
    for (const auto& [name, document] : used) all.push_back({name, document});
    return all;
}

} // namespace facetmill::validate_stage
