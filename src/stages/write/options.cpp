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
          "the steps are at most those of the scene's longest side; a small mesh has fewer "
          "bits, but at least 10"},
         {"mesh", Grid::mesh, "each mesh has all bits for its own longest side"},
         {"even", Grid::even,
          "the same steps everywhere, those of the scene's longest side, however small a mesh is, but finer "
          "ones where vertices would coincide otherwise. Parts that meet keep meeting: where none is turned, "
          "all have one grid. Meshes that an animation moves are as with scene"}},
        "What the bits of positions are of.");
}

void declare_draco(Declare<DracoOptions>& d) {
    d.option("position_bits", &DracoOptions::position_bits,
             "Bits of each coordinate: the longest side is divided into 2^bits - 1 steps (a count); unless "
             "given, 14, and up to 24 where vertices would coincide otherwise (14, if 24 are too few).")
        .between(1, 30);
    declare_grid(d);
    d.option("normal_bits", &DracoOptions::normal_bits, "Bits of normals (a count).").between(1, 30);
    d.option("uv_bits", &DracoOptions::uv_bits, "Bits of texture coordinates (a count).").between(1, 30);
    d.option("colour_bits", &DracoOptions::colour_bits, "Bits of colours (a count).").between(1, 30);
    d.option("generic_bits", &DracoOptions::generic_bits, "Bits of every other attribute (a count).")
        .between(1, 30);
    d.option("speed", &DracoOptions::speed,
             "0 gives the smallest file, 10 the fastest compression (a count).")
        .between(0, 10);
    d.choice<DracoOptions::Degenerate>(
         "degenerate_faces", &DracoOptions::degenerate_faces,
         {{"drop", DracoOptions::Degenerate::drop, "they are left out, with a warning"},
          {"keep", DracoOptions::Degenerate::keep,
           "in a separate primitive, without the connectivity that makes Draco files small"}},
         "What is done with faces that use a vertex twice, which Draco's compression of connectivity cannot "
         "represent.")
        .also_called(property_named("degenerate_faces")->also_called);
    d.shorthand(ShortForm::truth, "true or false", {{"type", "boolean"}},
                [](const Value& v, DracoOptions& out, Problems& problems) {
                    return OptionType<bool>::parse(v, out.on, problems);
                });
}

void declare_quantize(Declare<QuantizeOptions>& d) {
    d.option("position", &QuantizeOptions::position,
             "Bits of each coordinate: the longest side is divided into 2^bits - 1 steps (a count); unless "
             "given, 14, and up to 16 where vertices would coincide otherwise (14, if 16 are too few).")
        .between(1, 16);
    declare_grid(d);
    d.option("normal", &QuantizeOptions::normal, "Bits of each number of normals and tangents (a count).")
        .between(2, 16);
    d.option("uv", &QuantizeOptions::uv,
             "Bits of texture coordinates (a count). Under meshopt's filters they are multiples of 2^-uv in "
             "float32; otherwise those beyond [-1, 1] stay float32.")
        .between(1, 16);
    d.option("colour", &QuantizeOptions::colour, "Bits of each channel of colours (a count).").between(1, 16);
    d.option("weights", &QuantizeOptions::weights,
             "8 stores the weights of joints as bytes, more as 16 bits (a count).")
        .between(8, 16);
    d.shorthand(ShortForm::truth, "true or false", {{"type", "boolean"}},
                [](const Value& v, QuantizeOptions& out, Problems& problems) {
                    return OptionType<bool>::parse(v, out.on, problems);
                });
}

void declare_meshopt(Declare<MeshoptOptions>& d) {
    using Extension = io::MeshoptSettings::Extension;
    d.choice<Extension>(
        "extension", &MeshoptOptions::extension,
        {{"EXT", Extension::ext, "EXT_meshopt_compression, which readers have known since 2020"},
         {"KHR", Extension::khr,
          "KHR_meshopt_compression, with streams of version 1: smaller files for newer readers"}},
        "The name of the extension under which the compressed data is stored.");
    d.option("filters", &MeshoptOptions::filters,
             "Encodes normals and tangents on an octahedron, rotations of animations and instances in 16 "
             "bits, and values that stay float32 as multiples of a power of two: positions within quantize's "
             "bits; translations, scales and morph weights within 2^-16 of their extent, "
             "places of instances within a quarter of a step of the grid. "
             "Without filters, the values are "
             "compressed unchanged.");
    d.shorthand(ShortForm::truth, "true or false", {{"type", "boolean"}},
                [](const Value& v, MeshoptOptions& out, Problems& problems) {
                    return OptionType<bool>::parse(v, out.on, problems);
                });
}

void declare_tiles(Declare<TilesOptions>& d) {
    d.choice<TilesOptions::Kind>(
         "format", &TilesOptions::format,
         {{"3d", TilesOptions::Kind::three_d, "3D Tiles 1.1, each tile a GLB, refined by REPLACE"}},
         "The kind of tiles.")
        .also_called(format_synonyms)
        .primary();
    d.option("faces", &TilesOptions::faces,
             "Triangles that a tile has at the most, but where its borders need more (a count).")
        .also_called(property_named("faces")->also_called)
        .between(100, 10000000);
    d.choice<bool>(
        "tiling", &TilesOptions::implicit,
        {{"explicit", false, "the tileset lists every tile"},
         {"implicit", true,
          "tiles are known by level and place in a quadtree; binary files of some levels each say which "
          "there are, with their boxes and errors, so that a viewer reads no list of all"}},
        "How the tileset names its tiles.");
}

/// An option that only some formats support, and whether it is set to have an effect.
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
        add_refusal(
            Refusal{name,
                    fmt::format("'{}' goes with {}, not with {}", name, fmt::join(formats, ", "), codec.name),
                    "leave it out"},
            "write", given, problems);
    }
    const bool draco = o.draco && o.draco->on;
    for (const auto& [name, asked] : {std::pair("quantize", o.quantize && o.quantize->on),
                                      std::pair("meshopt", o.meshopt && o.meshopt->on),
                                      std::pair("order", o.order != io::TriangleOrder::automatic)})
        if (draco && asked)
            add_refusal(Refusal{name,
                                fmt::format("'{}' and 'draco' exclude each other, since Draco compresses the "
                                            "same data in its own way",
                                            name),
                                "leave one of them out"},
                        "write", given, problems);
    if (const bool meshopt = o.meshopt && o.meshopt->on; o.interleave && (draco || meshopt))
        add_refusal(Refusal{"interleave",
                            fmt::format("'interleave' and '{}' exclude each other, since that compresses "
                                        "each attribute by itself",
                                        draco ? "draco" : "meshopt"),
                            "leave one of them out"},
                    "write", given, problems);
    if (o.textures == io::Textures::embed && codec.can.textures && !codec.can.library.empty())
        add_refusal(
            Refusal{"textures",
                    fmt::format("{} cannot hold images: its textures are files beside it", codec.name),
                    "write: {textures: copy}, or a .glb"},
            "write", given, problems);
    if (o.feature_angle && o.normals != NormalKind::smooth)
        add_refusal(
            Refusal{"feature_angle", "'feature_angle' goes with normals: smooth only", "add normals: smooth"},
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
             "The file to write; its suffix decides the format; - is standard output.")
        .also_called(path_synonyms)
        .primary()
        .required();
    d.option("format", &WriteOptions::format, "The name of the format, when the suffix does not show it.")
        .also_called(format_synonyms);
    d.choice<Unit>("unit", &WriteOptions::unit,
                   unit_choices("auto", "the format's (glTF: metres), else the scene's"),
                   "The unit of the numbers in the file.")
        .also_called(property_named("unit")->also_called);
    d.choice<UpAxis>("up", &WriteOptions::up, up_choices("auto", "the format's (glTF: y), else the scene's"),
                     "The axis that points up in the file.")
        .also_called(property_named("up")->also_called);
    d.option("ascii", &WriteOptions::ascii, "PLY and STL as text instead of binary.")
        .also_called("binary", "(ascii: false), which is the default");
    d.option("big_endian", &WriteOptions::big_endian, "Binary PLY with the most significant byte first.");
    d.choice<Precision>(
        "precision", &WriteOptions::precision,
        {{"auto", Precision::automatic,
          "single, but full in PLY, OBJ and OFF where float32 would move points by more than a "
          "millionth of the scene's diagonal, as with geographic coordinates"},
         {"single", Precision::single, "rounded to 32-bit floats"},
         {"full", Precision::full, "with all 64 bits (PLY, OBJ, OFF, 3MF)"}},
        "How positions are written.");
    d.option(
        "origin", &WriteOptions::origin,
        "Where coordinates in the file count from, in formats whose parts have places (glTF, 3MF): a point "
        "of "
        "the scene, to which the parts' nodes move; keep, the origin that they have; or auto: keep, unless "
        "float32 would move points by more than a millionth of the scene's diagonal, as with geographic "
        "coordinates, then a point near the centre.");
    d.option(
        "triangulate", &WriteOptions::triangulate,
        "Writes triangles to PLY, OBJ and OFF, for programs that read no larger faces; other formats have "
        "triangles in any case. The scene keeps its faces.");
    d.choice<NormalKind>(
        "normals", &WriteOptions::normals,
        {{"keep", NormalKind::keep,
          "those of the scene; viewers of glTF use flat shading where there are none"},
         {"smooth", NormalKind::smooth, "the mean of the faces around a vertex, weighted by angle"},
         {"flat", NormalKind::flat, "the normals of the faces"},
         {"none", NormalKind::none, "neither normals nor tangents are written"}},
        "The normals in the file; the scene keeps its own.");
    d.option("feature_angle", &WriteOptions::feature_angle,
             "With normals: smooth, edges whose dihedral angle is larger than this stay sharp (an angle "
             "between the normals of the two faces; if not given, none does).")
        .above(0);
    d.choice<Tangents>(
        "tangents", &WriteOptions::tangents,
        {{"keep", Tangents::keep, "those of the scene; viewers make them where there are none"},
         {"missing", Tangents::missing, "made by MikkTSpace where a material has a map of normals"},
         {"new", Tangents::all, "made there in any case"}},
        "The tangents in a glTF file; the scene keeps its own.");
    d.group("draco", &WriteOptions::draco,
            "Writes glTF with KHR_draco_mesh_compression: true, or its settings.", declare_draco)
        .also_called("compress compression use_draco compressed");
    d.group("quantize", &WriteOptions::quantize,
            "Writes glTF with KHR_mesh_quantization, which stores attributes as small integers: true, or the "
            "numbers of bits. meshopt also quantises unless this is false.",
            declare_quantize);
    d.group("meshopt", &WriteOptions::meshopt,
            "Writes glTF with EXT_meshopt_compression: true, or its settings.", declare_meshopt);
    d.group("tiles", &WriteOptions::tiles,
            "Writes a tileset: 3d, or its settings. A path that ends in tileset.json says so by itself.",
            declare_tiles);
    d.choice<io::TriangleOrder>(
        "order", &WriteOptions::order,
        {{"auto", io::TriangleOrder::automatic,
          "size under meshopt, else draw; a mesh that comes from glTF unchanged stays as it is"},
         {"keep", io::TriangleOrder::keep, "as the scene has them"},
         {"draw", io::TriangleOrder::draw,
          "triangles that share vertices behind each other, those that hide others first"},
         {"size", io::TriangleOrder::size, "the one of several, mostly strips, that meshopt compresses best"},
         {"strips", io::TriangleOrder::strips,
          "one order of strips, found in a fifth of the time; under meshopt about 1 % larger"}},
        "The order of triangles and vertices in glTF.");
    d.option("interleave", &WriteOptions::interleave,
             "Puts the attributes of a vertex side by side in glTF, in one buffer view with a stride, which "
             "some GPUs draw faster; morph targets stay by themselves. Without it, each attribute has a "
             "view of its own, which gzip makes smaller.");
    d.option("mesh_manifold", &WriteOptions::mesh_manifold,
             "Writes glTF with EXT_mesh_manifold, so that readers need not weld.");
    d.choice<io::Textures>(
        "textures", &WriteOptions::textures,
        {{"auto", io::Textures::automatic, "embed for .glb, copy for .gltf and .obj"},
         {"embed", io::Textures::embed, "in the .glb or the .bin; an .obj cannot hold them"},
         {"copy", io::Textures::copy, "beside the file, under names that begin with its stem"},
         {"reference", io::Textures::reference, "not at all: the file refers to the images of the input"}},
        "Where the images of textures are stored. Those that a glTF input holds itself stay in a .glb or "
        ".bin, and "
        "become files beside an .obj.");
    d.option(
        "drop_names", &WriteOptions::drop_names,
        "Leaves out of glTF the names of nodes, meshes, images, skins and accessors, and that of the program "
        "it came from (generator); scenes, animations, cameras and materials keep theirs.");
    d.option("lods", &WriteOptions::lods,
             "Writes glTF with MSFT_lod: the parts X.lod1, X.lod2, ... become levels of detail of X rather "
             "than nodes beside it.");
}

namespace {

/// The stage that writes such a file, otherwise the list of formats.
std::string hint_of_suffix(const std::string& path, const std::vector<std::string>& names) {
    const std::string suffix = lower_case(std::filesystem::path(path).extension().string());
    if (suffix == ".svg" || suffix == ".dxf")
        return fmt::format("section: {{path: {}}} draws what a plane cuts", path);
    if (suffix == ".png") return fmt::format("render: {{path: {}}} makes a picture", path);
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
        problems.add(mark, "E-FORMAT", fmt::format("there is no format '{}'", o.format),
                     suggestion(o.format, names));
    else if (!codec)
        problems.add(mark, "E-FORMAT", fmt::format("the suffix of '{}' names no format", o.path.text),
                     hint_of_suffix(o.path.text, names));
    else if (!codec->write)
        problems.add(mark, "E-FORMAT", fmt::format("{} is read but not written", codec->name),
                     suggestion("", names));
    else if (codec->can.tiles && !is_tileset_name(o.path.text))
        problems.add(
            path ? path->mark : mark, "E-FORMAT",
            fmt::format("tiles go to a folder beside a tileset, which '{}' does not name", o.path.text),
            "give a path that ends in .json, such as out/tileset.json");
    else if (!codec->can.companion.empty() && o.path.text == "-")
        problems.add(mark, "E-FORMAT",
                     fmt::format("a {} has a file beside it, which standard output cannot hold", codec->name),
                     "format: glb");
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
