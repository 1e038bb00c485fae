#include "stage/bind_pose.hpp"

#include "base/text/words.hpp"
#include "io/gltf/read/skinned_pose.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

/// The largest distance of a vertex from its shown position, as a share of the shown part's diagonal.
double share_of_move(const Part& bind, const Part& shown) {
    Box box;
    double farthest = 0;
    for (std::size_t v = 0; v < bind.mesh.vertex_count(); ++v) {
        const Vec3 p = shown.transform.point(shown.mesh.positions[v]);
        box.add(p);
        farthest = std::max(farthest, length(bind.transform.point(bind.mesh.positions[v]) - p));
    }
    return box.empty() || !(box.diagonal() > 0) ? 0 : farthest / box.diagonal();
}

} // namespace

void warn_of_bind_pose(const Scene& scene, Context& context) {
    const auto concerns = [&](const Part& part) { return part.skinned && context.selects(part, scene); };
    if (std::none_of(scene.parts.begin(), scene.parts.end(), concerns)) return;
    const auto shown = io::posed(scene);
    if (!shown) return;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene.parts.size(); ++i)
        if (concerns(scene.parts[i]) && share_of_move(scene.parts[i], shown->parts[i]) > 0.01)
            names.push_back(fmt::format("'{}'", scene.parts[i].name));
    if (names.empty()) return;
    context.warn(
        "W-BIND-POSE",
        fmt::format("{}: {} {} {} in bind pose, but viewers show another pose, which the joints define",
                    context.name(), names.size() == 1 ? "part" : "parts", join_texts(names),
                    names.size() == 1 ? "is" : "are"),
        "give planes, boxes and points in the bind pose; info prints its bounds, render shows the other "
        "pose");
}

bool has_poses(const Part& part) {
    const auto is_morph = [](const Attribute& a) { return a.role == Role::morph_vector; };
    return part.mesh.face_count() > 0 &&
           (part.skinned || std::any_of(part.mesh.attributes.begin(), part.mesh.attributes.end(), is_morph));
}

void warn_of_rest_pose(const std::string& limit, const std::vector<std::string>& parts, Context& context) {
    if (parts.empty()) return;
    constexpr std::size_t most = 3;
    std::vector<std::string> shown;
    for (std::size_t i = 0; i < std::min(most, parts.size()); ++i)
        shown.push_back(fmt::format("'{}'", parts[i]));
    if (parts.size() > most) shown.push_back(fmt::format("{} more", parts.size() - most));
    context.warn("W-REST-POSE",
                 fmt::format("{}: {} and the deviation apply only to the rest pose of {}: where joints bend "
                             "the surface or morph targets move it, the error may be much larger",
                             context.name(), limit, join_texts(shown)),
                 "use simplify: 50%, a ratio, for parts that move, and compare their poses");
}

} // namespace facetmill
