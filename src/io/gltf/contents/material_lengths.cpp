#include "io/gltf/contents/material_lengths.hpp"

#include "base/math/numbers.hpp"
#include "mesh/transform.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::io {

using namespace gltf;

namespace {

constexpr const char* volume_extension = "KHR_materials_volume";

/// The extension's object; null if the material has none.
const Json* volume_of(const Json& material) {
    const auto extensions = material.is_object() ? material.find("extensions") : material.end();
    if (extensions == material.end() || !extensions->is_object()) return nullptr;
    const auto volume = extensions->find(volume_extension);
    return volume != extensions->end() && volume->is_object() ? &*volume : nullptr;
}

/// A positive length of the material's volume; 0 for none.
double length_in(const Json& material, const char* key) {
    const Json* volume = volume_of(material);
    const auto found = volume ? volume->find(key) : Json::const_iterator();
    return volume && found != volume->end() && found->is_number() ? std::max(0.0, found->get<double>()) : 0;
}

/// Nine digits hold a float32 exactly, and hide the rounding of the factor.
double with_nine_digits(double x) { return parse_real(fmt::format("{:.9g}", x)).value_or(x); }

bool grows(const LengthGrowth& g) { return g.mesh != 1 || g.world != 1; }

/// The documents of a scene whose materials have volumes, parsed on first use.
class Volumes {
  public:
    explicit Volumes(const Scene& scene) : scene_(scene) {}

    /// Null if the material has no document with volumes.
    Json* document_of(const Material& material) {
        if (material.document < 0 || material.index < 0) return nullptr;
        const auto found = parsed_.find(material.document);
        if (found != parsed_.end()) return found->second.get();
        const std::string& text = scene_.documents[static_cast<std::size_t>(material.document)]->json;
        auto json = text.find(volume_extension) == std::string::npos
                        ? nullptr
                        : std::make_unique<Json>(parse_document(text));
        return parsed_.emplace(material.document, std::move(json)).first->second.get();
    }

  private:
    const Scene& scene_;
    std::map<int, std::unique_ptr<Json>> parsed_;
};

/// Scales the materials of a scene's parts.
class SceneScaler {
  public:
    explicit SceneScaler(Scene& scene) : scene_(scene), volumes_(scene) {}

    void scale(Part& part, LengthGrowth by) {
        for (Primitive& p : part.mesh.primitives) {
            if (p.material >= scene_.materials.size()) continue;
            const Material material = scene_.materials[p.material];
            Json* document = volumes_.document_of(material);
            if (!document) continue;
            MaterialScaler& scaler = scalers_.try_emplace(material.document, *document).first->second;
            p.material = instead_of(p.material, scaler.scaled(static_cast<std::size_t>(material.index), by));
            if (p.json.find("KHR_materials_variants") == std::string::npos) continue;
            Json members = parse_document(p.json);
            scaler.scale_variants(members, by);
            p.json = gltf::to_string(members);
        }
    }

    void finish() {
        for (auto& [d, scaler] : scalers_) {
            if (!scaler.changed()) continue;
            auto& document = scene_.documents[static_cast<std::size_t>(d)];
            auto changed = std::make_shared<Document>(*document);
            Material any;
            any.document = d;
            any.index = 0;
            changed->json = gltf::to_string(*volumes_.document_of(any));
            document = std::move(changed);
        }
    }

  private:
    /// The scene's material for another one of its document.
    Index instead_of(Index given, std::size_t index) {
        if (scene_.materials[given].index == static_cast<int>(index)) return given;
        const auto [known, first] =
            made_.try_emplace({given, index}, static_cast<Index>(scene_.materials.size()));
        if (first) {
            Material copy = scene_.materials[given];
            copy.index = static_cast<int>(index);
            scene_.materials.push_back(std::move(copy));
        }
        return known->second;
    }

    Scene& scene_;
    Volumes volumes_;
    std::map<int, MaterialScaler> scalers_; // by document
    std::map<std::pair<Index, std::size_t>, Index> made_;
};

} // namespace

double length_growth(const Transform& t) {
    const double growth = is_similarity(t) ? length(t.vector({1, 0, 0})) : mean_stretch(t);
    return std::abs(growth - 1) < 1e-9 || !(growth > 0) ? 1 : growth; // the rounding of a rotation
}

void scale_material_lengths(Scene& scene, const std::vector<LengthGrowth>& growth) {
    if (std::none_of(growth.begin(), growth.end(), grows)) return;
    SceneScaler scaler(scene);
    for (const bool growing : {false, true}) // materials of parts that stay keep their numbers
        for (std::size_t i = 0; i < growth.size(); ++i)
            if (grows(growth[i]) == growing) scaler.scale(scene.parts[i], growth[i]);
    scaler.finish();
}

std::vector<std::vector<double>> thicknesses(const Scene& scene) {
    std::vector<std::vector<double>> all(scene.parts.size());
    Volumes volumes(scene);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Part& part = scene.parts[i];
        for (const Primitive& p : part.mesh.primitives) {
            if (p.material >= scene.materials.size()) continue;
            const Material& material = scene.materials[p.material];
            const Json* document = volumes.document_of(material);
            if (!document) continue;
            const auto index = static_cast<std::size_t>(material.index);
            const double thickness = length_in(item(*document, "materials", index).json(), "thicknessFactor");
            if (thickness > 0) all[i].push_back(thickness * length_growth(part.transform));
        }
        std::sort(all[i].begin(), all[i].end());
        all[i].erase(std::unique(all[i].begin(), all[i].end()), all[i].end());
    }
    return all;
}

} // namespace facetmill::io

namespace facetmill::io::gltf {

std::size_t MaterialScaler::scaled(std::size_t index, LengthGrowth by) {
    if (index >= count_of(document_, "materials")) return index;
    const Json& given = original_.try_emplace(index, document_["materials"][index]).first->second;
    if (length_in(given, "thicknessFactor") == 0) by.mesh = 1;
    if (length_in(given, "attenuationDistance") == 0) by.world = 1;
    if (!volume_of(given)) return index;
    const bool first = std::none_of(made_.begin(), made_.end(),
                                    [&](const auto& made) { return std::get<0>(made.first) == index; });
    const auto [known, is_new] =
        made_.try_emplace({index, by.mesh, by.world}, first ? index : document_["materials"].size());
    if (!is_new) return known->second;
    if (!first) document_["materials"].push_back(given);
    Json& volume = document_["materials"][known->second]["extensions"][volume_extension];
    for (const auto& [key, factor] :
         {std::pair("thicknessFactor", by.mesh), {"attenuationDistance", by.world}})
        if (factor != 1) volume[key] = with_nine_digits(volume[key].get<double>() * factor);
    changed_ = changed_ || !first || by.mesh != 1 || by.world != 1;
    return known->second;
}

void MaterialScaler::scale_variants(Json& primitive, LengthGrowth by) {
    const Json::json_pointer mappings("/extensions/KHR_materials_variants/mappings");
    if (!primitive.contains(mappings) || !primitive[mappings].is_array()) return;
    for (Json& mapping : primitive[mappings])
        if (const auto material = index_at(mapping, "material")) mapping["material"] = scaled(*material, by);
}

void scale_thickness(Json& document, const std::vector<double>& factors) {
    if (!uses_extension(document, volume_extension)) return;
    MaterialScaler scaler(document);
    for (const bool growing : {false, true}) // materials of meshes that stay keep their numbers
        for (std::size_t m = 0; m < factors.size(); ++m) {
            if ((factors[m] != 1) != growing) continue;
            for (std::size_t p = 0; p < document["meshes"][m]["primitives"].size(); ++p) {
                Json& primitive = document["meshes"][m]["primitives"][p];
                if (const auto material = index_at(primitive, "material"))
                    primitive["material"] = scaler.scaled(*material, {factors[m], 1});
                scaler.scale_variants(primitive, {factors[m], 1});
            }
        }
}

} // namespace facetmill::io::gltf
