#include "io/gltf/document/rules.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace facetmill::io::gltf {

namespace {

bool begins(std::string_view text, std::string_view prefix) {
    return text.substr(0, prefix.size()) == prefix;
}

class MeshRules {
  public:
    explicit MeshRules(const CheckedDocument& document) : document_(document) {}

    void run() {
        for (std::size_t m = 0; m < count_of(document_.json, "meshes"); ++m)
            mesh(item(document_.json, "meshes", m));
    }

  private:
    void attribute(const JsonCursor& place, const std::string& name, bool target) {
        const auto set = name.find_last_of('_');
        const std::string base = name.substr(0, set);
        const bool numbered = is_one_of(base, {"TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"});
        const std::string number = numbered && set != std::string::npos ? name.substr(set + 1) : "";
        const bool good =
            begins(name, "_") || is_one_of(name, {"POSITION", "NORMAL", "TANGENT"}) ||
            (numbered && !number.empty() && (number == "0" || number[0] != '0') &&
             std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; }));
        if (!good)
            return document_.breaches.add(
                place, "glTF has no attribute with this name; names of custom attributes begin with _");
        const Json& accessor = document_.at("accessors", place.json());
        const std::string format = format_of(accessor);
        const std::string type = accessor["type"];
        const bool floats = number_in(accessor, "componentType") == float32;
        const bool small = uses_extension(document_.json, "KHR_mesh_quantization") && !floats;
        bool fits = true;
        if (is_one_of(name, {"POSITION", "NORMAL"})) fits = type == "VEC3" && (floats || small);
        if (name == "TANGENT") fits = type == (target ? "VEC3" : "VEC4") && (floats || small);
        const bool fractions =
            floats || is_one_of(format.substr(type.size() + 1), {"5121 normalized", "5123 normalized"});
        if (base == "TEXCOORD") fits = type == "VEC2" && (fractions || small || target);
        if (base == "COLOR") fits = (type == "VEC3" || type == "VEC4") && (fractions || target);
        if (base == "JOINTS") fits = is_one_of(format, {"VEC4 5121", "VEC4 5123"});
        if (base == "WEIGHTS") fits = type == "VEC4" && fractions;
        if (begins(name, "_")) fits = number_in(accessor, "componentType") != uint32;
        if (!fits) document_.breaches.add(place, fmt::format("cannot be {}", format));
    }

    std::size_t sets(const Json& attributes, const char* prefix) const {
        std::size_t count = 0;
        while (attributes.contains(fmt::format("{}{}", prefix, count))) ++count;
        return count;
    }

    void mesh(const JsonCursor& place) {
        const JsonCursor primitives = place.at("primitives");
        const std::size_t targets = primitives.size() == 0 ? 0 : CheckedDocument::targets_of(place.json());
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            primitive(primitives.at(p));
            const auto own = primitives.at(p).find("targets");
            if ((own ? own->size() : 0) != targets)
                document_.breaches.add(primitives.at(p),
                                       "has a different number of morph targets than the first primitive");
        }
        if (const auto weights = place.find("weights"); weights && weights->size() != targets)
            document_.breaches.add(
                *weights, fmt::format("has {} numbers for {} morph targets", weights->size(), targets));
    }

    void primitive(const JsonCursor& place) {
        const JsonCursor attributes = place.at("attributes");
        const Json& all = attributes.json();
        if (!all.contains("POSITION")) document_.breaches.add(attributes, "has no POSITION");
        const std::size_t count =
            all.empty() ? 0 : number_in(document_.at("accessors", all.begin().value()), "count");
        const auto check = [&](const JsonCursor& of, bool target) {
            for (const auto& [key, value] : of.json().get_ref<const Json::object_t&>()) {
                const JsonCursor reference(of, {&key, 0}, value);
                attribute(reference, key, target);
                if (number_in(document_.at("accessors", value), "count") != count)
                    document_.breaches.add(reference, "has a different count than the other attributes");
                if (target && !all.contains(key))
                    document_.breaches.add(reference, "moves an attribute that the primitive does not have");
            }
        };
        check(attributes, false);
        if (const auto targets = place.find("targets"))
            for (std::size_t t = 0; t < targets->size(); ++t) check(targets->at(t), true);
        if (sets(all, "JOINTS_") != sets(all, "WEIGHTS_"))
            document_.breaches.add(attributes, "has different numbers of JOINTS and WEIGHTS");
        if (all.contains("TANGENT") && !all.contains("NORMAL"))
            document_.breaches.add(attributes, "has a TANGENT without a NORMAL");
        count_of_corners(place, count);
        variants(place);
        if (const auto material = place.find("material"))
            texture_coordinates(*material, document_.at("materials", material->json()),
                                sets(all, "TEXCOORD_"));
    }

    void count_of_corners(const JsonCursor& place, std::size_t vertices) {
        const auto indices = place.find("indices");
        if (indices && !is_one_of(format_of(document_.at("accessors", indices->json())),
                                  {"SCALAR 5121", "SCALAR 5123", "SCALAR 5125"}))
            document_.breaches.add(*indices, "indices must be unsigned scalars");
        const std::size_t count =
            indices ? number_in(document_.at("accessors", indices->json()), "count") : vertices;
        const auto mode = number_in(place.json(), "mode", 4);
        const bool whole = mode == 1 ? count % 2 == 0 : mode == 4 ? count % 3 == 0 : true;
        const std::size_t least = mode == 0 ? 1 : mode < 4 ? 2 : 3;
        if (!whole || count < least)
            document_.breaches.add(place, fmt::format("{} corners do not fit mode {}", count, mode));
    }

    void texture_coordinates(const JsonCursor& place, const Json& json, std::size_t sets) {
        if (!json.is_object()) return;
        for (const auto& [key, value] : json.get_ref<const Json::object_t&>()) {
            if (key == "extras" || !value.is_object()) continue;
            if (std::string_view(key).ends_with("Texture")) {
                const Json::json_pointer other("/extensions/KHR_texture_transform/texCoord");
                const std::size_t set = value.contains(other)
                                            ? static_cast<std::size_t>(value[other].get<double>())
                                            : number_in(value, "texCoord", 0);
                if (set >= sets)
                    document_.breaches.add(
                        place,
                        fmt::format("its {} needs TEXCOORD_{}, which the primitive does not have", key, set));
            }
            texture_coordinates(place, value, sets);
        }
    }

    /// Each variant has at most one material.
    void variants(const JsonCursor& primitive) {
        const Json::json_pointer place("/extensions/KHR_materials_variants/mappings");
        if (!primitive.json().contains(place)) return;
        std::set<double> known;
        for (const Json& mapping : primitive.json()[place])
            for (const Json& variant : mapping["variants"])
                if (!known.insert(variant.get<double>()).second)
                    document_.breaches.add(
                        primitive, fmt::format("variant {} has two materials", variant.get<double>()));
    }

    const CheckedDocument& document_;
};

} // namespace

void check_meshes(const CheckedDocument& document) { MeshRules(document).run(); }

} // namespace facetmill::io::gltf
