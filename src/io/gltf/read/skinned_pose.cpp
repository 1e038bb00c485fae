#include "io/gltf/read/skinned_pose.hpp"

#include "io/gltf/document/nodes.hpp"
#include "io/gltf/gltf.hpp"
#include "io/gltf/read/pose_mesh.hpp"

#include <algorithm>
#include <map>

namespace facetmill::io {

namespace {

using namespace gltf;

/// A document, opened on first use.
class Opened {
  public:
    explicit Opened(const facetmill::Document& document)
        : json_(parse_document(document.json)), frames_(node_frames(json_)),
          source_(json_, document.buffers) {}

    std::vector<Transform> joints(std::size_t node) {
        std::vector<Transform> worlds;
        worlds.reserve(frames_.size());
        for (const NodeFrame& frame : frames_) worlds.push_back(frame.world);
        return joint_matrices(source_, node, worlds);
    }
    std::vector<double> weights(const Part& part) const { return default_weights(json_, part); }

  private:
    Json json_;
    std::vector<NodeFrame> frames_;
    Source source_;
};

/// Returns true if the part has moved.
bool take_pose(Part& part, Opened& document) {
    const bool moved = has_targets(part.mesh) && morph(part.mesh, document.weights(part));
    if (!part.skinned || part.node < 0) return moved;
    return bend(part.mesh, document.joints(static_cast<std::size_t>(part.node))) || moved;
}

} // namespace

std::optional<Scene> posed(const Scene& scene) {
    const auto may_move = [](const Part& p) { return p.document >= 0 && (p.skinned || has_targets(p.mesh)); };
    if (std::none_of(scene.parts.begin(), scene.parts.end(), may_move)) return {};
    Scene out = scene;
    std::map<int, Opened> documents;
    bool any = false;
    for (Part& part : out.parts) {
        if (!may_move(part)) continue;
        try { // reading checks only meshes, so this may throw
            const auto document = static_cast<std::size_t>(part.document);
            Part moved = part;
            if (!take_pose(moved,
                           documents.try_emplace(part.document, *scene.documents.at(document)).first->second))
                continue;
            part = std::move(moved);
            any = true;
        } catch (const Error& error) {
            if (error.kind() != ErrorKind::malformed) throw;
        }
    }
    return any ? std::optional(std::move(out)) : std::nullopt;
}

Box posed_bounds(const Scene& scene, std::vector<bool> chosen) {
    const auto pose = posed(scene);
    const Scene& seen = pose ? *pose : scene;
    std::vector<PartView> views(seen.parts.size());
    try {
        views = part_views(seen);
    } catch (const Error&) { // a document whose animations are invalid: viewers cannot play them
        for (std::size_t i = 0; i < views.size(); ++i) views[i].largest = seen.parts[i].transform;
    }
    chosen.resize(views.size(), chosen.empty());
    bool any = false, any_drawn = false;
    for (std::size_t i = 0; i < views.size(); ++i) {
        chosen[i] = chosen[i] && seen.parts[i].mesh.vertex_count() > 0;
        any |= chosen[i];
        any_drawn |= chosen[i] && views[i].is_drawn();
    }
    if (!any) return {};
    for (std::size_t i = 0; i < views.size(); ++i) {
        views[i].hidden = !chosen[i] || (any_drawn && views[i].hidden);
        views[i].lower_level = any_drawn && views[i].lower_level;
    }
    return drawn_bounds(seen, views);
}

} // namespace facetmill::io
