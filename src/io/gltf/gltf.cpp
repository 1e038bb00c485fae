#include "io/gltf/container.hpp"
#include "io/gltf/read.hpp"
#include "io/gltf/write.hpp"

namespace facetmill::io::gltf {

namespace {

int sniff_glb(Span bytes) { return is_glb(bytes) ? 2 : 0; }

/// An object that names its asset near its beginning or end is glTF; any other object may be.
int sniff_gltf(Span bytes) {
    const std::string_view text = as_text(bytes);
    const auto first = text.find_first_not_of("\xEF\xBB\xBF \t\r\n");
    if (first == std::string_view::npos || text[first] != '{') return 0;
    constexpr std::size_t near = 65536;
    const std::string_view tail = text.substr(text.size() > near ? text.size() - near : 0);
    const bool asset = text.substr(0, near).find("\"asset\"") != std::string_view::npos ||
                       tail.find("\"asset\"") != std::string_view::npos;
    return asset ? 2 : 1;
}

Capabilities abilities(std::string companion) {
    return {.transforms = true,
            .skins = true,
            .mesh_manifold = true,
            .lods = true,
            .draco = Capabilities::Draco::on_request,
            .attributes = "all at vertices, with materials and textures",
            .companion = std::move(companion)};
}

const RegisterCodec glb({
    .name = "glb",
    .about = "glTF 2.0 in one binary file, with Draco on request",
    .extensions = {"glb"},
    .unit = Unit::m,
    .up = UpAxis::y,
    .can = abilities(""),
    .sniff = sniff_glb,
    .read = read,
    .write = [](const Scene& scene, const WriteSettings& s) { return write(scene, s, true); },
    .peek = peek,
});

const RegisterCodec gltf({
    .name = "gltf",
    .about = "glTF 2.0 as JSON with a .bin and images beside it",
    .extensions = {"gltf"},
    .unit = Unit::m,
    .up = UpAxis::y,
    .can = abilities(".bin"),
    .sniff = sniff_gltf,
    .read = read,
    .write = [](const Scene& scene, const WriteSettings& s) { return write(scene, s, false); },
    .peek = peek,
});

} // namespace

} // namespace facetmill::io::gltf
