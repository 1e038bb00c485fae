#include "stage/mask_option.hpp"

namespace facetmill {

void declare_mask(Declare<MaskSettings>& d) {
    d.option("material", &MaskSettings::material, "Name or glob of the materials whose faces move.");
    d.option("group", &MaskSettings::group,
             "Number of the group whose faces move, as in face attribute group (without unit).");
    d.option("attribute", &MaskSettings::attribute,
             "A vertex, wedge or face attribute: its first number, cut to 0 .. 1, is the share of the move.")
        .primary();
    d.option("invert", &MaskSettings::invert, "Move the others, by the rest of the share.");
    d.at_least_one({"material", "group", "attribute"});
}

} // namespace facetmill
