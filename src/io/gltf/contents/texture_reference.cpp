#include "io/gltf/contents/texture_reference.hpp"

#include "base/math/portable_math.hpp"
#include "io/images/avif.hpp"

#include <algorithm>

namespace facetmill::io::gltf {

namespace {

/// No mesh has 256 sets, so a larger number is clamped to a missing set.
int set_of_number(std::uint64_t number) { return static_cast<int>(std::min<std::uint64_t>(number, 255)); }

/// Stores the specification's product T R S as two rows.
void read_transform(const JsonCursor& moved, Texture& out) {
    std::array<float, 2> offset{0, 0}, scale{1, 1};
    read_numbers_of(moved, "offset", offset);
    read_numbers_of(moved, "scale", scale);
    const auto turned = moved.find("rotation");
    const double angle = turned ? turned->real() : 0;
    const double c = cosine(angle), s = sine(angle), sx = scale[0], sy = scale[1];
    out.transform = {c * sx, s * sy, offset[0], -s * sx, c * sy, offset[1]};
    out.set = set_of_number(moved.natural_or("texCoord", static_cast<std::uint64_t>(out.set)));
}

void read_sampler(const JsonCursor& sampler, Texture& out) {
    constexpr std::uint64_t nearest = 9728, repeat = 10497, clamp = 33071, mirror = 33648;
    const auto wrap = [&](const char* key) {
        const std::uint64_t value = sampler.natural_or(key, repeat);
        return value == clamp    ? TextureWrap::clamp
               : value == mirror ? TextureWrap::mirror
                                 : TextureWrap::repeat;
    };
    out.wrap_u = wrap("wrapS");
    out.wrap_v = wrap("wrapT");
    out.nearest = sampler.natural_or("magFilter", 0) == nearest;
}

JsonCursor texture_at(const Json& document, const JsonCursor& info) {
    return item(document, "textures", info.at("index").index(count_of(document, "textures"), "texture"));
}

} // namespace

std::optional<JsonCursor> extension_of(const JsonCursor& owner, const char* name) {
    const auto all = owner.find("extensions");
    return all ? all->find(name) : std::nullopt;
}

Texture sampling_of(const Json& document, const JsonCursor& info) {
    Texture out;
    out.set = set_of_number(info.natural_or("texCoord", 0));
    if (const auto moved = extension_of(info, "KHR_texture_transform")) read_transform(*moved, out);
    const JsonCursor place = texture_at(document, info);
    if (const auto sampler = place.find("sampler"))
        read_sampler(item(document, "samplers", sampler->index(count_of(document, "samplers"), "sampler")),
                     out);
    return out;
}

std::optional<std::size_t> image_of(const Json& document, const JsonCursor& info) {
    const JsonCursor place = texture_at(document, info);
    auto image = place.find("source");
    if (const auto webp = extension_of(place, "EXT_texture_webp")) image = webp->find("source");
    if (const auto avif = extension_of(place, "EXT_texture_avif"); avif && (has_avif() || !image))
        image = avif->find("source");
    if (!image) return {};
    return image->index(count_of(document, "images"), "image");
}

} // namespace facetmill::io::gltf
