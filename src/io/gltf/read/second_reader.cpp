#include "io/gltf/read/second_reader.hpp"

#include "base/fast_json.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/container.hpp"
#include "io/gltf/document/tinygltf_files.hpp"
#include "mesh/drawn_box.hpp"
#include "parallel/memory.hpp"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <set>

namespace facetmill::io::gltf {

namespace {

/// Collects the first differences.
class Differences {
  public:
    void add(std::string text) {
        if (found_.size() < most) found_.push_back(std::move(text));
    }
    template <class A, class B>
    void compare(const std::string& name, const A& ours, const B& theirs) {
        if (!(ours == theirs)) add(fmt::format("{}: {}, tinygltf reads {}", name, ours, theirs));
    }
    std::vector<std::string> take() { return std::move(found_); }

  private:
    static constexpr std::size_t most = 5;
    std::vector<std::string> found_;
};

/// The neighbours of a written file. Images are not decoded, so one byte replaces each.
class WrittenFiles : public TinygltfFiles {
  public:
    explicit WrittenFiles(const Input& file) : file_(file) {}

    bool read(const std::string& path, std::vector<unsigned char>& out, std::string& error) override {
        if (!path.ends_with(".bin")) {
            out.assign(1, 0);
            return true;
        }
        try {
            const Input neighbour = file_.beside(path);
            out.resize(neighbour.bytes().size());
            if (!out.empty()) std::memcpy(out.data(), neighbour.bytes().data(), out.size());
            return true;
        } catch (const Error& e) {
            error = e.diagnostics().front().message;
            return false;
        }
    }

  private:
    const Input& file_;
};

/// Returns tinygltf's error, or an empty text.
std::string load(const Input& file, tinygltf::Model& model) {
    WrittenFiles files(file);
    tinygltf::TinyGLTF loader = loader_for(files);
    const Span bytes = file.bytes();
    std::string error, warning;
    const auto size = static_cast<unsigned>(bytes.size());
    try {
        const bool loaded =
            is_glb(bytes) ? loader.LoadBinaryFromMemory(&model, &error, &warning,
                                                        reinterpret_cast<const unsigned char*>(bytes.data()),
                                                        size, "", tinygltf::NO_REQUIRE)
                          : loader.LoadASCIIFromString(&model, &error, &warning, as_text(bytes).data(), size,
                                                       "", tinygltf::NO_REQUIRE);
        if (loaded) return "";
    } catch (const std::exception& e) { // tinygltf throws for some sizes that it does not check
        return e.what();
    }
    return error.empty() ? "no reason given" : error.substr(0, error.find_last_not_of('\n') + 1);
}

/// The numbers of an accessor as tinygltf stores them. None without a view, with sparse values, or out of
/// range.
struct Numbers {
    const unsigned char* data = nullptr;
    std::size_t count = 0, stride = 0;
    int component_type = 0;
    bool normalised = false;

    double number(std::size_t i, std::size_t component) const {
        const unsigned char* at = data + i * stride;
        const auto read = [&]<class T>(T value) {
            std::memcpy(&value, at + component * sizeof(T), sizeof(T));
            const auto number = static_cast<double>(value);
            if constexpr (std::is_integral_v<T>)
                if (normalised) return std::max(number / std::numeric_limits<T>::max(), -1.0);
            return number;
        };
        switch (component_type) {
        case int8:
            return read(std::int8_t{});
        case uint8:
            return read(std::uint8_t{});
        case int16:
            return read(std::int16_t{});
        case uint16:
            return read(std::uint16_t{});
        case uint32:
            return read(std::uint32_t{});
        default:
            return read(float{});
        }
    }
};

template <class T>
const T* entry(const std::vector<T>& all, int index) {
    return index >= 0 && static_cast<std::size_t>(index) < all.size() ? &all[static_cast<std::size_t>(index)]
                                                                      : nullptr;
}

/// packed: a Draco array, which tinygltf stores without gaps, regardless of its view.
std::optional<Numbers> numbers_of(const tinygltf::Model& model, int index, bool packed) {
    const auto* accessor = entry(model.accessors, index);
    const auto* view = accessor ? entry(model.bufferViews, accessor->bufferView) : nullptr;
    const auto* buffer = view ? entry(model.buffers, view->buffer) : nullptr;
    if (!buffer || accessor->sparse.isSparse) return std::nullopt;
    const int components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor->type));
    const int bytes = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor->componentType));
    if (components <= 0 || bytes <= 0) return std::nullopt;
    const auto element = static_cast<std::size_t>(components) * static_cast<std::size_t>(bytes);
    Numbers all{.count = accessor->count,
                .stride = packed || view->byteStride == 0 ? element : view->byteStride,
                .component_type = accessor->componentType,
                .normalised = accessor->normalized};
    const std::size_t begin = packed ? 0 : view->byteOffset + accessor->byteOffset;
    if (all.count > 0 && begin + (all.count - 1) * all.stride + element > buffer->data.size())
        return std::nullopt;
    all.data = buffer->data.data() + begin;
    return all;
}

/// The contents of a part, as tinygltf reads them.
struct Contents {
    std::size_t triangles = 0, lines = 0;
    Box box;           ///< of the vertices that triangles and lines use
    bool known = true; ///< all positions and indices could be read
};

void add(const tinygltf::Model& model, const tinygltf::Primitive& primitive, Contents& contents) {
    const bool packed = primitive.extensions.contains("KHR_draco_mesh_compression");
    const auto named = primitive.attributes.find("POSITION");
    if (named == primitive.attributes.end()) return;
    if (packed && primitive.indices < 0) { // only the Draco data has the triangles
        contents.known = false;
        return;
    }
    const auto positions = numbers_of(model, named->second, packed);
    const auto indices =
        primitive.indices < 0 ? std::optional<Numbers>() : numbers_of(model, primitive.indices, packed);
    const int mode = primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
    if (!positions || (primitive.indices >= 0 && !indices) ||
        (mode != TINYGLTF_MODE_TRIANGLES && mode != TINYGLTF_MODE_LINE && mode != TINYGLTF_MODE_POINTS)) {
        contents.known = false;
        return;
    }
    const std::size_t corners = indices ? indices->count : positions->count;
    if (mode == TINYGLTF_MODE_TRIANGLES) contents.triangles += corners / 3;
    if (mode == TINYGLTF_MODE_LINE) contents.lines += corners / 2;
    for (std::size_t i = 0; i < corners; ++i) {
        const std::size_t v = indices ? static_cast<std::size_t>(indices->number(i, 0)) : i;
        if (v >= positions->count) {
            contents.known = false;
            return;
        }
        contents.box.add(Vec3{positions->number(v, 0), positions->number(v, 1), positions->number(v, 2)});
    }
}

void compare_parts(const tinygltf::Model& model, const Scene& scene, Differences& differences) {
    std::map<int, Contents> of_meshes;
    for (const Part& part : scene.parts) {
        // Documents may have meshes without nodes.
        const auto* node = entry(model.nodes, part.node);
        const int number = part.node < 0 ? part.source_mesh : node ? node->mesh : -1;
        const auto* mesh = entry(model.meshes, number);
        if (!mesh) {
            differences.add(
                fmt::format("part '{}': tinygltf finds no mesh at node {}", part.name, part.node));
            continue;
        }
        const auto [known, is_new] = of_meshes.try_emplace(number);
        Contents& contents = known->second;
        if (is_new)
            for (const auto& primitive : mesh->primitives) add(model, primitive, contents);
        if (!contents.known) continue;
        differences.compare(fmt::format("faces of '{}'", part.name), part.mesh.face_count(),
                            contents.triangles);
        differences.compare(fmt::format("lines of '{}'", part.name), part.mesh.line_count(), contents.lines);
        if (part.mesh.face_count() == 0) continue;
        const Box box = drawn_box(part.mesh);
        // Both readers convert the same numbers to doubles; only a division may round.
        const double margin = 1e-12 * (length(box.min) + length(box.max));
        if (!(length(box.min - contents.box.min) <= margin && length(box.max - contents.box.max) <= margin))
            differences.add(fmt::format("box of '{}'", part.name));
    }
}

std::size_t size_of_list(const Json& document, const char* name) {
    const auto found = document.find(name);
    return found == document.end() ? 0 : found->size();
}

void compare_counts(const tinygltf::Model& model, const Json& document, Differences& differences) {
    const auto compare = [&](const char* name, std::size_t theirs) {
        differences.compare(name, size_of_list(document, name), theirs);
    };
    compare("scenes", model.scenes.size());
    compare("nodes", model.nodes.size());
    compare("meshes", model.meshes.size());
    compare("materials", model.materials.size());
    compare("textures", model.textures.size());
    compare("images", model.images.size());
    compare("samplers", model.samplers.size());
    compare("skins", model.skins.size());
    compare("animations", model.animations.size());
    compare("cameras", model.cameras.size());
    compare("accessors", model.accessors.size());
}

/// The bounds in the document, as numbers.
std::vector<double> bound(const Json& accessor, const char* name) {
    std::vector<double> all;
    const auto found = accessor.find(name);
    if (found == accessor.end() || !found->is_array()) return all;
    all.reserve(found->size());
    for (const Json& number : *found)
        if (number.is_number()) all.push_back(number.get<double>());
    return all;
}

void compare_accessors(const tinygltf::Model& model, const Json& document, Differences& differences) {
    const auto found = document.find("accessors");
    if (found == document.end()) return;
    for (std::size_t i = 0; i < std::min(found->size(), model.accessors.size()); ++i) {
        const Json& ours = (*found)[i];
        const auto& theirs = model.accessors[i];
        const std::string name = fmt::format("accessors[{}]", i);
        differences.compare(name + ".componentType", ours.value("componentType", 0), theirs.componentType);
        differences.compare(name + ".type", components_of(ours.value("type", std::string())),
                            tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(theirs.type)));
        differences.compare(name + ".count", ours.value("count", std::size_t{0}), theirs.count);
        if (bound(ours, "min") != theirs.minValues || bound(ours, "max") != theirs.maxValues)
            differences.add(name + ": other bounds");
    }
}

/// Whether the accessor has a type for which tinygltf's buffers are large enough.
bool fits_draco(const Json& document, const Json& number) {
    const auto all = document.find("accessors");
    if (!number.is_number_unsigned() || all == document.end() || number.get<std::size_t>() >= all->size())
        return false;
    const Json& accessor = (*all)[number.get<std::size_t>()];
    const int components = components_of(accessor.value("type", std::string()));
    return size_of(accessor.value("componentType", 0)) > 0 && components >= 1 && components <= 4;
}

/// tinygltf trusts Draco data, so it gets only data that our reader has decoded and checked: triangles of the
/// meshes of parts.
bool is_draco_checked(const Json& document, const Scene& scene) {
    std::set<std::size_t> read;
    for (const Part& part : scene.parts)
        if (part.source_mesh >= 0) read.insert(static_cast<std::size_t>(part.source_mesh));
    const auto meshes = document.find("meshes");
    for (std::size_t m = 0; meshes != document.end() && m < meshes->size(); ++m) {
        const Json primitives = (*meshes)[m].value("primitives", Json::array());
        for (const Json& primitive : primitives) {
            const Json extensions = primitive.value("extensions", Json::object());
            if (!extensions.contains("KHR_draco_mesh_compression")) continue;
            if (!read.contains(m) || primitive.value("mode", 4) != 4) return false;
            if (primitive.contains("indices") && !fits_draco(document, primitive["indices"])) return false;
            const Json attributes = primitive.value("attributes", Json::object());
            for (const auto& [name, accessor] : attributes.items())
                if (!fits_draco(document, accessor)) return false;
        }
    }
    return true;
}

/// The reason why tinygltf is not asked, or an empty text.
std::string reason_not_to_ask(const Input& file, const std::string& json) {
    if (json.find("_meshopt_compression\"") != std::string::npos)
        return "tinygltf does not decode meshopt compression";
    constexpr double copies = 2;
    const double bytes = copies * static_cast<double>(file.bytes().size());
    if (file.bytes().size() > UINT32_MAX) return "tinygltf reads at most 4 GiB";
    if (is_much_memory(bytes) && static_cast<double>(memory_left().value_or(0)) < bytes)
        return "there is too little memory for a second reader";
    return "";
}

SecondReading compare(const Input& file, const Scene& scene, const std::string& json) {
    SecondReading reading;
    reading.reader = "tinygltf";
    reading.not_asked = reason_not_to_ask(file, json);
    if (!reading.not_asked.empty()) return reading;
    Json document = parse_document(json);
    const ScopedDestroy destroyed(document);
    if (!is_draco_checked(document, scene)) {
        reading.not_asked = "tinygltf does not check Draco data, and facetmill did not read all of it";
        return reading;
    }
    tinygltf::Model model;
    if (const std::string error = load(file, model); !error.empty()) {
        // It refuses some documents that others accept, for example with an empty skin.
        reading.not_asked = "tinygltf cannot read it: " + error.substr(0, error.find('\n'));
        return reading;
    }
    Differences differences;
    compare_counts(model, document, differences);
    compare_accessors(model, document, differences);
    compare_parts(model, scene, differences);
    reading.differences = differences.take();
    return reading;
}

} // namespace

SecondReading read_again(const Input& file, const Scene& scene) {
    if (scene.documents.size() != 1) return {};
    try {
        return compare(file, scene, scene.documents.front()->json);
    } catch (const Json::exception&) {
        SecondReading reading;
        reading.reader = "tinygltf";
        reading.not_asked = "members of the document do not have the types that glTF requires";
        return reading;
    }
}

} // namespace facetmill::io::gltf
