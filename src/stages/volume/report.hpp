#pragma once
// The report and warnings of volume.

#include "geometry/terrain/terrain.hpp"
#include "mesh/scene.hpp"
#include "options/fields.hpp"
#include "stage/context.hpp"

namespace facetmill::volume_stage {

struct VolumeReport {
    VolumeResult result;
    std::string axis;
    std::optional<double> level; ///< none if another surface is the reference
    bool has_footprint = false;
    Unit unit = Unit::unknown;

    bool is_solid() const { return result.cover == Cover::solid; }
};
void declare_volume_report(DeclareFields<VolumeReport>& d);

/// Warns (W-VOLUME-MISSING) of places without a surface that are more than a millionth of the footprint.
void warn_of_missing(const VolumeReport& report, Context& context);

} // namespace facetmill::volume_stage
