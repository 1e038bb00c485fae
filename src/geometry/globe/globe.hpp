#pragma once
// Places on the globe: geodetic and geocentric coordinates, local frames, and projected coordinates of common
// systems. All by closed formulas and facetmill's own functions, so results do not depend on the processor.

#include "base/math/vec.hpp"

#include <optional>
#include <string_view>

namespace facetmill {

/// Metres.
struct Ellipsoid {
    double equator = 6378137, flattening = 1 / 298.257223563; ///< WGS84
};
inline constexpr Ellipsoid grs80{6378137, 1 / 298.257222101};

/// The angles are in radians, the height above the ellipsoid is in metres.
struct Geodetic {
    double latitude = 0, longitude = 0, height = 0;
};

/// Geocentric coordinates (ECEF, EPSG:4978) in metres, to a nanometre near the ground.
[[nodiscard]] Vec3 geocentric(const Geodetic& place, const Ellipsoid& ellipsoid = {});

/// The map from a local frame to geocentric coordinates. z is up and y is north, turned clockwise by the
/// heading (radians).
[[nodiscard]] Transform local_frame(const Geodetic& place, double heading = 0);

/// A projected coordinate system: x is the easting, y the northing, z the height, in metres.
class ProjectedSystem {
  public:
    /// EPSG:32601 to 32660 and 32701 to 32760 (UTM on WGS84, north and south), 25828 to 25838 (UTM on ETRS89,
    /// taken as WGS84), 3857 (Web Mercator). None for other names.
    [[nodiscard]] static std::optional<ProjectedSystem> named(std::string_view name);

    /// The inverse projection. UTM by the series of L. Krueger, "Konforme Abbildung des Erdellipsoids in der
    /// Ebene" (1912), to the sixth order, and C. F. F. Karney, "Transverse Mercator with an accuracy of a few
    /// nanometers" (2011).
    [[nodiscard]] Geodetic geodetic(const Vec3& projected) const;
    [[nodiscard]] Vec3 geocentric(const Vec3& projected) const;
    /// Like local_frame, with x and y along the grid at a point.
    [[nodiscard]] Transform frame_at(const Vec3& projected) const;

    /// Whether the coordinates can be in the system: UTM up to 1,000 km from its central meridian.
    [[nodiscard]] bool may_hold(const Vec3& projected) const;

  private:
    enum class Kind { utm, web_mercator };
    Kind kind_ = Kind::utm;
    Ellipsoid ellipsoid_;
    double meridian_ = 0, false_northing_ = 0;
};

} // namespace facetmill
