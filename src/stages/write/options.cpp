#include "stages/write/options.hpp"

#include "base/text/spelling.hpp"
#include "geometry/inspect/inspect.hpp"
#include "io/other_formats.hpp"
#include "io/packing.hpp"
#include "io/write_options.hpp"
#include "options/mark_at.hpp"
#include "stage/options/convention.hpp"
#include "stage/options/synonyms.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <set>

namespace facetmill::write_stage {

namespace {

using Precision = WriteOptions::Precision;

/// Adds an error for each option that the chosen format does not support but another does.
void refuse_options(const WriteOptions& o, const io::Codec& codec, const Value& given, Problems& problems) {
    using Can = io::Capabilities;
    const auto require = [&](const std::string& name, const std::function<bool(const Can&)>& known) {
        if (known(codec.can)) return;
        std::vector<std::string> formats;
        for (const auto& other : io::codecs())
            if (other.write && known(other.can)) formats.push_back(other.name);
        add_refusal(Refusal{name,
                            fmt::format("'{}' works with {}, not with {}", name, fmt::join(formats, ", "),
                                        codec.name),
                            "remove it"},
                    "write", given, problems);
    };
    if (o.precision == Precision::full) require("precision", &Can::full_precision);
    if (o.normals != NormalKind::keep) require("normals", &Can::normals);
    if (o.origin.kind == OriginOption::Kind::point) require("origin", &Can::transforms);
    if (o.tangents != Tangents::keep)
        require("tangents", [](const Can& can) { return can.honours("quantize"); });
    std::set<std::string> seen;
    for (const auto& other : io::codecs())
        for (const auto& [name, asked] : other.can.options)
            if (asked(o.file) && seen.insert(name).second)
                require(name, [&name = name](const Can& can) { return can.honours(name); });
}

/// Adds an error for options that exclude each other, or that the chosen format does not support.
void verify_options(const WriteOptions& o, const io::Codec& codec, const Value& given, Problems& problems) {
    refuse_options(o, codec, given, problems);
    const bool draco = o.file.draco.on, meshopt = o.file.meshopt.on;
    for (const auto& [name, asked] :
         {std::pair("quantize", o.file.quantize.on), std::pair("meshopt", meshopt),
          std::pair("order", o.file.order != io::TriangleOrder::automatic)})
        if (draco && asked)
            add_refusal(Refusal{name,
                                fmt::format("'{}' and 'draco' exclude each other because Draco compresses "
                                            "the same data in its own way",
                                            name),
                                "remove one of them"},
                        "write", given, problems);
    if (o.file.interleave && (draco || meshopt))
        add_refusal(Refusal{"interleave",
                            fmt::format("'interleave' and '{}' exclude each other because the latter "
                                        "compresses each attribute separately",
                                        draco ? "draco" : "meshopt"),
                            "remove one of them"},
                    "write", given, problems);
    if (o.file.textures == io::Textures::embed && codec.can.honours("textures") && !codec.can.library.empty())
        add_refusal(
            Refusal{"textures",
                    fmt::format("{} cannot contain images: its textures are separate files", codec.name),
                    "use write: {textures: copy}, or write a .glb"},
            "write", given, problems);
    if (o.feature_angle && o.normals != NormalKind::smooth)
        add_refusal(Refusal{"feature_angle", "'feature_angle' needs normals: smooth", "add normals: smooth"},
                    "write", given, problems);
}

bool is_tileset_name(const std::string& path) {
    return path.size() > 5 && lower_case(path).ends_with(".json");
}

/// The file's name without suffix, .gz and .zst.
std::string title_of(const std::filesystem::path& target) {
    return target == "-" ? "mesh" : io::stem_of_neighbours(target);
}

} // namespace

void declare_write(Declare<WriteOptions>& d) {
    d.option("path", &WriteOptions::path,
             "The file to write. Its suffix selects the format. - writes to standard output.")
        .also_called(path_synonyms)
        .primary()
        .required();
    d.option("format", &WriteOptions::format, "The name of the format, if the suffix does not show it.")
        .also_called(format_synonyms);
    d.choice<Unit>("unit", &WriteOptions::unit,
                   unit_choices("auto", "the unit of the format (glTF: metres), otherwise the scene's unit"),
                   "The unit of the numbers in the file.")
        .also_called(property_named("unit")->also_called);
    d.choice<UpAxis>("up", &WriteOptions::up,
                     up_choices("auto", "the axis of the format (glTF: y), otherwise the scene's axis"),
                     "The up axis of the file.")
        .also_called(property_named("up")->also_called);
    d.embed(&WriteOptions::file, io::declare_encoding);
    d.choice<Precision>(
        "precision", &WriteOptions::precision,
        {{"auto", Precision::automatic,
          "single, except for PLY, OBJ and OFF files with coordinates far from the origin. They get full if "
          "float32 would move points by more than a millionth of the scene's diagonal"},
         {"single", Precision::single, "positions are rounded to 32-bit floats"},
         {"full", Precision::full, "positions keep all 64 bits (PLY, OBJ, OFF, 3MF)"}},
        "The precision of positions.");
    d.option(
        "origin", &WriteOptions::origin,
        "The origin of coordinates in glTF and 3MF files. Give a point of the scene, which the nodes of the "
        "parts then refer to. keep preserves the current origins. auto is like keep, but uses a point near "
        "the centre if float32 would move points by more than a millionth of the scene's diagonal.");
    d.option("triangulate", &WriteOptions::triangulate,
             "Writes triangles to PLY, OBJ and OFF, for programs that cannot read larger faces. Other "
             "formats always get triangles. The faces of the scene do not change.");
    d.choice<NormalKind>(
        "normals", &WriteOptions::normals,
        {{"keep", NormalKind::keep,
          "the normals of the scene; without normals, viewers of glTF use flat shading"},
         {"smooth", NormalKind::smooth, "the mean of the face normals around a vertex, weighted by angle"},
         {"flat", NormalKind::flat, "the normals of the faces"},
         {"none", NormalKind::none, "no normals and tangents are written"}},
        "The normals in the file. The normals of the scene do not change.");
    d.option("feature_angle", &WriteOptions::feature_angle,
             "With normals: smooth, keeps edges sharp if the normals of their two faces differ by more than "
             "this angle. By default, no edge is sharp.")
        .above(0);
    d.choice<Tangents>(
        "tangents", &WriteOptions::tangents,
        {{"keep", Tangents::keep, "the tangents of the scene; viewers compute missing tangents"},
         {"missing", Tangents::missing,
          "computes missing tangents with MikkTSpace for materials with a normal map"},
         {"new", Tangents::all, "computes all tangents for materials with a normal map"}},
        "The tangents in a glTF file. The tangents of the scene do not change.");
    for (const auto declare : {io::declare_compression, io::declare_tiles, io::declare_layout})
        d.embed(&WriteOptions::file, declare);
}

namespace {

/// Names the stage that writes such a file, otherwise lists the formats.
std::string hint_of_suffix(const std::string& path, const std::vector<std::string>& names) {
    const std::string suffix = lower_case(std::filesystem::path(path).extension().generic_string());
    if (suffix == ".svg" || suffix == ".dxf")
        return fmt::format("use section: {{path: {}}} to draw a plane section", path);
    if (suffix == ".png") return fmt::format("use render: {{path: {}}} to make an image", path);
    if (std::string hint = io::hint_for_writing(path); !hint.empty()) return hint;
    return fmt::format("give 'format', one of: {}", fmt::join(names, ", "));
}

} // namespace

void verify_write(const WriteOptions& o, const Value& given, Problems& problems) {
    const Value* path = given.is_map() ? given.find("path") : &given;
    const Value* format = given.is_map() ? given.find("format") : nullptr;
    if ((path && path->deferred) || (format && format->deferred)) return;
    const io::Codec* codec = codec_of(o);
    const auto names = io::names_of_writers();
    const Mark& mark = format ? format->mark : path ? path->mark : given.mark;
    if (!codec && format)
        problems.add(mark, "E-FORMAT", fmt::format("format '{}' does not exist", o.format),
                     suggestion(o.format, names));
    else if (!codec)
        problems.add(mark, "E-FORMAT", fmt::format("the suffix of '{}' is unknown", o.path.text),
                     hint_of_suffix(o.path.text, names));
    else if (!codec->write)
        problems.add(mark, "E-FORMAT", fmt::format("{} can be read but not written", codec->name),
                     hint_of_suffix(o.path.text, names));
    else if (codec->can.honours("tiles") && !is_tileset_name(o.path.text))
        problems.add(
            path ? path->mark : mark, "E-FORMAT",
            fmt::format("tiles go to a folder next to a tileset, but '{}' is not the path of a tileset",
                        o.path.text),
            "give a path that ends in .json, such as out/tileset.json");
    else if (!codec->can.companion.empty() && o.path.text == "-")
        problems.add(mark, "E-FORMAT",
                     fmt::format("a {} needs a second file, which standard output cannot hold", codec->name),
                     "use format: glb");
    else
        verify_options(o, *codec, given, problems);
}

const io::Codec* codec_of(const WriteOptions& o) {
    if (!o.format.empty()) return io::codec_named(o.format);
    return o.file.tiles.on ? io::codec_named("3d-tiles") : io::codec_for(o.path.text);
}

io::WriteSettings settings_of(const WriteOptions& o, const io::Codec& codec,
                              const std::filesystem::path& target) {
    io::WriteSettings s = o.file;
    s.directory = target.parent_path();
    s.double_positions = o.precision == Precision::full;
    s.title = title_of(target);
    if (!s.quantize.given) s.quantize.on = s.meshopt.on;
    s.draco.on |= codec.can.always_draco;
    return s;
}

StageFiles files_of_write(const WriteOptions& o) {
    const io::Codec* codec = codec_of(o);
    const std::filesystem::path path = o.path.text;
    StageFiles files{{}, {o.path}};
    if (!codec || o.path.text == "-") return files;
    const auto beside = [&](const std::string& suffix) {
        return PathText{(path.parent_path() / (title_of(path) + suffix)).generic_string()};
    };
    if (!codec->can.companion.empty()) files.outputs.push_back(beside(codec->can.companion));
    if (!codec->can.library.empty()) files.materials = beside(codec->can.library);
    using io::Textures;
    // Embedded images need no file. Only images of unknown kinds are copied then, and a warning lists them.
    const bool embeds = o.file.textures == Textures::embed ||
                        (o.file.textures == Textures::automatic && !codec->can.copies_images);
    if (codec->can.honours("textures") && !embeds)
        files.images = codec->can.honours("tiles") ? beside("/" + path.filename().generic_string()) : o.path;
    if (o.file.textures == Textures::reference)
        files.copies = [](const io::NamedImage& image) { return !image.is_file; };
    return files;
}

} // namespace facetmill::write_stage
