#pragma once
// The options of relax, and what they come to.

#include "geometry/relax/relax.hpp"
#include "stage/options/mask.hpp"

namespace facetmill {

struct RelaxOptions {
    std::optional<std::int64_t> iterations; ///< none: 1, or 1000 with until
    RelaxSettings::Method method = RelaxSettings::Method::laplacian;
    std::optional<double> lambda;
    RelaxSettings::Neighbours neighbours = RelaxSettings::Neighbours::faces;
    RelaxSettings::Boundary boundary = RelaxSettings::Boundary::fixed;
    std::optional<Angle> feature_angle;
    std::optional<Length> until;
    double pass_band = RelaxSettings{}.pass_band;
    double alpha = RelaxSettings{}.alpha;
    double beta = RelaxSettings{}.beta;
    std::optional<MaskSettings> mask;
};

void declare_relax(Declare<RelaxOptions>& d);
/// What the declaration cannot say: options of other methods, a lambda that a method cannot take.
void verify_relax(const RelaxOptions& o, const Value& given, Problems& problems);

/// What is the same for all parts; until, mask and the transform are each part's own.
RelaxSettings relax_settings(const RelaxOptions& o);

} // namespace facetmill
