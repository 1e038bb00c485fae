#include "stages/write/origin.hpp"

#include "base/text/words.hpp"
#include "mesh/equal_meshes.hpp"
#include "mesh/transform.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace facetmill {

bool OptionType<OriginOption>::parse(const Value& value, OriginOption& out, Problems& problems) {
    if (value.deferred) return true;
    if (value.is_scalar() && (value.text == "auto" || value.text == "keep")) {
        out.kind = value.text == "auto" ? OriginOption::Kind::automatic : OriginOption::Kind::keep;
        return true;
    }
    out.kind = OriginOption::Kind::point;
    Problems unheard;
    if (OptionType<Vec3>::parse(value, out.point, unheard)) return true;
    problems.add(value.mark, "E-TYPE",
                 fmt::format("expected auto, keep, or a point ([0, 0, 1]), found {}", value.described()));
    return false;
}
std::string OptionType<OriginOption>::print(const OriginOption& value) {
    if (value.kind == OriginOption::Kind::point) return OptionType<Vec3>::print(value.point);
    return value.kind == OriginOption::Kind::keep ? "keep" : "auto";
}
Json OptionType<OriginOption>::schema() {
    return {{"anyOf", Json::array({OptionType<Vec3>::schema(), {{"enum", Json::array({"auto", "keep"})}}})}};
}

namespace write_stage {

namespace {

/// The largest distance in the world that float32 moves a point of the part.
double rounding_of(const Part& part) {
    const Box box = part.mesh.bounds();
    double most = 0;
    for (std::size_t i = 0; i < 3 && !box.empty(); ++i)
        most = std::max({most, std::abs(box.min[i]), std::abs(box.max[i])});
    const auto x = static_cast<float>(most);
    if (!std::isfinite(x)) return 0; // such coordinates are refused
    const double step = static_cast<double>(std::nextafter(x, HUGE_VALF)) - static_cast<double>(x);
    return step / 2 * greatest_stretch(part.transform);
}

/// Whether the part is skinned, or its document has animations or instances, so that its node must not
/// change.
bool moves_nodes(const Scene& scene, const Part& part) {
    if (part.skinned) return true;
    if (part.document < 0 || part.node < 0) return false;
    const std::string& json = scene.documents[static_cast<std::size_t>(part.document)]->json;
    return json.find("\"animations\"") != std::string::npos ||
           json.find("\"EXT_mesh_gpu_instancing\"") != std::string::npos;
}

/// The centre of the box, rounded to a grid of at most a sixteenth of its diagonal, so that it has few
/// digits.
Vec3 near_centre(const Box& box) {
    const double step = std::ldexp(1.0, std::ilogb(box.diagonal() / 8));
    Vec3 p = box.centre();
    for (std::size_t i = 0; i < 3; ++i) p[i] = std::round(p[i] / step) * step;
    return p;
}

} // namespace

std::optional<OriginReport> move_origin(Scene& scene, const OriginOption& option, Context& context,
                                        std::map<std::size_t, std::vector<Vec3>>& moved) {
    using Kind = OriginOption::Kind;
    const Box box = scene.bounds();
    const double size = box.diagonal();
    if (option.kind == Kind::keep || box.empty() || !std::isfinite(size)) return {};
    constexpr double tolerable = 1e-6; // times the diagonal
    std::vector<std::size_t> chosen;
    std::vector<std::string> kept;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        const Part& part = scene.parts[i];
        if (option.kind == Kind::automatic && !(size > 0 && rounding_of(part) > tolerable * size)) continue;
        if (!moves_nodes(scene, part) && inverse(part.transform))
            chosen.push_back(i);
        else
            kept.push_back(part.name);
    }
    if (!kept.empty() && option.kind == Kind::point)
        context.warn("W-ORIGIN",
                     fmt::format("{} with skins, animations or instances keep{} the origin: {}",
                                 counted(kept.size(), "part"), kept.size() == 1 ? "s" : "",
                                 fmt::join(kept, ", ")),
                     "use merge before write, because merge removes skins and animations");
    if (chosen.empty()) return {};
    OriginReport report{option.kind == Kind::point ? option.point : near_centre(box), chosen.size()};
    const auto first = DistinctParts(scene).first; // uses the meshes before the move; equal meshes stay equal
    std::map<std::size_t, Vec3> offsets;
    for (const std::size_t i : chosen) {
        Part& part = scene.parts[i];
        const Vec3 own = inverse(part.transform)->point(report.offset);
        const Vec3 offset = offsets.emplace(first[i], own).first->second;
        moved.emplace(i, part.mesh.positions);
        for (Vec3& p : part.mesh.positions) p -= offset;
        Transform shift;
        for (std::size_t k = 0; k < 3; ++k) shift.m[k][3] = offset[k];
        part.transform = part.transform * shift;
        part.changed = true;
    }
    return report;
}

} // namespace write_stage

} // namespace facetmill
