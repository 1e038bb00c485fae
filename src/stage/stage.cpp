#include "stage/stage.hpp"

#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
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

std::shared_ptr<Stage> StageInfo::made() const {
    auto stage = make();
    stage->info = this;
    return stage;
}

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

/// Warns with `id` about parts that a stage for faces leaves unchanged, unless it omits them from its result.
void tell_of_left(const StageInfo& stage, const std::string& what, bool leaves_out, const char* id,
                  const char* hint, Context& context) {
    if (leaves_out)
        context.say(what + " skipped");
    else
        context.warn(id, fmt::format("{} works on faces and leaves {} unchanged", stage.name, what), hint);
}

void leave_lines(const StageInfo& stage, const Scene& scene, Context& context) {
    if (stage.lines == LinesPolicy::work || stage.loads) return;
    const std::size_t left = context.leave_lines(scene);
    if (left == 0) return;
    tell_of_left(stage, counted(left, "part") + " of lines",
                 stage.lines == LinesPolicy::pass || stage.checks || stage.tells, "W-LINES",
                 "use load: {lines: 1%} to turn lines into tubes", context);
}

void tell_of_points(const StageInfo& stage, const Scene& scene, Context& context) {
    if (!stage.leaves_points) return;
    const auto clouds =
        static_cast<std::size_t>(std::count_if(scene.parts.begin(), scene.parts.end(), [&](const Part& part) {
            return part.mesh.face_count() == 0 && part.mesh.line_count() == 0 &&
                   part.mesh.vertex_count() > 0 && context.selects(part, scene);
        }));
    if (clouds == 0) return;
    tell_of_left(stage, counted(clouds, "cloud") + " of points", stage.tells, "W-POINTS",
                 "exclude them with only; crop, clip and tile work on points", context);
}

} // namespace

Scene perform(const Stage& stage, Scene scene, Context& context) {
    std::optional<std::vector<PartSurface>> unknown;
    return perform(stage, std::move(scene), context, unknown);
}

Scene perform(const Stage& stage, Scene scene, Context& context,
              std::optional<std::vector<PartSurface>>& surfaces) {
    auto known = std::exchange(surfaces, std::nullopt);
    const CrossingFacePolicy crossing = stage.crossing_faces();
    if (crossing == CrossingFacePolicy::fill) known.reset(); // filling changes the area of faces
    prepare_crossing_faces(crossing, scene, context);
    leave_lines(*stage.info, scene, context);
    tell_of_points(*stage.info, scene, context);
    const MayLose may_lose = stage.may_lose();
    if (stage.info->checks || stage.info->loads || may_lose == MayLose::all)
        return stage.run(std::move(scene), context);
    const auto before = known ? *std::move(known) : surfaces_of_parts(scene);
    context.know_surfaces(before);
    scene = stage.run(std::move(scene), context);
    auto after = surfaces_of_parts(scene, context.kept_sizes(scene));
    warn_of_lost_surface(before, after, may_lose, context);
    surfaces = std::move(after);
    return scene;
}

std::vector<std::string> stage_names() {
    std::vector<std::string> names;
    for (const auto& s : registry()) names.push_back(s.name);
    return names;
}

const StageInfo* stage_called(std::string_view other_name) {
    std::string word = lower_case(std::string(other_name));
    std::replace(word.begin(), word.end(), '-', '_');
    for (const auto& s : registry())
        if (has_word(s.also_called, word)) return &s;
    return nullptr;
}

std::string hint_for_stage(std::string_view word, const std::vector<std::string>& names) {
    if (const StageInfo* stage = stage_called(word))
        return fmt::format("'{}' is done by {} here: facetmill stages {}", word, stage->name, stage->name);
    return did_you_mean(word, names, "facetmill stages lists all stages");
}

} // namespace facetmill
