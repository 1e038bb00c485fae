// Animations of assimp.

#include "convert.hpp"

#include <cmath>

namespace importers {

namespace {

/// The keys of one channel. glTF requires strictly ascending times.
class Keys {
  public:
    Keys(std::size_t width, double ticks) : width_(width), ticks_(ticks) {}

    void add(double time, std::initializer_list<float> values) { add(time, std::vector<float>(values)); }
    void add(double time, const std::vector<float>& values) {
        const auto seconds = static_cast<float>(time / ticks_);
        if (!std::isfinite(seconds) || seconds < 0 || (!times_.empty() && seconds <= times_.back())) return;
        for (const float x : values)
            if (!std::isfinite(x)) return;
        times_.push_back(seconds);
        values_.insert(values_.end(), values.begin(), values.end());
    }

    void write(Glb& glb, Json& animation, int node, const char* path) const {
        if (times_.empty()) return;
        const char* type = width_ == 3 ? "VEC3" : width_ == 4 ? "VEC4" : "SCALAR";
        Json sampler = {{"input", glb.floats(times_, "SCALAR", 0, true)},
                        {"output", glb.floats(values_, type)},
                        {"interpolation", "LINEAR"}};
        animation["channels"].push_back(
            {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
        animation["samplers"].push_back(std::move(sampler));
    }

  private:
    std::size_t width_;
    double ticks_;
    std::vector<float> times_, values_;
};

void add_channel(const aiNodeAnim& channel, int node, double ticks, float scale, Glb& glb, Json& to) {
    Keys places(3, ticks), turns(4, ticks), sizes(3, ticks);
    for (unsigned k = 0; k < channel.mNumPositionKeys; ++k) {
        const aiVectorKey& key = channel.mPositionKeys[k];
        places.add(key.mTime, {key.mValue.x * scale, key.mValue.y * scale, key.mValue.z * scale});
    }
    for (unsigned k = 0; k < channel.mNumRotationKeys; ++k) {
        aiQuatKey key = channel.mRotationKeys[k];
        key.mValue.Normalize();
        turns.add(key.mTime, {key.mValue.x, key.mValue.y, key.mValue.z, key.mValue.w});
    }
    for (unsigned k = 0; k < channel.mNumScalingKeys; ++k) {
        const aiVectorKey& key = channel.mScalingKeys[k];
        sizes.add(key.mTime, {key.mValue.x, key.mValue.y, key.mValue.z});
    }
    places.write(glb, to, node, "translation");
    turns.write(glb, to, node, "rotation");
    sizes.write(glb, to, node, "scale");
}

void add_weights(const aiMeshMorphAnim& channel, const AnimatedNodes& nodes, double ticks, Glb& glb,
                 Json& to) {
    std::string name = channel.mName.C_Str();
    if (!nodes.with_targets.contains(name)) name = name.substr(0, name.find('*')); // "node*mesh"
    const auto target = nodes.with_targets.find(name);
    if (target == nodes.with_targets.end()) return;
    const auto [node, count] = target->second;
    Keys keys(1, ticks);
    for (unsigned k = 0; k < channel.mNumKeys; ++k) {
        const aiMeshMorphKey& key = channel.mKeys[k];
        std::vector<float> weights(count);
        for (unsigned i = 0; i < key.mNumValuesAndWeights; ++i)
            if (key.mValues[i] < count) weights[key.mValues[i]] = static_cast<float>(key.mWeights[i]);
        keys.add(key.mTime, weights);
    }
    keys.write(glb, to, node, "weights");
}

} // namespace

void add_animations(const aiScene& scene, const AnimatedNodes& nodes, double scale, Glb& glb, Notes& notes) {
    for (unsigned a = 0; a < scene.mNumAnimations; ++a) {
        const aiAnimation& from = *scene.mAnimations[a];
        constexpr double usual_ticks = 25;
        const double ticks = from.mTicksPerSecond > 0 ? from.mTicksPerSecond : usual_ticks;
        Json to = {{"channels", Json::array()}, {"samplers", Json::array()}};
        if (from.mName.length > 0) to["name"] = from.mName.C_Str();
        for (unsigned c = 0; c < from.mNumChannels; ++c) {
            const auto node = nodes.by_name.find(from.mChannels[c]->mNodeName.C_Str());
            if (node == nodes.by_name.end())
                notes.warn("animations of missing nodes are dropped");
            else
                add_channel(*from.mChannels[c], node->second, ticks, static_cast<float>(scale), glb, to);
        }
        for (unsigned c = 0; c < from.mNumMorphMeshChannels; ++c)
            add_weights(*from.mMorphMeshChannels[c], nodes, ticks, glb, to);
        if (from.mNumMeshChannels > 0) notes.warn("animations that replace meshes are dropped");
        if (!to["channels"].empty()) glb.add("animations", std::move(to));
    }
}

} // namespace importers
