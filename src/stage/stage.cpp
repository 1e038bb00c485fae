#include "stage/stage.hpp"

#include "base/words.hpp"
#include "stage/known_surfaces.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace facetmill {

namespace {
std::vector<StageInfo>& registry() {
    static std::vector<StageInfo> all;
    return all;
}
} // namespace

RegisterStage::RegisterStage(StageInfo info) {
    auto& all = registry();
    const auto at =
        std::lower_bound(all.begin(), all.end(), info.name,
                         [](const StageInfo& s, const std::string& name) { return s.name < name; });
    all.insert(at, std::move(info));
}

const std::vector<StageInfo>& stages() { return registry(); }

const StageInfo* stage_named(std::string_view name) {
    for (const auto& s : registry())
        if (s.name == name) return &s;
    return nullptr;
}

namespace {

void leave_lines(const StageInfo& stage, const Scene& scene, Context& context) {
    if (stage.lines == LinesPolicy::work || stage.loads) return;
    const std::size_t left = context.leave_lines(scene);
    if (left == 0) return;
    if (stage.lines == LinesPolicy::pass || stage.checks || stage.tells)
        context.say(counted(left, "part") + " of lines left out");
    else
        context.warn("W-LINES",
                     fmt::format("{} works on faces and leaves {} of lines as {}", stage.name,
                                 counted(left, "part"), left == 1 ? "it is" : "they are"),
                     "load: {lines: 1%} makes tubes of lines");
}

void tell_of_points(const StageInfo& stage, const Scene& scene, Context& context) {
    if (!stage.leaves_points) return;
    const auto clouds =
        static_cast<std::size_t>(std::count_if(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
            return part.mesh.face_count() == 0 && part.mesh.line_count() == 0 &&
                   part.mesh.vertex_count() > 0 && context.selects(part, scene);
        }));
    if (clouds == 0) return;
    if (stage.tells)
        context.say(counted(clouds, "cloud") + " of points left out");
    else
        context.warn("W-POINTS",
                     fmt::format("{} works on faces and leaves {} of points as {}", stage.name,
                                 counted(clouds, "cloud"), clouds == 1 ? "it is" : "they are"),
                     "leave them out with only; crop, clip and tile work on points");
}

} // namespace

Scene perform(const StageInfo& stage, Scene scene, const void* options, Context& context) {
    std::optional<std::vector<PartSurface>> unknown;
    return perform(stage, std::move(scene), options, context, unknown);
}

Scene perform(const StageInfo& stage, Scene scene, const void* options, Context& context,
              std::optional<std::vector<PartSurface>>& surfaces) {
    auto known = std::exchange(surfaces, std::nullopt);
    const CrossingFacePolicy crossing =
        stage.crossing_faces_with ? stage.crossing_faces_with(options) : stage.crossing_faces;
    if (crossing == CrossingFacePolicy::fill) known.reset(); // filled faces have another area
    prepare_crossing_faces(crossing, scene, context);
    leave_lines(stage, scene, context);
    tell_of_points(stage, scene, context);
    const MayLose may_lose = stage.may_lose_with ? stage.may_lose_with(options) : stage.may_lose;
    if (stage.checks || stage.loads || may_lose == MayLose::all)
        return stage.run(std::move(scene), options, context);
    const auto before = known ? *std::move(known) : surfaces_of_parts(scene);
    context.know_surfaces(before);
    scene = stage.run(std::move(scene), options, context);
    auto after = surfaces_of_parts(scene, context.kept_sizes(scene));
    warn_of_lost_surface(before, after, may_lose, context);
    surfaces = std::move(after);
    return scene;
}

std::shared_ptr<void> owned_options(void* options, void (*drop)(void*)) { return {options, drop}; }

std::vector<std::string> stage_names() {
    std::vector<std::string> names;
    for (const auto& s : registry()) names.push_back(s.name);
    return names;
}

} // namespace facetmill
