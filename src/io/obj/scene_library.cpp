#include "io/obj/scene_library.hpp"

#include "base/text/unique_names.hpp"
#include "mesh/primitives_in_use.hpp"

#include <algorithm>

namespace facetmill::io::obj {

namespace {

/// Names for usemtl: single-line, nonempty, unique.
std::vector<std::string> material_names(const std::vector<Material>& materials) {
    std::vector<std::string> names;
    UniqueNames taken;
    for (const auto& m : materials) {
        std::string name = m.name.empty() ? "material" : m.name;
        for (char& c : name)
            if (static_cast<unsigned char>(c) <= ' ' || c == '#') c = '_';
        names.push_back(taken.add(name));
    }
    return names;
}

/// Whether `plain` equals `textured` without its textures. Both then give the same material for faces
/// without texture coordinates. A missing Pr equals Pr 1.
bool is_without_textures(const Description& plain, Description textured) {
    textured.maps.clear();
    if (!plain.roughness && textured.roughness == 1.0) textured.roughness.reset();
    return plain == textured;
}

} // namespace

SceneLibrary::SceneLibrary(const Scene& scene, const WriteSettings& settings)
    : settings_(settings), images_(scene, settings), names_(material_names(scene.materials)),
      textured_(scene.materials.size()) {
    describe_used(scene);
    join_untextured(scene);
    keep_names(scene);
}

void SceneLibrary::describe_used(const Scene& scene) {
    std::vector<bool> used(scene.materials.size());
    for (const Part& part : scene.parts) {
        const std::vector<bool> primitives = primitives_in_use(part.mesh);
        const Attribute* uv = part.mesh.find("TEXCOORD_0", Domain::wedge);
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const Primitive& primitive = part.mesh.primitives[p];
            if (!primitives[p] || primitive.material >= used.size()) continue;
            used[primitive.material] = true;
            if (uv && part.mesh.face_count() > 0 && primitive.has("TEXCOORD_0"))
                textured_[primitive.material] = true;
        }
    }
    for (Index m = 0; m < used.size(); ++m) {
        if (!used[m]) continue;
        Material named = scene.materials[m];
        named.name = names_[m];
        described_[m] = describe(named, images_, losses_);
    }
}

/// Merges materials that a reader has split: a textured material becomes two if some of its faces lack
/// texture coordinates.
void SceneLibrary::join_untextured(const Scene& scene) {
    std::multimap<std::string, Index> with_maps;
    for (const auto& [m, description] : described_)
        if (!description.maps.empty()) with_maps.emplace(scene.materials[m].name, m);
    for (auto at = described_.begin(); at != described_.end();) {
        const auto& [m, description] = *at;
        bool joined = false;
        if (description.maps.empty() && !textured_[m]) {
            const auto [begin, end] = with_maps.equal_range(scene.materials[m].name);
            for (auto other = begin; other != end && !joined; ++other) {
                joined = is_without_textures(description, described_.at(other->second));
                if (joined) names_[m] = names_[other->second];
            }
        }
        at = joined ? described_.erase(at) : std::next(at);
    }
}

/// Stores, in comments, names that usemtl spells differently or that several materials have.
void SceneLibrary::keep_names(const Scene& scene) {
    const auto is_control = [](unsigned char c) { return c < ' '; };
    for (auto& [m, description] : described_) {
        const std::string& name = scene.materials[m].name;
        if (name != names_[m] && std::none_of(name.begin(), name.end(), is_control)) description.name = name;
    }
}

std::optional<std::string> SceneLibrary::file_name() const {
    return described_.empty() ? std::nullopt : std::optional(settings_.title + ".mtl");
}

void SceneLibrary::add_to(Written& written) {
    const auto name = file_name();
    if (!name) return;
    std::vector<std::pair<std::string, Description>> materials;
    materials.reserve(described_.size());
    for (const auto& [m, description] : described_) materials.emplace_back(names_[m], description);
    written.files.push_back({*name, bytes_of_text(material_library(materials))});
    for (const auto& warnings : {losses_.warnings(), images_.warnings()})
        written.warnings.insert(written.warnings.end(), warnings.begin(), warnings.end());
    for (OutputFile& file : images_.take_files()) written.files.push_back(std::move(file));
}

} // namespace facetmill::io::obj
