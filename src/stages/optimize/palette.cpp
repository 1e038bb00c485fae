#include "stages/optimize/palette.hpp"

#include "mesh/separate_wedges.hpp"

#include <algorithm>
#include <map>

namespace facetmill::optimize_stage {

namespace {

/// The looks of the same kind, and the look of each material.
struct Palette {
    int document = -1;
    std::vector<io::PlainLook> looks;
    std::map<Index, std::size_t> of_material; ///< the look of each of the scene's materials
    std::set<std::size_t> parts;
    Index material = none; ///< index of the palette's material in the scene
};

using Key = std::pair<int, std::string>; // document and kind

bool has_uvs(const Mesh& mesh) {
    return std::any_of(mesh.attributes.begin(), mesh.attributes.end(),
                       [](const Attribute& a) { return a.name.rfind("TEXCOORD_", 0) == 0; });
}

/// The kind that all materials of a part share; none if the kinds differ.
std::optional<Key> kind_of(const Scene& scene, const Mesh& mesh,
                           const std::map<Index, io::PlainLook>& looks) {
    std::optional<Key> kind;
    if (has_uvs(mesh)) return {};
    for (const Primitive& p : mesh.primitives) {
        const auto look = looks.find(p.material);
        if (look == looks.end() || !p.json.empty()) return {};
        const Key own{scene.materials[p.material].document, look->second.kind};
        if (kind && *kind != own) return {};
        kind = own;
    }
    return kind;
}

void paint(Mesh& mesh, const Palette& palette) {
    std::vector<Index> look_of_primitive, look_of_corner(mesh.corner_count());
    for (const Primitive& p : mesh.primitives)
        look_of_primitive.push_back(static_cast<Index>(palette.of_material.at(p.material)));
    for (Index f = 0; f < mesh.face_count(); ++f)
        for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
            look_of_corner[c] = look_of_primitive[mesh.primitive_of(f)];
    std::vector<float> uvs;
    for (const Index look : separate_wedges(mesh, look_of_corner)) {
        const double column = look == none ? 0 : look;
        uvs.push_back(static_cast<float>((column + 0.5) / static_cast<double>(palette.looks.size())));
        uvs.push_back(0.5F);
    }
    mesh.attributes.push_back({"TEXCOORD_0", Domain::wedge, Role::uv, 2, false, std::move(uvs)});
    for (Primitive& p : mesh.primitives) {
        p.material = palette.material;
        if (!p.attributes.empty()) p.attributes.emplace_back("TEXCOORD_0");
    }
}

void add_look(Palette& palette, Index material, const io::PlainLook& look) {
    if (palette.of_material.contains(material)) return;
    const auto same =
        std::find_if(palette.looks.begin(), palette.looks.end(),
                     [&](const io::PlainLook& other) { return other.surface() == look.surface(); });
    palette.of_material[material] = static_cast<std::size_t>(same - palette.looks.begin());
    if (same == palette.looks.end()) palette.looks.push_back(look);
}

/// The plain looks, by index of the scene's materials.
std::map<Index, io::PlainLook> plain_looks(const Scene& scene,
                                           const std::vector<io::DocumentOptimizer>& documents) {
    std::map<Index, io::PlainLook> looks;
    for (Index m = 0; m < scene.materials.size(); ++m) {
        const Material& material = scene.materials[m];
        if (material.document < 0 || material.index < 0) continue;
        const auto& document = documents[static_cast<std::size_t>(material.document)];
        if (!document.numbers_are_known()) continue;
        if (auto look = document.plain_look(static_cast<std::size_t>(material.index)))
            looks.emplace(m, std::move(*look));
    }
    return looks;
}

} // namespace

PaletteCounts make_palettes(Scene& scene, std::vector<io::DocumentOptimizer>& documents,
                            const std::vector<std::size_t>& parts, std::size_t least) {
    const std::map<Index, io::PlainLook> looks = plain_looks(scene, documents);
    std::map<Key, Palette> palettes;
    for (const std::size_t i : parts) {
        const auto key = kind_of(scene, scene.parts[i].mesh, looks);
        if (!key) continue;
        Palette& palette = palettes[*key];
        palette.document = key->first;
        palette.parts.insert(i);
        for (const Primitive& p : scene.parts[i].mesh.primitives)
            add_look(palette, p.material, looks.at(p.material));
    }
    PaletteCounts counts;
    for (auto& [key, palette] : palettes) {
        if (palette.looks.size() > most_looks)
            counts.too_many_looks = std::max(counts.too_many_looks, palette.looks.size());
        if (palette.looks.size() < std::max<std::size_t>(least, 2) || palette.looks.size() > most_looks)
            continue;
        Material material{.name = "palette", .document = palette.document};
        material.double_sided = scene.materials[palette.of_material.begin()->first].double_sided;
        const int material_index = material.index = static_cast<int>(
            documents[static_cast<std::size_t>(palette.document)].add_palette(palette.looks));
        palette.material = static_cast<Index>(scene.materials.size());
        scene.materials.push_back(std::move(material));
        for (const std::size_t i : palette.parts) {
            Part& part = scene.parts[i];
            paint(part.mesh, palette);
            part.changed = true;
            if (part.document == palette.document &&
                part.source_mesh >= 0) // the mesh as written, if no other part uses it
                documents[static_cast<std::size_t>(part.document)].set_material(
                    static_cast<std::size_t>(part.source_mesh), static_cast<std::size_t>(material_index));
        }
        ++counts.palettes;
        counts.materials += palette.of_material.size();
    }
    return counts;
}

} // namespace facetmill::optimize_stage
