#include "stage/options/mask.hpp"

#include "base/text/words.hpp"
#include "stage/options/synonyms.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

void declare_mask(Declare<MaskSettings>& d) {
    d.option("material", &MaskSettings::material, "The name or glob of the materials whose faces move.");
    d.option("group", &MaskSettings::group,
             "The number of the group whose faces move, from the face attribute group.");
    d.option("attribute", &MaskSettings::attribute,
             "A vertex, wedge or face attribute. Its first component, clamped to 0 .. 1, is the share of the "
             "movement.")
        .also_called(attribute_synonyms)
        .primary();
    d.option("invert", &MaskSettings::invert, "Inverts the mask: each share becomes 1 minus the share.");
    d.at_least_one({"material", "group", "attribute"});
}

std::vector<double> MaskOfParts::of(const Part& part) {
    const auto moving = [](const std::vector<double>& shares) {
        return static_cast<std::size_t>(
            std::count_if(shares.begin(), shares.end(), [](double share) { return share > 0; }));
    };
    std::vector<double> shares;
    if (settings_) {
        shares = vertex_mask(part, scene_, *settings_);
        vertices_ += shares.size();
        selected_ += moving(shares);
    }
    if (caps_ == Caps::fixed) hold_caps(part.mesh, shares);
    if (settings_) moving_ += moving(shares);
    return shares;
}

void MaskOfParts::warn_if_idle(Context& context) const {
    if (vertices_ == 0 || moving_ > 0) return;
    if (selected_ > 0)
        return context.warn(
            "W-MASK",
            fmt::format("{}: the mask selects only vertices of caps, so nothing moves", context.name()),
            "use caps: free");
    std::string materials;
    for (const auto& m : scene_.materials) append_item(materials, m.name);
    context.warn(
        "W-MASK",
        fmt::format("{}: the mask selects none of {} vertices, so nothing moves", context.name(), vertices_),
        settings_->material.empty() ? std::string("a vertex moves if all its faces are selected")
        : materials.empty()         ? std::string("the scene has no materials")
                                    : "the materials are " + materials);
}

} // namespace facetmill
