// Rules between the objects of a document.

#include "io/gltf/document/check.hpp"
#include "io/gltf/document/nodes.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace facetmill::io::gltf {

namespace {

bool begins(std::string_view text, std::string_view prefix) {
    return text.substr(0, prefix.size()) == prefix;
}

std::size_t number_in(const Json& owner, const char* key, std::size_t otherwise = SIZE_MAX) {
    const auto found = owner.find(key);
    return found == owner.end() ? otherwise : static_cast<std::size_t>(found->get<double>());
}

/// The accessor as "VEC3 5126 normalized".
std::string format_of(const Json& accessor) {
    return fmt::format("{} {}{}", accessor["type"].get<std::string>(), number_in(accessor, "componentType"),
                       accessor.value("normalized", false) ? " normalized" : "");
}

bool is_one_of(const std::string& format, std::initializer_list<const char*> all) {
    return std::find(all.begin(), all.end(), format) != all.end();
}

/// A user of an accessor.
enum class Use { vertices, indices, bind_matrices, times, values, instances };

/// Calls visit(use, semantic or path, reference) for every use of an accessor. The semantic of a morph target
/// begins with "TARGET ".
template <class Visit>
void each_use(const Json& document, const Visit& visit) {
    const auto named = [&](Use use, const std::string& prefix, const JsonCursor& of) {
        for (const auto& [key, value] : of.json().get_ref<const Json::object_t&>())
            visit(use, prefix + key, JsonCursor(of, {&key, 0}, value));
    };
    for (std::size_t m = 0; m < count_of(document, "meshes"); ++m) {
        const JsonCursor primitives = item(document, "meshes", m).at("primitives");
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const JsonCursor primitive = primitives.at(p);
            named(Use::vertices, "", primitive.at("attributes"));
            if (const auto indices = primitive.find("indices")) visit(Use::indices, std::string(), *indices);
            const auto targets = primitive.find("targets");
            for (std::size_t t = 0; targets && t < targets->size(); ++t)
                named(Use::vertices, "TARGET ", targets->at(t));
        }
    }
    for (std::size_t s = 0; s < count_of(document, "skins"); ++s)
        if (const auto matrices = item(document, "skins", s).find("inverseBindMatrices"))
            visit(Use::bind_matrices, std::string(), *matrices);
    for (std::size_t a = 0; a < count_of(document, "animations"); ++a) {
        const JsonCursor samplers = item(document, "animations", a).at("samplers");
        for (std::size_t s = 0; s < samplers.size(); ++s) {
            visit(Use::times, std::string(), samplers.at(s).at("input"));
            visit(Use::values, std::string(), samplers.at(s).at("output"));
        }
    }
}

class RuleCheck {
  public:
    RuleCheck(const Json& document, Breaches& breaches) : document_(document), breaches_(breaches) {}

    void run() {
        extensions();
        for (std::size_t n = 0; n < count_of(document_, "nodes"); ++n) node(item(document_, "nodes", n));
        scenes();
        for (std::size_t m = 0; m < count_of(document_, "meshes"); ++m) mesh(item(document_, "meshes", m));
        if (count_of(document_, "skins") > 0) frames_ = node_frames(document_);
        for (std::size_t s = 0; s < count_of(document_, "skins"); ++s) skin(item(document_, "skins", s));
        for (std::size_t a = 0; a < count_of(document_, "animations"); ++a)
            animation(item(document_, "animations", a));
        for (std::size_t i = 0; i < count_of(document_, "images"); ++i) image(item(document_, "images", i));
        for (std::size_t c = 0; c < count_of(document_, "cameras"); ++c)
            camera(item(document_, "cameras", c));
        for (std::size_t a = 0; a < count_of(document_, "accessors"); ++a)
            accessor(item(document_, "accessors", a));
        uses();
        lights();
    }

  private:
    const Json& at(const char* list, const Json& index) const {
        return document_[list][static_cast<std::size_t>(index.get<double>())];
    }

    void extensions() {
        const auto needed = list(document_, "extensionsRequired");
        for (std::size_t i = 0; needed && i < needed->size(); ++i)
            if (!uses_extension(document_, needed->at(i).text()))
                breaches_.add(needed->at(i), "is not in extensionsUsed");
        const auto used = list(document_, "extensionsUsed");
        constexpr const char* quantization = "KHR_mesh_quantization";
        for (std::size_t i = 0; used && i < used->size(); ++i)
            if (used->at(i).json() == quantization &&
                !(needed && std::count(needed->json().begin(), needed->json().end(), Json(quantization)) > 0))
                breaches_.add(used->at(i), "is not in extensionsRequired");
    }

    std::size_t targets_of(const Json& mesh) const {
        const Json& primitives = mesh["primitives"];
        return primitives.empty() || !primitives[0].contains("targets") ? 0 : primitives[0]["targets"].size();
    }

    void node(const JsonCursor& place) {
        const Json& node = place.json();
        for (const char* key : {"translation", "rotation", "scale"})
            if (node.contains("matrix") && node.contains(key))
                breaches_.add(place, fmt::format("has a matrix and a {}", key));
        if (node.contains("rotation")) {
            constexpr double tolerance = 0.00769; // of the length: rotations of 8 bits
            double square = 0;
            for (const Json& x : node["rotation"]) square += x.get<double>() * x.get<double>();
            if (!(std::abs(std::sqrt(square) - 1) <= tolerance))
                breaches_.add(place.at("rotation"), "is not a unit quaternion");
        }
        for (const char* key : {"skin", "weights"})
            if (node.contains(key) && !node.contains("mesh"))
                breaches_.add(place.at(key), "belongs to a node without a mesh");
        if (!node.contains("mesh")) return;
        const Json& mesh = at("meshes", node["mesh"]);
        if (node.contains("weights") && node["weights"].size() != targets_of(mesh))
            breaches_.add(place.at("weights"), fmt::format("has {} numbers for {} morph targets",
                                                           node["weights"].size(), targets_of(mesh)));
        const auto skinned = [](const Json& primitive) {
            return primitive["attributes"].contains("JOINTS_0") &&
                   primitive["attributes"].contains("WEIGHTS_0");
        };
        if (node.contains("skin") &&
            std::none_of(mesh["primitives"].begin(), mesh["primitives"].end(), skinned))
            breaches_.add(place.at("skin"), "belongs to a mesh without joints and weights");
    }

    void scenes() {
        std::vector<bool> child(count_of(document_, "nodes"));
        for (std::size_t n = 0; n < child.size(); ++n)
            if (const auto children = item(document_, "nodes", n).find("children"))
                for (const Json& c : children->json())
                    child[static_cast<std::size_t>(c.get<double>())] = true;
        for (std::size_t s = 0; s < count_of(document_, "scenes"); ++s) {
            const auto roots = item(document_, "scenes", s).find("nodes");
            if (!roots || !roots->json().is_array()) continue;
            for (std::size_t i = 0; i < roots->size(); ++i)
                if (const Json& n = roots->at(i).json();
                    n.is_number_unsigned() && n < child.size() && child[n.get<std::size_t>()])
                    breaches_.add(roots->at(i), "the node is the child of another");
        }
    }

    void attribute(const JsonCursor& place, const std::string& name, bool target) {
        const auto set = name.find_last_of('_');
        const std::string base = name.substr(0, set);
        const bool numbered = is_one_of(base, {"TEXCOORD", "COLOR", "JOINTS", "WEIGHTS"});
        const std::string number = numbered && set != std::string::npos ? name.substr(set + 1) : "";
        const bool good =
            begins(name, "_") || is_one_of(name, {"POSITION", "NORMAL", "TANGENT"}) ||
            (numbered && !number.empty() && (number == "0" || number[0] != '0') &&
             std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; }));
        if (!good) return breaches_.add(place, "no attribute of glTF has this name; own names begin with _");
        const Json& accessor = at("accessors", place.json());
        const std::string format = format_of(accessor);
        const std::string type = accessor["type"];
        const bool floats = number_in(accessor, "componentType") == float32;
        const bool small = uses_extension(document_, "KHR_mesh_quantization") && !floats;
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
        if (!fits) breaches_.add(place, fmt::format("cannot be {}", format));
    }

    std::size_t sets(const Json& attributes, const char* prefix) const {
        std::size_t count = 0;
        while (attributes.contains(fmt::format("{}{}", prefix, count))) ++count;
        return count;
    }

    void mesh(const JsonCursor& place) {
        const JsonCursor primitives = place.at("primitives");
        const std::size_t targets = primitives.size() == 0 ? 0 : targets_of(place.json());
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            primitive(primitives.at(p));
            const auto own = primitives.at(p).find("targets");
            if ((own ? own->size() : 0) != targets)
                breaches_.add(primitives.at(p),
                              "has another number of morph targets than the first primitive");
        }
        if (const auto weights = place.find("weights"); weights && weights->size() != targets)
            breaches_.add(*weights,
                          fmt::format("has {} numbers for {} morph targets", weights->size(), targets));
    }

    void primitive(const JsonCursor& place) {
        const JsonCursor attributes = place.at("attributes");
        const Json& all = attributes.json();
        if (!all.contains("POSITION")) breaches_.add(attributes, "has no POSITION");
        const std::size_t count = all.empty() ? 0 : number_in(at("accessors", all.begin().value()), "count");
        const auto check = [&](const JsonCursor& of, bool target) {
            for (const auto& [key, value] : of.json().get_ref<const Json::object_t&>()) {
                const JsonCursor reference(of, {&key, 0}, value);
                attribute(reference, key, target);
                if (number_in(at("accessors", value), "count") != count)
                    breaches_.add(reference, "has another count than the other attributes");
                if (target && !all.contains(key))
                    breaches_.add(reference, "moves an attribute that the primitive does not have");
            }
        };
        check(attributes, false);
        if (const auto targets = place.find("targets"))
            for (std::size_t t = 0; t < targets->size(); ++t) check(targets->at(t), true);
        if (sets(all, "JOINTS_") != sets(all, "WEIGHTS_"))
            breaches_.add(attributes, "has another number of JOINTS than of WEIGHTS");
        if (all.contains("TANGENT") && !all.contains("NORMAL"))
            breaches_.add(attributes, "has a TANGENT without a NORMAL");
        count_of_corners(place, count);
        variants(place);
        if (const auto material = place.find("material"))
            texture_coordinates(*material, at("materials", material->json()), sets(all, "TEXCOORD_"));
    }

    void count_of_corners(const JsonCursor& place, std::size_t vertices) {
        const auto indices = place.find("indices");
        if (indices && !is_one_of(format_of(at("accessors", indices->json())),
                                  {"SCALAR 5121", "SCALAR 5123", "SCALAR 5125"}))
            breaches_.add(*indices, "indices must be unsigned scalars");
        const std::size_t count = indices ? number_in(at("accessors", indices->json()), "count") : vertices;
        const auto mode = number_in(place.json(), "mode", 4);
        const bool whole = mode == 1 ? count % 2 == 0 : mode == 4 ? count % 3 == 0 : true;
        const std::size_t least = mode == 0 ? 1 : mode < 4 ? 2 : 3;
        if (!whole || count < least)
            breaches_.add(place, fmt::format("{} corners do not fit mode {}", count, mode));
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
                    breaches_.add(
                        place,
                        fmt::format("its {} needs TEXCOORD_{}, which the primitive does not have", key, set));
            }
            texture_coordinates(place, value, sets);
        }
    }

    void bind_matrices(const JsonCursor& skin, std::size_t joints) {
        const auto matrices = skin.find("inverseBindMatrices");
        if (!matrices) return;
        const Json& accessor = at("accessors", matrices->json());
        const std::size_t count = number_in(accessor, "count");
        if (format_of(accessor) != "MAT4 5126") breaches_.add(*matrices, "must be MAT4 of floats");
        if (count < joints)
            breaches_.add(*matrices, fmt::format("has {} matrices for {} joints", count, joints));
    }

    void skin(const JsonCursor& place) {
        const auto joints = place.find("joints");
        if (!joints) return;
        bind_matrices(place, joints->size());
        const auto root = [&](std::size_t n) {
            while (frames_[n].parent >= 0) n = static_cast<std::size_t>(frames_[n].parent);
            return n;
        };
        for (std::size_t j = 1; j < joints->size(); ++j)
            if (root(joints->at(j).natural()) != root(joints->at(std::size_t{0}).natural()))
                return breaches_.add(*joints, "the joints have no common root");
        const auto skeleton = place.find("skeleton");
        for (std::size_t j = 0; skeleton && j < joints->size(); ++j) {
            int n = static_cast<int>(joints->at(j).natural());
            while (n >= 0 && n != static_cast<int>(skeleton->natural()))
                n = frames_[static_cast<std::size_t>(n)].parent;
            if (n < 0)
                return breaches_.add(*skeleton,
                                     fmt::format("is not above joint {}", joints->at(j).natural()));
        }
    }

    /// The number of values per key: of the morph targets for weights.
    std::size_t values_per_key(const Json& target) const {
        if (target["path"] != "weights" || !target.contains("node")) return 1;
        const Json& node = at("nodes", target["node"]);
        return node.contains("mesh") ? targets_of(at("meshes", node["mesh"])) : 0;
    }

    void channel(const JsonCursor& place, const JsonCursor& samplers) {
        const JsonCursor target = place.at("target");
        const std::string path = target.at("path").text();
        const bool pointer = target.json().contains("extensions");
        if (pointer && path == "pointer" && target.find("node"))
            breaches_.add(target, "has a node and a pointer");
        if (pointer || path == "pointer") return;
        const JsonCursor sampler = samplers.at(place.at("sampler").natural());
        const Json& input = at("accessors", sampler.at("input").json());
        const Json& output = at("accessors", sampler.at("output").json());
        const std::string format = format_of(output);
        const bool fractions =
            is_one_of(format.substr(format.find(' ') + 1),
                      {"5126", "5120 normalized", "5121 normalized", "5122 normalized", "5123 normalized"});
        const std::string type = output["type"];
        const bool fits = path == "rotation"  ? type == "VEC4" && fractions
                          : path == "weights" ? type == "SCALAR" && fractions
                                              : format == "VEC3 5126";
        if (!fits) breaches_.add(sampler.at("output"), fmt::format("{} cannot be {}", path, format));
        const std::size_t keys = number_in(input, "count"), values = number_in(output, "count");
        const bool cubic = sampler.text_or("interpolation", "") == "CUBICSPLINE";
        const std::size_t wanted = keys * values_per_key(target.json()) * (cubic ? 3 : 1);
        if (values != wanted)
            breaches_.add(sampler.at("output"), fmt::format("has {} values, expected {}", values, wanted));
        if (!target.json().contains("node")) return;
        const Json& node = at("nodes", target.json()["node"]);
        if (path != "weights" && node.contains("matrix"))
            breaches_.add(target, "the node has a matrix, which cannot be animated");
    }

    void animation(const JsonCursor& place) {
        const JsonCursor channels = place.at("channels"), samplers = place.at("samplers");
        std::map<std::string, int> targets;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            channel(channels.at(c), samplers);
            const Json& target = channels.at(c).at("target").json();
            if (target.contains("node") && ++targets[to_string(target)] == 2)
                breaches_.add(channels.at(c), "another channel has the same target");
        }
        for (std::size_t s = 0; s < samplers.size(); ++s) {
            const Json& input = at("accessors", samplers.at(s).at("input").json());
            if (format_of(input) != "SCALAR 5126")
                breaches_.add(samplers.at(s).at("input"), "must be scalars of floats");
            if (samplers.at(s).text_or("interpolation", "") == "CUBICSPLINE" && number_in(input, "count") < 2)
                breaches_.add(samplers.at(s).at("input"), "a spline needs two keys");
        }
    }

    void image(const JsonCursor& place) {
        const Json& image = place.json();
        if (image.contains("uri") == image.contains("bufferView"))
            breaches_.add(place, image.contains("uri") ? "has a uri and a buffer view"
                                                       : "has no uri and no buffer view");
        if (image.contains("bufferView") && !image.contains("mimeType"))
            breaches_.add(place, "\"mimeType\" is missing");
        if (image.contains("bufferView") && at("bufferViews", image["bufferView"]).contains("byteStride"))
            breaches_.add(place.at("bufferView"), "the view of an image has a byteStride");
    }

    void camera(const JsonCursor& place) {
        const std::string type = place.text_or("type", "");
        for (const char* of : {"perspective", "orthographic"})
            if (place.json().contains(of) != (type == of))
                breaches_.add(place, fmt::format("its type is {}, {} {}", type,
                                                 type == of ? "without the member" : "with the member", of));
        if (const auto lens = place.find("orthographic"))
            for (const char* key : {"xmag", "ymag"})
                if (const auto half = lens->find(key); half && !(half->real() > 0))
                    breaches_.add(*half, "must be greater than 0");
        for (const char* of : {"perspective", "orthographic"}) {
            const auto lens = place.find(of);
            if (!lens || !lens->find("zfar") || !lens->find("znear")) continue;
            if (!(lens->at("zfar").real() > lens->at("znear").real()))
                breaches_.add(lens->at("zfar"), "is not greater than znear");
        }
    }

    void accessor(const JsonCursor& place) {
        const Json& accessor = place.json();
        const std::size_t size = size_of(static_cast<int>(number_in(accessor, "componentType")));
        const std::size_t components =
            static_cast<std::size_t>(components_of(accessor["type"].get<std::string>()));
        for (const char* bound : {"min", "max"})
            if (const auto numbers = place.find(bound); numbers && numbers->size() != components)
                breaches_.add(*numbers, fmt::format("expected {} numbers", components));
        if (accessor.value("normalized", false) && (size == 4 || size == 0))
            breaches_.add(place, "floats and 32-bit integers cannot be normalized");
        if (const auto sparse = place.find("sparse");
            sparse && sparse->at("count").natural() > number_in(accessor, "count"))
            breaches_.add(sparse->at("count"), "is more than the count of the accessor");
        if (!accessor.contains("bufferView")) {
            if (accessor.contains("byteOffset"))
                breaches_.add(place, "has a byteOffset without a buffer view");
            return;
        }
        const Json& view = at("bufferViews", accessor["bufferView"]);
        const std::size_t offset = number_in(accessor, "byteOffset", 0),
                          stride = number_in(view, "byteStride", 0);
        if (size > 0 && (offset % size != 0 || (offset + number_in(view, "byteOffset", 0)) % size != 0))
            breaches_.add(place, fmt::format("its offset is not a multiple of {} bytes", size));
        if (size > 0 && stride % size != 0)
            breaches_.add(place, fmt::format("its stride is not a multiple of {} bytes", size));
        if (stride > 0 && stride < size * components)
            breaches_.add(place, fmt::format("its elements are longer than the stride of {} bytes", stride));
        if (accessor["type"].get<std::string>().starts_with("MAT") && offset % 4 != 0)
            breaches_.add(place, "the offset of matrices is not a multiple of 4 bytes");
    }

    /// Rules for the views of vertices, indices and other numbers.
    void uses() {
        std::map<std::size_t, Use> view_use;
        std::map<std::size_t, std::set<std::size_t>> vertices_of; // by view
        each_use(document_, [&](Use use, const std::string&, const JsonCursor& reference) {
            const Json& accessor = at("accessors", reference.json());
            if (!accessor.contains("bufferView")) return;
            const std::size_t v = number_in(accessor, "bufferView");
            const Json& view = document_["bufferViews"][v];
            const bool strided = view.contains("byteStride");
            if (use != Use::vertices && strided)
                breaches_.add(reference, "its view has a byteStride, which is for vertices");
            const auto target = number_in(view, "target", 0);
            const std::size_t wanted = use == Use::vertices ? 34962 : use == Use::indices ? 34963 : 0;
            if (target != 0 && target != wanted)
                breaches_.add(reference, fmt::format("its view is for another use: target {}", target));
            const auto [known, fresh] = view_use.try_emplace(v, use);
            const bool both = (known->second == Use::vertices) != (use == Use::vertices) ||
                              (known->second == Use::indices) != (use == Use::indices);
            if (!fresh && both) breaches_.add(reference, "its view has data of another use, too");
            if (use != Use::vertices) return;
            if (number_in(accessor, "byteOffset", 0) % 4 != 0 || number_in(view, "byteOffset", 0) % 4 != 0)
                breaches_.add(reference, "the offset of vertices is not a multiple of 4 bytes");
            auto& all = vertices_of[v];
            if (all.insert(reference.natural()).second && all.size() == 2 && !strided)
                breaches_.add(reference, "several accessors of vertices share a view without byteStride");
        });
        for (std::size_t v = 0; v < count_of(document_, "bufferViews"); ++v) {
            const JsonCursor place = item(document_, "bufferViews", v);
            const auto stride = place.find("byteStride");
            if (stride && stride->natural() % 4 != 0) breaches_.add(*stride, "is not a multiple of 4");
            if (stride && number_in(place.json(), "target", 34962) != 34962)
                breaches_.add(*stride, "is for vertices");
            if (stride && stride->natural() > number_in(place.json(), "byteLength"))
                breaches_.add(*stride, "is more than byteLength");
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
                    breaches_.add(primitive,
                                  fmt::format("variant {} has two materials", variant.get<double>()));
    }

    void lights() {
        const Json::json_pointer place("/extensions/KHR_lights_punctual/lights");
        if (!document_.contains(place)) return;
        const JsonCursor lights(document_[place], "extensions.KHR_lights_punctual.lights");
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const auto spot = lights.at(i).find("spot");
            if (lights.at(i).text_or("type", "") == "spot" && !spot)
                breaches_.add(lights.at(i), "\"spot\" is missing");
            if (!spot) continue;
            const double inner = spot->find("innerConeAngle") ? spot->at("innerConeAngle").real() : 0;
            constexpr double usual = 0.7853981633974483; // pi / 4
            const double outer = spot->find("outerConeAngle") ? spot->at("outerConeAngle").real() : usual;
            if (!(inner < outer)) breaches_.add(*spot, "the inner cone is not inside the outer one");
        }
    }

    const Json& document_;
    Breaches& breaches_;
    std::vector<NodeFrame> frames_; ///< if the document has skins
};

} // namespace

void check_rules(const Json& document, Breaches& breaches) { RuleCheck(document, breaches).run(); }

} // namespace facetmill::io::gltf
