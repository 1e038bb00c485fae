#include "stage/scene_limits.hpp"

#include "base/glob.hpp"
#include "base/json.hpp"
#include "base/numbers.hpp"
#include "stage/assertions.hpp"

#include <algorithm>
#include <set>

namespace facetmill {

namespace {

/// Bytes b at i as an unsigned number, the highest first; 0 beyond the end.
std::size_t big_endian(const std::vector<std::byte>& b, std::size_t i, std::size_t count) {
    std::size_t value = 0;
    for (std::size_t k = 0; k < count; ++k)
        value = value << 8 | (i + k < b.size() ? std::to_integer<std::size_t>(b[i + k]) : 0);
    return value;
}

/// Pixels of a PNG or JPEG by its header; 0 for others.
std::size_t pixels_of(const std::vector<std::byte>& b) {
    if (big_endian(b, 0, 4) == 0x89504e47) return big_endian(b, 16, 4) * big_endian(b, 20, 4);
    if (big_endian(b, 0, 2) != 0xffd8) return 0;
    for (std::size_t i = 2; i + 9 < b.size();) { // segments: ff, kind, length
        const std::size_t kind = big_endian(b, i + 1, 1);
        if (big_endian(b, i, 1) != 0xff) return 0;
        const bool frame = kind >= 0xc0 && kind <= 0xcf && kind != 0xc4 && kind != 0xc8 && kind != 0xcc;
        if (frame) return big_endian(b, i + 5, 2) * big_endian(b, i + 7, 2);
        i += 2 + big_endian(b, i + 2, 2);
    }
    return 0;
}

std::vector<std::byte> slice(const std::vector<std::byte>& b, std::size_t offset, std::size_t length) {
    if (offset > b.size() || length > b.size() - offset) return {};
    return {b.begin() + static_cast<std::ptrdiff_t>(offset),
            b.begin() + static_cast<std::ptrdiff_t>(offset + length)};
}

std::size_t number_at(const Json& j, const char* name) {
    return j.is_object() && j.contains(name) && j[name].is_number_unsigned() ? j[name].get<std::size_t>() : 0;
}

/// The pixels of a document's images, those inside buffers and those beside it.
std::size_t pixels_of(const Document& d) {
    std::size_t sum = 0;
    for (const auto& [uri, bytes] : d.files) sum += pixels_of(bytes);
    const Json json = Json::parse(d.json, nullptr, false);
    if (!json.is_object() || !json.contains("images") || !json["images"].is_array()) return sum;
    for (const auto& image : json["images"]) {
        if (!image.is_object() || !image.contains("bufferView")) continue;
        const std::size_t v = number_at(image, "bufferView");
        if (!json.contains("bufferViews") || v >= json["bufferViews"].size()) continue;
        const Json& view = json["bufferViews"][v];
        const std::size_t buffer = number_at(view, "buffer");
        if (buffer < d.buffers.size())
            sum += pixels_of(
                slice(d.buffers[buffer], number_at(view, "byteOffset"), number_at(view, "byteLength")));
    }
    return sum;
}

std::size_t bytes_of(const Document& d) {
    std::size_t sum = d.json.size();
    for (const auto& b : d.buffers) sum += b.size();
    for (const auto& [uri, bytes] : d.files) sum += bytes.size();
    return sum;
}

template <class Of>
double sum_over(const Scene& scene, Of&& of) {
    double sum = 0;
    for (const auto& d : scene.documents)
        if (d) sum += static_cast<double>(of(*d));
    return sum;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const auto& w : words) text += (text.empty() ? "" : ", ") + w;
    return text;
}

/// Names that none of the patterns matches.
report::Check check_words(const char* name, const std::vector<std::string>& patterns,
                          const std::vector<std::string>& words) {
    report::Check check;
    check.name = name, check.expected = joined(patterns);
    std::vector<std::string> bad;
    for (const auto& w : words)
        if (std::none_of(patterns.begin(), patterns.end(), [&](const auto& p) { return glob_matches(p, w); }))
            bad.push_back(w);
    check.passed = bad.empty();
    check.found = bad.empty() ? "nothing else" : joined(bad);
    return check;
}

std::vector<std::string> extensions_of(const Scene& scene) {
    std::set<std::string> used;
    for (const auto& d : scene.documents) {
        const Json json = d ? Json::parse(d->json, nullptr, false) : Json();
        if (!json.is_object() || !json.contains("extensionsUsed")) continue;
        for (const auto& e : json["extensionsUsed"])
            if (e.is_string()) used.insert(e.get<std::string>());
    }
    return {used.begin(), used.end()};
}

} // namespace

void declare_limits(Declare<SceneLimits>& d) {
    d.option("parts", &SceneLimits::parts, "How many parts ({max: 10}).");
    d.option("materials", &SceneLimits::materials, "How many materials.");
    d.option("bytes", &SceneLimits::documents_bytes,
             "Bytes of the glTF documents as loaded, buffers and images included.")
        .measures(Dimension::bytes);
    d.option("texture_pixels", &SceneLimits::texture_pixels,
             "Pixels of all PNG and JPEG images together (a count).");
    d.option("names", &SceneLimits::names, "Patterns; every part's name has to match one of them.");
    d.option("extensions", &SceneLimits::extensions,
             "Names or patterns of the glTF extensions that may be used.");
}

std::vector<report::Check> check_limits(const SceneLimits& limits, const Scene& scene) {
    std::vector<report::Check> checks;
    const auto number = [&](const char* name, const std::optional<Bound>& bound, double found) {
        if (!bound) return;
        report::Check check;
        check.name = name, check.expected = expectation(*bound), check.found = spelled(found);
        check.passed = holds(*bound, found);
        checks.push_back(std::move(check));
    };
    number("parts", limits.parts, static_cast<double>(scene.parts.size()));
    number("materials", limits.materials, static_cast<double>(scene.materials.size()));
    if (limits.documents_bytes)
        number("bytes", limits.documents_bytes,
               sum_over(scene, [](const Document& d) { return bytes_of(d); }));
    if (limits.texture_pixels)
        number("texture_pixels", limits.texture_pixels,
               sum_over(scene, [](const Document& d) { return pixels_of(d); }));
    if (!limits.names.empty()) {
        std::vector<std::string> names;
        for (const auto& part : scene.parts) names.push_back(part.name);
        checks.push_back(check_words("names", limits.names, names));
    }
    if (!limits.extensions.empty())
        checks.push_back(check_words("extensions", limits.extensions, extensions_of(scene)));
    return checks;
}

} // namespace facetmill
