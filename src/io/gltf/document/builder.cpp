#include "io/gltf/document/builder.hpp"

#include "base/fast_json.hpp"
#include "base/math/random.hpp"
#include "base/progress.hpp"
#include "io/gltf/encode/encode.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace facetmill::io::gltf {

namespace {

const char* name_of(const MeshoptSettings& settings) {
    return meshopt_names[settings.extension == MeshoptSettings::Extension::khr ? 1 : 0];
}

using Numbers = std::set<std::size_t>;

/// [count] 1 for the numbers below count that are in the set.
std::vector<std::uint8_t> flags_of(const Numbers& numbers, std::size_t count) {
    std::vector<std::uint8_t> flags(count);
    for (auto n = numbers.begin(); n != numbers.end() && *n < count; ++n) flags[*n] = 1;
    return flags;
}

/// Clears the flag of the referenced item.
void keep(std::vector<std::uint8_t>& flags, const Json& reference) {
    if (const auto n = reference.get<std::size_t>(); n < flags.size()) flags[n] = 0;
}

Numbers numbers_of(const std::vector<std::uint8_t>& flags) {
    Numbers numbers;
    for (std::size_t n = 0; n < flags.size(); ++n)
        if (flags[n]) numbers.insert(numbers.end(), n);
    return numbers;
}

void erase_positions(std::vector<std::size_t>& list, const Numbers& positions) {
    const auto gone = flags_of(positions, list.size());
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < list.size(); ++i)
        if (!gone[i]) kept.push_back(list[i]);
    list = std::move(kept);
}

Json with_view(std::size_t view, Json accessor) {
    Json with = object_of("bufferView", view);
    for (auto& [key, value] : accessor.get_ref<Json::object_t&>()) with[key] = std::move(value);
    return with;
}

std::uint64_t hash_of(const Bytes& bytes, const std::string& text) {
    const std::hash<std::string_view> hash;
    return hashed(hash(as_text(bytes)), hash(text));
}

// References to single items, see the end of this file.
using Visit = std::function<void(Json&)>;
void primitive_accessors(Json& primitive, const Visit& visit);
void primitive_views(Json& primitive, const Visit& visit);
void mesh_accessors(Json& mesh, const Visit& visit);
void mesh_views(Json& mesh, const Visit& visit);
void accessor_views(Json& accessor, const Visit& visit);
void other_views(Json& document, const Visit& visit);

} // namespace

Builder::Builder(Json document, const std::vector<Bytes>* buffers)
    : original_(document), json_(std::move(document)), source_(original_, buffers ? *buffers : no_buffers_),
      current_(json_, buffers ? *buffers : no_buffers_, &new_views_) {
    for (std::size_t i = 0; i < count_of(json_, "bufferViews"); ++i) old_view_.push_back(i);
}

Builder::~Builder() {
    destroy(original_);
    destroy(json_);
}

std::size_t Builder::add(const char* name, Json value) {
    Json& items = json_[name];
    if (!items.is_array()) items = Json::array();
    items.push_back(std::move(value));
    return items.size() - 1;
}

std::size_t Builder::add_view(Bytes bytes, int target, std::size_t stride) {
    Json view = object_of("buffer", 0, "byteLength", bytes.size());
    if (stride) view["byteStride"] = stride;
    if (target) view["target"] = target;
    const std::size_t index = add("bufferViews", std::move(view));
    old_view_.push_back(index);
    new_views_[index] = std::move(bytes);
    return index;
}

std::size_t Builder::add_accessor(Json accessor) { return add("accessors", std::move(accessor)); }

std::size_t Builder::add_stored(Stored stored, int target) {
    if (target != 0)
        return add_shared(std::move(stored.bytes), target, stored.stride, std::move(stored.accessor),
                          stored.filter);
    const std::size_t view = add_view(std::move(stored.bytes), target, stored.stride);
    if (!stored.filter.empty()) filters_[view] = std::move(stored.filter);
    return add_accessor(with_view(view, std::move(stored.accessor)));
}

std::size_t Builder::add_shared(Bytes bytes, int target, std::size_t stride, Json accessor,
                                const std::string& filter) {
    auto& known = shared_accessors_[hash_of(bytes, to_string(accessor))];
    const auto same = [&](std::size_t a) {
        const Json& other = json_["accessors"][a];
        const auto view = other["bufferView"].get<std::size_t>();
        const auto of = filters_.find(view);
        const Json& view_json = json_["bufferViews"][view];
        return other == with_view(view, accessor) && new_views_[view] == bytes &&
               view_json.value("target", 0) == target &&
               view_json.value("byteStride", std::size_t{0}) == stride &&
               (of == filters_.end() ? filter.empty() : of->second == filter);
    };
    const auto found = std::find_if(known.begin(), known.end(), same);
    if (found != known.end()) return *found;
    const std::size_t view = add_view(std::move(bytes), target, stride);
    if (!filter.empty()) filters_[view] = filter;
    known.push_back(add_accessor(with_view(view, std::move(accessor))));
    return known.back();
}

std::size_t Builder::add_positions(Stored stored, std::vector<Vec3> exact) {
    const std::size_t before = count_of(json_, "accessors");
    std::size_t added = add_shared(Bytes(stored.bytes), array_buffer, stored.stride, stored.accessor);
    if (added < before) {
        const auto other = exact_positions.find(added);
        if (other != exact_positions.end() && other->second == exact) return added;
        const std::size_t view = add_view(std::move(stored.bytes), array_buffer, stored.stride);
        added = add_accessor(with_view(view, std::move(stored.accessor)));
    }
    exact_positions[added] = std::move(exact);
    return added;
}

Json Builder::add_compressed(Bytes bytes, const std::string& names, const std::function<Json()>& make) {
    auto& known = compressed_[names];
    for (const auto& [view, primitive] : known)
        if (new_views_[view] == bytes) return primitive;
    Json primitive = make();
    const std::size_t view = add_view(std::move(bytes));
    primitive["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = view;
    known.emplace_back(view, primitive);
    return primitive;
}

void Builder::release(const Json& primitive) {
    Json visited = primitive; // the visitor may change it
    primitive_accessors(visited, [&](Json& r) { released_accessors_.insert(r.get<std::size_t>()); });
    primitive_views(visited, [&](Json& r) { released_views_.insert(r.get<std::size_t>()); });
}

void Builder::release_mesh(const Json& mesh) {
    Json visited = mesh; // the visitor may change it
    mesh_accessors(visited, [&](Json& r) { released_accessors_.insert(r.get<std::size_t>()); });
    mesh_views(visited, [&](Json& r) { released_views_.insert(r.get<std::size_t>()); });
}

void Builder::use_extension(const std::string& name, bool required) {
    add_name(json_, "extensionsUsed", name);
    if (required) add_name(json_, "extensionsRequired", name);
}

void Builder::drop_extension(const std::string& name) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        remove_name(json_, list, name);
        erase_empty(json_, list);
    }
}

void Builder::drop_released() {
    if (released_accessors_.empty() && released_views_.empty()) return;
    auto dead_accessors = flags_of(released_accessors_, count_of(json_, "accessors")),
         dead_views = flags_of(released_views_, count_of(json_, "bufferViews"));
    Json& all_accessors = json_["accessors"];
    visit_accessor_references(json_, [&](Json& r) { keep(dead_accessors, r); });
    // References from dropped accessors do not count as use.
    for (std::size_t a = 0; a < dead_accessors.size(); ++a)
        if (dead_accessors[a])
            accessor_views(all_accessors[a], [&](Json& r) {
                if (const auto v = r.get<std::size_t>(); v < dead_views.size()) dead_views[v] = 1;
            });
    for (std::size_t a = 0; a < dead_accessors.size(); ++a)
        if (dead_accessors[a])
            all_accessors[a] = nullptr; // unknown extensions of a dropped accessor do not matter
        else
            accessor_views(all_accessors[a], [&](Json& r) { keep(dead_views, r); });
    other_views(json_, [&](Json& r) { keep(dead_views, r); });
    const Numbers accessors = numbers_of(dead_accessors), views = numbers_of(dead_views);

    if (may_name_accessors(json_)) {
        // Unknown extensions may refer to accessors and views by number, so dead ones stay as empty
        // placeholders.
        for (const std::size_t a : accessors)
            all_accessors[a] = {{"componentType", int(uint8)}, {"count", 1}, {"type", "SCALAR"}};
        for (const std::size_t v : views) {
            json_["bufferViews"][v] = {{"buffer", 0}, {"byteLength", 1}};
            new_views_[v] = Bytes(1);
        }
        return;
    }
    erase_items(json_["accessors"], accessors,
                [&](const auto& visit) { visit_accessor_references(json_, visit); });
    erase_items(json_["bufferViews"], views, [&](const auto& visit) { visit_view_references(json_, visit); });
    erase_positions(old_view_, views);
}

std::vector<std::optional<Packing>> Builder::packings_now() const {
    std::map<std::size_t, std::string> filters; // filters by current view index
    for (std::size_t i = 0; i < old_view_.size(); ++i)
        if (const auto filter = filters_.find(old_view_[i]); filter != filters_.end())
            filters[i] = filter->second;
    return packings(json_, filters);
}

/// Merges new views of the same kind, which needs less JSON and compresses better.
void Builder::join_views() {
    if (may_name_accessors(json_)) return;
    const auto how = packings_now();
    std::map<std::string, std::size_t> first;
    std::map<std::size_t, std::pair<std::size_t, std::size_t>> moved; // target view and byte offset
    std::set<std::size_t> joined;
    for (std::size_t i = 0; i < how.size(); ++i) {
        if (!how[i] || how[i]->kind.empty() || !new_views_.contains(old_view_[i])) continue;
        const auto [at, is_first] = first.emplace(how[i]->kind, i);
        if (is_first) continue;
        Bytes& to = new_views_[old_view_[at->second]];
        Bytes& from = new_views_[old_view_[i]];
        moved[i] = {at->second, to.size()};
        to.insert(to.end(), from.begin(), from.end());
        from = {};
        joined.insert(i);
        Json& view = json_["bufferViews"][at->second];
        view["byteLength"] = to.size();
        // glTF requires an explicit stride when accessors share vertex data.
        if (view.value("target", 0) == array_buffer && !view.contains("byteStride"))
            view["byteStride"] = how[i]->stride;
    }
    for (Json& accessor : json_["accessors"]) {
        if (!accessor.contains("bufferView")) continue;
        const auto at = moved.find(accessor["bufferView"].get<std::size_t>());
        if (at == moved.end()) continue;
        accessor["bufferView"] = at->second.first;
        accessor["byteOffset"] = accessor.value("byteOffset", std::size_t{0}) + at->second.second;
    }
    erase_items(json_["bufferViews"], joined,
                [&](const auto& visit) { visit_view_references(json_, visit); });
    erase_positions(old_view_, joined);
}

/// True if a compressed view of the source is copied unchanged.
bool Builder::passes_through(std::size_t i) const {
    if (!meshopt_.on || new_views_.contains(old_view_[i])) return false;
    const Json* compressed = compression_of(json_["bufferViews"][i]);
    if (!compressed) return false;
    if (meshopt_.extension == MeshoptSettings::Extension::khr) return true;
    const Span bytes = source_.range(JsonCursor(*compressed, "bufferViews"));
    const bool version_1 = !bytes.empty() && bytes[0] == std::byte{0xA1};
    return !version_1 && compressed->value("filter", "") != "COLOR";
}

/// The streams of the views; empty for views written uncompressed because compression would not pay off.
std::vector<Bytes> Builder::packed_views(const std::vector<std::optional<Packing>>& how) {
    constexpr std::size_t json_bytes = 160; // bytes of JSON for the extension's object
    std::vector<Bytes> packed(old_view_.size());
    if (how.empty()) return packed;
    std::vector<Span> plain(old_view_.size());
    const int version = meshopt_.extension == MeshoptSettings::Extension::khr ? 1 : 0;
    for (std::size_t i = 0; i < plain.size() && i < how.size(); ++i) {
        const auto added = new_views_.find(old_view_[i]);
        if (!how[i] || passes_through(i)) continue;
        if (added == new_views_.end() && source_.without_bytes(old_view_[i])) continue;
        plain[i] = added != new_views_.end() ? Span(added->second) : source_.view(old_view_[i]);
    }
    ProgressScope::report_next_loop();
    parallel_for(
        packed.size(),
        [&](std::size_t i) {
            if (plain[i].empty()) return;
            Bytes stream = encode_meshopt(plain[i], *how[i], version);
            if (!how[i]->filter.empty() || stream.size() + json_bytes < plain[i].size())
                packed[i] = std::move(stream);
        },
        1);
    return packed;
}

/// Appends a stream to the buffer, and returns its view. The view then refers to the fallback buffer without
/// data.
Json Builder::pack_view(std::size_t i, const std::optional<Packing>& packing, const Bytes& packed,
                        Bytes& buffer) {
    Json view = json_["bufferViews"][i], extension = Json::object();
    if (packed.empty()) {
        const Json original = *compression_of(view);
        const Span bytes = source_.range(JsonCursor(original, "bufferViews"));
        extension = original;
        extension["byteOffset"] = buffer.size();
        buffer.insert(buffer.end(), bytes.begin(), bytes.end());
    } else {
        extension = {{"buffer", 0},
                     {"byteOffset", buffer.size()},
                     {"byteLength", packed.size()},
                     {"byteStride", packing->stride},
                     {"mode", packing->mode},
                     {"count", packing->count}};
        if (!packing->filter.empty()) extension["filter"] = packing->filter;
        buffer.insert(buffer.end(), packed.begin(), packed.end());
    }
    extension["buffer"] = 0;
    for (const char* name : meshopt_names)
        if (view.contains("extensions")) view["extensions"].erase(name);
    view["extensions"][name_of(meshopt_)] = std::move(extension);
    view["buffer"] = 1;
    view["byteOffset"] = unpacked_bytes_;
    unpacked_bytes_ += (view["byteLength"].get<std::size_t>() + 3) / 4 * 4;
    return view;
}

Bytes Builder::build_buffer(std::vector<Diagnostic>& warnings) {
    Bytes buffer;
    bool decompressed = false;
    const auto how = meshopt_.on ? packings_now() : std::vector<std::optional<Packing>>{};
    const std::vector<Bytes> packed = packed_views(how);
    for (std::size_t i = 0; i < old_view_.size(); ++i) {
        Json& view = json_["bufferViews"][i];
        const auto added = new_views_.find(old_view_[i]);
        if (added == new_views_.end() && source_.without_bytes(old_view_[i])) {
            dataless_[view["buffer"].get<std::size_t>()].push_back(i);
            continue;
        }
        while (buffer.size() % 4 != 0) buffer.push_back(std::byte{0});
        if (!packed[i].empty() || passes_through(i)) {
            view = pack_view(i, packed[i].empty() ? std::nullopt : how[i], packed[i], buffer);
            continue;
        }
        const Span bytes = added != new_views_.end() ? Span(added->second) : source_.view(old_view_[i]);
        view["buffer"] = 0;
        view["byteOffset"] = buffer.size();
        view["byteLength"] = bytes.size();
        for (const char* name : meshopt_names) {
            if (!view.contains("extensions") || view["extensions"].erase(name) == 0) continue;
            decompressed = true;
            if (view["extensions"].empty()) view.erase("extensions");
        }
        buffer.insert(buffer.end(), bytes.begin(), bytes.end());
    }
    if (decompressed && !meshopt_.on)
        warnings.push_back(
            {Severity::warning,
             "W-MESHOPT",
             "the meshopt compression of the input is not written: the data is stored uncompressed",
             {},
             "write: {meshopt: true} compresses it"});
    for (const char* name : meshopt_names) drop_extension(name);
    if (unpacked_bytes_ > 0) use_extension(name_of(meshopt_), true);
    return buffer;
}

Bytes Builder::finish(std::vector<Diagnostic>& warnings) {
    for (const char* name : {"accessors", "bufferViews"})
        if (!json_.contains(name)) json_[name] = Json::array();
    drop_released();
    if (meshopt_.on) join_views();
    Bytes buffer = build_buffer(warnings);
    for (const char* name : {"accessors", "bufferViews", "meshes", "nodes", "materials"})
        erase_empty(json_, name);
    list_buffers(buffer.size());
    return buffer;
}

/// Lists the buffer with all bytes, then buffers without data, which glTF allows for external sources.
void Builder::list_buffers(std::size_t bytes) {
    const Json before = json_.contains("buffers") ? json_["buffers"] : Json::array();
    json_.erase("buffers");
    if (bytes > 0) {
        Json first = before.empty() ? Json::object() : before[0];
        first.erase("uri");
        first.erase("extensions");
        first["byteLength"] = bytes;
        add("buffers", std::move(first));
    }
    if (unpacked_bytes_ > 0)
        add("buffers",
            {{"byteLength", unpacked_bytes_}, {"extensions", {{name_of(meshopt_), {{"fallback", true}}}}}});
    for (const auto& [buffer, views] : dataless_) {
        const std::size_t index = add("buffers", before[buffer]);
        for (const std::size_t view : views) json_["bufferViews"][view]["buffer"] = index;
    }
}

// --- references

namespace {

/// The member of an object, or null when there is none.
Json* member(Json* object, const char* key) {
    if (!object || !object->is_object()) return nullptr;
    const auto it = object->find(key);
    return it == object->end() ? nullptr : &*it;
}

Json* extension(Json* object, const char* name) { return member(member(object, "extensions"), name); }

void each(Json* list, const Visit& visit) {
    if (list && list->is_array())
        for (auto& value : *list) visit(value);
}

void reference(Json* value, const Visit& visit) {
    if (value && value->is_number()) visit(*value);
}

void all_members(Json* object, const Visit& visit) {
    if (object && object->is_object())
        for (auto& [key, value] : object->items()) reference(&value, visit);
}

void primitive_accessors(Json& primitive, const Visit& visit) {
    reference(member(&primitive, "indices"), visit);
    all_members(member(&primitive, "attributes"), visit);
    each(member(&primitive, "targets"), [&](Json& target) { all_members(&target, visit); });
}

bool known(const std::string& name) {
    static const std::set<std::string, std::less<>> names = {"KHR_draco_mesh_compression",
                                                             "KHR_mesh_quantization",
                                                             "EXT_meshopt_compression",
                                                             "KHR_meshopt_compression",
                                                             "EXT_mesh_manifold",
                                                             "EXT_mesh_gpu_instancing",
                                                             "EXT_instance_features",
                                                             "KHR_lights_punctual",
                                                             "KHR_xmp_json_ld",
                                                             "KHR_node_visibility",
                                                             "MSFT_lod",
                                                             "MSFT_texture_dds",
                                                             "EXT_lights_image_based",
                                                             "EXT_mesh_features",
                                                             "EXT_structural_metadata"};
    const auto starts = [&](const char* prefix) { return name.rfind(prefix, 0) == 0; };
    return names.count(name) > 0 || starts("KHR_materials_") || starts("KHR_texture_") ||
           starts("EXT_texture_");
}

void mesh_accessors(Json& mesh, const Visit& visit) {
    each(member(&mesh, "primitives"), [&](Json& p) { primitive_accessors(p, visit); });
    if (Json* manifold = extension(&mesh, "EXT_mesh_manifold")) {
        if (Json* p = member(manifold, "manifoldPrimitive")) primitive_accessors(*p, visit);
        reference(member(manifold, "mergeIndices"), visit);
        reference(member(manifold, "mergeValues"), visit);
    }
}

void primitive_views(Json& primitive, const Visit& visit) {
    reference(member(extension(&primitive, "KHR_draco_mesh_compression"), "bufferView"), visit);
}

void mesh_views(Json& mesh, const Visit& visit) {
    each(member(&mesh, "primitives"), [&](Json& p) { primitive_views(p, visit); });
}

void accessor_views(Json& accessor, const Visit& visit) {
    reference(member(&accessor, "bufferView"), visit);
    Json* sparse = member(&accessor, "sparse");
    reference(member(member(sparse, "indices"), "bufferView"), visit);
    reference(member(member(sparse, "values"), "bufferView"), visit);
}

/// Visits references to views from everything except accessors.
void other_views(Json& document, const Visit& visit) {
    each(member(&document, "images"), [&](Json& image) { reference(member(&image, "bufferView"), visit); });
    each(member(&document, "meshes"), [&](Json& mesh) { mesh_views(mesh, visit); });
    each(member(extension(&document, "EXT_structural_metadata"), "propertyTables"), [&](Json& table) {
        Json* properties = member(&table, "properties");
        if (!properties || !properties->is_object()) return;
        for (auto& [name, property] : properties->items())
            for (const char* column : {"values", "arrayOffsets", "stringOffsets"})
                reference(member(&property, column), visit);
    });
}

} // namespace

void visit_accessor_references(Json& document, const Visit& visit) {
    each(member(&document, "meshes"), [&](Json& mesh) { mesh_accessors(mesh, visit); });
    each(member(&document, "animations"), [&](Json& animation) {
        each(member(&animation, "samplers"), [&](Json& sampler) {
            reference(member(&sampler, "input"), visit);
            reference(member(&sampler, "output"), visit);
        });
    });
    each(member(&document, "skins"),
         [&](Json& skin) { reference(member(&skin, "inverseBindMatrices"), visit); });
    each(member(&document, "nodes"), [&](Json& node) {
        all_members(member(extension(&node, "EXT_mesh_gpu_instancing"), "attributes"), visit);
    });
}

void visit_view_references(Json& document, const Visit& visit) {
    each(member(&document, "accessors"), [&](Json& accessor) { accessor_views(accessor, visit); });
    other_views(document, visit);
}

void see_view_references(const Json& document, const std::function<void(const Json&)>& see) {
    // Does not modify the document: the visitor gets mutable references, and `see` takes them as const.
    visit_view_references(const_cast<Json&>(document), [&](Json& r) { see(r); });
}

void visit_mesh_references(Json& document, const Visit& visit) {
    each(member(&document, "nodes"), [&](Json& node) { reference(member(&node, "mesh"), visit); });
}

namespace {

/// True if the content may name an item: by a number, or by a JSON pointer.
bool may_name(const Json& content) {
    if (content.is_number_integer()) return true;
    if (content.is_string()) return content.get_ref<const std::string&>().starts_with('/');
    if (!content.is_structured()) return false;
    return std::any_of(content.begin(), content.end(), may_name);
}

/// True if any extension matches whose content may name an item.
template <class Matches>
bool any_extension(const Json& json, const Matches& matches) {
    if (json.is_object()) {
        for (const auto& [key, value] : json.get_ref<const Json::object_t&>()) {
            if (!value.is_structured() || key == "extras") continue;
            if (key == "extensions" && value.is_object())
                for (const auto& [name, content] : value.items())
                    if (matches(name) && may_name(content)) return true;
            if (any_extension(value, matches)) return true;
        }
    } else if (json.is_array()) {
        for (const auto& value : json)
            if (value.is_structured() && any_extension(value, matches)) return true;
    }
    return false;
}

/// Extensions that refer to nodes, meshes, materials and others, never to accessors and views.
bool names_no_accessors(const std::string& name) {
    static const std::set<std::string, std::less<>> names = {
        "KHR_animation_pointer", "KHR_interactivity",   "KHR_node_selectability",
        "KHR_node_hoverability", "KHR_implicit_shapes", "KHR_physics_rigid_bodies"};
    return names.contains(name);
}

} // namespace

bool has_unknown_extensions(const Json& document) {
    return any_extension(document, [](const std::string& name) { return !known(name); });
}

bool may_name_accessors(const Json& document) {
    return any_extension(document,
                         [](const std::string& name) { return !known(name) && !names_no_accessors(name); });
}

void erase_items(Json& list, const std::set<std::size_t>& items,
                 const std::function<void(const std::function<void(Json&)>&)>& references) {
    if (items.empty()) return;
    const auto gone = flags_of(items, list.size());
    std::vector<std::size_t> number;
    Json::array_t kept;
    kept.reserve(list.size());
    for (std::size_t i = 0; i < gone.size(); ++i) {
        number.push_back(kept.size());
        if (!gone[i]) kept.push_back(std::move(list[i]));
    }
    list = std::move(kept);
    references([&](Json& reference) {
        const auto old = reference.get<std::size_t>();
        if (old < number.size()) reference = number[old];
    });
}

} // namespace facetmill::io::gltf
