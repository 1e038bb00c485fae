#pragma once
// What a stage cuts by: a plane, several, or a box; in the world or in each part's own space.

#include "stage/options/box.hpp"
#include "stage/options/plane.hpp"

namespace facetmill {

enum class Space { world, local };

/// The options of a stage that cuts derive from these.
struct CutterOption {
    std::optional<PlaneOption> plane;
    std::vector<PlaneOption> planes;
    std::optional<BoxOption> box;
    Space space = Space::world;
};

/// Declares plane (primary), planes and box, of which one is needed.
template <class S>
void declare_cutter(Declare<S>& d) {
    d.group("plane", static_cast<std::optional<PlaneOption> S::*>(&S::plane), "The plane to clip by.",
            declare_plane)
        .primary();
    d.option("planes", static_cast<std::vector<PlaneOption> S::*>(&S::planes),
             "Several planes, each as for plane; one after the other.");
    d.group("box", static_cast<std::optional<BoxOption> S::*>(&S::box),
            "A box to clip by; its front is the inside.", declare_box);
    d.exactly_one({"plane", "planes", "box"});
}

/// Declares space.
template <class S>
void declare_space(Declare<S>& d) {
    d.template choice<Space>(
        "space", static_cast<Space S::*>(&S::space),
        {{"world", Space::world, "planes and boxes stand in the scene"},
         {"local", Space::local, "they stand in each part's own space, before its node's transform"}},
        "What coordinates, centre and extent refer to.");
}

/// Adds E-PLANE and E-BOX for what is none.
void verify_cutter(const CutterOption& option, const Value& given, Problems& problems);

/// The planes that they are in a scene.
class Cutter {
  public:
    /// Throws usage (E-UNIT, E-PLANE), as planes_for does.
    Cutter(const CutterOption& option, const Scene& scene, Context& context);
    /// With space: world, as they stand in the scene.
    const std::vector<Plane>& world() const { return world_; }
    /// In the part's own space.
    std::vector<Plane> planes_for(const Part& part) const;

  private:
    const CutterOption& option_;
    const Scene& scene_;
    Context& context_;
    std::vector<Plane> world_;
};

} // namespace facetmill
