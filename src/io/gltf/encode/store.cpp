// Rounds attributes when the document is otherwise complete. This covers attributes from all sources,
// including unchanged meshes, points and lines.

#include "io/attributes.hpp"
#include "io/gltf/contents/material_lengths.hpp"
#include "io/gltf/encode/encode.hpp"
#include "io/gltf/numbers/quantise.hpp"
#include "io/gltf/read/instances.hpp"
#include "io/gltf/write/patch.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

bool begins(const std::string& text, const char* prefix) { return text.rfind(prefix, 0) == 0; }

bool has_extension(const Json& object, const char* name) {
    return object.contains("extensions") && object["extensions"].contains(name);
}

/// A key for a grid.
std::string key_of(const std::optional<PositionGrid>& grid) {
    return grid ? fmt::format("{} {} {} {}", grid->origin.x, grid->origin.y, grid->origin.z, grid->step) : "";
}

/// A pass over the document's meshes.
class Store {
  public:
    Store(Patch& patch, const PartNodes& nodes)
        : patch_(patch), builder_(patch.builder), json_(patch.builder.json()),
          quantize_(patch.settings.quantize),
          filters_(patch.settings.meshopt.on && patch.settings.meshopt.filters) {
        for (std::size_t i = 0; i < nodes.of_part.size(); ++i) {
            if (nodes.of_part[i] < 0) continue;
            const auto node = static_cast<std::size_t>(nodes.of_part[i]);
            bits_of_node_[node] = patch.settings.grid_bits(i);
            if (const Lattice own = patch.settings.lattice(i); own.step > 0) lattice_of_node_[node] = own;
        }
    }

    void run();

  private:
    void store_mesh(std::size_t mesh);
    Json store_primitive(Json primitive, const std::optional<PositionGrid>& grid);
    void store_influences(Json& attributes);
    Json store_target(const Json& target, const std::optional<PositionGrid>& grid);
    void store_manifold(Json& mesh) const;

    int bits_of(std::size_t mesh) const;
    PositionGrid grid_in(std::size_t mesh, const Box& box) const;
    std::optional<PositionGrid> grid_of(std::size_t mesh);
    const char* reason_for_floats(std::size_t mesh, const PositionGrid& grid);
    std::size_t position(std::size_t accessor, const std::optional<PositionGrid>& grid);
    std::size_t vector(std::size_t accessor, bool unit);
    std::size_t fraction(std::size_t accessor, const std::string& semantic);
    std::size_t displacement(std::size_t accessor, const std::optional<PositionGrid>& grid);
    std::size_t sparse(std::size_t accessor, const Attribute& numbers, double factor);
    std::optional<Stored> as_floats(const Attribute& numbers, int exponent, bool bounds) const;

    bool readable(std::size_t accessor) const;
    bool floats(std::size_t accessor) const;
    bool compressed(std::size_t accessor) const;
    std::vector<Vec3> positions(std::size_t accessor);
    std::size_t replace(std::size_t accessor, std::optional<Stored> stored);
    /// Returns the accessor for the key; calls make the first time.
    template <class Make>
    std::size_t made_once(const std::string& key, Make&& make) {
        const auto known = made_.find(key);
        return known != made_.end() ? known->second : made_.emplace(key, make()).first->second;
    }

    std::optional<Attribute> instances_on_grid(std::size_t node, const PositionGrid& grid);
    void place_origin_in_instances(std::size_t node, const PositionGrid& grid);
    void place_grid(std::size_t node, const PositionGrid& grid);
    void place_in_node(std::size_t node, const PositionGrid& grid);
    void keep(const std::string& attribute, std::string why);

    Patch& patch_;
    Builder& builder_;
    Json& json_;
    const QuantizeSettings& quantize_;
    bool filters_;
    bool small_integers_ =
        false; ///< true if small integers are used, which only KHR_mesh_quantization allows
    std::vector<std::vector<std::size_t>> nodes_;    ///< [meshes] nodes
    std::map<std::size_t, int> bits_of_node_;        ///< position bits of the node's mesh, if on a grid
    std::map<std::size_t, Lattice> lattice_of_node_; ///< lattices of nodes whose parts have one
    std::vector<NodeFrame> frames_;
    std::set<std::size_t> animated_, joints_;
    std::set<std::size_t> fixed_;             ///< meshes that extensions use by themselves, such as colliders
    std::vector<double> growth_;              ///< by mesh, of its coordinates
    std::map<std::string, std::size_t> made_; ///< by accessor and requested form
};

void Store::keep(const std::string& attribute, std::string why) {
    const AttributeChange change{attribute, Domain::wedge, AttributeChange::Kind::kept, std::move(why)};
    auto& all = patch_.written.changes;
    if (std::find(all.begin(), all.end(), change) == all.end()) all.push_back(change);
}

/// True if the bytes are available. A buffer may be filled externally.
bool Store::readable(std::size_t accessor) const {
    if (accessor >= count_of(json_, "accessors")) return false;
    const Json& a = json_["accessors"][accessor];
    return !a.contains("bufferView") || !builder_.current().without_bytes(a["bufferView"].get<std::size_t>());
}

bool Store::floats(std::size_t accessor) const {
    return json_["accessors"][accessor]["componentType"] == int(float32);
}

/// True if meshopt compressed the accessor in the source.
bool Store::compressed(std::size_t accessor) const {
    const Json& a = json_["accessors"][accessor];
    return a.contains("bufferView") &&
           compression_of(json_["bufferViews"][a["bufferView"].get<std::size_t>()]);
}

std::vector<Vec3> Store::positions(std::size_t accessor) {
    if (const auto exact = builder_.exact_positions.find(accessor); exact != builder_.exact_positions.end())
        return exact->second;
    const Attribute a = decode_numbers(builder_.current(), accessor);
    if (a.components != 3)
        throw Error(ErrorKind::malformed, "E-GLTF",
                    fmt::format("accessors[{}]: POSITION must be VEC3", accessor));
    return to_vectors(a);
}

/// Replaces an accessor by a new one with these numbers; returns the old accessor if there is nothing to
/// store.
std::size_t Store::replace(std::size_t accessor, std::optional<Stored> stored) {
    if (!stored) return accessor;
    for (const char* key : {"name", "extras"})
        if (json_["accessors"][accessor].contains(key))
            stored->accessor[key] = json_["accessors"][accessor][key];
    return builder_.add_stored(std::move(*stored), array_buffer);
}

/// Floats for meshopt's filter; none if no filter is used.
std::optional<Stored> Store::as_floats(const Attribute& numbers, int exponent, bool bounds) const {
    if (!filters_) return {};
    auto stored = exponential(numbers, exponent, bounds);
    return stored ? std::move(stored) : exponential(numbers, finest_exponent(numbers), bounds);
}

// --- positions

/// Calls see for each member "mesh" or "node" within extensions.
void see_extension_references(const Json& json, bool within,
                              const std::function<void(const std::string&, std::size_t)>& see) {
    if (json.is_array())
        for (const Json& item : json) see_extension_references(item, within, see);
    if (!json.is_object()) return;
    for (const auto& [key, value] : json.items()) {
        if (within && (key == "mesh" || key == "node") && value.is_number_unsigned())
            see(key, value.get<std::size_t>());
        if (value.is_structured() && key != "extras")
            see_extension_references(value, within || key == "extensions", see);
    }
}

/// The reason why a node cannot hold the grid of its mesh; null if it can.
const char* Store::reason_for_floats(std::size_t mesh, const PositionGrid& grid) {
    if (uses_extension(json_, "KHR_animation_pointer"))
        return "stays float32, because KHR_animation_pointer may drive its nodes";
    if (fixed_.contains(mesh)) return "stays float32, because an extension uses the mesh without its node";
    if (nodes_[mesh].empty()) return "stays float32, because no node can store its grid";
    for (const std::size_t n : nodes_[mesh]) {
        const Json& node = json_["nodes"][n];
        if (node.contains("skin")) return "stays float32 where a mesh has a skin, which ignores nodes";
        if (has_extension(node, instancing_extension) && !instances_on_grid(n, grid))
            return "stays float32 where the positions of its instances are unknown or too far away for a "
                   "grid";
    }
    return nullptr;
}

/// The largest number of bits that parts with this mesh request.
int Store::bits_of(std::size_t mesh) const {
    int bits = 0;
    for (const std::size_t node : nodes_[mesh])
        if (const auto of = bits_of_node_.find(node); of != bits_of_node_.end())
            bits = std::max(bits, of->second);
    return bits > 0 ? bits : bits_or_usual(quantize_.position_bits);
}

/// The grid with a step of 1.
PositionGrid whole_grid(const Box& box) {
    return {{short_near(box.min.x, 1), short_near(box.min.y, 1), short_near(box.min.z, 1)},
            1,
            box.longest_side() > 255 ? 16 : 8};
}

/// The finest lattice of the parts with this mesh; without one, the grid of the box and the bits.
PositionGrid Store::grid_in(std::size_t mesh, const Box& box) const {
    const int bits = bits_of(mesh);
    Lattice finest;
    bool all = true;
    for (const std::size_t node : nodes_[mesh]) {
        const auto found = lattice_of_node_.find(node);
        all = all && found != lattice_of_node_.end();
        if (all && !(finest.step > 0 && finest.step <= found->second.step)) finest = found->second;
    }
    bool within = all && finest.step > 0;
    for (std::size_t c = 0; within && c < 3; ++c) within = box.min[c] >= finest.origin[c] - finest.step / 2;
    if (within) return {finest.origin, finest.step, 16};
    const double range = box.longest_side();
    const auto steps = static_cast<double>((1 << bits) - 1);
    const double step = range > 0 ? short_above(range / steps) : 1;
    return {
        {short_near(box.min.x, step), short_near(box.min.y, step), short_near(box.min.z, step)}, step, bits};
}

std::optional<PositionGrid> Store::grid_of(std::size_t mesh) {
    Box faces, all;
    const Json& primitives = json_["meshes"][mesh]["primitives"];
    for (const Json& primitive : primitives) {
        if (!primitive.contains("attributes") || !primitive["attributes"].contains("POSITION")) continue;
        const auto accessor = primitive["attributes"]["POSITION"].get<std::size_t>();
        if (!readable(accessor) || !floats(accessor)) return {};
        const bool triangles = makes_triangles(JsonCursor(primitive, ""));
        for (const Vec3& p : positions(accessor)) {
            all.add(p);
            if (triangles) faces.add(p);
        }
    }
    if (all.empty()) return {};
    const Box& box = faces.empty() ? all : faces;
    if (patch_.settings.whole_positions && box.longest_side() > 65535) return {}; // positions beyond 16 bits
    const PositionGrid grid = patch_.settings.whole_positions ? whole_grid(box) : grid_in(mesh, box);
    if (!(grid.step > 0) || !(grid.step < HUGE_VAL)) return {};
    if (const char* why = reason_for_floats(mesh, grid)) {
        keep("POSITION", why);
        return {};
    }
    const double reach = (grid.bits <= 8 ? 255.0 : 65535.0) * grid.step;
    const double half = grid.step / 2;
    for (std::size_t c = 0; c < 3; ++c)
        if (all.min[c] < grid.origin[c] - half || all.max[c] > grid.origin[c] + reach + half) {
            keep("POSITION", "stays float32 where points or lines reach far beyond the faces of their mesh");
            return {};
        }
    return grid;
}

std::size_t Store::position(std::size_t accessor, const std::optional<PositionGrid>& grid) {
    if (!readable(accessor) || !floats(accessor)) return accessor;
    if (grid) {
        small_integers_ = true;
        return replace(accessor, on_grid(positions(accessor), *grid));
    }
    const Attribute a = decode_numbers(builder_.current(), accessor);
    return replace(accessor,
                   as_floats(a,
                             patch_.settings.whole_positions ? 0
                             : quantize_.on ? exponent_of_range(a, bits_or_usual(quantize_.position_bits))
                                            : finest_exponent(a),
                             true));
}

/// Keeps sparse accessors sparse.
std::size_t Store::sparse(std::size_t accessor, const Attribute& given, double factor) {
    std::vector<std::uint32_t> where;
    std::vector<float> all, values;
    for (std::size_t i = 0; i < given.size(); ++i) {
        bool zero = true;
        for (int c = 0; c < 3; ++c) {
            all.push_back(static_cast<float>(given.value(i, c) * factor));
            zero = zero && all.back() == 0;
        }
        if (zero) continue;
        where.push_back(static_cast<std::uint32_t>(i));
        values.insert(values.end(), all.end() - 3, all.end());
    }
    Stored dense = plain(all, 3, false, true);
    for (const char* key : {"name", "extras"})
        if (json_["accessors"][accessor].contains(key))
            dense.accessor[key] = json_["accessors"][accessor][key];
    if (!where.empty()) {
        const std::size_t places = builder_.add_view(plain(where, 1, false, false).bytes);
        const std::size_t numbers = builder_.add_view(plain(values, 3, false, false).bytes);
        dense.accessor["sparse"] = {{"count", where.size()},
                                    {"indices", {{"bufferView", places}, {"componentType", int(uint32)}}},
                                    {"values", {{"bufferView", numbers}}}};
    }
    return builder_.add_accessor(std::move(dense.accessor));
}

std::size_t Store::displacement(std::size_t accessor, const std::optional<PositionGrid>& grid) {
    const Attribute a = decode_numbers(builder_.current(), accessor);
    if (a.components != 3) return accessor;
    const bool dense = json_["accessors"][accessor].contains("bufferView");
    if (!grid)
        return dense && floats(accessor) ? replace(accessor, as_floats(a, finest_exponent(a), true))
                                         : accessor;
    if (!dense) return sparse(accessor, a, 1 / grid->step);
    Stored stored = displacements(a, *grid);
    if (stored.accessor["componentType"] == int(float32) && filters_) {
        Attribute steps = a;
        for (float& x : std::get<std::vector<float>>(steps.data))
            x = static_cast<float>(static_cast<double>(x) / grid->step);
        if (auto filtered = as_floats(steps, 0, true)) return replace(accessor, std::move(filtered));
    }
    return replace(accessor, std::move(stored));
}

// --- the other attributes

/// Normals, tangents, and their morph displacements.
std::size_t Store::vector(std::size_t accessor, bool unit) {
    if (!readable(accessor)) return accessor;
    const Json& given = json_["accessors"][accessor];
    if (!given.contains("bufferView")) return accessor;
    // Bytes are already quantised; octahedral coding would use two numbers instead of three.
    const bool bytes = given["componentType"] == int(int8) && given.value("normalized", false) && unit &&
                       !compressed(accessor) && filters_ && quantize_.on && quantize_.normal_bits <= 8;
    if (!floats(accessor) && !bytes) return accessor;
    const Attribute a = decode_numbers(builder_.current(), accessor);
    if (a.components < 3) return accessor;
    if (!quantize_.on) return replace(accessor, as_floats(a, finest_exponent(a), false));
    auto stored = unit && filters_ ? std::optional(octahedral(a, quantize_.normal_bits))
                                   : signed_fractions(a, quantize_.normal_bits);
    if (!stored) return replace(accessor, as_floats(a, 1 - quantize_.normal_bits, false));
    small_integers_ = true;
    return replace(accessor, std::move(stored));
}

/// Texture coordinates and colours.
std::size_t Store::fraction(std::size_t accessor, const std::string& semantic) {
    if (!readable(accessor) || !floats(accessor)) return accessor;
    const Attribute a = decode_numbers(builder_.current(), accessor);
    if (!quantize_.on) return replace(accessor, as_floats(a, finest_exponent(a), false));
    const bool uv = begins(semantic, "TEXCOORD_");
    const int bits = uv ? quantize_.uv_bits : quantize_.colour_bits;
    // Multiples of 2^-bits have that many significant bits; 65535ths of the same steps have 16.
    if (uv && filters_ && compressed(accessor)) return accessor;
    if (uv && filters_)
        if (auto stored = exponential(a, -bits, false)) return replace(accessor, std::move(stored));
    if (auto stored = fractions(a, bits)) return replace(accessor, std::move(stored));
    if (auto stored = uv ? signed_fractions(a, std::min(bits + 1, 16)) : std::nullopt) {
        small_integers_ = true;
        return replace(accessor, std::move(stored));
    }
    keep(semantic,
         uv ? "stays float32 where it is beyond [-1, 1]" : "stays float32 where it is beyond [0, 1]");
    return replace(accessor, as_floats(a, -bits, false));
}

/// Processes all sets of joints and weights together, because the weights of a vertex sum to one over all
/// sets.
void Store::store_influences(Json& attributes) {
    Influences all;
    std::string key = "influences";
    std::vector<std::string> names;
    for (const char* prefix : {"JOINTS_", "WEIGHTS_"})
        for (int set = 0; attributes.contains(fmt::format("{}{}", prefix, set)); ++set) {
            names.push_back(fmt::format("{}{}", prefix, set));
            const auto accessor = attributes[names.back()].get<std::size_t>();
            if (!readable(accessor)) return;
            Attribute a = decode_numbers(builder_.current(), accessor);
            if (a.components != 4) return;
            (prefix[0] == 'J' ? all.joints : all.weights).push_back(std::move(a));
            key += fmt::format(" {}", accessor);
        }
    if (all.weights.empty() || all.weights.size() != all.joints.size()) return;
    const auto wide = [](const Attribute& a) { return std::holds_alternative<std::vector<float>>(a.data); };
    if (std::none_of(all.weights.begin(), all.weights.end(), wide)) return; // already integers
    const bool known = made_.contains(key + " 0");
    const StoredInfluences stored = known ? StoredInfluences{} : influences(all, quantize_.weight_bits);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto accessor = attributes[names[i]].get<std::size_t>();
        const std::string own = fmt::format("{} {}", key, i);
        if (!known)
            made_[own] =
                replace(accessor, i < stored.joints.size() ? stored.joints[i]
                                                           : stored.weights[i - stored.joints.size()]);
        attributes[names[i]] = made_[own];
    }
}

Json Store::store_target(const Json& target, const std::optional<PositionGrid>& grid) {
    Json stored = target;
    for (auto& item : stored.items()) {
        const std::string& semantic = item.key();
        const auto accessor = item.value().get<std::size_t>();
        if (!readable(accessor)) continue;
        item.value() = made_once(fmt::format("target {} {} {}", semantic, accessor, key_of(grid)), [&] {
            if (semantic == "POSITION") return displacement(accessor, grid);
            if (semantic == "NORMAL" || semantic == "TANGENT") return vector(accessor, false);
            return accessor;
        });
    }
    return stored;
}

Json Store::store_primitive(Json primitive, const std::optional<PositionGrid>& grid) {
    if (!primitive.contains("attributes") || has_extension(primitive, "KHR_draco_mesh_compression"))
        return primitive;
    builder_.release(primitive);
    for (auto& item : primitive["attributes"].items()) {
        const std::string& semantic = item.key();
        const auto accessor = item.value().get<std::size_t>();
        item.value() = made_once(fmt::format("{} {} {}", semantic, accessor, key_of(grid)), [&] {
            if (semantic == "POSITION") return position(accessor, grid);
            if (semantic == "NORMAL" || semantic == "TANGENT") return vector(accessor, true);
            if (begins(semantic, "TEXCOORD_") || begins(semantic, "COLOR_"))
                return fraction(accessor, semantic);
            return accessor;
        });
    }
    if (quantize_.on) store_influences(primitive["attributes"]);
    if (!primitive.contains("targets")) return primitive;
    for (std::size_t t = 0; t < primitive["targets"].size(); ++t)
        primitive["targets"][t] = store_target(primitive["targets"][t], grid);
    return primitive;
}

/// EXT_mesh_manifold refers to the positions of the primitives too.
void Store::store_manifold(Json& mesh) const {
    const Json::json_pointer place("/extensions/EXT_mesh_manifold/manifoldPrimitive/attributes/POSITION");
    if (!mesh.contains(place) || mesh["primitives"].empty()) return;
    const Json& first = mesh["primitives"][0];
    if (first.contains("attributes")) mesh[place] = first["attributes"]["POSITION"];
}

void Store::store_mesh(std::size_t mesh) {
    const std::optional<PositionGrid> grid = quantize_.on ? grid_of(mesh) : std::nullopt;
    for (std::size_t p = 0; p < json_["meshes"][mesh]["primitives"].size(); ++p) {
        Json stored = store_primitive(json_["meshes"][mesh]["primitives"][p], grid);
        json_["meshes"][mesh]["primitives"][p] = std::move(stored);
    }
    store_manifold(json_["meshes"][mesh]);
    if (grid) growth_[mesh] = 1 / grid->step;
    if (grid)
        for (const std::size_t node : nodes_[mesh]) place_grid(node, *grid);
}

// --- the grid in a node

/// True if a node's transform affects only its mesh.
bool stands_alone(const Json& node) {
    if (node.contains("camera") || (node.contains("children") && !node["children"].empty())) return false;
    std::size_t of_mesh = 0;
    for (const char* name : {"MSFT_lod", instancing_extension, instance_features})
        of_mesh += has_extension(node, name);
    return !node.contains("extensions") || node["extensions"].size() == of_mesh;
}

/// The animation of morph weights follows the mesh to the other node.
void move_weights(Json& document, std::size_t from, std::size_t to) {
    if (document["nodes"][from].contains("weights")) {
        document["nodes"][to]["weights"] = document["nodes"][from]["weights"];
        document["nodes"][from].erase("weights");
    }
    if (!document.contains("animations")) return;
    for (Json& animation : document["animations"])
        for (Json& channel : animation["channels"])
            if (channel["target"].value("path", "") == "weights" &&
                channel["target"].value("node", std::size_t{0}) == from && channel["target"].contains("node"))
                channel["target"]["node"] = to;
}

Json three(const Vec3& v) { return Json::array({v.x, v.y, v.z}); }

const Json::json_pointer instance_attributes("/extensions/EXT_mesh_gpu_instancing/attributes");

/// The translations of a node's instances; none when they cannot be read or changed.
std::optional<Attribute> Store::instances_on_grid(std::size_t n, const PositionGrid& grid) {
    const Json& node = json_["nodes"][n];
    if (!node.contains(instance_attributes)) return {};
    for (const auto& item : node[instance_attributes].items())
        if (!readable(item.value().get<std::size_t>())) return {};
    const auto given = instances_of(builder_.current(), n);
    return given ? translations_on_grid(*given, grid) : std::nullopt;
}

/// Adds the origin to each instance, because the node's own transform applies outside of them.
void Store::place_origin_in_instances(std::size_t n, const PositionGrid& grid) {
    const Attribute moved = instances_on_grid(n, grid).value();
    Json& attributes = json_["nodes"][n][instance_attributes];
    const std::size_t made = made_once(fmt::format("instances {} {}", attributes.dump(), key_of(grid)), [&] {
        return builder_.add_stored(plain(moved.data, moved.components, false, false), 0);
    });
    if (attributes.contains("TRANSLATION"))
        builder_.release({{"attributes", {{"old", attributes["TRANSLATION"]}}}});
    attributes["TRANSLATION"] = made;
}

void Store::place_grid(std::size_t n, const PositionGrid& grid) {
    if (json_["nodes"][n].contains(instance_attributes)) {
        place_origin_in_instances(n, grid);
        return place_in_node(n, {{}, grid.step, grid.bits});
    }
    place_in_node(n, grid);
}

void Store::place_in_node(std::size_t n, const PositionGrid& grid) {
    Json& node = json_["nodes"][n];
    if (animated_.contains(n) || joints_.contains(n) || !stands_alone(node)) {
        Json below = {{"mesh", node["mesh"]},
                      {"translation", three(grid.origin)},
                      {"scale", three({grid.step, grid.step, grid.step})}};
        if (node.contains("name")) below["name"] = node["name"];
        node.erase("mesh");
        for (const char* name : {instancing_extension, instance_features}) {
            if (!has_extension(node, name)) continue;
            below["extensions"][name] = node["extensions"][name];
            node["extensions"].erase(name);
            if (node["extensions"].empty()) node.erase("extensions");
        }
        const std::size_t child = builder_.add("nodes", std::move(below));
        Json& children = json_["nodes"][n]["children"];
        if (!children.is_array()) children = Json::array();
        children.push_back(child);
        return move_weights(json_, n, child);
    }
    const Transform& local = frames_[n].local;
    if (node.contains("matrix")) {
        Transform with = local;
        for (auto& row : with.m) {
            for (std::size_t c = 0; c < 3; ++c) row[c] *= grid.step;
        }
        const Vec3 origin = local.point(grid.origin);
        for (std::size_t r = 0; r < 3; ++r) with.m[r][3] = origin[r];
        node["matrix"] = matrix(with);
        return;
    }
    Vec3 scale{1, 1, 1};
    for (std::size_t c = 0; c < 3 && node.contains("scale"); ++c) scale[c] = node["scale"][c].get<double>();
    node["translation"] = three(local.point(grid.origin));
    node["scale"] = three(scale * grid.step);
}

void Store::run() {
    frames_ = node_frames(json_);
    animated_ = animated_nodes(json_);
    nodes_.resize(count_of(json_, "meshes"));
    growth_.resize(nodes_.size(), 1);
    for (std::size_t n = 0; n < frames_.size(); ++n)
        if (frames_[n].mesh >= 0) nodes_[static_cast<std::size_t>(frames_[n].mesh)].push_back(n);
    for (const char* list : {"extensions", "scenes", "nodes", "meshes"})
        if (json_.contains(list))
            see_extension_references(json_[list], list == std::string_view("extensions"),
                                     [&](const std::string& key, std::size_t i) {
                                         if (key == "mesh") fixed_.insert(i);
                                         if (key == "node" && i < frames_.size() && frames_[i].mesh >= 0)
                                             fixed_.insert(static_cast<std::size_t>(frames_[i].mesh));
                                     });
    for (std::size_t s = 0; s < count_of(json_, "skins"); ++s)
        for (const Json& joint : json_["skins"][s].value("joints", Json::array()))
            joints_.insert(joint.get<std::size_t>());
    for (std::size_t mesh = 0; mesh < nodes_.size(); ++mesh) store_mesh(mesh);
    scale_thickness(json_, growth_);
    if (small_integers_) builder_.use_extension("KHR_mesh_quantization", true);
}

} // namespace

StoredMeshes store_meshes(Patch& patch, PartNodes nodes) {
    const MeshoptSettings& meshopt = patch.settings.meshopt;
    if (patch.settings.quantize.on || (meshopt.on && meshopt.filters)) Store(patch, nodes).run();
    return {std::move(nodes.images)};
}

} // namespace facetmill::io::gltf
