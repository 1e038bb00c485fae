#include "stages/transform/report.hpp"

#include <fmt/format.h>

namespace facetmill {

Json described(const Scene& scene, const io::Conversion& converted, const Transform& all) {
    Json rows = Json::array();
    for (const auto& row : all.m) rows.push_back({row[0], row[1], row[2], row[3]});
    return {{"matrix", rows},
            {"unit_factor", converted.factor},
            {"unit", to_string(scene.unit)},
            {"up", to_string(scene.up)}};
}

void warn_of_conversion(const io::Conversion& converted, const TransformOptions& o, Context& context) {
    for (const auto& name : converted.lost_skins) warn_of_skin(name, context);
    if (converted.unit_guessed)
        context.warn(
            "W-UNITS",
            fmt::format("transform: the scene had no unit; its numbers are taken as {}", to_string(o.unit)),
            "say what the file's numbers mean when it is loaded (load: {unit: mm})");
    if (converted.up_guessed)
        context.warn("W-UP",
                     fmt::format("transform: the scene had no up axis; nothing is turned, and {} is up now",
                                 to_string(o.up)),
                     "say which axis is up in the file when it is loaded (load: {up: z})");
}

void warn_of_skin(const std::string& part, Context& context) {
    context.warn("W-SKIN", fmt::format("transform: part '{}' moves in bind pose and loses its skin", part),
                 "move the node of its skeleton instead");
}

void warn_of_animation(const std::string& part, Context& context) {
    context.warn("W-TRANSFORM", fmt::format("transform: part '{}' is animated and is not baked", part),
                 "its node has moved; merge makes it a part that stands still");
}

} // namespace facetmill
