#pragma once
// The options of relax and their conversion to settings.

#include "geometry/relax/relax.hpp"
#include "stage/options/mask.hpp"

namespace facetmill::relax_stage {

struct RelaxOptions {
    std::optional<std::int64_t> iterations;      ///< if empty: 1, or 1000 with until
    std::optional<RelaxSettings::Method> method; ///< if empty: laplacian, or hc with until
    std::optional<double> lambda;
    RelaxSettings::Neighbours neighbours = RelaxSettings::Neighbours::faces;
    RelaxSettings::Boundary boundary = RelaxSettings::Boundary::fixed;
    std::optional<Angle> feature_angle;
    std::optional<Length> until;
    double pass_band = RelaxSettings{}.pass_band;
    std::optional<double> alpha; ///< if empty: 0, or 0.1 with until, so that the iteration converges
    double beta = RelaxSettings{}.beta;
    Caps caps = Caps::fixed;
    std::optional<MaskSettings> mask;
};

void declare_relax(Declare<RelaxOptions>& d);
/// Checks options of other methods, and a lambda that is invalid for the method. The declaration cannot
/// express these.
void verify_relax(const RelaxOptions& o, const Value& given, Problems& problems);

/// The settings shared by all parts, except until, mask and the transform.
[[nodiscard]] RelaxSettings relax_settings(const RelaxOptions& o);

} // namespace facetmill::relax_stage
