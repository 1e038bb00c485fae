#include "stages/write/options.hpp"

#include "base/text/spelling.hpp"
#include "geometry/inspect/inspect.hpp"
#include "io/other_formats.hpp"
#include "io/packing.hpp"
#include "options/mark_at.hpp"
#include "stage/options/convention.hpp"
#include "stage/options/synonyms.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace facetmill::write_stage {

namespace {

using Precision = WriteOptions::Precision;

template <class Options>
void declare_grid(Declare<Options>& d) {
    d.template choice<Grid>(
        "grid", &Options::grid,
        {{"scene", Grid::scene,
          "steps are at most the scene's longest side divided by 2^bits - 1; a small mesh gets fewer bits, "
          "but at least 10"},
         {"mesh", Grid::mesh, "each mesh uses all bits for its own longest side"},
         {"even", Grid::even,
          "all meshes use the same steps, derived from the scene's longest side. Steps are finer only where "
          "vertices would coincide. Parts that meet stay in contact, and parts that are not rotated share "
          "one grid. Animated meshes use scene"}},
        "The length that is divided into 2^bits - 1 steps.");
}

void declare_draco(Declare<DracoOptions>& d) {
    d.option("position_bits", &DracoOptions::position_bits,
             "Bits of each coordinate. The longest side is divided into 2^bits - 1 steps. Default: 14, and "
             "up to 24 where vertices would coincide. If 24 bits are too few, 14 are used.")
        .between(1, 30);
    declare_grid(d);
    d.option("normal_bits", &DracoOptions::normal_bits, "Bits of normals.").between(1, 30);
    d.option("uv_bits", &DracoOptions::uv_bits, "Bits of texture coordinates.").between(1, 30);
    d.option("colour_bits", &DracoOptions::colour_bits, "Bits of colours.").between(1, 30);
    d.option("generic_bits", &DracoOptions::generic_bits, "Bits of all other attributes.").between(1, 30);
    d.option("speed", &DracoOptions::speed, "0 gives the smallest file, 10 the fastest compression.")
        .between(0, 10);
    d.choice<DracoOptions::Degenerate>(
         "degenerate_faces", &DracoOptions::degenerate_faces,
         {{"drop", DracoOptions::Degenerate::drop, "remove these faces, with a warning"},
          {"keep", DracoOptions::Degenerate::keep,
           "store them in a separate primitive, with weaker compression"}},
         "How to handle faces that use a vertex twice. Draco's compression cannot represent such faces.")
        .also_called(property_named("degenerate_faces")->also_called);
    d.shorthand(ShortForm::truth, "true or false", {{"type", "boolean"}},
                [](const Value& v, DracoOptions& out, Problems& problems) {
                    return OptionType<bool>::parse(v, out.on, problems);
                });
}

void declare_quantize(Declare<QuantizeOptions>& d) {
    d.option("position", &QuantizeOptions::position,
             "Bits of each coordinate. The longest side is divided into 2^bits - 1 steps. Default: 14, and "
             "up to 16 where vertices would coincide. If 16 bits are too few, 14 are used.")
        .between(1, 16);
    declare_grid(d);
    d.option("normal", &QuantizeOptions::normal, "Bits of each component of normals and tangents.")
        .between(2, 16);
    d.option("uv", &QuantizeOptions::uv,
             "Bits of texture coordinates. With meshopt's filters, coordinates are multiples of 2^-uv in "
             "float32. Otherwise, coordinates beyond [-1, 1] stay float32.")
        .between(1, 16);
    d.option("colour", &QuantizeOptions::colour, "Bits of each colour channel.").between(1, 16);
    d.option("weights", &QuantizeOptions::weights,
             "8 stores joint weights as bytes. More bits store them as 16-bit numbers.")
        .between(8, 16);
    d.shorthand(ShortForm::truth, "true or false", {{"type", "boolean"}},
                [](const Value& v, QuantizeOptions& out, Problems& problems) {
                    return OptionType<bool>::parse(v, out.on, problems);
                });
}

void declare_meshopt(Declare<MeshoptOptions>& d) {
    using Extension = io::MeshoptSettings::Extension;
    d.choice<Extension>("extension", &MeshoptOptions::extension,
                        {{"EXT", Extension::ext, "EXT_meshopt_compression, supported by readers since 2020"},
                         {"KHR", Extension::khr,
                          "KHR_meshopt_compression with version 1 streams: smaller files for newer readers"}},
                        "The glTF extension for the compressed data.");
    d.option("filters", &MeshoptOptions::filters,
             "Rounds values before compression. Normals and tangents become octahedral, and rotations of "
             "animations and instances get 16 bits. Other float32 values become multiples of a power of two. "
             "Positions use the bits of quantize. Translations, scales and morph weights stay within 2^-16 "
             "of their extent, positions of instances within a quarter of a grid step. Without filters, "
             "values are compressed unchanged.");
    d.shorthand(ShortForm::truth, "true or false", {{"type", "boolean"}},
                [](const Value& v, MeshoptOptions& out, Problems& problems) {
                    return OptionType<bool>::parse(v, out.on, problems);
                });
}

void declare_tiles(Declare<TilesOptions>& d) {
    d.choice<TilesOptions::Kind>(
         "format", &TilesOptions::format,
         {{"3d", TilesOptions::Kind::three_d, "3D Tiles 1.1; each tile is a GLB, refined by REPLACE"}},
         "The format of the tiles.")
        .also_called(format_synonyms)
        .primary();
    d.option("faces", &TilesOptions::faces,
             "The maximum number of triangles in a tile. A tile may have more if its borders need them.")
        .also_called(property_named("faces")->also_called)
        .between(100, 10000000);
    d.choice<bool>(
        "tiling", &TilesOptions::implicit,
        {{"explicit", false, "the tileset lists every tile"},
         {"implicit", true,
          "tiles are identified by their level and position in a quadtree. Binary files list the existing "
          "tiles of a few levels each, with boxes and errors. Viewers need not read the whole list"}},
        "How the tileset refers to its tiles.");
}

/// An option that only some formats support, and whether its value has an effect.
struct FormatOption {
    const char* name;
    bool asked;
    std::function<bool(const io::Capabilities&)> known;
};

std::vector<FormatOption> format_options(const WriteOptions& o) {
    using Can = io::Capabilities;
    return {{"ascii", o.ascii, &Can::text},
            {"big_endian", o.big_endian, &Can::big_endian},
            {"precision", o.precision == Precision::full, &Can::full_precision},
            {"draco", o.draco && o.draco->on, [](const Can& can) { return can.draco != Can::Draco::never; }},
            {"quantize", o.quantize && o.quantize->on, &Can::quantize},
            {"meshopt", o.meshopt && o.meshopt->on, &Can::meshopt},
            {"order", o.order != io::TriangleOrder::automatic, &Can::order},
            {"tiles", o.tiles.has_value(), &Can::tiles},
            {"mesh_manifold", o.mesh_manifold, &Can::mesh_manifold},
            {"lods", o.lods, &Can::lods},
            {"drop_names", o.drop_names, &Can::lods},
            {"interleave", o.interleave, &Can::quantize},
            {"textures", o.textures != io::Textures::automatic, &Can::textures},
            {"normals", o.normals != NormalKind::keep, &Can::normals},
            {"origin", o.origin.kind == OriginOption::Kind::point, &Can::transforms},
            {"tangents", o.tangents != Tangents::keep, &Can::quantize}};
}

/// Adds an error for options that the chosen format does not support but another does.
void verify_options(const WriteOptions& o, const io::Codec& codec, const Value& given, Problems& problems) {
    for (const auto& [name, asked, known] : format_options(o)) {
        if (!asked || known(codec.can)) continue;
        std::vector<std::string> formats;
        for (const auto& other : io::codecs())
            if (other.write && known(other.can)) formats.push_back(other.name);
        add_refusal(Refusal{name,
                            fmt::format("'{}' works with {}, not with {}", name, fmt::join(formats, ", "),
                                        codec.name),
                            "remove it"},
                    "write", given, problems);
    }
    const bool draco = o.draco && o.draco->on;
    for (const auto& [name, asked] : {std::pair("quantize", o.quantize && o.quantize->on),
                                      std::pair("meshopt", o.meshopt && o.meshopt->on),
                                      std::pair("order", o.order != io::TriangleOrder::automatic)})
        if (draco && asked)
            add_refusal(Refusal{name,
                                fmt::format("'{}' and 'draco' exclude each other because Draco compresses "
                                            "the same data in its own way",
                                            name),
                                "remove one of them"},
                        "write", given, problems);
    if (const bool meshopt = o.meshopt && o.meshopt->on; o.interleave && (draco || meshopt))
        add_refusal(Refusal{"interleave",
                            fmt::format("'interleave' and '{}' exclude each other because the latter "
                                        "compresses each attribute separately",
                                        draco ? "draco" : "meshopt"),
                            "remove one of them"},
                    "write", given, problems);
    if (o.textures == io::Textures::embed && codec.can.textures && !codec.can.library.empty())
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
    d.option("ascii", &WriteOptions::ascii, "Writes PLY and STL as text instead of binary.")
        .also_called("binary", "(ascii: false), which is the default");
    d.option("big_endian", &WriteOptions::big_endian,
             "Writes binary PLY with the most significant byte first.");
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
    d.group("draco", &WriteOptions::draco,
            "Writes glTF with KHR_draco_mesh_compression. Give true, or a map of settings.", declare_draco)
        .also_called("compress compression use_draco compressed");
    d.group("quantize", &WriteOptions::quantize,
            "Writes glTF with KHR_mesh_quantization, which stores attributes as small integers. Give true, "
            "or the numbers of bits. meshopt also quantises, unless this is false.",
            declare_quantize);
    d.group("meshopt", &WriteOptions::meshopt,
            "Writes glTF with EXT_meshopt_compression. Give true, or a map of settings.", declare_meshopt);
    d.group(
        "tiles", &WriteOptions::tiles,
        "Writes a tileset. Give 3d, or a map of settings. You can omit it if the path ends in tileset.json.",
        declare_tiles);
    d.choice<io::TriangleOrder>(
        "order", &WriteOptions::order,
        {{"auto", io::TriangleOrder::automatic,
          "size with meshopt, otherwise draw; an unchanged mesh from a glTF file keeps its order"},
         {"keep", io::TriangleOrder::keep, "the order of the scene"},
         {"draw", io::TriangleOrder::draw,
          "triangles that share vertices are close together, and triangles that hide others come first"},
         {"size", io::TriangleOrder::size,
          "the best of several orders, mostly strips, for meshopt's compression"},
         {"strips", io::TriangleOrder::strips,
          "a single order of strips, found in a fifth of the time; about 1 % larger with meshopt"}},
        "The order of triangles and vertices in glTF.");
    d.option("interleave", &WriteOptions::interleave,
             "Stores the attributes of a vertex next to each other in glTF, in one buffer view with a "
             "stride. Some GPUs draw this faster. Morph targets stay separate. Otherwise, each attribute has "
             "its own view, which gzip compresses better.");
    d.option("mesh_manifold", &WriteOptions::mesh_manifold,
             "Writes glTF with EXT_mesh_manifold, so that readers do not need to weld.");
    d.choice<io::Textures>(
        "textures", &WriteOptions::textures,
        {{"auto", io::Textures::automatic, "embed for .glb, copy for .gltf and .obj"},
         {"embed", io::Textures::embed, "in the .glb or the .bin; an .obj cannot contain images"},
         {"copy", io::Textures::copy,
          "as separate files next to the output, with names that begin with its stem"},
         {"reference", io::Textures::reference, "not copied: the file refers to the images of the input"}},
        "The location of texture images. Images inside a glTF input stay inside a .glb or .bin, and become "
        "separate files for an .obj.");
    d.option(
        "drop_names", &WriteOptions::drop_names,
        "Removes names of nodes, meshes, images, skins and accessors from glTF, and the name of the "
        "original program (generator). Scenes, animations, cameras and materials keep their names, and so do "
        "nodes that have nothing else, because applications find them by name.");
    d.option("lods", &WriteOptions::lods,
             "Writes glTF with MSFT_lod. The parts X.lod1, X.lod2, ... become levels of detail of X instead "
             "of separate nodes.");
}

namespace {

/// Names the stage that writes such a file, otherwise lists the formats.
std::string hint_of_suffix(const std::string& path, const std::vector<std::string>& names) {
    const std::string suffix = lower_case(std::filesystem::path(path).extension().string());
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
                     suggestion("", names));
    else if (codec->can.tiles && !is_tileset_name(o.path.text))
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
    return o.tiles ? io::codec_named("3d-tiles") : io::codec_for(o.path.text);
}

io::WriteSettings settings_of(const WriteOptions& o, const io::Codec& codec,
                              const std::filesystem::path& target) {
    io::WriteSettings s;
    s.ascii = o.ascii;
    s.big_endian = o.big_endian;
    s.order = o.order;
    s.mesh_manifold = o.mesh_manifold;
    s.lods = o.lods;
    s.names = !o.drop_names;
    s.interleave = o.interleave;
    s.textures = o.textures;
    s.directory = target.parent_path();
    s.double_positions = o.precision == Precision::full;
    s.title = title_of(target);
    if (o.draco && o.draco->on)
        s.draco = {.on = true,
                   .position_bits = static_cast<int>(o.draco->position_bits.value_or(s.draco.position_bits)),
                   .normal_bits = static_cast<int>(o.draco->normal_bits),
                   .uv_bits = static_cast<int>(o.draco->uv_bits),
                   .colour_bits = static_cast<int>(o.draco->colour_bits),
                   .generic_bits = static_cast<int>(o.draco->generic_bits),
                   .speed = static_cast<int>(o.draco->speed),
                   .keep_degenerate = o.draco->degenerate_faces == DracoOptions::Degenerate::keep};
    if (o.meshopt && o.meshopt->on)
        s.meshopt = {.on = true, .extension = o.meshopt->extension, .filters = o.meshopt->filters};
    QuantizeOptions quantize;
    quantize.on = s.meshopt.on;
    if (o.quantize) quantize = *o.quantize;
    if (quantize.on)
        s.quantize = {.on = true,
                      .position_bits = static_cast<int>(quantize.position.value_or(s.quantize.position_bits)),
                      .normal_bits = static_cast<int>(quantize.normal),
                      .uv_bits = static_cast<int>(quantize.uv),
                      .colour_bits = static_cast<int>(quantize.colour),
                      .weight_bits = static_cast<int>(quantize.weights)};
    if (o.tiles) {
        s.tiles.faces = static_cast<std::size_t>(o.tiles->faces);
        s.tiles.implicit = o.tiles->implicit;
    }
    s.draco.on |= codec.can.draco == io::Capabilities::Draco::always;
    return s;
}

StageFiles files_of_write(const WriteOptions& o) {
    const io::Codec* codec = codec_of(o);
    const std::filesystem::path path = o.path.text;
    StageFiles files{{}, {o.path}};
    if (!codec || o.path.text == "-") return files;
    const auto beside = [&](const std::string& suffix) {
        return PathText{(path.parent_path() / (title_of(path) + suffix)).string()};
    };
    if (!codec->can.companion.empty()) files.outputs.push_back(beside(codec->can.companion));
    if (!codec->can.library.empty()) files.materials = beside(codec->can.library);
    using io::Textures;
    // Embedded images need no file. Only images of unknown kinds are copied then, and a warning lists them.
    const bool embeds =
        o.textures == Textures::embed || (o.textures == Textures::automatic && !codec->can.copies_images);
    if (codec->can.textures && !embeds)
        files.images = codec->can.tiles ? beside("/" + path.filename().string()) : o.path;
    if (o.textures == Textures::reference)
        files.copies = [](const io::NamedImage& image) { return !image.is_file; };
    return files;
}

} // namespace facetmill::write_stage
