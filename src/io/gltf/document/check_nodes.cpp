#include "io/gltf/document/nodes.hpp"
#include "io/gltf/document/rules.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill::io::gltf {

namespace {

class NodeRules {
  public:
    explicit NodeRules(const CheckedDocument& document) : document_(document) {}

    void run() {
        for (std::size_t n = 0; n < count_of(document_.json, "nodes"); ++n)
            node(item(document_.json, "nodes", n));
        scenes();
        if (count_of(document_.json, "skins") > 0) frames_ = node_frames(document_.json);
        for (std::size_t s = 0; s < count_of(document_.json, "skins"); ++s)
            skin(item(document_.json, "skins", s));
    }

  private:
    void node(const JsonCursor& place) {
        const Json& node = place.json();
        for (const char* key : {"translation", "rotation", "scale"})
            if (node.contains("matrix") && node.contains(key))
                document_.breaches.add(place, fmt::format("has a matrix and a {}", key));
        if (node.contains("rotation")) {
            constexpr double tolerance = 0.00769; // of the length: rotations of 8 bits
            double square = 0;
            for (const Json& x : node["rotation"]) square += x.get<double>() * x.get<double>();
            if (!(std::abs(std::sqrt(square) - 1) <= tolerance))
                document_.breaches.add(place.at("rotation"), "is not a unit quaternion");
        }
        for (const char* key : {"skin", "weights"})
            if (node.contains(key) && !node.contains("mesh"))
                document_.breaches.add(place.at(key), "belongs to a node without a mesh");
        if (!node.contains("mesh")) return;
        const Json& mesh = document_.at("meshes", node["mesh"]);
        if (node.contains("weights") && node["weights"].size() != CheckedDocument::targets_of(mesh))
            document_.breaches.add(place.at("weights"),
                                   fmt::format("has {} numbers for {} morph targets", node["weights"].size(),
                                               CheckedDocument::targets_of(mesh)));
        const auto skinned = [](const Json& primitive) {
            return primitive["attributes"].contains("JOINTS_0") &&
                   primitive["attributes"].contains("WEIGHTS_0");
        };
        if (node.contains("skin") &&
            std::none_of(mesh["primitives"].begin(), mesh["primitives"].end(), skinned))
            document_.breaches.add(place.at("skin"), "belongs to a mesh without joints and weights");
    }

    void scenes() {
        std::vector<bool> child(count_of(document_.json, "nodes"));
        for (std::size_t n = 0; n < child.size(); ++n)
            if (const auto children = item(document_.json, "nodes", n).find("children"))
                for (const Json& c : children->json())
                    child[static_cast<std::size_t>(c.get<double>())] = true;
        for (std::size_t s = 0; s < count_of(document_.json, "scenes"); ++s) {
            const auto roots = item(document_.json, "scenes", s).find("nodes");
            if (!roots || !roots->json().is_array()) continue;
            for (std::size_t i = 0; i < roots->size(); ++i)
                if (const Json& n = roots->at(i).json();
                    n.is_number_unsigned() && n < child.size() && child[n.get<std::size_t>()])
                    document_.breaches.add(roots->at(i), "the node is the child of another");
        }
    }

    void bind_matrices(const JsonCursor& skin, std::size_t joints) {
        const auto matrices = skin.find("inverseBindMatrices");
        if (!matrices) return;
        const Json& accessor = document_.at("accessors", matrices->json());
        const std::size_t count = number_in(accessor, "count");
        if (format_of(accessor) != "MAT4 5126") document_.breaches.add(*matrices, "must be MAT4 of floats");
        if (count < joints)
            document_.breaches.add(*matrices, fmt::format("has {} matrices for {} joints", count, joints));
    }

    void skin(const JsonCursor& place) {
        const auto joints = place.find("joints");
        if (!joints) return;
        bind_matrices(place, joints->size());
        const auto root = [&](std::size_t n) {
            while (frames_[n].parent >= 0) n = static_cast<std::size_t>(frames_[n].parent);
            return n;
        };
        for (std::size_t j = 1; j < joints->size(); ++j)
            if (root(joints->at(j).natural()) != root(joints->at(std::size_t{0}).natural()))
                return document_.breaches.add(*joints, "the joints have no common root");
        const auto skeleton = place.find("skeleton");
        for (std::size_t j = 0; skeleton && j < joints->size(); ++j) {
            int n = static_cast<int>(joints->at(j).natural());
            while (n >= 0 && n != static_cast<int>(skeleton->natural()))
                n = frames_[static_cast<std::size_t>(n)].parent;
            if (n < 0)
                return document_.breaches.add(*skeleton,
                                              fmt::format("is not above joint {}", joints->at(j).natural()));
        }
    }

    const CheckedDocument& document_;
    std::vector<NodeFrame> frames_; ///< if the document has skins
};

} // namespace

void check_nodes(const CheckedDocument& document) { NodeRules(document).run(); }

} // namespace facetmill::io::gltf
