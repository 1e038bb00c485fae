#include "io/gltf/document/check.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <span>

namespace facetmill::io::gltf {

namespace {

enum class Type {
    text,
    boolean,
    integer,
    number,
    numbers,
    reference,
    references,
    references_by_name,
    texts,
    object,
    objects,
    other
};

/// expected: the rules require it, but a document without it has a meaning.
enum class Need { none, expected, required };

/// A member of a kind of object.
struct Member {
    const char* kind; ///< of the object; "node/NAME" for its extension NAME
    const char* key;
    Type type;
    const char* of = ""; ///< the list of references, the kind of objects, or the allowed values: "a|b"
    double least = -HUGE_VAL, most = HUGE_VAL;
    std::size_t size = 0; ///< of numbers; 0: any
    Need need = Need::none;
};

constexpr Need expected = Need::expected, required = Need::required;
constexpr double above_0 = 5e-324; ///< the least number above 0
constexpr double half_pi = 1.5707963267948966;

// Kinds are contiguous.
constexpr Member members[] = {
    {"document", "asset", Type::object, "asset", 0, 0, 0, required},
    {"document", "extensionsUsed", Type::texts},
    {"document", "extensionsRequired", Type::texts},
    {"document", "accessors", Type::objects, "accessor"},
    {"document", "animations", Type::objects, "animation"},
    {"document", "buffers", Type::objects, "buffer"},
    {"document", "bufferViews", Type::objects, "bufferView"},
    {"document", "cameras", Type::objects, "camera"},
    {"document", "images", Type::objects, "image"},
    {"document", "materials", Type::objects, "material"},
    {"document", "meshes", Type::objects, "mesh"},
    {"document", "nodes", Type::objects, "node"},
    {"document", "samplers", Type::objects, "sampler"},
    {"document", "scene", Type::reference, "scenes"},
    {"document", "scenes", Type::objects, "scene"},
    {"document", "skins", Type::objects, "skin"},
    {"document", "textures", Type::objects, "texture"},
    {"asset", "version", Type::text, "", 0, 0, 0, required},
    {"asset", "minVersion", Type::text},
    {"asset", "generator", Type::text},
    {"asset", "copyright", Type::text},
    {"accessor", "name", Type::text},
    {"accessor", "bufferView", Type::reference, "bufferViews"},
    {"accessor", "byteOffset", Type::integer},
    {"accessor", "componentType", Type::integer, "5120|5121|5122|5123|5125|5126", 0, HUGE_VAL, 0, required},
    {"accessor", "normalized", Type::boolean},
    {"accessor", "count", Type::integer, "", 1, HUGE_VAL, 0, required},
    {"accessor", "type", Type::text, "SCALAR|VEC2|VEC3|VEC4|MAT2|MAT3|MAT4", 0, 0, 0, required},
    {"accessor", "min", Type::numbers},
    {"accessor", "max", Type::numbers},
    {"accessor", "sparse", Type::object, "sparse"},
    {"sparse", "count", Type::integer, "", 1, HUGE_VAL, 0, required},
    {"sparse", "indices", Type::object, "sparse indices", 0, 0, 0, required},
    {"sparse", "values", Type::object, "sparse values", 0, 0, 0, required},
    {"sparse indices", "bufferView", Type::reference, "bufferViews", 0, 0, 0, required},
    {"sparse indices", "byteOffset", Type::integer},
    {"sparse indices", "componentType", Type::integer, "5121|5123|5125", 0, HUGE_VAL, 0, required},
    {"sparse values", "bufferView", Type::reference, "bufferViews", 0, 0, 0, required},
    {"sparse values", "byteOffset", Type::integer},
    {"animation", "name", Type::text},
    {"animation", "channels", Type::objects, "channel", 0, 0, 0, required},
    {"animation", "samplers", Type::objects, "animation sampler", 0, 0, 0, required},
    {"channel", "sampler", Type::reference, "animation samplers", 0, 0, 0, required},
    {"channel", "target", Type::object, "target", 0, 0, 0, required},
    {"target", "node", Type::reference, "nodes"},
    {"target", "path", Type::text, "translation|rotation|scale|weights|pointer", 0, 0, 0, required},
    {"target/KHR_animation_pointer", "pointer", Type::text, "", 0, 0, 0, expected},
    {"animation sampler", "input", Type::reference, "accessors", 0, 0, 0, required},
    {"animation sampler", "interpolation", Type::text, "LINEAR|STEP|CUBICSPLINE"},
    {"animation sampler", "output", Type::reference, "accessors", 0, 0, 0, required},
    {"buffer", "name", Type::text},
    {"buffer", "uri", Type::text},
    {"buffer", "byteLength", Type::integer, "", 1, HUGE_VAL, 0, required},
    {"bufferView", "name", Type::text},
    {"bufferView", "buffer", Type::reference, "buffers", 0, 0, 0, required},
    {"bufferView", "byteOffset", Type::integer},
    {"bufferView", "byteLength", Type::integer, "", 1, HUGE_VAL, 0, required},
    {"bufferView", "byteStride", Type::integer, "", 4, 252},
    {"bufferView", "target", Type::integer, "34962|34963"},
    {"bufferView/EXT_meshopt_compression", "buffer", Type::reference, "buffers", 0, 0, 0, required},
    {"bufferView/KHR_meshopt_compression", "buffer", Type::reference, "buffers", 0, 0, 0, required},
    {"buffer/EXT_meshopt_compression", "fallback", Type::boolean},
    {"buffer/KHR_meshopt_compression", "fallback", Type::boolean},
    {"camera", "name", Type::text},
    {"camera", "type", Type::text, "perspective|orthographic", 0, 0, 0, expected},
    {"camera", "perspective", Type::object, "perspective"},
    {"camera", "orthographic", Type::object, "orthographic"},
    {"perspective", "aspectRatio", Type::number, "", above_0},
    {"perspective", "yfov", Type::number, "", above_0, HUGE_VAL, 0, expected},
    {"perspective", "zfar", Type::number, "", above_0},
    {"perspective", "znear", Type::number, "", above_0, HUGE_VAL, 0, expected},
    {"orthographic", "xmag", Type::number, "", -HUGE_VAL, HUGE_VAL, 0, expected},
    {"orthographic", "ymag", Type::number, "", -HUGE_VAL, HUGE_VAL, 0, expected},
    {"orthographic", "zfar", Type::number, "", above_0, HUGE_VAL, 0, expected},
    {"orthographic", "znear", Type::number, "", 0, HUGE_VAL, 0, expected},
    {"image", "name", Type::text},
    {"image", "uri", Type::text},
    {"image", "mimeType", Type::text},
    {"image", "bufferView", Type::reference, "bufferViews"},
    {"material", "name", Type::text},
    {"material", "pbrMetallicRoughness", Type::object, "pbr"},
    {"material", "normalTexture", Type::object, "texture reference"},
    {"material", "occlusionTexture", Type::object, "texture reference"},
    {"material", "emissiveTexture", Type::object, "texture reference"},
    {"material", "emissiveFactor", Type::numbers, "", 0, 1, 3},
    {"material", "alphaMode", Type::text, "OPAQUE|MASK|BLEND"},
    {"material", "alphaCutoff", Type::number, "", 0},
    {"material", "doubleSided", Type::boolean},
    {"material/KHR_materials_unlit", "", Type::other},
    {"material/MSFT_lod", "ids", Type::references, "materials", 0, 0, 0, required},
    {"material/KHR_materials_anisotropy", "anisotropyStrength", Type::number, "", 0, 1},
    {"material/KHR_materials_anisotropy", "anisotropyRotation", Type::number},
    {"material/KHR_materials_anisotropy", "anisotropyTexture", Type::object, "texture reference"},
    {"material/KHR_materials_clearcoat", "clearcoatFactor", Type::number, "", 0, 1},
    {"material/KHR_materials_clearcoat", "clearcoatTexture", Type::object, "texture reference"},
    {"material/KHR_materials_clearcoat", "clearcoatRoughnessFactor", Type::number, "", 0, 1},
    {"material/KHR_materials_clearcoat", "clearcoatRoughnessTexture", Type::object, "texture reference"},
    {"material/KHR_materials_clearcoat", "clearcoatNormalTexture", Type::object, "texture reference"},
    {"material/KHR_materials_diffuse_transmission", "diffuseTransmissionFactor", Type::number, "", 0, 1},
    {"material/KHR_materials_diffuse_transmission", "diffuseTransmissionTexture", Type::object,
     "texture reference"},
    {"material/KHR_materials_diffuse_transmission", "diffuseTransmissionColorFactor", Type::numbers, "", 0,
     HUGE_VAL, 3},
    {"material/KHR_materials_diffuse_transmission", "diffuseTransmissionColorTexture", Type::object,
     "texture reference"},
    {"material/KHR_materials_dispersion", "dispersion", Type::number, "", 0},
    {"material/KHR_materials_emissive_strength", "emissiveStrength", Type::number, "", 0},
    {"material/KHR_materials_ior", "ior", Type::number, "", 0},
    {"material/KHR_materials_iridescence", "iridescenceFactor", Type::number, "", 0, 1},
    {"material/KHR_materials_iridescence", "iridescenceTexture", Type::object, "texture reference"},
    {"material/KHR_materials_iridescence", "iridescenceIor", Type::number, "", 1},
    {"material/KHR_materials_iridescence", "iridescenceThicknessMinimum", Type::number, "", 0},
    {"material/KHR_materials_iridescence", "iridescenceThicknessMaximum", Type::number, "", 0},
    {"material/KHR_materials_iridescence", "iridescenceThicknessTexture", Type::object, "texture reference"},
    {"material/KHR_materials_pbrSpecularGlossiness", "diffuseFactor", Type::numbers, "", 0, 1, 4},
    {"material/KHR_materials_pbrSpecularGlossiness", "diffuseTexture", Type::object, "texture reference"},
    {"material/KHR_materials_pbrSpecularGlossiness", "specularFactor", Type::numbers, "", 0, 1, 3},
    {"material/KHR_materials_pbrSpecularGlossiness", "glossinessFactor", Type::number, "", 0, 1},
    {"material/KHR_materials_pbrSpecularGlossiness", "specularGlossinessTexture", Type::object,
     "texture reference"},
    {"material/KHR_materials_sheen", "sheenColorFactor", Type::numbers, "", 0, 1, 3},
    {"material/KHR_materials_sheen", "sheenColorTexture", Type::object, "texture reference"},
    {"material/KHR_materials_sheen", "sheenRoughnessFactor", Type::number, "", 0, 1},
    {"material/KHR_materials_sheen", "sheenRoughnessTexture", Type::object, "texture reference"},
    {"material/KHR_materials_specular", "specularFactor", Type::number, "", 0, 1},
    {"material/KHR_materials_specular", "specularTexture", Type::object, "texture reference"},
    {"material/KHR_materials_specular", "specularColorFactor", Type::numbers, "", 0, HUGE_VAL, 3},
    {"material/KHR_materials_specular", "specularColorTexture", Type::object, "texture reference"},
    {"material/KHR_materials_transmission", "transmissionFactor", Type::number, "", 0, 1},
    {"material/KHR_materials_transmission", "transmissionTexture", Type::object, "texture reference"},
    {"material/KHR_materials_volume", "thicknessFactor", Type::number, "", 0},
    {"material/KHR_materials_volume", "thicknessTexture", Type::object, "texture reference"},
    {"material/KHR_materials_volume", "attenuationDistance", Type::number, "", above_0},
    {"material/KHR_materials_volume", "attenuationColor", Type::numbers, "", 0, 1, 3},
    {"pbr", "baseColorFactor", Type::numbers, "", 0, 1, 4},
    {"pbr", "baseColorTexture", Type::object, "texture reference"},
    {"pbr", "metallicFactor", Type::number, "", 0, 1},
    {"pbr", "roughnessFactor", Type::number, "", 0, 1},
    {"pbr", "metallicRoughnessTexture", Type::object, "texture reference"},
    {"texture reference", "index", Type::reference, "textures", 0, 0, 0, required},
    {"texture reference", "texCoord", Type::integer},
    {"texture reference", "scale", Type::number},
    {"texture reference", "strength", Type::number, "", 0, 1},
    {"texture reference/KHR_texture_transform", "offset", Type::numbers, "", -HUGE_VAL, HUGE_VAL, 2},
    {"texture reference/KHR_texture_transform", "rotation", Type::number},
    {"texture reference/KHR_texture_transform", "scale", Type::numbers, "", -HUGE_VAL, HUGE_VAL, 2},
    {"texture reference/KHR_texture_transform", "texCoord", Type::integer},
    {"mesh", "name", Type::text},
    {"mesh", "primitives", Type::objects, "primitive", 0, 0, 0, required},
    {"mesh", "weights", Type::numbers},
    {"primitive", "attributes", Type::references_by_name, "accessors", 0, 0, 0, required},
    {"primitive", "indices", Type::reference, "accessors"},
    {"primitive", "material", Type::reference, "materials"},
    {"primitive", "mode", Type::integer, "0|1|2|3|4|5|6"},
    {"primitive", "targets", Type::objects, "target attributes"},
    {"target attributes", "", Type::references_by_name, "accessors"},
    {"primitive/KHR_draco_mesh_compression", "bufferView", Type::reference, "bufferViews", 0, 0, 0, required},
    {"primitive/KHR_materials_variants", "mappings", Type::objects, "variant mapping", 0, 0, 0, required},
    {"variant mapping", "variants", Type::references, "variants", 0, 0, 0, required},
    {"variant mapping", "material", Type::reference, "materials", 0, 0, 0, required},
    {"document/KHR_materials_variants", "variants", Type::objects, "variant", 0, 0, 0, required},
    {"variant", "name", Type::text, "", 0, 0, 0, expected},
    {"node", "name", Type::text},
    {"node", "camera", Type::reference, "cameras"},
    {"node", "children", Type::references, "nodes"},
    {"node", "skin", Type::reference, "skins"},
    {"node", "mesh", Type::reference, "meshes"},
    {"node", "matrix", Type::numbers, "", -HUGE_VAL, HUGE_VAL, 16},
    {"node", "rotation", Type::numbers, "", -1, 1, 4},
    {"node", "scale", Type::numbers, "", -HUGE_VAL, HUGE_VAL, 3},
    {"node", "translation", Type::numbers, "", -HUGE_VAL, HUGE_VAL, 3},
    {"node", "weights", Type::numbers},
    {"node/EXT_mesh_gpu_instancing", "attributes", Type::references_by_name, "accessors"},
    {"node/KHR_lights_punctual", "light", Type::reference, "lights", 0, 0, 0, required},
    {"node/KHR_node_visibility", "visible", Type::boolean},
    {"node/MSFT_lod", "ids", Type::references, "nodes", 0, 0, 0, required},
    {"document/KHR_lights_punctual", "lights", Type::objects, "light", 0, 0, 0, expected},
    {"light", "name", Type::text},
    {"light", "type", Type::text, "directional|point|spot", 0, 0, 0, expected},
    {"light", "color", Type::numbers, "", 0, 1, 3},
    {"light", "intensity", Type::number, "", 0},
    {"light", "range", Type::number, "", above_0},
    {"light", "spot", Type::object, "spot"},
    {"spot", "innerConeAngle", Type::number, "", 0, half_pi},
    {"spot", "outerConeAngle", Type::number, "", above_0, half_pi},
    {"no object/KHR_mesh_quantization", "", Type::other},
    {"sampler", "name", Type::text},
    {"sampler", "magFilter", Type::integer, "9728|9729"},
    {"sampler", "minFilter", Type::integer, "9728|9729|9984|9985|9986|9987"},
    {"sampler", "wrapS", Type::integer, "33071|33648|10497"},
    {"sampler", "wrapT", Type::integer, "33071|33648|10497"},
    {"scene", "name", Type::text},
    {"scene", "nodes", Type::references, "nodes"},
    {"skin", "name", Type::text},
    {"skin", "inverseBindMatrices", Type::reference, "accessors"},
    {"skin", "skeleton", Type::reference, "nodes"},
    {"skin", "joints", Type::references, "nodes", 0, 0, 0, expected},
    {"texture", "name", Type::text},
    {"texture", "sampler", Type::reference, "samplers"},
    {"texture", "source", Type::reference, "images"},
    {"texture/EXT_texture_avif", "source", Type::reference, "images"},
    {"texture/EXT_texture_webp", "source", Type::reference, "images"},
    {"texture/KHR_texture_basisu", "source", Type::reference, "images"},
    {"texture/MSFT_texture_dds", "source", Type::reference, "images"},
};

using Members = std::span<const Member>;

/// The members of each kind.
const std::map<std::string_view, Members>& kinds() {
    static const auto all = [] {
        std::map<std::string_view, Members> by_kind;
        const Members rows(members);
        for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
            const std::string_view kind = rows[begin].kind;
            while (end < rows.size() && rows[end].kind == kind) ++end;
            by_kind[kind] = rows.subspan(begin, end - begin);
        }
        return by_kind;
    }();
    return all;
}

/// True if some kind of object has that extension.
bool has_place(std::string_view extension) {
    return std::any_of(kinds().begin(), kinds().end(), [&](const auto& kind) {
        const auto slash = kind.first.find('/');
        return slash != std::string_view::npos && kind.first.substr(slash + 1) == extension;
    });
}

bool is_one_of(std::string_view allowed, std::string_view value) {
    while (true) {
        const auto end = allowed.find('|');
        if (allowed.substr(0, end) == value) return true;
        if (end == std::string_view::npos) return false;
        allowed.remove_prefix(end + 1);
    }
}

/// The array in an extension of the document, or null.
const Json* list_in(const Json& document, const char* extension, const char* list) {
    const auto extensions = document.find("extensions");
    if (extensions == document.end() || !extensions->is_object()) return nullptr;
    const auto owner = extensions->find(extension);
    if (owner == extensions->end() || !owner->is_object()) return nullptr;
    const auto found = owner->find(list);
    return found != owner->end() && found->is_array() ? &*found : nullptr;
}

class MemberCheck {
  public:
    MemberCheck(const Json& document, Breaches& breaches) : document_(document), breaches_(breaches) {}

    void object(const JsonCursor& place, std::string_view kind) {
        const auto found = kinds().find(kind);
        const Members rows = found == kinds().end() ? Members{} : found->second;
        for (const Member& row : rows)
            if (row.need != Need::none && !place.find(row.key)) {
                if (row.need == Need::required) place.at(row.key); // throws
                breaches_.add(place, fmt::format("\"{}\" is missing", row.key));
            }
        if (!place.json().is_object()) place.find(""); // throws
        const Json* const samplers = samplers_;
        if (kind == "animation") samplers_ = &place.at("samplers").json();
        for (const auto& [key, value] : place.json().get_ref<const Json::object_t&>()) {
            const JsonCursor at(place, {&key, 0}, value);
            if (key == "extensions") {
                extensions(at, kind);
                continue;
            }
            if (key == "extras") continue;
            for (const Member& row : rows)
                if (key == row.key || *row.key == 0) try_member(at, row);
        }
        samplers_ = samplers;
    }

  private:
    void extensions(const JsonCursor& place, std::string_view kind) {
        if (!place.json().is_object()) place.find(""); // throws
        for (const auto& [name, value] : place.json().get_ref<const Json::object_t&>()) {
            const JsonCursor at(place, {&name, 0}, value);
            if (!uses_extension(document_, name)) breaches_.add(at, "is not in extensionsUsed");
            if (!value.is_object()) at.find(""); // throws
            const std::string own = fmt::format("{}/{}", kind, name);
            if (kinds().contains(own))
                object(at, own);
            else if (has_place(name))
                breaches_.add(at, "this extension does not belong here");
        }
    }

    /// Without valid scenes, a document still has its parts.
    void try_member(const JsonCursor& at, const Member& row) {
        try {
            member(at, row);
        } catch (const Error& error) {
            if (std::string_view(row.kind) != "scene" && std::string_view(row.key) != "scene") throw;
            breaches_.add(error);
        }
    }

    void member(const JsonCursor& at, const Member& row) {
        switch (row.type) {
        case Type::text:
            allowed(at, row, at.text());
            break;
        case Type::boolean:
            static_cast<void>(at.boolean());
            break;
        case Type::integer: {
            const auto value = at.natural();
            allowed(at, row, std::to_string(value));
            range(at, row, static_cast<double>(value));
            break;
        }
        case Type::number:
            range(at, row, at.real());
            break;
        case Type::numbers:
            numbers(at, row);
            break;
        case Type::reference:
            reference(at, row);
            break;
        case Type::references:
            references(at, row);
            break;
        case Type::references_by_name:
            references_by_name(at, row);
            break;
        case Type::texts:
            texts(at);
            break;
        case Type::object:
            object(at, row.of);
            break;
        case Type::objects:
            for (std::size_t i = 0; i < not_empty(at); ++i) object(at.at(i), row.of);
            break;
        case Type::other:
            break;
        }
    }

    void allowed(const JsonCursor& at, const Member& row, const std::string& value) {
        if (*row.of != 0 && !is_one_of(row.of, value))
            breaches_.add(at, fmt::format("\"{}\" is not one of {}", value, row.of));
    }

    void range(const JsonCursor& at, const Member& row, double value) {
        if (!(value >= row.least && value <= row.most))
            breaches_.add(at, fmt::format("{} is out of range", value));
    }

    std::size_t not_empty(const JsonCursor& at) {
        const std::size_t size = at.size();
        if (size == 0) breaches_.add(at, "is empty");
        return size;
    }

    void numbers(const JsonCursor& at, const Member& row) {
        const std::size_t size = at.size();
        if (size == 0 || (row.size > 0 && size != row.size))
            at.fail(fmt::format("expected {} numbers, found {}", std::max<std::size_t>(row.size, 1), size));
        for (std::size_t i = 0; i < size; ++i) {
            const JsonCursor number = at.at(i);
            const double value = number.real();
            if (!(value >= row.least && value <= row.most))
                breaches_.add(number, fmt::format("{} is out of range", value));
        }
    }

    std::size_t count(std::string_view of) const {
        const Json* list = of == "lights"     ? list_in(document_, "KHR_lights_punctual", "lights")
                           : of == "variants" ? list_in(document_, "KHR_materials_variants", "variants")
                           : of == "animation samplers" ? samplers_
                                                        : nullptr;
        if (list || of == "lights" || of == "variants") return list ? list->size() : 0;
        return count_of(document_, std::string(of).c_str());
    }

    void reference(const JsonCursor& at, const Member& row) {
        const std::string_view of = row.of;
        const std::string one = of == "meshes"        ? "mesh"
                                : of == "bufferViews" ? "buffer view"
                                                      : std::string(of.substr(0, of.size() - 1));
        static_cast<void>(at.index(count(of), one.c_str()));
    }

    void references(const JsonCursor& at, const Member& row) {
        const std::size_t size = not_empty(at);
        std::vector<std::uint64_t> all;
        all.reserve(size);
        for (std::size_t i = 0; i < size; ++i) {
            reference(at.at(i), row);
            all.push_back(at.at(i).natural());
        }
        std::sort(all.begin(), all.end());
        if (std::adjacent_find(all.begin(), all.end()) != all.end())
            breaches_.add(at, "has an element twice");
    }

    void references_by_name(const JsonCursor& at, const Member& row) {
        if (*row.key == 0) return reference(at, row);
        if (!at.json().is_object()) at.find(""); // throws
        if (at.json().empty()) breaches_.add(at, "is empty");
        for (const auto& [key, value] : at.json().get_ref<const Json::object_t&>())
            reference(JsonCursor(at, {&key, 0}, value), row);
    }

    void texts(const JsonCursor& at) {
        const std::size_t size = not_empty(at);
        std::vector<std::string> all;
        all.reserve(size);
        for (std::size_t i = 0; i < size; ++i) all.push_back(at.at(i).text());
        std::sort(all.begin(), all.end());
        if (std::adjacent_find(all.begin(), all.end()) != all.end())
            breaches_.add(at, "has an element twice");
    }

    const Json& document_;
    Breaches& breaches_;
    const Json* samplers_ = nullptr; ///< of the animation
};

/// The names of members that are integers or lists of them, in some kind of object.
const std::set<std::string_view>& integer_members() {
    static const auto all = [] {
        std::set<std::string_view> names;
        for (const Member& m : members)
            if (m.type == Type::integer || m.type == Type::reference || m.type == Type::references)
                names.insert(m.key);
        // Of extensions that the table does not have.
        for (const char* name : {"attribute", "texture", "featureCount", "nullFeatureId", "propertyTable",
                                 "propertyTables", "propertyTextures", "mergeIndices", "mergeValues"})
            names.insert(name);
        return names;
    }();
    return all;
}

bool make_integer(Json& number) {
    constexpr double most = 9007199254740992.0; // every smaller integer is a double
    if (!number.is_number_float()) return false;
    const auto x = number.get<double>();
    if (!(x >= 0 && x < most && x == std::floor(x))) return false;
    number = static_cast<std::uint64_t>(x);
    return true;
}

/// is_map: all members are references by name.
bool make_integers_in(Json& json, bool is_map) {
    bool changed = false;
    if (json.is_array()) {
        for (Json& element : json)
            if (element.is_structured()) changed |= make_integers_in(element, is_map);
        return changed;
    }
    for (auto& [key, value] : json.get_ref<Json::object_t&>()) {
        if (key == "extras") continue;
        const bool named = is_map || integer_members().contains(key);
        if (value.is_structured()) {
            if (named && value.is_array())
                for (Json& element : value) changed |= make_integer(element);
            changed |= make_integers_in(value, key == "attributes" || key == "targets");
        } else if (named) {
            changed |= make_integer(value);
        }
    }
    return changed;
}

} // namespace

bool make_integers(Json& document) { return document.is_object() && make_integers_in(document, false); }

void check_members(const Json& document, Breaches& breaches) {
    MemberCheck(document, breaches).object(JsonCursor(document, ""), "document");
}

} // namespace facetmill::io::gltf
