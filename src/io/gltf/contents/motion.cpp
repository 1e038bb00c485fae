#include "io/gltf/contents/motion.hpp"

#include "base/math/portable_math.hpp"
#include "io/gltf/read/skins.hpp"
#include "mesh/transform.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace facetmill::io::gltf {

namespace {

constexpr double largest_angle = 0.1 * pi / 180, largest_scale_error = 1e-3, largest_weight_error = 1e-3;

/// What a normalised integer of the accessor's bounds stands for.
double unit_of(const Accessor& a) {
    if (!a.normalised) return 1;
    return a.component_type == int8     ? 1.0 / 127
           : a.component_type == uint8  ? 1.0 / 255
           : a.component_type == int16  ? 1.0 / 32767
           : a.component_type == uint16 ? 1.0 / 65535
                                        : 1;
}

/// The distance of the farthest corner of the accessor's bounds from the origin; infinite without bounds.
double radius_of(const Source& source, const JsonCursor& reference) {
    const Accessor of = accessor(source, reference);
    const Json& a = of.place.json();
    double sum = 0;
    for (std::size_t c = 0; c < 3; ++c) {
        double most = 0;
        for (const char* bound : {"min", "max"}) {
            const auto found = a.find(bound);
            if (found == a.end() || found->size() != 3 || !(*found)[c].is_number()) return HUGE_VAL;
            most = std::max(most, std::abs((*found)[c].get<double>()));
        }
        sum += most * most;
    }
    return std::sqrt(sum) * unit_of(of);
}

/// True if the node shows more than its mesh: its transform then matters far from its vertices.
bool reaches_far(const Json& node) {
    if (node.contains("camera")) return true;
    const auto extensions = node.find("extensions");
    if (extensions == node.end()) return false;
    return std::any_of(extensions->items().begin(), extensions->items().end(), [](const auto& extension) {
        return extension.key() != "MSFT_lod" && extension.key() != "KHR_node_visibility";
    });
}

double length_at(const Attribute& a, std::size_t i) {
    double sum = 0;
    for (int c = 0; c < a.components; ++c) sum += a.value(i, c) * a.value(i, c);
    return std::sqrt(sum);
}

/// True if two keys differ. Weights of several targets count as different, unless all are equal.
bool varies(const Attribute& keys) {
    for (std::size_t i = 1; i < keys.size(); ++i)
        for (int c = 0; c < keys.components; ++c)
            if (keys.value(i, c) != keys.value(0, c)) return true;
    return false;
}

/// The largest component without its sign.
double largest_at(const Attribute& a, std::size_t i) {
    double most = 0;
    for (int c = 0; c < a.components; ++c) most = std::max(most, std::abs(a.value(i, c)));
    return most;
}

/// The corners of the accessor's bounds; none without finite bounds.
std::vector<Vec3> corners_of(const Source& source, const JsonCursor& reference) {
    if (!(radius_of(source, reference) < HUGE_VAL)) return {};
    const Accessor of = accessor(source, reference);
    std::vector<Vec3> corners;
    for (unsigned k = 0; k < 8; ++k) {
        Vec3 p;
        for (std::size_t c = 0; c < 3; ++c)
            p[c] = of.place.json()[k >> c & 1 ? "max" : "min"][c].get<double>() * unit_of(of);
        corners.push_back(p);
    }
    return corners;
}

/// The diagonal of all meshes at rest, skinned meshes in their bind pose; without meshes, of all nodes.
double size_of(const Source& source, const std::vector<NodeFrame>& frames) {
    Box nodes, meshes;
    for (const NodeFrame& frame : frames) {
        nodes.add(frame.world.point({}));
        if (frame.mesh < 0) continue;
        const JsonCursor primitives =
            item(source.json(), "meshes", static_cast<std::size_t>(frame.mesh)).at("primitives");
        for (std::size_t p = 0; p < primitives.size(); ++p)
            if (const auto position = primitives.at(p).at("attributes").find("POSITION"))
                for (const Vec3& corner : corners_of(source, *position))
                    meshes.add(frame.skinned ? corner : frame.world.point(corner));
    }
    const Box& box = meshes.empty() ? nodes : meshes;
    return box.empty() ? 0 : length(box.extent());
}

} // namespace

MotionLimits::MotionLimits(Source& source, const std::vector<NodeFrame>& frames, double ratio)
    : nodes_(frames.size()), length_(ratio * size_of(source, frames)) {
    const Json& document = source.json();
    for (std::size_t n = 0; n < frames.size(); ++n) {
        const Json& node = document["nodes"][n];
        const Transform& local = frames[n].local;
        nodes_[n].move = length(Vec3{local.m[0][3], local.m[1][3], local.m[2][3]});
        nodes_[n].scale = greatest_stretch(local);
        if (reaches_far(node)) nodes_[n].reach = HUGE_VAL;
    }
    see_animations(source);
    see_meshes(source);
    see_skins(source);
    see_hierarchy(frames);
}

void MotionLimits::see_animations(Source& source) {
    const Json& document = source.json();
    std::map<std::pair<std::size_t, std::string>, std::vector<double>> first; // keys
    for (std::size_t a = 0; a < count_of(document, "animations"); ++a) {
        const JsonCursor animation = item(document, "animations", a);
        const JsonCursor channels = animation.at("channels"), samplers = animation.at("samplers");
        for (std::size_t c = 0; c < channels.size(); ++c) {
            const auto property = animated_property(channels.at(c), nodes_.size());
            if (!property) continue;
            const std::size_t sampler = channels.at(c).at("sampler").index(samplers.size(), "sampler");
            const Attribute keys =
                decode_numbers(source, accessor(source, samplers.at(sampler).at("output")));
            if (keys.size() == 0) continue;
            std::vector<double> key;
            key.reserve(static_cast<std::size_t>(keys.components));
            for (int i = 0; i < keys.components; ++i) key.push_back(keys.value(0, i));
            const std::pair name{property->node, property->path};
            // Animations with constant tracks still differ where their constants do.
            if (first.emplace(name, key).first->second != key || varies(keys)) moving_.insert(name);
            see_keys(*property, keys);
        }
    }
    for (const auto& [node, path] : moving_) ++nodes_[node].own;
}

void MotionLimits::see_keys(const AnimatedProperty& property, const Attribute& keys) {
    Node& node = nodes_[property.node];
    // Tangents of cubic keys count too: curves stay within the sum of their control points.
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (property.path == "scale")
            node.scale = std::max(node.scale, largest_at(keys, i));
        else if (property.path == "translation")
            node.move = std::max(node.move, length_at(keys, i));
}

void MotionLimits::see_meshes(Source& source) {
    const Json& document = source.json();
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const auto mesh = index_at(document["nodes"][n], "mesh", count_of(document, "meshes"));
        if (!mesh) continue;
        const JsonCursor primitives = item(document, "meshes", *mesh).at("primitives");
        const bool skinned = document["nodes"][n].contains("skin"); // its joints move it, not the node
        double radius = 0, morph = 0;
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            const auto position = primitives.at(p).at("attributes").find("POSITION");
            if (position) radius = std::max(radius, radius_of(source, *position));
            double sum = 0;
            if (const auto targets = primitives.at(p).find("targets"))
                for (std::size_t t = 0; t < targets->size(); ++t)
                    if (const auto moved = targets->at(t).find("POSITION")) {
                        const double reach = radius_of(source, *moved);
                        morph = std::max(morph, reach);
                        sum += reach;
                    }
            radius += sum;
        }
        nodes_[n].morph = morph;
        if (!skinned) nodes_[n].reach = std::max(nodes_[n].reach, radius);
    }
}

void MotionLimits::see_skins(Source& source) {
    const Json& document = source.json();
    std::set<std::pair<std::size_t, std::size_t>> seen; // mesh and skin
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
        const auto skin = index_at(document["nodes"][n], "skin", count_of(document, "skins"));
        const auto mesh = index_at(document["nodes"][n], "mesh", count_of(document, "meshes"));
        if (!skin || !mesh || !seen.emplace(*mesh, *skin).second) continue;
        const JsonCursor place = item(document, "skins", *skin), joints = place.at("joints");
        const std::vector<float> bind = bind_matrices(source, place, joints.size());
        std::vector<Joint> all;
        for (std::size_t j = 0; j < joints.size(); ++j)
            all.push_back({joints.at(j).index(nodes_.size(), "node"), from_columns(&bind[16 * j])});
        const JsonCursor primitives = item(document, "meshes", *mesh).at("primitives");
        for (std::size_t p = 0; p < primitives.size(); ++p)
            see_skinned(source, primitives.at(p), all, nodes_[n].morph);
    }
}

void MotionLimits::see_skinned(Source& source, const JsonCursor& primitive, const std::vector<Joint>& joints,
                               double morph) {
    const auto raise = [&](double number, const Vec3& p, double more) {
        if (!(number >= 0) || number >= static_cast<double>(joints.size())) return;
        const Joint& joint = joints[static_cast<std::size_t>(number)];
        double& reach = nodes_[joint.node].reach;
        reach = std::max(reach, length(joint.from_mesh.point(p)) + more * greatest_stretch(joint.from_mesh));
    };
    const JsonCursor attributes = primitive.at("attributes");
    const auto where = attributes.find("POSITION"), of = attributes.find("JOINTS_0"),
               by = attributes.find("WEIGHTS_0");
    if (!where) return;
    const bool draco = primitive.find("extensions").has_value();
    if (!of || !by || draco || attributes.find("JOINTS_1")) { // any joint may move any vertex
        for (std::size_t j = 0; j < joints.size(); ++j)
            raise(static_cast<double>(j), {}, radius_of(source, *where) + morph);
        return;
    }
    const Attribute positions = decode_numbers(source, accessor(source, *where)),
                    ids = decode_numbers(source, accessor(source, *of)),
                    weights = decode_numbers(source, accessor(source, *by));
    const std::size_t count = std::min({positions.size(), ids.size(), weights.size()});
    if (positions.components != 3 || ids.components != 4 || weights.components != 4) return;
    for (std::size_t i = 0; i < count; ++i)
        for (int k = 0; k < 4; ++k)
            if (weights.value(i, k) > 0)
                raise(ids.value(i, k), {positions.value(i, 0), positions.value(i, 1), positions.value(i, 2)},
                      morph);
}

void MotionLimits::see_hierarchy(const std::vector<NodeFrame>& frames) {
    const std::vector<std::size_t> order = parents_first(frames);
    std::vector<double> stretch(frames.size(), 1);
    for (const std::size_t n : order) {
        Node& node = nodes_[n];
        if (frames[n].parent >= 0) {
            const auto parent = static_cast<std::size_t>(frames[n].parent);
            node.parent_stretch = stretch[parent];
            node.above = nodes_[parent].above + nodes_[parent].own;
        }
        stretch[n] = node.parent_stretch * node.scale;
    }
    for (std::size_t i = order.size(); i-- > 0;) {
        const std::size_t n = order[i];
        if (frames[n].parent < 0) continue;
        Node& parent = nodes_[static_cast<std::size_t>(frames[n].parent)];
        // The length of the path bounds the distance in every pose. A bone is as long as it is, even if
        // nothing hangs on it.
        parent.reach = std::max(parent.reach, nodes_[n].move + nodes_[n].scale * nodes_[n].reach);
        parent.below = std::max(parent.below, nodes_[n].below + nodes_[n].own);
    }
}

double MotionLimits::share(std::size_t node) const {
    const Node& n = nodes_[node];
    return length_ / std::max(1, n.above + n.own + n.below);
}

double MotionLimits::of(std::size_t node, const std::string& path) const {
    if (!moving_.contains({node, path})) return 0;
    const Node& n = nodes_[node];
    const auto over = [&](double lever) { return share(node) / std::max(lever, 1e-300); };
    if (path == "translation") return n.reach < HUGE_VAL ? over(n.parent_stretch) : 0;
    if (path == "rotation") return std::min(largest_angle, over(n.parent_stretch * n.scale * n.reach));
    if (path == "scale") return std::min(largest_scale_error, over(n.parent_stretch * n.reach));
    return path == "weights" ? std::min(largest_weight_error, over(n.parent_stretch * n.scale * n.morph)) : 0;
}

} // namespace facetmill::io::gltf
