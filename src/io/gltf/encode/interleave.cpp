// Interleaves the attributes of each vertex, as GPUs read them.

#include "io/gltf/encode/encode.hpp"
#include "io/gltf/numbers/quantise.hpp"
#include "io/gltf/write/patch.hpp"

#include <cstring>
#include <numeric>

namespace facetmill::io::gltf {

namespace {

constexpr std::size_t greatest_stride = 252; // glTF's limit

class Interleave {
  public:
    explicit Interleave(Builder& builder) : builder_(builder), json_(builder.json()) {}

    void run();

  private:
    bool suits(std::size_t accessor);
    std::size_t group_of(std::size_t accessor);
    void join_accessors();
    void store(const std::vector<std::size_t>& accessors);
    void store_view(const std::vector<std::size_t>& accessors, const std::vector<Bytes>& elements);
    void point_at_new(Json& attributes);

    Builder& builder_;
    Json& json_;
    std::vector<std::size_t>
        group_; ///< [accessors] another member of the group; the last member refers to itself
    std::vector<std::size_t> used_; ///< accessors of attributes, in order of first use
    std::map<std::size_t, std::size_t> new_accessor_;
};

template <class Call>
void each_attributes(Json& document, Call&& call) {
    for (std::size_t m = 0; m < count_of(document, "meshes"); ++m)
        for (Json& primitive : document["meshes"][m]["primitives"]) {
            const Json::json_pointer draco("/extensions/KHR_draco_mesh_compression");
            if (primitive.contains("attributes") && !primitive.contains(draco)) call(primitive["attributes"]);
        }
}

/// True if the accessor has its own bytes, without gaps between elements.
bool Interleave::suits(std::size_t accessor) {
    if (accessor >= count_of(json_, "accessors")) return false;
    const Json& a = json_["accessors"][accessor];
    return a.contains("bufferView") && !a.contains("sparse") && a.value("count", std::size_t{0}) > 0 &&
           !a["type"].get_ref<const std::string&>().starts_with("MAT") &&
           !builder_.current().without_bytes(a["bufferView"].get<std::size_t>());
}

std::size_t Interleave::group_of(std::size_t accessor) {
    while (group_[accessor] != accessor) accessor = group_[accessor] = group_[group_[accessor]];
    return accessor;
}

/// Groups the accessors of each primitive; groups with a common accessor are merged.
void Interleave::join_accessors() {
    group_.resize(count_of(json_, "accessors"));
    std::iota(group_.begin(), group_.end(), std::size_t{0});
    std::set<std::size_t> met;
    each_attributes(json_, [&](Json& attributes) {
        std::optional<std::size_t> first;
        for (const auto& [name, reference] : attributes.items()) {
            const auto accessor = reference.template get<std::size_t>();
            if (!suits(accessor)) continue;
            if (met.insert(accessor).second) used_.push_back(accessor);
            if (!first) first = accessor;
            if (json_["accessors"][accessor]["count"] == json_["accessors"][*first]["count"])
                group_[group_of(accessor)] = group_of(*first);
        }
    });
}

void Interleave::store_view(const std::vector<std::size_t>& accessors, const std::vector<Bytes>& elements) {
    const auto count = json_["accessors"][accessors.front()]["count"].get<std::size_t>();
    std::vector<std::size_t> offsets;
    std::size_t stride = 0;
    for (const Bytes& bytes : elements) {
        offsets.push_back(stride);
        stride += bytes.size() / count;
    }
    Bytes all(stride * count);
    for (std::size_t e = 0; e < elements.size(); ++e) {
        const std::size_t size = elements[e].size() / count;
        for (std::size_t i = 0; i < count; ++i)
            std::memcpy(all.data() + i * stride + offsets[e], elements[e].data() + i * size, size);
    }
    const std::size_t view = builder_.add_view(std::move(all), array_buffer, stride);
    for (std::size_t e = 0; e < accessors.size(); ++e) {
        Json accessor = json_["accessors"][accessors[e]];
        accessor["bufferView"] = view;
        accessor["byteOffset"] = offsets[e];
        if (offsets[e] == 0) accessor.erase("byteOffset");
        builder_.release({{"attributes", {{"old", accessors[e]}}}});
        new_accessor_[accessors[e]] = builder_.add_accessor(std::move(accessor));
    }
}

/// Uses as few views as the maximum stride allows.
void Interleave::store(const std::vector<std::size_t>& accessors) {
    std::vector<std::size_t> together;
    std::vector<Bytes> elements;
    std::size_t stride = 0;
    const auto finish = [&] {
        if (together.size() > 1) store_view(together, elements);
        together.clear();
        elements.clear();
        stride = 0;
    };
    for (const std::size_t index : accessors) {
        const Json reference = index;
        const Accessor a = accessor(builder_.current(), JsonCursor(reference, "accessors"));
        Bytes bytes = plain(decode(builder_.current(), a), a.components, a.normalised, false).bytes;
        const std::size_t size = bytes.size() / a.count;
        if (stride + size > greatest_stride) finish();
        stride += size;
        together.push_back(index);
        elements.push_back(std::move(bytes));
    }
    finish();
}

void Interleave::point_at_new(Json& attributes) {
    for (auto& item : attributes.items())
        if (const auto found = new_accessor_.find(item.value().get<std::size_t>());
            found != new_accessor_.end())
            item.value() = found->second;
}

void Interleave::run() {
    join_accessors();
    std::map<std::size_t, std::vector<std::size_t>> groups;
    for (const std::size_t accessor : used_) groups[group_of(accessor)].push_back(accessor);
    for (const auto& [_, accessors] : groups) store(accessors);
    each_attributes(json_, [&](Json& attributes) { point_at_new(attributes); });
    const Json::json_pointer manifold("/extensions/EXT_mesh_manifold/manifoldPrimitive/attributes");
    for (std::size_t m = 0; m < count_of(json_, "meshes"); ++m)
        if (json_["meshes"][m].contains(manifold)) point_at_new(json_["meshes"][m][manifold]);
}

} // namespace

void interleave_attributes(Patch& patch, const StoredMeshes&) {
    if (patch.settings.interleave) Interleave(patch.builder).run();
}

} // namespace facetmill::io::gltf
