#include "io/tileset/tiles.hpp"

#include "base/json.hpp"
#include "facetmill_version.hpp"
#include "io/convert.hpp"
#include "io/images/image_files.hpp"
#include "io/tileset/implicit.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>

namespace facetmill::io::tileset {

namespace {

Json box_json(const Box& box) { return {{"box", numbers_of_box(box)}}; }

Json tile_json(const std::vector<TreeTile>& tiles, std::size_t t, const TilesetFrame& frame,
               const WriteSettings& settings) {
    const TreeTile& tile = tiles[t];
    Json json = {{"boundingVolume", box_json(tile.all)}, {"geometricError", tile.error}};
    if (t == 0) json["refine"] = "REPLACE";
    const Vec3& o = frame.origin;
    if (t == 0 && o != Vec3{})
        json["transform"] = {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, o.x, o.y, o.z, 1.0};
    json["content"] = {{"uri", uri_of(uri_of_tile(settings, tile.name))}};
    if (settings.tiles.implicit) return json;
    if (tile.own.min != tile.all.min || tile.own.max != tile.all.max)
        json["content"]["boundingVolume"] = box_json(tile.own);
    for (const std::size_t child : tile.children)
        json["children"].push_back(tile_json(tiles, child, frame, settings));
    return json;
}

} // namespace

WriteSettings settings_of_tiles(const WriteSettings& settings) {
    WriteSettings own = settings;
    if (own.title.empty()) own.title = "tileset";
    if (own.textures == Textures::automatic) own.textures = Textures::copy;
    own.directory = settings.directory / own.title;
    own.whole_positions = settings.draco.on || settings.quantize.on;
    own.lattices.clear(); // lattices apply to the parts, not to the tiles
    return own;
}

std::string uri_of_tile(const WriteSettings& settings, const std::string& name) {
    return fmt::format("{}/{}.glb", settings.title,
                       settings.tiles.implicit ? implicit_name(name) : "r" + name);
}

std::array<double, 12> numbers_of_box(const Box& box) {
    const Vec3 c = box.centre(), h = box.extent() * 0.5;
    return {c.x, c.y, c.z, h.x, 0, 0, 0, h.y, 0, 0, 0, h.z};
}

Written encode_tile(Mesh mesh, TreeTile& tile, const Scene& outline, const WriteSettings& given,
                    const TilesetFrame& frame) {
    WriteSettings settings = given;
    tile.own = tile.all = mesh.bounds();
    tile.faces = mesh.face_count();
    const Vec3 origin = tile_origin(tile.own, frame);
    const double unit = settings.whole_positions ? frame.step : 1;
    for (Vec3& p : mesh.positions) p = (p - origin) * (1 / unit);
    const Transform turn = turn_up(UpAxis::z, UpAxis::y);
    apply(mesh, turn);
    Scene scene = outline;
    scene.unit = Unit::m;
    scene.up = UpAxis::y;
    Part& part = scene.parts.emplace_back();
    part.name = settings.title;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        part.transform.m[axis][axis] = unit;
        part.transform.m[axis][3] = turn.point(origin)[axis] + 0.0;
    }
    const auto reach =
        static_cast<std::uint64_t>(settings.whole_positions ? mesh.bounds().longest_side() : 0);
    if (settings.whole_positions) settings.part_bits = {std::max(1, static_cast<int>(std::bit_width(reach)))};
    part.mesh = std::move(mesh);
    Written one = codec_named("glb")->write(scene, settings);
    one.files.front().name = uri_of_tile(settings, tile.name);
    for (std::size_t i = 1; i < one.files.size(); ++i) one.files[i].name = settings.title / one.files[i].name;
    tile.dropped_faces = one.dropped_faces;
    tile.cache = one.cache;
    return one;
}

TilesetSummary summary_of(std::vector<TreeTile>& tiles, const TilesetFrame& frame,
                          const WriteSettings& settings) {
    TilesetSummary summary;
    TilesWritten& told = summary.told;
    for (std::size_t t = tiles.size(); t-- > 0;) {
        TreeTile& tile = tiles[t];
        for (const std::size_t child : tile.children) tile.all.add(tiles[child].all);
        told.levels = std::max(told.levels, tile.name.size() + 1);
        told.largest = std::max(told.largest, tile.faces);
        summary.cache.add(tile.cache);
        if (!tile.children.empty()) continue;
        ++told.leaves;
        summary.dropped_faces += tile.dropped_faces;
    }
    told.tiles = tiles.size();
    told.error = tiles[0].error;
    Json json = {{"asset", {{"version", "1.1"}, {"extras", {{"generator", "facetmill " FACETMILL_VERSION}}}}},
                 {"geometricError", std::max(tiles[0].all.diagonal(), tiles[0].error)},
                 {"root", tile_json(tiles, 0, frame, settings)}};
    if (settings.tiles.implicit) {
        add_implicit_tiling(json, tiles, settings.title);
        summary.files = subtree_files(tiles, settings.title);
    }
    summary.files.insert(summary.files.begin(),
                         {settings.title + ".json", bytes_of_text(json.dump(1) + "\n")});
    return summary;
}

} // namespace facetmill::io::tileset
