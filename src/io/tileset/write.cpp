#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "geometry/pyramid/pyramid.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/convert.hpp"
#include "io/gltf/container.hpp"
#include "io/gltf/textures.hpp"
#include "io/image_files.hpp"
#include "io/tileset/frame.hpp"
#include "io/tileset/tileset.hpp"
#include "mesh/skin.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <set>

namespace facetmill::io::tileset {

namespace {

Bytes bytes_of(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

AttributeChanges drop_morph_targets(Mesh& mesh) {
    AttributeChanges changes;
    std::erase_if(mesh.attributes, [&](const Attribute& a) {
        if (a.role != Role::morph_vector) return false;
        changes.push_back({a.name, a.domain, AttributeChange::Kind::dropped, "tiles have no morph targets"});
        return true;
    });
    return changes;
}

/// All parts in the world as one mesh of triangles.
Mesh as_one(const Scene& scene, Written& written) {
    Mesh all;
    for (const Part& part : scene.parts) {
        Mesh mesh = part.mesh.all_triangles() ? part.mesh : triangles_of(part.mesh);
        for (auto& changes : {drop_skin(mesh, "tiles have no skins"), drop_morph_targets(mesh)})
            written.changes.insert(written.changes.end(), changes.begin(), changes.end());
        apply(mesh, part.transform);
        append(all, mesh);
    }
    drop_unused(all);
    return all;
}

/// What materials need of a document. What it has beside that is told once (W-MERGED). Images that are among
/// its bytes become files where all tiles are to share them.
std::shared_ptr<const Document> materials_only(const Document& document, bool share, Written& written) {
    Json json = gltf::parse_document(document.json);
    std::vector<std::string> lost;
    for (const char* list : {"animations", "skins", "cameras"})
        if (json.contains(list) && !json[list].empty()) lost.emplace_back(list);
    if (!lost.empty())
        written.warnings.push_back(
            {Severity::warning,
             "W-MERGED",
             fmt::format("of '{}' only the meshes and materials are written, without its {}", document.name,
                         fmt::join(lost, ", ")),
             {},
             "write a .glb to keep them"});
    Document kept{{}, document.buffers, document.files, document.name};
    for (const char* list : {"animations", "skins", "cameras", "scenes", "scene", "nodes", "meshes"})
        json.erase(list);
    const std::vector<Bytes> images = share ? image_bytes(document, json) : std::vector<Bytes>{};
    for (std::size_t i = 0; i < images.size(); ++i) {
        Json& image = json["images"][i];
        const std::string type = media_type(images[i]);
        if (!image.contains("bufferView") || type.empty()) continue;
        const std::string name = fmt::format("image{}.{}", i, type.substr(type.find('/') + 1));
        kept.files[name] = images[i];
        image.erase("bufferView");
        image["uri"] = name;
    }
    kept.json = gltf::to_string(json);
    return std::make_shared<const Document>(std::move(kept));
}

/// A tile on its way to a file: boxes are in the tileset's frame.
struct TileFile {
    Box own, all; ///< around its content; and around that of the tiles below it, too
    std::vector<OutputFile> files;
    std::vector<Diagnostic> warnings;
    std::size_t faces = 0, dropped_faces = 0;
    VertexCacheUse cache;
};

class TilesetWriter {
  public:
    TilesetWriter(const Scene& scene, const WriteSettings& settings) : settings_(settings) {
        const bool share = settings.textures == Textures::automatic || settings.textures == Textures::copy;
        for (const auto& document : scene.documents)
            outline_.documents.push_back(materials_only(*document, share, written_));
        outline_.materials = scene.materials;
        outline_.unit = Unit::m;
        outline_.up = UpAxis::y;
        settings_.title = settings.title.empty() ? "tileset" : settings.title;
        settings_.textures = share ? Textures::copy : settings.textures;
        settings_.directory = settings.directory / settings_.title;
        settings_.whole_positions = settings.draco.on || settings.quantize.on;
        settings_.lattices.clear(); // of the parts, not of the tiles
    }

    Written run(const Scene& scene) {
        ShareOfSteps steps({1, 12, 6});
        Mesh mesh = as_one(scene, written_);
        if (mesh.face_count() == 0)
            throw Error(ErrorKind::stage, "E-EMPTY", "a tileset needs at least one face");
        const double size = mesh.bounds().diagonal();
        if (!(size <= std::numeric_limits<float>::max()))
            throw Error(ErrorKind::stage, "E-RANGE",
                        fmt::format("the scene measures {:.3g}, which float32 cannot hold", size),
                        "bring it near 1 with transform: {scale: ...}, or write PLY with precision: full");
        frame_ = tileset_frame(mesh.positions, settings_);
        put_into_frame(mesh.positions, frame_);
        steps.next();
        tiles_ = make_pyramid(mesh, {settings_.tiles.faces, frame_.step});
        mesh = {};
        steps.next();
        files_.resize(tiles_.size());
        Share::loop_tells();
        parallel_for(
            tiles_.size(), [&](std::size_t t) { encode(t); }, 1);
        for (std::size_t t = tiles_.size(); t-- > 0;) {
            files_[t].all = files_[t].own;
            for (const std::size_t child : tiles_[t].children) files_[t].all.add(files_[child].all);
        }
        finish();
        return std::move(written_);
    }

  private:
    std::string uri_of_tile(std::size_t t) const {
        return fmt::format("{}/r{}.glb", settings_.title, tiles_[t].name);
    }

    /// The tile as a GLB; its mesh is taken.
    void encode(std::size_t t) {
        TileFile& file = files_[t];
        Mesh mesh = std::move(tiles_[t].mesh);
        file.own = mesh.bounds();
        file.faces = mesh.face_count();
        const Vec3 origin = tile_origin(file.own, frame_);
        const double unit = settings_.whole_positions ? frame_.step : 1;
        for (Vec3& p : mesh.positions) p = (p - origin) * (1 / unit);
        const Transform turn = turn_up(UpAxis::z, UpAxis::y);
        apply(mesh, turn);
        Scene scene = outline_;
        Part& part = scene.parts.emplace_back();
        part.name = settings_.title;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            part.transform.m[axis][axis] = unit;
            part.transform.m[axis][3] = turn.point(origin)[axis] + 0.0;
        }
        WriteSettings settings = settings_;
        const auto reach =
            static_cast<std::uint64_t>(settings.whole_positions ? mesh.bounds().longest_side() : 0);
        if (settings.whole_positions)
            settings.part_bits = {std::max(1, static_cast<int>(std::bit_width(reach)))};
        part.mesh = std::move(mesh);
        Written one = codec_named("glb")->write(scene, settings);
        one.files.front().name = uri_of_tile(t);
        for (std::size_t i = 1; i < one.files.size(); ++i)
            one.files[i].name = settings_.title / one.files[i].name;
        file.files = std::move(one.files);
        file.warnings = std::move(one.warnings);
        file.dropped_faces = one.dropped_faces;
        file.cache = one.cache;
        if (t == 0) written_.changes.insert(written_.changes.end(), one.changes.begin(), one.changes.end());
    }

    static Json box_json(const Box& box) {
        const Vec3 c = box.centre(), h = box.extent() * 0.5;
        return {{"box", {c.x, c.y, c.z, h.x, 0.0, 0.0, 0.0, h.y, 0.0, 0.0, 0.0, h.z}}};
    }

    Json tile_json(std::size_t t) const {
        Json json = {{"boundingVolume", box_json(files_[t].all)}, {"geometricError", tiles_[t].error}};
        if (t == 0) json["refine"] = "REPLACE";
        const Vec3& o = frame_.origin;
        if (t == 0 && o != Vec3{})
            json["transform"] = {1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0,
                                 0.0, 0.0, 1.0, 0.0, o.x, o.y, o.z, 1.0};
        json["content"] = {{"uri", uri_of(uri_of_tile(t))}};
        if (files_[t].own.min != files_[t].all.min || files_[t].own.max != files_[t].all.max)
            json["content"]["boundingVolume"] = box_json(files_[t].own);
        for (const std::size_t child : tiles_[t].children) json["children"].push_back(tile_json(child));
        return json;
    }

    void finish() {
        const Json json = {
            {"asset", {{"version", "1.1"}, {"extras", {{"generator", "facetmill " FACETMILL_VERSION}}}}},
            {"geometricError", std::max(files_[0].all.diagonal(), tiles_[0].error)},
            {"root", tile_json(0)}};
        written_.files.push_back({settings_.title + ".json", bytes_of(json.dump(1) + "\n")});
        TilesWritten& told = written_.tiles.emplace();
        told.tiles = tiles_.size();
        told.error = tiles_[0].error;
        std::set<std::filesystem::path> names;
        std::set<std::string> said;
        for (std::size_t t = 0; t < tiles_.size(); ++t) {
            TileFile& file = files_[t];
            told.levels = std::max(told.levels, tiles_[t].name.size() + 1);
            told.largest = std::max(told.largest, file.faces);
            if (tiles_[t].children.empty()) {
                ++told.leaves;
                written_.dropped_faces += file.dropped_faces;
            }
            written_.cache.add(file.cache);
            for (OutputFile& one : file.files)
                if (names.insert(one.name).second) written_.files.push_back(std::move(one));
            for (Diagnostic& warning : file.warnings)
                if (said.insert(warning.message).second) written_.warnings.push_back(std::move(warning));
        }
    }

    WriteSettings settings_;
    Scene outline_; ///< of every tile: materials and documents
    TilesetFrame frame_;
    std::vector<PyramidTile> tiles_;
    std::vector<TileFile> files_;
    Written written_;
};

} // namespace

Written write(const Scene& scene, const WriteSettings& settings) {
    return TilesetWriter(scene, settings).run(scene);
}

} // namespace facetmill::io::tileset
