#include "base/hash.hpp"
#include "base/progress.hpp"
#include "geometry/edit/equal_wedges.hpp"
#include "io/convert.hpp"
#include "io/gltf/document/container.hpp"
#include "io/gltf/gltf.hpp"
#include "io/images/image_files.hpp"
#include "io/tileset/files.hpp"
#include "io/tileset/implicit.hpp"
#include "io/tileset/tileset.hpp"
#include "mesh/transform.hpp"
#include "parallel/memory.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace facetmill::io::tileset {

namespace {

using gltf::JsonCursor;

[[noreturn]] void not_read(const JsonCursor& place, const char* what) {
    place.fail(fmt::format("{} are not read", what), "E-TILESET", "load the files of its tiles one by one");
}

Transform transform_of(const JsonCursor& tile) {
    Transform t;
    const auto matrix = tile.find("transform");
    if (!matrix) return t;
    if (matrix->size() != 16) matrix->fail(fmt::format("expected 16 numbers, found {}", matrix->size()));
    for (std::size_t column = 0; column < 4; ++column)
        for (std::size_t row = 0; row < 3; ++row) t.m[row][column] = matrix->at(4 * column + row).real();
    return t;
}

/// The turn from a content's axes to z up. Tilesets before version 1.0 may state the axis that glTF files
/// have up.
Transform turn_of_contents(const JsonCursor& tileset) {
    const auto asset = tileset.find("asset");
    const std::string axis = asset ? asset->text_or("gltfUpAxis", "Y") : "Y";
    if (axis == "Y" || axis == "y") return turn_up(UpAxis::y, UpAxis::z);
    Transform t;
    if (axis == "Z" || axis == "z") return t;
    if (axis != "X" && axis != "x") asset->at("gltfUpAxis").fail("expected X, Y or Z", "E-TILESET");
    t.m[0][0] = t.m[2][2] = 0;
    t.m[0][2] = -1;
    t.m[2][0] = 1;
    return t;
}

/// A content file of a tile, and its place in the tileset.
struct Content {
    std::string uri, place;
    Transform transform; ///< from the axes of the file
    Input tileset;       ///< that names the file
};

/// The contents shown when every tile is refined, also of tilesets that are contents themselves.
class Contents {
  public:
    explicit Contents(const Input& input) { add_tileset(input, {}); }
    std::vector<Content> all;
    std::vector<Input> others; ///< nested tilesets, and files that list the existing implicit tiles

  private:
    static constexpr std::size_t most_nested = 65536;

    void add_tileset(const Input& input, const Transform& above) {
        constexpr std::size_t deepest = 32;
        if (open_.size() >= deepest || std::find(open_.begin(), open_.end(), input.path()) != open_.end())
            throw Error(
                ErrorKind::malformed, "E-TILESET",
                fmt::format("'{}' is nested in itself, or deeper than {} tilesets", input.name(), deepest));
        open_.push_back(input.path());
        const Json json = gltf::parse_document(as_text(input.bytes()));
        const JsonCursor tileset(json, "");
        if (const auto required = tileset.find("extensionsRequired"); required && required->size() > 0)
            not_read(*required, "tilesets that require extensions");
        const Input* const input_above = std::exchange(input_, &input);
        const Transform turn_above = std::exchange(turn_, turn_of_contents(tileset));
        visit(tileset.at("root"), above, true);
        input_ = input_above;
        turn_ = turn_above;
        open_.pop_back();
    }

    /// The JSON parser limits the nesting.
    void visit(const JsonCursor& tile, const Transform& above, bool replaces) {
        const Transform here = above * transform_of(tile);
        const std::string refine = tile.text_or("refine", replaces ? "REPLACE" : "ADD");
        if (refine != "REPLACE" && refine != "ADD")
            tile.at("refine").fail("expected REPLACE or ADD", "E-TILESET");
        if (tile.find("implicitTiling")) return add_implicit(tile, here, refine == "REPLACE");
        const auto children = tile.find("children");
        if (!children || children->size() == 0 || refine == "ADD") {
            if (const auto content = tile.find("content")) add(*content, here);
            const auto several = tile.find("contents");
            for (std::size_t i = 0; several && i < several->size(); ++i) add(several->at(i), here);
        }
        for (std::size_t i = 0; children && i < children->size(); ++i)
            visit(children->at(i), here, refine == "REPLACE");
    }

    void add(const JsonCursor& content, const Transform& here) {
        const JsonCursor uri = content.at("uri");
        const std::string text = uri.text();
        if (text.substr(0, text.find('?')).ends_with(".json")) {
            if (++nested_ > most_nested)
                throw Error(ErrorKind::limit, "E-LIMIT",
                            fmt::format("'{}' has more than {} nested tilesets", input_->name(), most_nested),
                            "load some of its tiles");
            const Input nested = file_below(*input_, text.substr(0, text.find('?')), uri.path());
            others.push_back(nested);
            return gltf::in_file(nested, [&] { add_tileset(nested, here); });
        }
        all.push_back({text, uri.path(), here * turn_, *input_});
    }

    void add_implicit(const JsonCursor& tile, const Transform& here, bool replaces) {
        ImplicitContents found = read_implicit(tile, replaces, *input_);
        for (std::string& uri : found.uris)
            all.push_back({std::move(uri), tile.path() + ".content", here * turn_, *input_});
        others.insert(others.end(), found.files.begin(), found.files.end());
    }

    std::size_t nested_ = 0;       ///< nested tilesets so far: each may name another twice
    const Input* input_ = nullptr; ///< the tileset being read
    Transform turn_;               ///< turn_of_contents
    std::vector<std::filesystem::path> open_;
};

/// Merges equal materials of several files.
class MaterialsOfTiles {
  public:
    explicit MaterialsOfTiles(Scene& all) : all_(all) {}

    /// Adds the new materials of a tile, and renumbers its primitives.
    void take(Scene& tile) {
        std::vector<Index> number;
        std::optional<int> document;
        MaterialContents contents(tile);
        for (Material& m : tile.materials) {
            const std::string key = m.name + contents.of(m).dump();
            const auto [at, is_new] = known_.emplace(key, static_cast<Index>(all_.materials.size()));
            number.push_back(at->second);
            if (!is_new) continue;
            if (m.document >= 0 && !document) {
                document = static_cast<int>(all_.documents.size());
                all_.documents.push_back(tile.documents[static_cast<std::size_t>(m.document)]);
            }
            if (document) m.document = *document;
            all_.materials.push_back(m);
        }
        for (Part& part : tile.parts)
            for (Primitive& p : part.mesh.primitives)
                if (p.material != none) p.material = number.at(p.material);
    }

  private:
    Scene& all_;
    std::map<std::string, Index> known_;
};

void log_file(const Input& file, ReadLog& log) {
    log.files.push_back({file.path(), file.stored().size(), sha256(file.stored())});
}

Scene read_tile(const Content& content, const ReadSettings& settings, ReadLog& log) {
    const Input file = file_below(content.tileset, content.uri, content.place);
    if (!gltf::is_glb(file.bytes()))
        throw Error(ErrorKind::malformed, "E-TILESET",
                    fmt::format("{}: '{}' is not a GLB, and facetmill reads no other contents of tiles",
                                content.place, content.uri),
                    "load the files one by one");
    ReadSettings inner = settings;
    inner.unit.reset();
    inner.up.reset();
    Scene tile = codec_named("glb")->read(file, inner, log);
    log_file(file, log);
    return tile;
}

} // namespace

std::vector<std::filesystem::path> named_files(const Input& tileset) {
    const Contents contents(tileset);
    std::vector<std::filesystem::path> named;
    for (const Input& file : contents.others) named.push_back(file.path());
    for (const Content& content : contents.all) {
        const auto relative = gltf::decoded_path(content.uri);
        const auto path = relative ? path_below(content.tileset, *relative) : std::nullopt;
        if (path) named.push_back(*path);
    }
    return named;
}

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log) {
    return gltf::in_file(input, [&] {
        const Contents named(input);
        const std::vector<Content>& contents = named.all;
        for (const Input& file : named.others) log_file(file, log);
        Scene scene;
        scene.unit = settings.unit.value_or(Unit::m);
        scene.up = settings.up.value_or(UpAxis::z);
        MaterialsOfTiles materials(scene);
        Part all;
        double bytes = 0;                     // bytes of all files; a file may count more than once
        constexpr double memory_per_byte = 4; // as for other meshes
        ProgressSteps steps(std::vector<double>(contents.size() + 1, 1));
        for (const Content& content : contents) {
            Scene tile = read_tile(content, settings, log);
            bytes += static_cast<double>(log.files.back().bytes);
            require_memory(memory_per_byte * bytes, fmt::format("reading the tiles of '{}'", input.name()),
                           "load some of its tiles, or use a machine with more memory");
            materials.take(tile);
            for (Part& part : tile.parts) {
                apply(part.mesh, content.transform * part.transform);
                append(all.mesh, part.mesh);
            }
            if (all.mesh.wedge_count() > settings.max_vertices)
                throw Error(ErrorKind::limit, "E-LIMIT",
                            fmt::format("its tiles have more than {} vertices", settings.max_vertices));
            steps.next();
        }
        if (all.mesh.face_count() == 0)
            throw Error(ErrorKind::malformed, "E-EMPTY",
                        fmt::format("'{}' has no tile with faces", input.name()));
        if (settings.weld != Weld::off) {
            weld_exact(all.mesh);
            merge_and_drop_wedges(all.mesh);
        }
        scene.parts.push_back(std::move(all));
        return scene;
    });
}

} // namespace facetmill::io::tileset
