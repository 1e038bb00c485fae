#include "stages/thicken/options.hpp"

namespace facetmill {

using What = ThickenOptions::What;

void declare_thicken(Declare<ThickenOptions>& d) {
    d.option("thickness", &ThickenOptions::thickness, "Of the solid; the diameter of cylinders.")
        .above(0)
        .required()
        .primary();
    d.choice<ThickenSide>(
        "side", &ThickenOptions::side,
        {{"inward", ThickenSide::inward, "behind the front, which stays where it is"},
         {"outward", ThickenSide::outward, "before it; what was the front is the back's place"},
         {"centred", ThickenSide::centred, "half of it on either side"}},
        "Where the thickness goes.");
    d.choice<What>("what", &ThickenOptions::what,
                   {{"surface", What::surface, "a shell with walls along open edges"},
                    {"edges", What::edges, "every edge becomes a cylinder, and the faces go"},
                    {"open-edges", What::open_edges, "only open edges do"}},
                   "What becomes thick.");
    d.option("corner_limit", &ThickenOptions::corner_limit,
             "A vertex at a sharp corner moves at most so many times the thickness (a factor).")
        .between(1, 100);
    d.option("sides", &ThickenOptions::sides, "Of each cylinder (a count).").between(3, 360);
    d.option("self_intersections", &ThickenOptions::self_intersections,
             "Looks for them in the result and says so.");
}

} // namespace facetmill
