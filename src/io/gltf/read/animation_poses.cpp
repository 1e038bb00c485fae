#include "io/gltf/read/animation_poses.hpp"

#include "base/math/portable_math.hpp"
#include "base/sort_unique.hpp"
#include "io/gltf/read/pose_mesh.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace facetmill::io {

using namespace gltf;

// Members of AnimationPoses::Tracks, which has external linkage.
namespace animation_poses {

/// The keys of a property of a node.
struct Track {
    std::size_t animation = 0, node = 0;
    std::string path, interpolation;
    std::vector<double> times;
    Attribute values;

    bool cubic() const { return interpolation == "CUBICSPLINE"; }
    /// The count of numbers at a key.
    std::size_t width() const {
        return values.size() * static_cast<std::size_t>(values.components) /
               (times.size() * (cubic() ? 3 : 1));
    }
    /// Number c of the value at a key; of cubic keys, part 0 and 2 are the tangents.
    double at(std::size_t key, std::size_t c, std::size_t part = 1) const {
        const std::size_t number = ((cubic() ? 3 * key + part : key) * width()) + c;
        const auto n = static_cast<std::size_t>(values.components);
        return values.value(number / n, static_cast<int>(number % n));
    }
    std::vector<double> value(double time) const;
};

/// A moment of an animation.
struct Moment {
    std::size_t animation;
    double time;
    auto operator<=>(const Moment&) const = default;
};

} // namespace animation_poses

using namespace animation_poses;

namespace {

/// Follows the shorter arc between unit quaternions.
std::vector<double> turned_between(const std::vector<double>& a, std::vector<double> b, double t) {
    double along = 0;
    for (std::size_t c = 0; c < a.size(); ++c) along += a[c] * b[c];
    if (along < 0)
        for (double& x : b) x = -x;
    const double angle = arc_cosine(std::abs(along)), whole = sine(angle);
    const bool is_near = !(whole > 1e-6); // the arc is straight then
    const double from = is_near ? 1 - t : sine((1 - t) * angle) / whole,
                 to = is_near ? t : sine(t * angle) / whole;
    for (std::size_t c = 0; c < a.size(); ++c) b[c] = from * a[c] + to * b[c];
    return b;
}

} // namespace

std::vector<double> animation_poses::Track::value(double time) const {
    const std::size_t n = width();
    const auto next =
        static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    const std::size_t a = next > 0 ? next - 1 : 0, b = std::min(next, times.size() - 1);
    std::vector<double> first(n), second(n);
    for (std::size_t c = 0; c < n; ++c) {
        first[c] = at(a, c);
        second[c] = at(b, c);
    }
    const double step = times[b] - times[a],
                 t = step > 0 ? std::clamp((time - times[a]) / step, 0.0, 1.0) : 0;
    if (t == 0 || interpolation == "STEP") return first;
    if (path == "rotation" && !cubic()) return turned_between(first, std::move(second), t);
    for (std::size_t c = 0; c < n; ++c) {
        if (!cubic()) {
            first[c] += (second[c] - first[c]) * t;
            continue;
        }
        const double t2 = t * t, t3 = t2 * t;
        first[c] = (2 * t3 - 3 * t2 + 1) * first[c] + (t3 - 2 * t2 + t) * step * at(a, c, 2) +
                   (3 * t2 - 2 * t3) * second[c] + (t3 - t2) * step * at(b, c, 0);
    }
    return first;
}

namespace {

std::vector<double> numbers_of(const Attribute& a) {
    std::vector<double> all(a.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = a.value(i, 0);
    return all;
}

/// At most `most` of the items, evenly, with the first and the last.
template <class T>
std::vector<T> evenly(const std::vector<T>& all, std::size_t most) {
    if (all.size() <= most) return all;
    std::vector<T> some;
    some.reserve(most);
    for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * (all.size() - 1) / (most - 1)]);
    return some;
}

} // namespace

class AnimationPoses::Tracks {
  public:
    Tracks(const facetmill::Document& document, std::size_t most)
        : json_(parse_document(document.json)), frames_(node_frames(json_)),
          source_(json_, document.buffers) {
        for (std::size_t a = 0; a < count_of(json_, "animations"); ++a) read(a);
        std::vector<Moment> all;
        for (const Track& track : tracks_)
            for (const double time : track.times) all.push_back({track.animation, time});
        sort_unique(all);
        moments_ = evenly(all, most);
    }

    std::vector<Pose> poses_of(const Part& part) {
        std::vector<Pose> poses;
        if (part.node < 0 || static_cast<std::size_t>(part.node) >= frames_.size()) return poses;
        const auto node = static_cast<std::size_t>(part.node);
        const std::vector<double> rest = default_weights(json_, part);
        const bool moves = part.skinned || drives(node, "weights");
        for (const Moment& moment : moments_) {
            if (!moves) break;
            Pose& pose = poses.emplace_back();
            pose.name =
                fmt::format("animation {} at {:.3g} s", in_quotes(name_of(moment.animation)), moment.time);
            pose.weights = rest;
            for (const Track& track : tracks_)
                if (track.animation == moment.animation && track.node == node && track.path == "weights")
                    pose.weights = track.value(moment.time);
            if (part.skinned) pose.joints = joint_matrices(source_, node, worlds_at(moment));
        }
        return poses;
    }

    bool drives(std::size_t node, const char* path) const {
        return std::any_of(tracks_.begin(), tracks_.end(),
                           [&](const Track& track) { return track.node == node && track.path == path; });
    }

    /// The joints at rest; empty without a skin.
    std::vector<Transform> joints_at_rest(const Part& part) {
        if (!part.skinned || part.node < 0) return {};
        std::vector<Transform> worlds;
        worlds.reserve(frames_.size());
        for (const NodeFrame& frame : frames_) worlds.push_back(frame.world);
        return joint_matrices(source_, static_cast<std::size_t>(part.node), worlds);
    }

  private:
    std::string name_of(std::size_t animation) const {
        return item(json_, "animations", animation).text_or("name", std::to_string(animation));
    }

    void read(std::size_t a) {
        const JsonCursor animation = item(json_, "animations", a), channels = animation.at("channels");
        const auto samplers = animation.find("samplers");
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const auto property = animated_property(channels.at(c), frames_.size());
            const auto sampler =
                samplers ? index_at(channels.at(c).json(), "sampler", samplers->size()) : std::nullopt;
            if (!property || !sampler) continue;
            const bool is_matrix = json_["nodes"][property->node].contains("matrix");
            constexpr const char* paths[] = {"translation", "rotation", "scale", "weights"};
            if (is_matrix || std::find(std::begin(paths), std::end(paths), property->path) == std::end(paths))
                continue;
            const JsonCursor place = samplers->at(*sampler);
            Track track{a,
                        property->node,
                        property->path,
                        place.text_or("interpolation", "LINEAR"),
                        numbers_of(decode_numbers(source_, accessor(source_, place.at("input")))),
                        decode_numbers(source_, accessor(source_, place.at("output")))};
            const std::size_t expected = track.path == "rotation" ? 4 : track.path == "weights" ? 1 : 3;
            if (!track.times.empty() && track.width() >= expected &&
                std::is_sorted(track.times.begin(), track.times.end()))
                tracks_.push_back(std::move(track));
        }
    }

    std::vector<Transform> worlds_at(const Moment& moment) const {
        std::map<std::size_t, Json> changed; // nodes
        for (const Track& track : tracks_)
            if (track.animation == moment.animation && track.path != "weights")
                changed.try_emplace(track.node, json_["nodes"][track.node]).first->second[track.path] =
                    track.value(moment.time);
        std::vector<Transform> worlds(frames_.size());
        for (const std::size_t n : parents_first(frames_)) {
            const auto found = changed.find(n);
            const Transform local = found == changed.end()
                                        ? frames_[n].local
                                        : local_transform(JsonCursor(found->second, "nodes"));
            worlds[n] =
                frames_[n].parent < 0 ? local : worlds[static_cast<std::size_t>(frames_[n].parent)] * local;
        }
        return worlds;
    }

    Json json_;
    std::vector<NodeFrame> frames_;
    Source source_;
    std::vector<Track> tracks_;
    std::vector<Moment> moments_;
};

AnimationPoses::AnimationPoses(const facetmill::Document& document, std::size_t most)
    : tracks_(std::make_unique<Tracks>(document, most)), most_(most) {}
AnimationPoses::~AnimationPoses() = default;

std::vector<AnimationPoses::Pose> AnimationPoses::of(const Part& part) {
    std::vector<Pose> poses = tracks_->poses_of(part);
    if (part.node >= 0 && tracks_->drives(static_cast<std::size_t>(part.node), "weights")) return poses;
    std::vector<std::size_t> targets;
    while (part.mesh.find(fmt::format("TARGET_{}_POSITION", targets.size()), Domain::wedge))
        targets.push_back(targets.size());
    for (const std::size_t target : evenly(targets, most_)) {
        Pose& pose = poses.emplace_back();
        pose.name = fmt::format("morph target {}", target);
        pose.weights.assign(targets.size(), 0);
        pose.weights[target] = 1;
        pose.joints = tracks_->joints_at_rest(part);
    }
    return poses;
}

Mesh posed_mesh(const Mesh& mesh, const AnimationPoses::Pose& pose) {
    Mesh moved = mesh;
    morph(moved, pose.weights);
    bend(moved, pose.joints);
    return moved;
}

} // namespace facetmill::io
