#include "io/gltf/document/container.hpp"
#include "io/tileset/tileset.hpp"

namespace facetmill::io::tileset {

namespace {

int sniff(Span bytes) { return gltf::is_tileset(as_text(bytes)) ? 2 : 0; }

/// Lists the neighbouring tiles.
void peek(const Input& input, FileHeader& header) {
    gltf::in_file(input, [&] {
        const auto named = named_files(input);
        header.files.insert(header.files.end(), named.begin(), named.end());
    });
    header.has_materials = [] { return true; };
}

const RegisterCodec registered({
    .name = "3d-tiles",
    .about = "3D Tiles 1.1: a tree of tiles in GLB, for viewers that stream",
    .extensions = {"tileset.json"},
    .unit = Unit::m,
    .up = UpAxis::z,
    .can = {.textures = true,
            .quantize = true,
            .meshopt = true,
            .order = true,
            .tiles = true,
            .draco = Capabilities::Draco::on_request,
            .attributes = "all at vertices, with materials and textures",
            .copies_images = true},
    .sniff = sniff,
    .read = read,
    .write = write,
    .peek = peek,
});

} // namespace

} // namespace facetmill::io::tileset
