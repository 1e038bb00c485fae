#include "geometry/inspect/inspect.hpp"
#include "io/gltf/document/container.hpp"
#include "io/tileset/tileset.hpp"
#include "io/write_options.hpp"

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

void declare_tile_settings(Declare<TileSettings>& d) {
    d.choice<TileSettings::Kind>(
         "format", &TileSettings::format,
         {{"3d", TileSettings::Kind::three_d, "3D Tiles 1.1; each tile is a GLB, refined by REPLACE"}},
         "The format of the tiles.")
        .also_called("type file_type filetype output_format")
        .primary();
    d.option("faces", &TileSettings::faces,
             "The maximum number of triangles in a tile. A tile may have more if its borders need them.")
        .also_called(property_named("faces")->also_called)
        .between(100, 10000000);
    d.choice<bool>("tiling", &TileSettings::implicit,
                   {{"explicit", false, "the tileset lists every tile"},
                    {"implicit", true,
                     "tiles are identified by their level and position in a quadtree. Binary files list the "
                     "existing tiles, with boxes and errors. Each file covers a few levels, so viewers read "
                     "only the files that they need"}},
                   "How the tileset refers to its tiles.");
}

std::vector<WriteOption> options() {
    std::vector<WriteOption> all = gltf_mesh_options();
    all.push_back({"tiles", [](const WriteSettings& s) { return s.tiles.on; }});
    return all;
}

const RegisterCodec registered({
    .name = "3d-tiles",
    .about = "3D Tiles 1.1: a tree of tiles in GLB, for viewers that stream",
    .extensions = {"tileset.json"},
    .unit = Unit::m,
    .up = UpAxis::z,
    .can = {.options = options(),
            .attributes = "all at vertices, with materials and textures",
            .copies_images = true},
    .sniff = sniff,
    .read = read,
    .write = write,
    .peek = peek,
});

} // namespace

} // namespace facetmill::io::tileset

void facetmill::io::declare_tiles(Declare<WriteSettings>& d) {
    declare_switched(
        d, "tiles", &WriteSettings::tiles,
        "Writes a tileset. Give 3d, or a map of settings. You can omit it if the path ends in tileset.json.",
        tileset::declare_tile_settings);
}
