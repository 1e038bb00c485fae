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

const RegisterCodec glb{{"glb",
                         "glTF 2.0 in one binary file, with Draco on request",
                         {"glb"},
                         Unit::m,
                         UpAxis::y,
                         sniff_glb,
                         read,
                         [](const Scene& scene, const WriteSettings& s) { return write(scene, s, true); },
                         peek}};

const RegisterCodec gltf{{"gltf",
                          "glTF 2.0 as JSON with a .bin and images beside it",
                          {"gltf"},
                          Unit::m,
                          UpAxis::y,
                          sniff_gltf,
                          read,
                          [](const Scene& scene, const WriteSettings& s) { return write(scene, s, false); },
                          peek}};

} // namespace

} // namespace facetmill::io::gltf
