#pragma once
// A simplification as reports have it.

#include "geometry/deviation/deviation.hpp"
#include "geometry/inspect/inspect.hpp"
#include "geometry/simplify/simplify.hpp"
#include "options/fields.hpp"

#include <string>
#include <vector>

namespace facetmill::simplify_stage {

/// What a surface measures.
struct Size {
    double area = 0;
    std::optional<double> volume; ///< when closed
};

/// A part, or a level of one.
struct SimplifiedPart {
    struct Topology {
        Properties before, after;
    };
    /// Of the surface, in the world.
    struct Sizes {
        Size before, after;
    };
    SimplifyResult result;                     ///< without its mesh
    double scale = 1;                          ///< takes lengths from the part's space to the scene's
    std::optional<double> max_quadric_error{}; ///< that held, in scene units
    std::string part;
    std::optional<std::vector<std::string>> joint_with;
    std::optional<Topology> topology; ///< of methods that may change it
    std::optional<Sizes> sizes;       ///< when measured
    std::optional<DeviationResult> deviation;
};

struct SimplifyReport {
    std::vector<SimplifiedPart> parts;
};
/// Lines for the terminal: counts, what stopped it, the deviation. A few parts one by one, more of them
/// together.
void declare_simplify_report(DeclareFields<SimplifyReport>& d);

/// What holds the edges that are left, as a phrase; and what can be done about most of them.
std::string held_by(const SimplifyResult& r);
std::string hint_for(const SimplifyResult& r);

} // namespace facetmill::simplify_stage
