#include "base/progress.hpp"
#include "geometry/pyramid/pyramid.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "io/attributes.hpp"
#include "io/gltf/contents/textures.hpp"
#include "io/gltf/document/container.hpp"
#include "io/gltf/gltf.hpp"
#include "io/images/image_files.hpp"
#include "io/tileset/tiles.hpp"
#include "io/tileset/tileset.hpp"
#include "mesh/skin.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace facetmill::io::tileset {

namespace {

AttributeChanges drop_morph_targets(Mesh& mesh) {
    AttributeChanges changes;
    std::erase_if(mesh.attributes, [&](const Attribute& a) {
        if (a.role != Role::morph_vector) return false;
        changes.push_back({a.name, a.domain, AttributeChange::Kind::dropped, "tiles have no morph targets"});
        return true;
    });
    return changes;
}

/// Joins all parts into a single triangle mesh in world space.
Mesh as_one(const Scene& scene, Written& written) {
    Mesh all;
    for (const Part& part : scene.parts) {
        Mesh mesh = part.mesh.all_triangles() ? part.mesh : triangles_of(part.mesh);
        for (auto& changes : {drop_skin(mesh, "tiles have no skins"), drop_morph_targets(mesh)})
            written.changes.insert(written.changes.end(), changes.begin(), changes.end());
        apply(mesh, part.transform);
        move_colours_to_wedges(mesh);
        append(all, mesh);
    }
    drop_unused(all);
    warn_of_nan(zero_nan(all), "a tileset", written.warnings);
    return all;
}

/// The part of a document that materials need. Warns of its other contents (W-MERGED). With `share`,
/// embedded images become files, because all tiles share them.
std::shared_ptr<const Document> materials_only(const Document& document, bool share, Written& written) {
    Json json = gltf::parse_document(document.json);
    const std::vector<std::string> lost = gltf::keep_materials_only(json);
    if (!lost.empty())
        written.warnings.push_back(
            {Severity::warning,
             "W-MERGED",
             fmt::format("only the meshes and materials of '{}' are written, but not its {}", document.name,
                         fmt::join(lost, ", ")),
             {},
             "write a .glb to keep them"});
    Document kept{{}, document.buffers, document.files, document.name};
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

class TilesetWriter {
  public:
    TilesetWriter(const Scene& scene, const WriteSettings& settings)
        : settings_(settings_of_tiles(settings)) {
        for (const auto& document : scene.documents)
            outline_.documents.push_back(
                materials_only(*document, settings_.textures == Textures::copy, written_));
        outline_.materials = scene.materials;
    }

    Written run(const Scene& scene) {
        ProgressSteps steps({1, 12, 6});
        Mesh mesh = as_one(scene, written_);
        if (mesh.face_count() == 0)
            throw Error(ErrorKind::stage, "E-EMPTY", "a tileset needs at least one face");
        const TilesetFrame frame = tileset_frame(mesh.positions, settings_);
        if (auto warning = warning_of_place(frame)) written_.warnings.push_back(std::move(*warning));
        put_into_frame(mesh.positions, frame);
        steps.next();
        std::vector<PyramidTile> pyramid = make_pyramid(mesh, {settings_.tiles.most_faces(), frame.step});
        mesh = {};
        steps.next();
        std::vector<TreeTile> tiles(pyramid.size());
        std::vector<Written> written(pyramid.size());
        ProgressScope::report_next_loop();
        parallel_for(
            tiles.size(),
            [&](std::size_t t) {
                tiles[t] = {pyramid[t].name, pyramid[t].children, pyramid[t].error, {}, {}, 0, 0, {}};
                written[t] = encode_tile(std::move(pyramid[t].mesh), tiles[t], outline_, settings_, frame);
            },
            1);
        finish(summary_of(tiles, frame, settings_), written);
        return std::move(written_);
    }

  private:
    void finish(TilesetSummary summary, std::vector<Written>& tiles) {
        written_.files = std::move(summary.files);
        written_.tiles = summary.told;
        written_.cache = summary.cache;
        written_.dropped_faces = summary.dropped_faces;
        const AttributeChanges& changes = tiles.front().changes;
        written_.changes.insert(written_.changes.end(), changes.begin(), changes.end());
        std::set<std::filesystem::path> names;
        std::set<std::string> said;
        for (Written& tile : tiles) {
            for (OutputFile& one : tile.files)
                if (names.insert(one.name).second) written_.files.push_back(std::move(one));
            for (Diagnostic& warning : tile.warnings)
                if (said.insert(warning.message).second) written_.warnings.push_back(std::move(warning));
        }
    }

    WriteSettings settings_;
    Scene outline_; ///< the materials and documents of every tile
    Written written_;
};

} // namespace

Written write(const Scene& scene, const WriteSettings& settings) {
    const auto thick = thicknesses(scene);
    if (std::all_of(thick.begin(), thick.end(), [](const auto& part) { return part.empty(); }))
        return TilesetWriter(scene, settings).run(scene);
    Scene scaled = scene; // tiles have world coordinates, so the thickness of volumes grows with their parts
    std::vector<LengthGrowth> growth;
    growth.reserve(scene.parts.size());
    for (const Part& part : scene.parts) growth.push_back({length_growth(part.transform), 1});
    scale_material_lengths(scaled, growth);
    return TilesetWriter(scaled, settings).run(scaled);
}

} // namespace facetmill::io::tileset
