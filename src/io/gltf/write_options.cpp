// The options of `write` for glTF.

#include "io/write_options.hpp"

#include "geometry/inspect/inspect.hpp"

namespace facetmill::io {

namespace {

template <class Settings>
void declare_grid(Declare<Settings>& d) {
    d.template choice<Grid>(
        "grid", &Settings::grid,
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

constexpr const char* bits_of_colours =
    "Bits of each channel of float colours. Colours are linear, so 8 bits show bands in dark tones. 12 bits "
    "keep all tones of 8-bit sRGB colours.";

void declare_draco(Declare<DracoSettings>& d) {
    d.option("position_bits", &DracoSettings::position_bits,
             "Bits of each coordinate. The longest side is divided into 2^bits - 1 steps. Default: 14, and "
             "up to 24 where vertices would coincide. If 24 bits are too few, 14 are used.")
        .between(1, 30);
    declare_grid(d);
    d.option("normal_bits", &DracoSettings::normal_bits, "Bits of normals.").between(1, 30);
    d.option("uv_bits", &DracoSettings::uv_bits, "Bits of texture coordinates.").between(1, 30);
    d.option("colour_bits", &DracoSettings::colour_bits, bits_of_colours).between(1, 30);
    d.option("generic_bits", &DracoSettings::generic_bits, "Bits of all other attributes.").between(1, 30);
    d.option("speed", &DracoSettings::speed, "0 gives the smallest file, 10 the fastest compression.")
        .between(0, 10);
    d.choice<bool>(
         "degenerate_faces", &DracoSettings::keep_degenerate,
         {{"drop", false, "remove these faces, with a warning"},
          {"keep", true, "store them in a separate primitive, with weaker compression"}},
         "How to handle faces that use a vertex twice. Draco's compression cannot represent such faces.")
        .also_called(property_named("degenerate_faces")->also_called);
    allow_truth(d);
}

void declare_quantize(Declare<QuantizeSettings>& d) {
    d.option("position", &QuantizeSettings::position_bits,
             "Bits of each coordinate. The longest side is divided into 2^bits - 1 steps. Default: 14, and "
             "up to 16 where vertices would coincide. If 16 bits are too few, 14 are used.")
        .between(1, 16);
    declare_grid(d);
    d.option("normal", &QuantizeSettings::normal_bits, "Bits of each component of normals and tangents.")
        .between(2, 16);
    d.option("uv", &QuantizeSettings::uv_bits,
             "Bits of texture coordinates. With meshopt's filters, coordinates are multiples of 2^-uv in "
             "float32. Otherwise, coordinates beyond [-1, 1] stay float32.")
        .between(1, 16);
    d.option("colour", &QuantizeSettings::colour_bits, bits_of_colours).between(1, 16);
    d.option("weights", &QuantizeSettings::weight_bits,
             "8 stores joint weights as bytes. More bits store them as 16-bit numbers.")
        .between(8, 16);
    allow_truth(d);
}

void declare_meshopt(Declare<MeshoptSettings>& d) {
    using Extension = MeshoptSettings::Extension;
    d.choice<Extension>("extension", &MeshoptSettings::extension,
                        {{"EXT", Extension::ext, "EXT_meshopt_compression, supported by readers since 2020"},
                         {"KHR", Extension::khr,
                          "KHR_meshopt_compression with version 1 streams: smaller files for newer readers"}},
                        "The glTF extension for the compressed data.");
    d.option("filters", &MeshoptSettings::filters,
             "Rounds values before compression. Normals and tangents become octahedral, and rotations of "
             "animations and instances get 16 bits. Other float32 values become multiples of a power of two. "
             "Positions use the bits of quantize. Translations, scales and morph weights stay within 2^-16 "
             "of their extent, positions of instances within a quarter of a grid step. Without filters, "
             "values are compressed unchanged.");
    allow_truth(d);
}

void declare_levels(Declare<LevelSettings>& d) {
    d.option(
         "pixels", &LevelSettings::pixels,
         "The error on the screen, in pixels, up to which a coarser level may be shown. "
         "MSFT_screencoverage follows from it, from the size of the screen and from the measured distance "
         "of each level from the finest one. It is the share of the screen under the bounding sphere.")
        .above(0);
    d.option("width", &LevelSettings::width, "The width of the screen in pixels.").above(0);
    d.option("height", &LevelSettings::height, "The height of the screen in pixels.").above(0);
    allow_truth(d);
}

} // namespace

void declare_compression(Declare<WriteSettings>& d) {
    declare_switched(d, "draco", &WriteSettings::draco,
                     "Writes glTF with KHR_draco_mesh_compression. Give true, or a map of settings.",
                     declare_draco)
        .also_called("compress compression use_draco compressed");
    declare_switched(
        d, "quantize", &WriteSettings::quantize,
        "Writes glTF with KHR_mesh_quantization, which stores attributes as small integers. Give true, "
        "or the numbers of bits. meshopt also quantises, unless this is false.",
        declare_quantize);
    declare_switched(d, "meshopt", &WriteSettings::meshopt,
                     "Writes glTF with EXT_meshopt_compression. Give true, or a map of settings.",
                     declare_meshopt);
}

void declare_layout(Declare<WriteSettings>& d) {
    d.choice<TriangleOrder>(
        "order", &WriteSettings::order,
        {{"auto", TriangleOrder::automatic,
          "size with meshopt, otherwise draw; an unchanged mesh from a glTF file keeps its order"},
         {"keep", TriangleOrder::keep, "the order of the scene"},
         {"draw", TriangleOrder::draw,
          "triangles that share vertices are close together, and triangles that hide others come first"},
         {"size", TriangleOrder::size,
          "the best of several orders, mostly strips, for meshopt's compression"},
         {"strips", TriangleOrder::strips,
          "a single order of strips, found in a fifth of the time; about 1 % larger with meshopt"}},
        "The order of triangles and vertices in glTF.");
    d.option("interleave", &WriteSettings::interleave,
             "Stores the attributes of a vertex next to each other in glTF, in one buffer view with a "
             "stride. Some GPUs draw this faster. Morph targets stay separate. Otherwise, each attribute has "
             "its own view, which gzip compresses better.");
    d.option("mesh_manifold", &WriteSettings::mesh_manifold,
             "Writes glTF with EXT_mesh_manifold, so that readers do not need to weld.");
    d.choice<Textures>(
        "textures", &WriteSettings::textures,
        {{"auto", Textures::automatic, "embed for .glb, copy for .gltf and .obj"},
         {"embed", Textures::embed, "in the .glb or the .bin; an .obj cannot contain images"},
         {"copy", Textures::copy,
          "as separate files next to the output, with names that begin with its stem"},
         {"reference", Textures::reference, "not copied: the file refers to the images of the input"}},
        "The location of texture images. Images inside a glTF input stay inside a .glb or .bin, and become "
        "separate files for an .obj.");
    d.option(
        "drop_names", &WriteSettings::drop_names,
        "Removes names of nodes, meshes, images, skins and accessors from glTF, and the name of the "
        "original program (generator). Scenes, animations, cameras and materials keep their names, and so do "
        "nodes that have nothing else, because applications find them by name.");
    declare_switched(
        d, "lods", &WriteSettings::lods,
        "Writes glTF with MSFT_lod. The parts X.lod1, X.lod2, ... become levels of detail of X "
        "instead of separate nodes. Its extras get the sizes on the screen at which levels change "
        "(MSFT_screencoverage) and the errors of the levels (lod_errors). Give true, or a map.",
        declare_levels);
}

WriteOption draco_option() {
    return {"draco", [](const WriteSettings& s) { return s.draco.on; }};
}

WriteOption textures_option() {
    return {"textures", [](const WriteSettings& s) { return s.textures != Textures::automatic; }};
}

std::vector<WriteOption> gltf_mesh_options() {
    return {draco_option(),
            {"quantize", [](const WriteSettings& s) { return s.quantize.on; }},
            {"meshopt", [](const WriteSettings& s) { return s.meshopt.on; }},
            {"order", [](const WriteSettings& s) { return s.order != TriangleOrder::automatic; }},
            {"interleave", &WriteSettings::interleave},
            textures_option()};
}

} // namespace facetmill::io
