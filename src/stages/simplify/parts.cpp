#include "stages/simplify/parts.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "geometry/edit/moved.hpp"
#include "io/gltf/gltf.hpp"
#include "stage/bind_pose.hpp"
#include "stages/simplify/posed_deviation.hpp"

#include <fmt/format.h>

namespace facetmill::simplify_stage {

namespace {

using Stop = SimplifyResult::Stop;

bool is_of_part(const Length& length) {
    return length.kind == Length::Kind::percent && length.of == Length::Of::part;
}

/// The scene with every part at the largest scale that an animation gives it.
class LargestPose {
  public:
    explicit LargestPose(Scene& scene) : scene_(scene) {
        const auto views = io::part_views(scene);
        rest_.reserve(scene.parts.size());
        for (const Part& part : scene.parts) rest_.push_back(part.transform);
        largest_ = rest_;
        for (std::size_t i = 0; i < views.size(); ++i) largest_[i] = views[i].largest;
    }

    const Transform& at_rest(std::size_t part) const { return rest_[part]; }
    bool enlarges(std::size_t part) const { return largest_[part] != rest_[part]; }
    void assume() const { set(largest_); }
    void leave() const { set(rest_); }

  private:
    void set(const std::vector<Transform>& transforms) const {
        for (std::size_t i = 0; i < transforms.size(); ++i) scene_.parts[i].transform = transforms[i];
    }

    Scene& scene_;
    std::vector<Transform> rest_, largest_;
};

/// Resolve the lengths in the order of the report.
SimplifyPartsSettings settings_in(const Scene& scene, const LargestPose& pose, const SimplifyOptions& o,
                                  Context& context) {
    SimplifyPartsSettings s{.all = simplify_settings(o), .selected = {}, .size_before = {}};
    for (const Part& part : scene.parts) s.selected.push_back(context.selects(part, scene));
    s.by_error = shares_by_error(o);
    s.measure = o.measure;
    s.certify = o.certify;
    s.size_before = [&scene, &pose, &context](std::size_t part) {
        const Part& p = scene.parts[part];
        return pose.enlarges(part) ? surface_size(p.mesh, p.transform) : context.size_before(scene, part);
    };
    if (o.lock.box) s.all.lock.body = planes_of(*o.lock.box);
    if (const auto& limit = o.constraints.hausdorff)
        s.all.constraints.hausdorff = context.resolve(*limit, scene, "constraints.hausdorff");
    if (o.max_error) s.all.max_error = context.resolve(*o.max_error, scene, "max_error");
    if (!o.max_quadric_error || !has_quadrics(o) || o.max_error) return s;
    if (is_of_part(*o.max_quadric_error))
        s.max_of_diagonal = o.max_quadric_error->amount / 100;
    else
        s.all.max_quadric_error = context.resolve(*o.max_quadric_error, scene, "max_quadric_error");
    return s;
}

/// Whether a level's target differs from the current counts. False for a ratio of 100 % or the same number
/// of faces.
bool asks_for_less(const SimplifyOptions& o, const MeshCounts& all, std::size_t level) {
    if (o.lods) return o.lods->ratios[level].value < 1;
    const auto differs = [](std::optional<std::int64_t> target, std::size_t count) {
        return target && *target != static_cast<std::int64_t>(count);
    };
    if (o.ratio && o.ratio->value == 1 && !o.faces && !o.vertices) return false;
    if (!o.ratio && (o.faces || o.vertices))
        return differs(o.faces, all.triangles) || differs(o.vertices, all.vertices);
    return true;
}

} // namespace

void warn_of_stop(const Part& part, const SimplifyResult& r, AskedFor asked, Context& context) {
    if (r.faces_before == 0 && asked.less)
        context.warn("W-SIMPLIFY-NOTHING",
                     fmt::format("part '{}' has no faces to simplify: {} unchanged", part.name,
                                 part.mesh.vertex_count() > 0 ? "the point cloud stays" : "it stays"),
                     "exclude it with only; crop, clip and tile can reduce points");
    else if (r.stop == Stop::nothing && asked.less)
        context.warn("W-SIMPLIFY-NOTHING",
                     fmt::format("part '{}' has {} and {}, at or below the target: nothing to do", part.name,
                                 counted(r.faces_before, "triangle"),
                                 counted(r.vertices_before, "vertex", "vertices")));
    if (r.stop == Stop::stuck && asked.target) // without a target, the error limit stops the simplification
        context.warn("W-SIMPLIFY-STOPPED",
                     fmt::format("part '{}' stopped at {}, above the target: {}", part.name,
                                 counted(r.faces_after, "triangle"), held_by(r)),
                     hint_for(r));
    if (r.faces_before > 0 && r.faces_after == 0)
        context.warn("W-SIMPLIFY-VANISHED", fmt::format("part '{}' has no faces left", part.name),
                     "ask for more faces, or preserve the topology (topology: keep, with a method other than "
                     "cluster)");
}

void warn_of_limit(const std::vector<Limited>& limited, const Length& limit, Context& context) {
    if (limited.empty()) return;
    std::size_t before = 0, after = 0;
    for (const Limited& l : limited) {
        before += l.before;
        after += l.after;
    }
    const std::string first = fmt::format("part '{}'", limited.front().part);
    const std::string who = limited.size() == 1
                                ? first + " stopped at"
                                : fmt::format("{} parts, the first {}, stopped at", limited.size(), first);
    context.warn(
        "W-SIMPLIFY-LIMIT",
        fmt::format("{} {} of {} triangles, above the target: fewer triangles would move the surface by "
                    "more than max_quadric_error ({})",
                    who, grouped(after), grouped(before), limit.text),
        "use max_quadric_error: off to reach the target regardless of the error, or a larger one, such as 5% "
        "of part");
}

namespace {

void warn_of_poses(const Part& part, const PosedDeviation& posed, std::optional<double> max_error,
                   Context& context) {
    if (!max_error || posed.maximum <= *max_error) return;
    context.warn(
        "W-REST-POSE",
        fmt::format("simplify: part '{}' deviates by {:.6g} ({}) in {}, above max_error ({:.6g}), which "
                    "bounds only the rest pose",
                    part.name, posed.maximum, percentage(posed.percent), posed.pose, *max_error),
        "use a smaller max_error, or a ratio, such as simplify: 50%, for parts that move");
}

} // namespace

Scene simplify_parts(Scene scene, const SimplifyOptions& o, Context& context, SimplifyReport& report) {
    const LargestPose pose(scene); // an error is seen at its largest
    const SimplifyPartsSettings settings = settings_in(scene, pose, o, context);
    const MeshCounts all = count_selected(scene, settings.selected);
    const bool has_target = o.lods || o.ratio || o.faces || o.vertices;
    std::vector<Limited> limited;
    std::vector<Part> coarser;
    std::vector<std::string> moving; // parts whose poses max_error does not bound
    const bool measures = o.measure || o.certify || o.max_error;
    PosedParts posed(scene, measures ? settings.selected : std::vector<std::uint8_t>(scene.parts.size()));
    // An entry takes a kilobyte, so growing the list would copy several times as much.
    report.parts.reserve(scene.parts.size() * (o.lods ? o.lods->ratios.size() : 1));
    const auto take = [&](std::size_t number, std::vector<SimplifiedPart> levels) {
        scene.parts[number].changed = true;
        Part base = scene.parts[number];
        base.transform = pose.at_rest(number);
        for (std::size_t i = 0; i < levels.size(); ++i) {
            Part part = base;
            if (i > 0) part.name += fmt::format(".lod{}", i);
            SimplifyResult& r = levels[i].result;
            part.mesh = std::exchange(r.mesh, {});
            context.attribute_changes(part, r.changes);
            warn_of_stop(part, r, {asks_for_less(o, all, i), has_target}, context);
            if (r.faces_after < r.faces_before) levels[i].posed = posed.compare(scene, number, part);
            if (levels[i].posed)
                warn_of_poses(part, *levels[i].posed, settings.all.max_error, context);
            else if (o.max_error && r.faces_after < r.faces_before && has_poses(part))
                moving.push_back(part.name);
            if (r.stop == Stop::max_quadric_error)
                limited.push_back({part.name, r.faces_before, r.faces_after});
            if (levels[i].surface && !o.lods && !pose.enlarges(number)) // lods add parts to the scene
                context.keep_size(number, *levels[i].surface);
            levels[i].part = part.name;
            report.parts.push_back(std::move(levels[i]));
            (i > 0 ? coarser.emplace_back() : scene.parts[number]) = std::move(part);
        }
    };
    pose.assume();
    facetmill::simplify_parts(scene, settings, take);
    pose.leave();
    for (Part& part : coarser) scene.parts.push_back(std::move(part));
    warn_of_rest_pose("max_error", moving, context);
    if (o.max_quadric_error) warn_of_limit(limited, *o.max_quadric_error, context);
    return scene;
}

} // namespace facetmill::simplify_stage
