// Fewer keys for animations: keys that interpolation gives anyway are dropped, and tracks are resampled on
// request.

#include "base/math/portable_math.hpp"
#include "io/gltf/contents/motion.hpp"
#include "io/gltf/document/accessor.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/gltf/numbers/columns.hpp"
#include "io/gltf/optimize/document_optimizer.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace facetmill::io {

using namespace gltf;

namespace {

/// The keys of a sampler. `values` has `width` numbers for each time.
struct TrackKeys {
    std::vector<float> times{};
    std::vector<double> values{};
    std::size_t width = 0;
    bool steps = false;   ///< values jump at the keys
    bool turns = false;   ///< values are unit quaternions
    bool weights = false; ///< values are weights of morph targets

    std::size_t size() const { return times.size(); }
    const double* at(std::size_t key) const { return &values[key * width]; }
};

/// Half the angle between two quaternions of rotations, which is their angle as vectors.
double angle_of(const double* a, const double* b, double& sign) {
    double dot = 0, apart = 0, together = 0;
    for (std::size_t c = 0; c < 4; ++c) dot += a[c] * b[c];
    sign = dot < 0 ? -1 : 1;
    for (std::size_t c = 0; c < 4; ++c) {
        apart += (a[c] - sign * b[c]) * (a[c] - sign * b[c]);
        together += (a[c] + sign * b[c]) * (a[c] + sign * b[c]);
    }
    return 2 * arc_tangent(std::sqrt(apart), std::sqrt(together)); // exact for small angles too
}

/// The values between two keys, as glTF 2.0 interpolates.
class Between {
  public:
    Between(const TrackKeys& keys, std::size_t from, std::size_t to)
        : keys_(keys), a_(keys.at(from)), b_(keys.at(to)), start_(keys.times[from]),
          duration_(double{keys.times[to]} - keys.times[from]), value_(keys.width) {
        if (keys.turns) angle_ = angle_of(a_, b_, sign_);
        if (keys.turns) whole_ = sine(angle_);
    }
    double angle() const { return angle_; }
    const std::vector<double>& at(double time) {
        const double t = std::clamp((time - start_) / duration_, 0.0, 1.0);
        const double of_a = whole_ > 0 ? sine((1 - t) * angle_) / whole_ : 1 - t;
        const double of_b = sign_ * (whole_ > 0 ? sine(t * angle_) / whole_ : t);
        for (std::size_t c = 0; c < keys_.width; ++c) value_[c] = of_a * a_[c] + of_b * b_[c];
        return value_;
    }

  private:
    const TrackKeys& keys_;
    const double *a_, *b_;
    double start_, duration_, angle_ = 0, whole_ = 0, sign_ = 1;
    std::vector<double> value_;
};

/// The difference of two values: an angle, a length, or for morph weights the sum of their differences.
double difference(const TrackKeys& keys, const double* a, const double* b) {
    double sign = 1, sum = 0;
    if (keys.turns) return 2 * angle_of(a, b, sign);
    for (std::size_t c = 0; c < keys.width; ++c)
        sum += keys.weights ? std::abs(a[c] - b[c]) : (a[c] - b[c]) * (a[c] - b[c]);
    return keys.weights ? sum : std::sqrt(sum);
}

/// True if the keys between the two are within the tolerance of what interpolation gives.
bool spans(const TrackKeys& keys, std::size_t from, std::size_t to, double tolerance) {
    Between between(keys, from, to);
    constexpr double widest = pi / 4; // viewers must take the same way round
    if (to > from + 1 && between.angle() > widest) return false;
    for (std::size_t k = from + 1; k < to; ++k) {
        const double* expected = keys.steps ? keys.at(from) : between.at(keys.times[k]).data();
        if (!(difference(keys, keys.at(k), expected) <= tolerance)) return false;
    }
    return true;
}

/// A far key that spans all keys from the given one on. Steps grow while they succeed, then shrink.
std::size_t farthest_spanned(const TrackKeys& keys, std::size_t from, double tolerance) {
    std::size_t to = from + 1, step = 1;
    const auto advances = [&] {
        if (to + step >= keys.size() || !spans(keys, from, to + step, tolerance)) return false;
        to += step;
        return true;
    };
    while (advances()) step *= 2;
    for (step /= 2; step > 0; step /= 2) static_cast<void>(advances());
    return to;
}

/// The keys that stay. Starts from the first key, and goes on with a far key that spans all between.
std::vector<std::size_t> needed_keys(const TrackKeys& keys, double tolerance) {
    const auto rests = [&](std::size_t k) { return difference(keys, keys.at(0), keys.at(k)) <= tolerance; };
    bool all_rest = true;
    for (std::size_t k = 1; k < keys.size() && all_rest; ++k) all_rest = rests(k);
    if (all_rest) return {0};
    std::vector<std::size_t> kept{0};
    while (kept.back() + 1 < keys.size()) kept.push_back(farthest_spanned(keys, kept.back(), tolerance));
    return kept;
}

TrackKeys chosen(const TrackKeys& keys, const std::vector<std::size_t>& which) {
    TrackKeys out{{}, {}, keys.width, keys.steps, keys.turns, keys.weights};
    out.times.reserve(which.size());
    for (const std::size_t k : which) {
        out.times.push_back(keys.times[k]);
        out.values.insert(out.values.end(), keys.at(k), keys.at(k) + keys.width);
    }
    return out;
}

/// Linear keys at multiples of 1 / rate, with the first and the last time of the given keys.
TrackKeys resampled(const TrackKeys& keys, double rate) {
    constexpr double most = 1e6;
    const double first = keys.times.front(), last = keys.times.back();
    if (keys.steps || keys.size() < 2 || !((last - first) * rate < most)) return keys;
    TrackKeys out{{}, {}, keys.width, false, keys.turns, keys.weights};
    std::size_t from = 0;
    const auto add = [&](double time) {
        while (from + 2 < keys.size() && keys.times[from + 1] <= time) ++from;
        Between between(keys, from, from + 1);
        const std::vector<double>& value = between.at(time);
        out.times.push_back(static_cast<float>(time));
        out.values.insert(out.values.end(), value.begin(), value.end());
    };
    add(first);
    for (double k = std::floor(first * rate) + 1; k / rate < last; ++k)
        if (static_cast<float>(k / rate) > out.times.back() &&
            static_cast<float>(k / rate) < keys.times.back())
            add(k / rate);
    add(last);
    return out;
}

std::vector<double> reals(Source& source, const Json& reference) {
    const Attribute numbers = decode_numbers(source, accessor(source, JsonCursor(reference, "accessor")));
    std::vector<double> out;
    out.reserve(numbers.size() * static_cast<std::size_t>(numbers.components));
    for (std::size_t i = 0; i < numbers.size(); ++i)
        for (int c = 0; c < numbers.components; ++c) out.push_back(numbers.value(i, c));
    return out;
}

/// Reads a sampler of a track of this path. None for cubic keys, and for keys that no viewer can play.
std::optional<TrackKeys> linear_keys(Source& source, const Json& sampler, const std::string& path,
                                     const std::vector<double>& times) {
    const std::string way = sampler.value("interpolation", "LINEAR");
    if (way != "LINEAR" && way != "STEP") return {};
    TrackKeys keys;
    keys.steps = way == "STEP";
    keys.turns = path == "rotation";
    keys.weights = path == "weights";
    keys.times.assign(times.begin(), times.end());
    keys.values = reals(source, sampler.at("output"));
    if (keys.times.empty() || keys.values.size() % keys.times.size() != 0) return {};
    keys.width = keys.values.size() / keys.times.size();
    if (keys.width != (keys.turns ? 4 : keys.weights ? std::max<std::size_t>(keys.width, 1) : 3)) return {};
    for (std::size_t k = 1; k < keys.size(); ++k)
        if (!(keys.times[k] > keys.times[k - 1])) return {};
    const auto finite = [](double x) { return std::isfinite(x); };
    if (!std::all_of(keys.values.begin(), keys.values.end(), finite)) return {};
    return keys;
}

/// What the channels of a sampler drive, and the smallest of their limits.
struct SamplerUse {
    std::string path{};
    double limit = HUGE_VAL;
    bool plain = true;
};

std::map<std::size_t, SamplerUse> sampler_uses(const Json& animation, const MotionLimits& limits) {
    std::map<std::size_t, SamplerUse> uses;
    for (const Json& channel : animation.at("channels")) {
        const auto sampler = channel.at("sampler").get<std::size_t>();
        const Json& target = channel.at("target");
        const auto [at, first] = uses.try_emplace(sampler);
        SamplerUse& use = at->second;
        const std::string path = target.value("path", "");
        use.plain = use.plain && !has_additions(channel) && !has_additions(target) &&
                    target.contains("node") && path != "pointer" && (first || use.path == path);
        use.path = path;
        if (use.plain) use.limit = std::min(use.limit, limits.of(target["node"].get<std::size_t>(), path));
    }
    return uses;
}

/// Times of its own cost a track an accessor, so a few keys less are not worth it.
bool is_worth_it(std::size_t before, std::size_t after) {
    constexpr std::size_t bytes_of_key = 4, bytes_of_time = 2, bytes_of_accessor = 130; // compressed
    return after == 1 || after * (bytes_of_key + bytes_of_time) + bytes_of_accessor < before * bytes_of_key;
}

/// A sampler and its new keys.
struct ChangedKeys {
    std::size_t sampler;
    TrackKeys keys;
    float end; ///< of the given keys
};

/// The keys of an animation's samplers that change.
std::vector<ChangedKeys> new_keys(Source& source, const Json& animation, const MotionLimits& limits,
                                  std::optional<double> rate, KeyCounts& counts) {
    std::vector<ChangedKeys> changes;
    float last = 0, kept = 0; // when the animation ends: as given, and with the new keys
    for (const auto& [s, use] : sampler_uses(animation, limits)) {
        const Json& sampler = animation.at("samplers").at(s);
        const std::vector<double> times = reals(source, sampler.at("input"));
        const float end = times.empty() ? 0 : static_cast<float>(times.back());
        last = std::max(last, end);
        auto keys = use.plain && !has_additions(sampler) ? linear_keys(source, sampler, use.path, times)
                                                         : std::nullopt;
        const std::size_t before = times.size();
        if (keys && rate) *keys = resampled(*keys, *rate);
        const auto needed = keys ? needed_keys(*keys, use.limit) : std::vector<std::size_t>{};
        const bool fewer = keys && needed.size() < keys->size() && is_worth_it(keys->size(), needed.size());
        counts.before += before;
        if (!fewer && !(keys && rate && keys->size() != before)) {
            counts.after += before;
            kept = std::max(kept, end);
            continue;
        }
        if (fewer) *keys = chosen(*keys, needed);
        counts.after += keys->size();
        kept = std::max(kept, keys->times.back());
        changes.push_back({s, std::move(*keys), end});
    }
    for (ChangedKeys& change : changes) {
        if (kept >= last || change.end < last) continue;
        change.keys.times.push_back(last); // a constant, which keeps the duration
        const std::vector<double> value = change.keys.values;
        change.keys.values.insert(change.keys.values.end(), value.begin(), value.end());
        ++counts.after;
        kept = last;
    }
    return changes;
}

} // namespace

std::size_t DocumentOptimizer::add_keys(Bytes& bytes, const std::vector<float>& numbers, int components) {
    Json accessor = {{"bufferView", count_of(json_, "bufferViews")},
                     {"byteOffset", bytes.size()},
                     {"componentType", int(float32)},
                     {"count", numbers.size() / static_cast<std::size_t>(components)},
                     {"type", type_name(components)}};
    if (components == 1) {
        const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
        accessor["min"] = Json::array({*low});
        accessor["max"] = Json::array({*high});
    }
    const auto* from = reinterpret_cast<const std::byte*>(numbers.data());
    bytes.insert(bytes.end(), from, from + numbers.size() * sizeof(float));
    return add("accessors", std::move(accessor));
}

KeyCounts DocumentOptimizer::drop_keys(double ratio, std::optional<double> rate) {
    KeyCounts counts;
    if (!known_ || !json_.contains("animations")) return counts;
    Source source(json_, buffers());
    std::vector<std::vector<ChangedKeys>> changes; // [animations]
    try {
        const MotionLimits limits(source, node_frames(json_), ratio);
        for (const Json& animation : json_["animations"])
            changes.push_back(new_keys(source, animation, limits, rate, counts));
    } catch (const Error& error) { // viewers cannot play invalid animations either
        if (error.kind() != ErrorKind::malformed) throw;
        return {};
    }
    Bytes bytes;
    std::map<std::vector<float>, std::size_t> accessors; // of times
    for (std::size_t n = 0; n < changes.size(); ++n)
        for (const ChangedKeys& change : changes[n]) {
            const TrackKeys& keys = change.keys;
            const auto [time, is_new] = accessors.try_emplace(keys.times, 0);
            if (is_new) time->second = add_keys(bytes, keys.times, 1);
            const std::vector<float> values(keys.values.begin(), keys.values.end());
            Json& sampler = json_["animations"][n]["samplers"][change.sampler];
            sampler["input"] = time->second;
            const int components = keys.weights ? 1 : static_cast<int>(keys.width);
            const std::size_t output = add_keys(bytes, values, components);
            json_["animations"][n]["samplers"][change.sampler]["output"] = output;
        }
    if (!bytes.empty()) add_view(std::move(bytes));
    return counts;
}

} // namespace facetmill::io
