// Writes USDZ: makes the glTF of the scene, and writes that as a USD layer with its textures.

#include "facetmill_version.hpp"
#include "io/attributes.hpp"
#include "io/gltf/document/container.hpp"
#include "io/gltf/gltf.hpp"
#include "io/threemf/zip.hpp"
#include "io/usd/nodes.hpp"
#include "io/usd/usd.hpp"

#include <algorithm>

namespace facetmill::io::usd {

namespace {

/// The scene whose meshes are written anew, as plain triangles. Skinned and instanced parts get ordinary
/// nodes, because their document nodes do not give their positions.
Scene plain_scene(Scene scene) {
    std::vector<PartView> views(scene.parts.size());
    try {
        views = part_views(scene);
    } catch (const Error&) { // invalid animations, which are not written
    }
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        Part& part = scene.parts[i];
        part.changed = true;
        if (!part.skinned && !views[i].instanced) continue;
        part.document = part.node = part.source_mesh = -1;
        part.skinned = false;
    }
    return scene;
}

/// The scene as GLB, in the order of its faces and without compression.
Written as_glb(const Scene& scene, const WriteSettings& settings) {
    WriteSettings plain;
    plain.title = settings.title;
    plain.directory = settings.directory;
    plain.textures = Textures::embed;
    plain.order = TriangleOrder::keep;
    return codec_named("glb")->write(plain_scene(scene), plain);
}

bool has_place(const Attribute& a) {
    return a.domain == Domain::wedge && (a.name == "NORMAL" || a.name == "COLOR_0" || a.role == Role::uv);
}

void tell_what_is_lost(Written& written, const Scene& scene) {
    std::set<std::pair<std::string, Domain>> told;
    for (const Part& part : scene.parts)
        for (const Attribute& a : part.mesh.attributes)
            if (!has_place(a) && a.name != primitive_attribute && told.insert({a.name, a.domain}).second)
                dropped(written, a, "USDZ cannot represent it");
    warn_of_dropped(written, scene, "USDZ");
    NanCounts nan;
    for (const Part& part : scene.parts)
        for (const auto& [name, count] : nan_of_primitives(part.mesh)) nan[name] += count;
    warn_of_nan(nan, "USDZ", written.warnings);
    std::set<std::string> kept = kept_extensions();
    kept.insert({"textures", "KHR_node_visibility", "KHR_mesh_quantization", "KHR_draco_mesh_compression",
                 "EXT_meshopt_compression", "KHR_meshopt_compression"});
    leave_documents(written, scene, "USDZ", kept);
    warn_of_names(written, scene, "USDZ");
}

/// The package: the layer comes first, and each file begins at a multiple of 64 bytes.
Bytes package(const std::string& stem, Bytes layer, std::vector<OutputFile> textures) {
    constexpr std::size_t alignment = 64;
    std::vector<threemf::ArchiveFile> files;
    files.push_back({stem + ".usda", std::move(layer)});
    for (OutputFile& texture : textures)
        files.push_back({texture.name.generic_string(), std::move(texture.bytes)});
    return threemf::make_archive(files, alignment);
}

} // namespace

Written write(const Scene& scene, const WriteSettings& settings) {
    Written written;
    const Written glb = as_glb(scene, settings);
    const gltf::Chunks chunks = gltf::split_glb(glb.files.front().bytes);
    const Json document = parse_json(chunks.json);
    std::vector<Bytes> buffers(1);
    if (chunks.binary) buffers.front().assign(chunks.binary->begin(), chunks.binary->end());
    gltf::Source source(document, buffers);
    const std::string stem = identifier(settings.title, "scene");
    Materials materials(source, "/" + stem);
    Nodes nodes(source, materials, "/" + stem);
    nodes.write();

    Layer layer(0);
    layer.line("#usda 1.0");
    layer.line("(");
    layer.line(
        fmt::format("    customLayerData = {{ string creator = \"facetmill {}\" }}", FACETMILL_VERSION));
    layer.line(fmt::format("    defaultPrim = \"{}\"", stem));
    layer.line("    metersPerUnit = 1");
    layer.line("    upAxis = \"Y\"");
    layer.line(")");
    layer.open("def Xform", stem, "", {"kind = \"component\""});
    const auto add = [&](const char* type, const char* name, const Layer& content) {
        if (content.empty()) return;
        layer.open(type, name, "");
        layer.add(content);
        layer.close();
    };
    add("def Scope", "Materials", materials.layer());
    add("class Scope", "Meshes", nodes.shared());
    layer.add(nodes.layer());
    layer.close();

    tell_what_is_lost(written, scene);
    materials.tell(written);
    written.files.push_back(
        {settings.title + ".usdz", package(stem, std::move(layer.text()), materials.take_files())});
    return written;
}

namespace {

const RegisterCodec codec({
    .name = "usdz",
    .about = "USDZ, OpenUSD's package for phones; reads the shapes of files that facetmill wrote",
    .extensions = {"usdz"},
    .unit = Unit::m,
    .up = UpAxis::y,
    .can = {.transforms = true, .attributes = "normals, UVs, colours"},
    .sniff = sniff,
    .read = read,
    .write = write,
});

} // namespace

} // namespace facetmill::io::usd
