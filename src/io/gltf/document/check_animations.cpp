#include "io/gltf/document/rules.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace facetmill::io::gltf {

namespace {

class AnimationRules {
  public:
    explicit AnimationRules(const CheckedDocument& document) : document_(document) {}

    void run() {
        for (std::size_t a = 0; a < count_of(document_.json, "animations"); ++a)
            animation(item(document_.json, "animations", a));
    }

  private:
    /// The number of values per key: of the morph targets for weights.
    std::size_t values_per_key(const Json& target) const {
        if (target["path"] != "weights" || !target.contains("node")) return 1;
        const Json& node = document_.at("nodes", target["node"]);
        return node.contains("mesh") ? CheckedDocument::targets_of(document_.at("meshes", node["mesh"])) : 0;
    }

    void channel(const JsonCursor& place, const JsonCursor& samplers) {
        const JsonCursor target = place.at("target");
        const std::string path = target.at("path").text();
        const bool pointer = target.json().contains("extensions");
        if (pointer && path == "pointer" && target.find("node"))
            document_.breaches.add(target, "has a node and a pointer");
        if (pointer || path == "pointer") return;
        const JsonCursor sampler = samplers.at(place.at("sampler").natural());
        const Json& input = document_.at("accessors", sampler.at("input").json());
        const Json& output = document_.at("accessors", sampler.at("output").json());
        const std::string format = format_of(output);
        const bool fractions =
            is_one_of(format.substr(format.find(' ') + 1),
                      {"5126", "5120 normalized", "5121 normalized", "5122 normalized", "5123 normalized"});
        const std::string type = output["type"];
        const bool fits = path == "rotation"  ? type == "VEC4" && fractions
                          : path == "weights" ? type == "SCALAR" && fractions
                                              : format == "VEC3 5126";
        if (!fits) document_.breaches.add(sampler.at("output"), fmt::format("{} cannot be {}", path, format));
        const std::size_t keys = number_in(input, "count"), values = number_in(output, "count");
        const bool cubic = sampler.text_or("interpolation", "") == "CUBICSPLINE";
        const std::size_t wanted = keys * values_per_key(target.json()) * (cubic ? 3 : 1);
        if (values != wanted)
            document_.breaches.add(sampler.at("output"),
                                   fmt::format("has {} values, expected {}", values, wanted));
        if (!target.json().contains("node")) return;
        const Json& node = document_.at("nodes", target.json()["node"]);
        if (path != "weights" && node.contains("matrix"))
            document_.breaches.add(target, "the node has a matrix, which cannot be animated");
    }

    void animation(const JsonCursor& place) {
        const JsonCursor channels = place.at("channels"), samplers = place.at("samplers");
        std::map<std::string, int> targets;
        for (std::size_t c = 0; c < channels.size(); ++c) {
            channel(channels.at(c), samplers);
            const Json& target = channels.at(c).at("target").json();
            if (target.contains("node") && ++targets[to_string(target)] == 2)
                document_.breaches.add(channels.at(c), "another channel has the same target");
        }
        for (std::size_t s = 0; s < samplers.size(); ++s) {
            const Json& input = document_.at("accessors", samplers.at(s).at("input").json());
            if (format_of(input) != "SCALAR 5126")
                document_.breaches.add(samplers.at(s).at("input"), "must be scalars of floats");
            if (samplers.at(s).text_or("interpolation", "") == "CUBICSPLINE" && number_in(input, "count") < 2)
                document_.breaches.add(samplers.at(s).at("input"), "a spline needs two keys");
        }
    }

    const CheckedDocument& document_;
};

} // namespace

void check_animations(const CheckedDocument& document) { AnimationRules(document).run(); }

} // namespace facetmill::io::gltf
