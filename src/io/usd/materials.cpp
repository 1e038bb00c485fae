#include "io/usd/materials.hpp"

#include "base/math/portable_math.hpp"
#include "base/text/words.hpp"
#include "io/images/encode_image.hpp"
#include "io/images/image_faults.hpp"
#include "io/images/image_files.hpp"
#include "io/images/pixels.hpp"

#include <algorithm>

namespace facetmill::io::usd {

namespace {

using Colour = std::array<double, 3>;
using Factor = std::array<double, 4>;

constexpr Factor as_is{1, 1, 1, 1}, no_bias{0, 0, 0, 0};

/// A member of an object that may be missing, or of another type because no check covers extensions.
const Json& member(const Json& object, const char* key) {
    static const Json nothing;
    if (!object.is_object()) return nothing;
    const auto at = object.find(key);
    return at == object.end() ? nothing : *at;
}

const Json& extension(const Json& object, const char* name) {
    return member(member(object, "extensions"), name);
}

double number(const Json& object, const char* key, double otherwise) {
    const Json& value = member(object, key);
    return value.is_number() ? value.get<double>() : otherwise;
}

template <std::size_t Size>
std::array<double, Size> numbers(const Json& object, const char* key, std::array<double, Size> otherwise) {
    const Json& value = member(object, key);
    if (!value.is_array()) return otherwise;
    for (std::size_t k = 0; k < Size && k < value.size(); ++k)
        if (value[k].is_number()) otherwise[k] = value[k].get<double>();
    return otherwise;
}

std::string text(const Json& object, const char* key) {
    const Json& value = member(object, key);
    return value.is_string() ? value.get<std::string>() : std::string();
}

std::string text_of(double value) {
    std::string all;
    put_number(all, static_cast<float>(value));
    return all;
}

Factor of_colour(const Colour& c) { return {c[0], c[1], c[2], 1}; }

const char* wrapping(const Json& sampler, const char* key) {
    constexpr double clamp = 33071, mirror = 33648;
    const double mode = number(sampler, key, 0);
    return mode == clamp ? "clamp" : mode == mirror ? "mirror" : "repeat";
}

} // namespace

const std::set<std::string>& kept_extensions() {
    static const std::set<std::string> all{
        "KHR_texture_transform", "KHR_materials_clearcoat", "KHR_materials_emissive_strength",
        "KHR_materials_ior",     "KHR_materials_unlit",     "EXT_texture_webp",
        "EXT_texture_avif"};
    return all;
}

/// Writes one material.
class MaterialWriter {
  public:
    MaterialWriter(Materials& to, const Json& material, std::size_t index, const VertexColours& colours)
        : to_(to), layer_(to.layer_), material_(material), pbr_(member(material, "pbrMetallicRoughness")),
          colours_(colours),
          name_(text(material, "name").empty() ? fmt::format("material_{}", index) : text(material, "name")) {
    }

    MaterialUse write() {
        MaterialUse use;
        const std::string prim = layer_.open("def Material", name_, "material");
        use.path = path_ = fmt::format("{}/Materials/{}", to_.root_, prim);
        layer_.line(fmt::format("token outputs:surface.connect = <{}/surface.outputs:surface>", path_));
        const Json& sided = member(material_, "doubleSided");
        use.double_sided = sided.is_boolean() && sided.get<bool>();
        base(use);
        if (!unlit_) metalness();
        if (!unlit_) details();
        emission();
        surface();
        layer_.close();
        for (const auto& [name, value] : member(material_, "extensions").items())
            if (!kept_extensions().contains(name)) to_.lose(name, name_);
        return use;
    }

  private:
    /// An input of the surface: a number, or a connection.
    void set(std::string_view type, std::string_view input, const std::string& value) {
        inputs_.push_back(fmt::format("{} inputs:{} = {}", type, input, value));
    }
    void connect(std::string_view type, std::string_view input, const std::string& output) {
        inputs_.push_back(fmt::format("{} inputs:{}.connect = <{}/{}>", type, input, path_, output));
    }

    /// Reads the vertex attribute of this name.
    std::string reader(const std::string& shader, const char* type, const char* id, const char* variable) {
        layer_.open("def Shader", shader, "");
        layer_.line(fmt::format("uniform token info:id = \"UsdPrimvarReader_{}\"", id));
        layer_.line(fmt::format("string inputs:varname = \"{}\"", variable));
        layer_.line(fmt::format("{} outputs:result", type));
        layer_.close();
        return shader + ".outputs:result";
    }

    /// The shader with the texture coordinates of a texture.
    std::string coordinates(const Json& info, const std::string& shader) {
        const Json& moved = extension(info, "KHR_texture_transform");
        const std::size_t set =
            gltf::index_at(moved, "texCoord").value_or(gltf::index_at(info, "texCoord").value_or(0));
        const std::string variable = set == 0 ? "st" : fmt::format("st{}", set);
        if (readers_.insert(variable).second)
            reader("reader_" + variable, "float2", "float2", variable.c_str());
        const std::string plain = fmt::format("reader_{}.outputs:result", variable);
        if (!moved.is_object()) return plain;
        // v of glTF is 1 - t, which changes the offset.
        const auto offset = numbers<2>(moved, "offset", {0, 0}), scale = numbers<2>(moved, "scale", {1, 1});
        const double turn = number(moved, "rotation", 0), half_turn = 180;
        const double s = sine(turn), c = cosine(turn);
        layer_.open("def Shader", shader + "_place", "");
        layer_.line("uniform token info:id = \"UsdTransform2d\"");
        layer_.line(fmt::format("float2 inputs:in.connect = <{}/{}>", path_, plain));
        layer_.line(fmt::format("float inputs:rotation = {}", text_of(turn * half_turn / pi)));
        layer_.line("float2 inputs:scale = " + tuple(scale));
        layer_.line("float2 inputs:translation = " +
                    tuple<2>({offset[0] + s * scale[1], 1 - offset[1] - c * scale[1]}));
        layer_.line("float2 outputs:result");
        layer_.close();
        return shader + "_place.outputs:result";
    }

    /// Writes a shader that samples a texture: result = scale * texel + bias. False without an image.
    bool texture(const Json& info, const std::string& shader, const Factor& scale, const Factor& bias,
                 bool is_colour) {
        const auto number_of_texture = gltf::index_at(info, "index");
        if (!number_of_texture) return false;
        const std::string file = to_.file_of(*number_of_texture);
        if (file.empty()) return false;
        const std::string at = coordinates(info, shader);
        const Json& document = to_.source_.json();
        const Json& all = member(document, "samplers");
        const auto sampler = gltf::index_at(document["textures"][*number_of_texture], "sampler");
        const Json how = sampler && all.is_array() && *sampler < all.size() ? all[*sampler] : Json();
        layer_.open("def Shader", shader, "");
        layer_.line("uniform token info:id = \"UsdUVTexture\"");
        layer_.line(fmt::format("asset inputs:file = @{}@", file));
        layer_.line(fmt::format("float2 inputs:st.connect = <{}/{}>", path_, at));
        layer_.line(fmt::format("token inputs:wrapS = \"{}\"", wrapping(how, "wrapS")));
        layer_.line(fmt::format("token inputs:wrapT = \"{}\"", wrapping(how, "wrapT")));
        if (scale != as_is) layer_.line("float4 inputs:scale = " + tuple(scale));
        if (bias != no_bias) layer_.line("float4 inputs:bias = " + tuple(bias));
        layer_.line(fmt::format("token inputs:sourceColorSpace = \"{}\"", is_colour ? "sRGB" : "raw"));
        for (const char* channel : {"r", "g", "b", "a"})
            layer_.line(fmt::format("float outputs:{}", channel));
        layer_.line("float3 outputs:rgb");
        layer_.close();
        return true;
    }

    void base(MaterialUse& use) {
        const auto factor = numbers<4>(pbr_, "baseColorFactor", as_is);
        unlit_ = extension(material_, "KHR_materials_unlit").is_object();
        const char* input = unlit_ ? "emissiveColor" : "diffuseColor";
        const bool textured = texture(member(pbr_, "baseColorTexture"), "base_colour", factor, no_bias, true);
        if (textured) {
            connect("color3f", input, "base_colour.outputs:rgb");
            if (colours_.colour) to_.lose("vertex colours that are multiplied with a texture", name_);
        } else if (colours_.colour) {
            connect("color3f", input, reader("colour", "float3", "float3", "displayColor"));
            use.factor = factor;
        } else {
            set("color3f", input, tuple<3>({factor[0], factor[1], factor[2]}));
        }
        opacity(use, factor, textured);
        if (!unlit_) return;
        // Only the emission is seen: no diffuse light, and no reflection, which an index of 1 lacks.
        set("color3f", "diffuseColor", "(0, 0, 0)");
        set("float", "roughness", "1");
        set("float", "ior", "1");
    }

    void opacity(MaterialUse& use, const Factor& factor, bool textured) {
        const std::string mode = text(material_, "alphaMode");
        if (mode != "BLEND" && mode != "MASK") return;
        if (mode == "MASK") {
            constexpr double usual = 0.5;
            set("float", "opacityThreshold", text_of(number(material_, "alphaCutoff", usual)));
        }
        if (textured) {
            connect("float", "opacity", "base_colour.outputs:a");
        } else if (colours_.alpha) {
            connect("float", "opacity", reader("alpha", "float", "float", "displayOpacity"));
            use.factor[3] = factor[3];
        } else {
            set("float", "opacity", text_of(factor[3]));
        }
    }

    void metalness() {
        const double metallic = number(pbr_, "metallicFactor", 1), rough = number(pbr_, "roughnessFactor", 1);
        if (texture(member(pbr_, "metallicRoughnessTexture"), "metallic_roughness", {1, rough, metallic, 1},
                    no_bias, false)) {
            connect("float", "metallic", "metallic_roughness.outputs:b");
            connect("float", "roughness", "metallic_roughness.outputs:g");
            return;
        }
        set("float", "metallic", text_of(metallic));
        set("float", "roughness", text_of(rough));
    }

    void details() {
        const Json& bumps = member(material_, "normalTexture");
        const double s = number(bumps, "scale", 1);
        if (texture(bumps, "normals", {2 * s, 2 * s, 2, 1}, {-s, -s, -1, 0}, false))
            connect("normal3f", "normal", "normals.outputs:rgb");
        const Json& shade = member(material_, "occlusionTexture");
        const double strength = number(shade, "strength", 1), rest = 1 - strength;
        if (texture(shade, "occlusion", {strength, strength, strength, 1}, {rest, rest, rest, 0}, false))
            connect("float", "occlusion", "occlusion.outputs:r");
        if (const Json& refraction = extension(material_, "KHR_materials_ior"); refraction.is_object()) {
            constexpr double usual = 1.5;
            set("float", "ior", text_of(number(refraction, "ior", usual)));
        }
        const Json& coat = extension(material_, "KHR_materials_clearcoat");
        if (!coat.is_object()) return;
        layer_of_coat(coat, "clearcoatFactor", "clearcoatTexture", "clearcoat", "r");
        layer_of_coat(coat, "clearcoatRoughnessFactor", "clearcoatRoughnessTexture", "clearcoatRoughness",
                      "g");
        if (member(coat, "clearcoatNormalTexture").is_object()) to_.lose("clearcoatNormalTexture", name_);
    }

    void layer_of_coat(const Json& coat, const char* factor, const char* image, const char* input,
                       const char* channel) {
        const double f = number(coat, factor, 0);
        if (texture(member(coat, image), input, {f, f, f, 1}, no_bias, false))
            connect("float", input, fmt::format("{}.outputs:{}", input, channel));
        else
            set("float", input, text_of(f));
    }

    void emission() {
        if (unlit_) return;
        const double strength =
            number(extension(material_, "KHR_materials_emissive_strength"), "emissiveStrength", 1);
        Colour factor = numbers<3>(material_, "emissiveFactor", {0, 0, 0});
        for (double& c : factor) c *= strength;
        if (factor == Colour{0, 0, 0}) return;
        if (texture(member(material_, "emissiveTexture"), "emission", of_colour(factor), no_bias, true))
            connect("color3f", "emissiveColor", "emission.outputs:rgb");
        else
            set("color3f", "emissiveColor", tuple(factor));
    }

    void surface() {
        layer_.open("def Shader", "surface", "");
        layer_.line("uniform token info:id = \"UsdPreviewSurface\"");
        for (const std::string& input : inputs_) layer_.line(input);
        layer_.line("token outputs:surface");
        layer_.close();
    }

    Materials& to_;
    Layer& layer_;
    const Json& material_;
    const Json& pbr_;
    const VertexColours colours_;
    const std::string name_;
    std::string path_;
    std::vector<std::string> inputs_;
    std::set<std::string> readers_;
    bool unlit_ = false;
};

const MaterialUse& Materials::use(std::size_t index, const VertexColours& colours) {
    const auto [at, is_new] = uses_.try_emplace({index, colours});
    if (is_new)
        at->second = MaterialWriter(*this, source_.json()["materials"][index], index, colours).write();
    return at->second;
}

std::string Materials::file_of(std::size_t texture) {
    const Json& textures = member(source_.json(), "textures");
    const std::size_t images = member(source_.json(), "images").size();
    if (!textures.is_array() || texture >= textures.size()) return {};
    const Json& chosen = textures[texture];
    std::vector<std::size_t> sources; // the plain one first, which is the fallback of the others
    if (const auto plain = gltf::index_at(chosen, "source")) sources.push_back(*plain);
    for (const auto& [name, value] : member(chosen, "extensions").items())
        if (const auto other = gltf::index_at(value, "source")) sources.push_back(*other);
    for (const std::size_t image : sources) {
        if (image >= images) continue;
        if (std::string name = add_image(image); !name.empty()) return name;
    }
    return {};
}

std::string Materials::add_image(std::size_t image) {
    const auto [at, is_new] = image_names_.try_emplace(image);
    if (!is_new) return at->second;
    const Json& json = source_.json()["images"][image];
    const auto view = gltf::index_at(json, "bufferView");
    const Json& views = member(source_.json(), "bufferViews");
    if (!view || !views.is_array() || *view >= views.size()) return {};
    const Span stored = source_.view(*view);
    Bytes bytes(stored.begin(), stored.end());
    std::string type = media_type(bytes);
    const std::string shown = file_name_of_image(text(json, "name"), image, bytes).generic_string();
    if (type != "image/png" && type != "image/jpeg") {
        const auto pixels = decoded_image(bytes);
        if (!pixels)
            throw Error(ErrorKind::stage, "E-USDZ",
                        fmt::format("USDZ holds PNG and JPEG: the image '{}' is {}, and cannot be converted",
                                    shown, type.empty() ? "of no known kind" : type),
                        "convert the textures to PNG or JPEG, or write .glb");
        bytes = encoded_png(*pixels);
        type = "image/png";
    } else if (const std::string fault = image_fault(bytes); !fault.empty()) {
        warnings_.push_back(warning_of_fault(shown, fault));
    }
    const std::string stem = identifier(std::filesystem::path(shown).stem().generic_string(), "image");
    const std::string name = fmt::format("textures/{}{}", file_names_.add(stem), suffix_of_image(type));
    files_.push_back({name, std::move(bytes)});
    return at->second = name;
}

std::vector<OutputFile> Materials::take_files() { return std::move(files_); }

void Materials::tell(Written& written) const {
    written.warnings.insert(written.warnings.end(), warnings_.begin(), warnings_.end());
    for (const auto& [what, materials] : lost_)
        written.warnings.push_back(
            {Severity::warning,
             "W-MATERIAL",
             fmt::format("USDZ has no {}: {} {}", what, materials.size() == 1 ? "material" : "materials",
                         some_of({materials.begin(), materials.end()})),
             {},
             "glTF keeps them: write .glb"});
}

} // namespace facetmill::io::usd
