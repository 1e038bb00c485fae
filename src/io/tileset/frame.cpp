#include "io/tileset/frame.hpp"

#include "base/text/readable_numbers.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace facetmill::io {

namespace {

/// The largest power of two that is at most x; a tiny power of two if x is 0.
double power_below(double x) { return std::ldexp(1.0, x > 0 ? std::max(std::ilogb(x), -1000) : -1000); }

/// The centre, rounded to multiples of a power of two. This is at most an eighth of the diagonal, but at
/// least `least`. Coordinates too large for such multiples in doubles stay unchanged.
Vec3 near_centre(const Box& box, double least) {
    constexpr double whole = 1LL << 52; // larger doubles have no fractions
    const double step = std::max(least, power_below(box.diagonal() / 8));
    Vec3 p = box.centre();
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (std::abs(p[axis]) < whole * step) p[axis] = std::round(p[axis] / step) * step + 0.0;
    return p;
}

std::size_t count_places(std::vector<Vec3> positions) {
    Mesh points;
    points.positions = std::move(positions);
    weld_exact(points);
    return points.vertex_count();
}

} // namespace

TilesetFrame usual_frame(const Box& box, const WriteSettings& settings) {
    constexpr int float_bits = 24;
    if (!(box.diagonal() <= std::numeric_limits<float>::max()))
        throw Error(ErrorKind::stage, "E-RANGE",
                    fmt::format("the scene has the size {:.3g}, which float32 cannot store", box.diagonal()),
                    "bring it near 1 with transform: {scale: ...}, or write PLY with precision: full");
    TilesetFrame frame{near_centre(box, 0)};
    double reach = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        reach = std::max({reach, box.max[axis] - frame.origin[axis], frame.origin[axis] - box.min[axis]});
    frame.step = frame.finest = power_below(reach) / (std::int64_t{1} << (float_bits - 1));
    if (!settings.draco.on && !settings.quantize.on) return frame;
    const int bits = settings.position_bits();
    const double steps = static_cast<double>((std::int64_t{1} << bits) - 1);
    frame.step = std::max(frame.finest, power_below(box.longest_side() / steps));
    if (settings.tiles.given_bits) frame.finest = frame.step;
    return frame;
}

double distinct_step(const std::vector<Vec3>& positions, const TilesetFrame& frame) {
    if (frame.step <= frame.finest) return frame.step;
    const auto places = [&](double step) {
        std::vector<Vec3> moved = positions;
        put_into_frame(moved, {frame.origin, step});
        return count_places(std::move(moved));
    };
    const std::size_t all = places(frame.finest);
    double step = frame.step;
    while (step > frame.finest && places(step) < all) step /= 2;
    return step;
}

TilesetFrame tileset_frame(const std::vector<Vec3>& positions, const WriteSettings& settings) {
    TilesetFrame frame = usual_frame(box_of(positions), settings);
    frame.step = distinct_step(positions, frame);
    return frame;
}

std::optional<Diagnostic> warning_of_place(const TilesetFrame& frame) {
    constexpr double local = 100e3;                     // metres; projected coordinates are larger
    constexpr double lowest = 6345e3, highest = 6478e3; // the poles less 12 km, the equator and 100 km
    const double radius = length(frame.origin);
    if (radius <= local || (radius >= lowest && radius <= highest)) return {};
    const double polar = 6356.752e3, above = (radius - polar) / 1000;
    return Diagnostic{
        Severity::warning,
        "W-GEOCENTRIC",
        fmt::format("the root's transform is ({}). Globe viewers read it as geocentric coordinates (ECEF), "
                    "about {:.0f} km {} the ground, but it seems to be projected (UTM or a national grid)",
                    readable(frame.origin, ", "), std::abs(above), above < 0 ? "below" : "above"),
        {},
        "give the coordinate system with transform: {crs: \"EPSG:25832\"}, or use transform: {centre: true} "
        "and "
        "place the tileset with transform: {place: {lat: 48.86, lon: 2.29}}"};
}

void put_into_frame(std::vector<Vec3>& positions, const TilesetFrame& frame) {
    parallel_for(positions.size(), [&](std::size_t v) {
        const Vec3 p = positions[v] - frame.origin;
        for (std::size_t axis = 0; axis < 3; ++axis)
            positions[v][axis] = std::round(p[axis] / frame.step) * frame.step + 0.0;
    });
}

Vec3 tile_origin(const Box& box, const TilesetFrame& frame) { return near_centre(box, frame.step); }

} // namespace facetmill::io
