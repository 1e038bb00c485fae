// Finds animation tracks that change nothing, or have the same value at all times.

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

double end_of(const Json& document, const Json& animation, const Json& channel) {
    const Json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
    const Json& times = document["accessors"][sampler["input"].get<std::size_t>()];
    return times.contains("max") ? times["max"][0].get<double>()
                                 : HUGE_VAL; // if unknown, the track may end last
}

/// The values of a channel over time.
struct Track {
    bool resting = false;  ///< always at the node's rest transform
    bool constant = false; ///< always at its first key
};

/// An accessor for the first or the last of the keys, in the same bytes.
Json one_key(Json keys, bool last) {
    const auto count = keys["count"].get<std::size_t>();
    if (last) {
        const std::size_t before = (count - 1) * size_of(keys["componentType"].get<int>());
        keys["byteOffset"] = keys.value("byteOffset", std::size_t{0}) + before;
        Json end = keys["max"]; // assigning a member to a new one would use it after it has moved
        keys["min"] = std::move(end);
    } else {
        for (const char* bound : {"min", "max"}) keys.erase(bound);
    }
    keys.erase("name");
    keys["count"] = 1;
    return keys;
}

/// Gives constant samplers a single key at their end, so that the animation keeps its duration.
void shorten_constants(Json& document, Json& animation, const std::vector<Track>& tracks) {
    std::map<std::size_t, bool> constant; // by sampler: of all its channels
    for (std::size_t c = 0; c < tracks.size(); ++c) {
        const auto sampler = animation["channels"][c]["sampler"].get<std::size_t>();
        constant.try_emplace(sampler, true).first->second &= tracks[c].constant;
    }
    std::map<std::size_t, std::size_t> ends; // accessors of last times, by those of all times
    Json& accessors = document["accessors"];
    for (const auto& [s, is_constant] : constant) {
        Json& sampler = animation["samplers"][s];
        const auto times = sampler["input"].get<std::size_t>(), values = sampler["output"].get<std::size_t>();
        const auto has_plain_keys = [&](std::size_t a) {
            return accessors[a]["count"] != 1 && accessors[a].contains("bufferView") &&
                   !accessors[a].contains("sparse") && !has_additions(accessors[a]) &&
                   !document["bufferViews"][accessors[a]["bufferView"].get<std::size_t>()].contains(
                       "byteStride");
        };
        if (!is_constant || !has_plain_keys(times) || !has_plain_keys(values) ||
            !accessors[times].contains("max"))
            continue;
        const auto [end, fresh] = ends.try_emplace(times, accessors.size());
        if (fresh) accessors.push_back(one_key(accessors[times], true));
        sampler["input"] = end->second;
        sampler["output"] = accessors.size();
        accessors.push_back(one_key(accessors[values], false));
    }
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

/// Compares the keys of channels.
struct TrackReader {
    const Json& document;
    Source& source;
    double length; ///< of translations, in the world
    std::vector<NodeFrame> frames = node_frames(document);
    std::vector<Transform> worlds = largest_worlds(source, frames);

    double length_at(std::size_t node) const { // in the space of its translation
        const int parent = frames[node].parent;
        return parent < 0 ? length : length / greatest_stretch(worlds[static_cast<std::size_t>(parent)]);
    }

    Track track(const Json& animation, const Json& channel) const {
        const std::string path = channel["target"].value("path", "");
        if (target_of(channel).empty() || has_additions(channel) || has_additions(channel["target"]))
            return {};
        const Json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
        const auto node = channel["target"]["node"].get<std::size_t>();
        if (has_additions(sampler) || sampler.value("interpolation", "LINEAR") == "CUBICSPLINE" ||
            node >= count_of(document, "nodes"))
            return {};
        const std::vector<double> rest = rest_of(document["nodes"][node], path);
        if (rest.empty()) return {};
        const Json reference = sampler["output"];
        const Attribute keys = decode_numbers(source, accessor(source, JsonCursor(reference, "output")));
        constexpr double ratio =
            1e-5; // tolerance for scales and unit quaternions, below any rounding of positions
        const double tolerance = path == "translation" ? length_at(node) : ratio;
        std::vector<double> first;
        for (int c = 0; keys.size() > 0 && c < keys.components; ++c) first.push_back(keys.value(0, c));
        return {rests(keys, rest, tolerance), rests(keys, first, tolerance)};
    }
};

} // namespace

std::size_t DocumentOptimizer::drop_resting_tracks(double length) {
    if (!known_) return 0;
    Source source(json_, buffers());
    const TrackReader reader{json_, source, length};
    std::vector<std::vector<Track>> tracks(count_of(json_, "animations"));
    std::set<std::string> moving; // animated properties that some animation moves
    for (std::size_t n = 0; n < tracks.size(); ++n)
        for (const Json& channel : json_["animations"][n]["channels"]) {
            tracks[n].push_back(reader.track(json_["animations"][n], channel));
            if (!tracks[n].back().resting) moving.insert(target_of(channel));
        }
    std::size_t dropped = 0;
    for (std::size_t n = 0; n < count_of(json_, "animations"); ++n) {
        Json animation = json_["animations"][n];
        std::vector<bool> resting;
        resting.reserve(tracks[n].size());
        for (std::size_t c = 0; c < tracks[n].size(); ++c)
            resting.push_back(tracks[n][c].resting && !moving.contains(target_of(animation["channels"][c])));
        shorten_constants(json_, animation, tracks[n]);
        dropped += drop_channels(json_, animation, std::move(resting));
        json_["animations"][n] = std::move(animation);
    }
    erased_.tracks += dropped;
    return dropped;
}

} // namespace facetmill::io
