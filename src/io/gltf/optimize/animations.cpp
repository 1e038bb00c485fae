// Finds animation tracks that change nothing.

#include "io/gltf/contents/largest_pose.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/optimize/document_optimizer.hpp"

#include <algorithm>
#include <cmath>

namespace facetmill::io {

using namespace gltf;

namespace {

/// The value of a node's property without animation; empty for other properties.
std::vector<double> rest_of(const Json& node, const std::string& path) {
    if (node.contains("matrix")) return {};
    std::vector<double> rest;
    if (path == "translation") rest = {0, 0, 0};
    if (path == "rotation") rest = {0, 0, 0, 1};
    if (path == "scale") rest = {1, 1, 1};
    if (!rest.empty() && node.contains(path)) rest = node[path].get<std::vector<double>>();
    return rest;
}

/// True if all keys equal the rest value within the tolerance, by component; rotations may be negated.
bool rests(const Attribute& keys, const std::vector<double>& rest, double tolerance) {
    if (static_cast<std::size_t>(keys.components) != rest.size()) return false;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        double along = 0;
        for (std::size_t c = 0; c < rest.size(); ++c) along += keys.value(i, static_cast<int>(c)) * rest[c];
        const double sign = rest.size() == 4 && along < 0 ? -1 : 1;
        for (std::size_t c = 0; c < rest.size(); ++c)
            if (!(std::abs(sign * keys.value(i, static_cast<int>(c)) - rest[c]) <= tolerance)) return false;
    }
    return true;
}

std::string target_of(const Json& channel) {
    return channel["target"].contains("node")
               ? channel["target"]["node"].dump() + channel["target"].value("path", "")
               : "";
}

bool has_additions(const Json& object) { return object.contains("extensions") || object.contains("extras"); }

double end_of(const Json& document, const Json& animation, const Json& channel) {
    const Json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
    const Json& times = document["accessors"][sampler["input"].get<std::size_t>()];
    return times.contains("max") ? times["max"][0].get<double>()
                                 : HUGE_VAL; // if unknown, the track may end last
}

/// Drops the resting channels and their samplers. The channel that ends last stays, so that the animation
/// keeps its duration.
std::size_t drop_channels(const Json& document, Json& animation, std::vector<bool> resting) {
    Json& channels = animation["channels"];
    double last = 0, kept = -1;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const double end = end_of(document, animation, channels[c]);
        last = std::max(last, end);
        if (!resting[c]) kept = std::max(kept, end);
    }
    for (std::size_t c = 0; c < channels.size() && kept < last; ++c)
        if (end_of(document, animation, channels[c]) == last) {
            resting[c] = false;
            kept = last;
        }
    Json left = Json::array(), samplers = Json::array();
    std::map<std::size_t, std::size_t> number;
    for (std::size_t c = 0; c < channels.size(); ++c) {
        if (resting[c]) continue;
        const auto sampler = channels[c]["sampler"].get<std::size_t>();
        if (number.try_emplace(sampler, samplers.size()).second)
            samplers.push_back(animation["samplers"][sampler]);
        left.push_back(channels[c]);
        left.back()["sampler"] = number[sampler];
    }
    const std::size_t dropped = channels.size() - left.size();
    if (dropped == 0) return 0;
    channels = std::move(left);
    animation["samplers"] = std::move(samplers);
    return dropped;
}

} // namespace

std::size_t DocumentOptimizer::drop_resting_tracks(double length) {
    if (!known_) return 0;
    std::vector<Bytes> buffers = document_.buffers;
    buffers.insert(buffers.end(), added_.begin(), added_.end());
    Source source(json_, buffers);
    const auto frames = node_frames(json_);
    const auto worlds = largest_worlds(source, frames);
    const auto length_at = [&](std::size_t node) { // in the space of its translation
        const int parent = frames[node].parent;
        return parent < 0 ? length : length / greatest_stretch(worlds[static_cast<std::size_t>(parent)]);
    };
    std::map<std::string, int> animations_of; // by animated property
    for (std::size_t a = 0; a < count_of(json_, "animations"); ++a) {
        std::set<std::string> here;
        for (const Json& channel : json_["animations"][a]["channels"]) here.insert(target_of(channel));
        for (const std::string& target : here) ++animations_of[target];
    }
    const auto is_resting = [&](const Json& animation, const Json& channel) {
        const std::string target = target_of(channel), path = channel["target"].value("path", "");
        if (target.empty() || animations_of[target] != 1 || has_additions(channel) ||
            has_additions(channel["target"]))
            return false;
        const Json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
        const auto node = channel["target"]["node"].get<std::size_t>();
        if (has_additions(sampler) || sampler.value("interpolation", "LINEAR") == "CUBICSPLINE" ||
            node >= count_of(json_, "nodes"))
            return false;
        const std::vector<double> rest = rest_of(json_["nodes"][node], path);
        if (rest.empty()) return false;
        const Json reference = sampler["output"];
        const Accessor a = accessor(source, JsonCursor(reference, "output"));
        constexpr double ratio =
            1e-5; // tolerance for scales and unit quaternions, below any rounding of positions
        return rests({"", Domain::wedge, Role::generic, a.components, a.normalised, decode(source, a)}, rest,
                     path == "translation" ? length_at(node) : ratio);
    };
    std::size_t dropped = 0;
    for (std::size_t n = 0; n < count_of(json_, "animations"); ++n) {
        Json animation = json_["animations"][n];
        std::vector<bool> resting;
        for (const Json& channel : animation["channels"]) resting.push_back(is_resting(animation, channel));
        dropped += drop_channels(json_, animation, std::move(resting));
        json_["animations"][n] = std::move(animation);
    }
    erased_.tracks += dropped;
    return dropped;
}

} // namespace facetmill::io
