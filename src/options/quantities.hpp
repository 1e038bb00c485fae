#pragma once
// The typed quantities of options. Each stores its spelling. Lengths become numbers when a scene is
// available.

#include "base/math/vec.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace facetmill {

/// A length as written: scene units, a physical unit, or a percentage of a bounding-box diagonal.
struct Length {
    enum class Kind { scene, physical, percent };
    enum class Of {
        stage,
        part,
        load
    }; ///< the reference of a percentage: the stage's input scene, the part, or the scene as loaded
    double amount = 0; ///< in scene units, in metres, or in percent
    Kind kind = Kind::scene;
    Of of = Of::stage;
    std::string text; ///< as written: "2mm"

    static Length scene(double amount);
    static Length percent(double amount, Of of = Of::stage);
};

/// An angle: radians in the program, degrees for users.
struct Angle {
    double radians = 0;
    std::string text = "0deg";
    static Angle degrees(double d);
};

/// A fraction: 0.25 for "25%".
struct Ratio {
    double value = 0;
};

/// A file as written; the pipeline resolves it.
struct PathText {
    std::string text;
    bool operator==(const PathText&) const = default;
};

/// A bound on a property: an exact value (a bare value), or min and max.
struct Bound {
    std::optional<double> min, max;
    std::optional<bool> truth; ///< for properties that are true or false
};

/// A bound on an angle, in degrees.
struct AngleBound : Bound {};
/// A limit on a count. A bare value is the maximum.
struct CountLimit : Bound {};
/// A limit on a count of bytes, which may have a unit.
struct ByteLimit : Bound {};

} // namespace facetmill
