// Moves animations, instances and bind matrices into separate views, so that meshopt can compress them.
// Rotations use its filter QUATERNION; translations, animated scales and morph weights use EXPONENTIAL; the
// rest is lossless.

#include "io/gltf/contents/motion.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/numbers/compress.hpp"
#include "io/gltf/numbers/quantise.hpp"
#include "io/gltf/write/patch.hpp"

#include <cmath>
#include <fmt/format.h>
#include <span>

namespace facetmill::io::gltf {

namespace {

constexpr int finest = -1000; ///< exponent at which the largest number keeps all bits

/// What numbers are for, and how exact they must be.
struct StreamUse {
    std::string path{};    ///< of an animation, or "turn" and "place" of instances; empty: exact
    int exponent = finest; ///< of places
    double limit = 0;      ///< of differences in animations; 0: the usual precision
};

class Streams {
  public:
    explicit Streams(Patch& patch)
        : builder_(patch.builder), json_(patch.builder.json()), filters_(patch.settings.meshopt.filters) {
        if (patch.settings.quantize.on) find_limits(std::ldexp(1.0, -patch.settings.position_bits()));
    }

    void run();

  private:
    void store(Json& reference, const StreamUse& use);
    std::optional<Stored> stored(std::size_t accessor, const StreamUse& use);
    void find_limits(double ratio);
    double limit(const Json& target) const;
    void store_animation(Json& animation);
    void store_instances(Json& attributes, bool on_grid);
    bool on_grid(const Json& node) const;

    Builder& builder_;
    Json& json_;
    bool filters_;
    std::optional<MotionLimits> limits_;      ///< of the document's nodes as they were read
    std::map<std::string, std::size_t> made_; ///< new accessors by old accessor and purpose
};

/// Bits of animated translations, scales and morph weights over their largest extent: half a step is below a
/// hundred-thousandth.
constexpr int path_bits = 16;

/// Stores numbers that round to fractions from 0 to 1 as plain uint16, if this is smaller than the stream of
/// floats.
std::optional<Stored> shorts(const Attribute& a, const Stored& floats) {
    std::vector<std::uint16_t> all;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double x = std::floor(a.value(i, 0) * 65535 + 0.5);
        if (a.components != 1 || !(x >= 0 && x <= 65535)) return {};
        all.push_back(static_cast<std::uint16_t>(x));
    }
    const Packing packing{"ATTRIBUTES", floats.filter, sizeof(float), all.size()};
    constexpr std::size_t json_bytes = 160; // bytes of JSON for the extension's object
    const Span bytes = std::as_bytes(std::span(all));
    if (encode_meshopt(floats.bytes, packing, 0).size() + json_bytes <= bytes.size()) return {};
    return Stored{
        {{"componentType", int(uint16)}, {"normalized", true}, {"count", all.size()}, {"type", "SCALAR"}},
        {bytes.begin(), bytes.end()}};
}

/// True if two neighbouring keys are about half a turn apart. Rounding could then change the sign of their
/// product, and interpolation would go the other way round.
bool has_half_turns(const Attribute& keys, double limit) {
    const double rounding = std::max(1e-3, 2 * limit); // of the product: ten times the error of the filter
    for (std::size_t i = 1; i < keys.size() && keys.components == 4; ++i) {
        double along = 0;
        for (int c = 0; c < 4; ++c) along += keys.value(i - 1, c) * keys.value(i, c);
        if (std::abs(along) < rounding) return true;
    }
    return false;
}

/// The coarsest exponent at which three numbers together are off by at most the limit.
int exponent_within(double limit) {
    constexpr double root_of_three = 1.7320508075688773;
    return limit > 0 ? std::ilogb(2 * limit / root_of_three) : finest;
}

std::optional<Stored> Streams::stored(std::size_t index, const StreamUse& use) {
    const auto& [path, exponent, limit] = use;
    const Json& given = json_["accessors"][index];
    if (!given.contains("bufferView") || given.contains("sparse")) return {};
    if (builder_.current().without_bytes(given["bufferView"].get<std::size_t>())) return {};
    const Attribute numbers = decode_numbers(builder_.current(), index);
    const bool floats = given["componentType"] == int(float32);
    std::optional<Stored> coded;
    const bool turns = path == "turn" || (path == "rotation" && !has_half_turns(numbers, limit));
    if (filters_ && floats && turns && numbers.components == 4)
        coded = quaternions(numbers, limit > 0 ? bits_of_turns(numbers, limit) : 16);
    if (filters_ && floats && (path == "translation" || path == "weights"))
        coded = exponential(numbers,
                            std::max({exponent_of_range(numbers, path_bits), exponent_within(limit),
                                      finest_exponent(numbers)}),
                            false);
    if (filters_ && floats && path == "place")
        coded = exponential(numbers, std::max(exponent, finest_exponent(numbers)), false);
    if (coded && path == "weights")
        if (auto fewer = shorts(numbers, *coded)) return fewer;
    if (coded) return coded;
    // Only vertex data may have padding between elements.
    const std::size_t size = size_of(given["componentType"].get<int>());
    if (size * static_cast<std::size_t>(numbers.components) % 4 != 0) return {};
    Stored plainly = plain(numbers.data, numbers.components, numbers.normalised, false);
    for (const char* key : {"min", "max"})
        if (given.contains(key)) plainly.accessor[key] = given[key];
    return plainly;
}

/// Replaces the reference by a new accessor for this purpose.
void Streams::store(Json& reference, const StreamUse& use) {
    const auto index = reference.get<std::size_t>();
    if (index >= count_of(json_, "accessors")) return;
    const std::string key = fmt::format("{} {} {} {}", index, use.path, use.exponent, use.limit);
    auto known = made_.find(key);
    if (known == made_.end()) {
        std::size_t made = index;
        if (auto better = stored(index, use)) {
            for (const char* member : {"name", "extras"})
                if (json_["accessors"][index].contains(member))
                    better->accessor[member] = json_["accessors"][index][member];
            made = builder_.add_stored(std::move(*better), 0);
            builder_.release({{"attributes", {{"old", index}}}});
        }
        known = made_.emplace(key, made).first;
    }
    reference = known->second;
}

void Streams::find_limits(double ratio) {
    const Json& source = builder_.source().json();
    if (!filters_ || !(ratio > 0) || count_of(source, "animations") == 0) return;
    try {
        limits_.emplace(builder_.source(), node_frames(source), ratio);
    } catch (const Error& error) { // invalid skins or animations keep the usual precision
        if (error.kind() != ErrorKind::malformed) throw;
    }
}

/// How far the keys of a channel may be off.
double Streams::limit(const Json& target) const {
    const std::string path = target.value("path", "");
    const auto node = index_at(target, "node", limits_ ? count_of(builder_.source().json(), "nodes") : 0);
    return node && path != "weights" ? limits_->of(*node, path) : 0;
}

void Streams::store_animation(Json& animation) {
    std::map<std::size_t, StreamUse> uses; // by sampler; without a path if channels differ
    for (const Json& channel : animation["channels"]) {
        std::string path = channel["target"].value("path", "");
        if (path == "scale") path = "translation";
        const double limit = this->limit(channel["target"]);
        const auto [at, first] =
            uses.emplace(channel["sampler"].get<std::size_t>(), StreamUse{path, finest, limit});
        if (!first && at->second.path != path) at->second.path.clear();
        at->second.limit = std::min(at->second.limit, limit);
    }
    for (std::size_t s = 0; s < animation["samplers"].size(); ++s) {
        Json& sampler = animation["samplers"][s];
        store(sampler["input"], {});
        const bool cubic = sampler.value("interpolation", "LINEAR") == "CUBICSPLINE";
        store(sampler["output"], cubic ? StreamUse{} : uses[s]);
    }
}

void Streams::run() {
    for (std::size_t a = 0; a < count_of(json_, "animations"); ++a) {
        Json animation = json_["animations"][a];
        store_animation(animation);
        json_["animations"][a] = std::move(animation);
    }
    for (std::size_t s = 0; s < count_of(json_, "skins"); ++s) {
        if (!json_["skins"][s].contains("inverseBindMatrices")) continue;
        Json reference = json_["skins"][s]["inverseBindMatrices"];
        store(reference, {});
        json_["skins"][s]["inverseBindMatrices"] = reference;
    }
    const Json::json_pointer instances("/extensions/EXT_mesh_gpu_instancing/attributes");
    for (std::size_t n = 0; n < count_of(json_, "nodes"); ++n) {
        if (!json_["nodes"][n].contains(instances)) continue;
        Json attributes = json_["nodes"][n][instances];
        store_instances(attributes, on_grid(json_["nodes"][n]));
        json_["nodes"][n][instances] = std::move(attributes);
    }
}

/// True if positions of the node's mesh are in grid steps.
bool Streams::on_grid(const Json& node) const {
    if (!node.contains("mesh")) return false;
    const Json& primitives = json_["meshes"][node["mesh"].get<std::size_t>()]["primitives"];
    return std::all_of(primitives.begin(), primitives.end(), [&](const Json& primitive) {
        const Json::json_pointer positions("/attributes/POSITION");
        return primitive.contains(positions) &&
               json_["accessors"][primitive[positions].get<std::size_t>()]["componentType"] != int(float32);
    });
}

/// Stores instance positions within a quarter of a grid step, measured at the scale of the smallest instance.
void Streams::store_instances(Json& attributes, bool on_grid) {
    int step = finest, of_scale = finest;
    if (on_grid && filters_) {
        double least = attributes.contains("SCALE") ? HUGE_VAL : 1;
        if (attributes.contains("SCALE")) {
            const Attribute scales =
                decode_numbers(builder_.current(), attributes["SCALE"].get<std::size_t>());
            for (std::size_t i = 0; i < scales.size(); ++i)
                for (int c = 0; c < 3; ++c)
                    if (const double s = std::abs(scales.value(i, c)); s > 0) least = std::min(least, s);
        }
        constexpr int bits = 16; // bits per position, at most
        if (least < HUGE_VAL) {
            step = std::ilogb(least) - 1;
            of_scale = step - bits;
        }
    }
    for (auto& [name, reference] : attributes.items()) {
        if (name == "ROTATION")
            store(reference, {"turn"});
        else if (name == "TRANSLATION")
            store(reference, {"place", step});
        else if (name == "SCALE")
            store(reference, {"place", of_scale});
        else
            store(reference, {});
    }
}

} // namespace

void store_streams(Patch& patch, const StoredMeshes&) {
    if (patch.settings.meshopt.on) Streams(patch).run();
}

} // namespace facetmill::io::gltf
