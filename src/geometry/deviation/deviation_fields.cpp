#include "geometry/deviation/deviation_fields.hpp"

namespace facetmill {

namespace {

constexpr const char* infinite = "one of the surfaces is empty";
constexpr const char* uncertified = "no bound was requested";

void declare_place(DeclareFields<DirectedDeviation>& d) {
    d.field("from", &DirectedDeviation::from, "The farthest sample.");
    d.field("to", &DirectedDeviation::to, "The point nearest to it.");
    const auto face = [](const DirectedDeviation& way) {
        return way.face == none ? std::optional<Index>() : way.face;
    };
    d.field("face", face, "The face of the sample.").null_when("the sample is a vertex");
}

void declare_way(DeclareFields<DirectedDeviation>& d) {
    d.field("samples", &DirectedDeviation::samples,
            "Sample points spread over the area. The other samples of a triangle are skipped if at least "
            "eight are averaged and stay below half of the maximum.");
    d.field(
        "averaged", &DirectedDeviation::averaged,
        "Samples used for rms and mean: enough for an error of 0.5 %, or all. Without samples, the vertices "
        "are used.");
    d.field("vertices", &DirectedDeviation::vertices, "Vertices measured in addition, for the maximum.");
    d.field("maximum", &DirectedDeviation::maximum, "The largest distance.")
        .unit("scene units")
        .null_when(infinite);
    d.field("rms", &DirectedDeviation::rms, "The root mean square distance.")
        .unit("scene units")
        .null_when(infinite);
    d.field("mean", &DirectedDeviation::mean, "The mean distance.").unit("scene units").null_when(infinite);
    d.field(
         "bound", &DirectedDeviation::bound,
         "A guaranteed upper bound: no point is farther than this. It is at least the larger maximum of both "
         "directions.")
        .unit("scene units")
        .null_when(uncertified);
    const auto at = [](const DirectedDeviation& way) {
        return std::isfinite(way.maximum) && way.vertices > 0 ? std::optional(way) : std::nullopt;
    };
    d.object("at", at, "The position of the maximum.", declare_place).null_when("nothing was measured");
}

/// Declares the four measures in percent of the diagonal.
void declare_percent(DeclareFields<DeviationResult>& d) {
    const auto percent = [](double (DeviationResult::*length)() const) {
        return [length](const DeviationResult& r) { return r.percent((r.*length)()); };
    };
    d.field("maximum", percent(&DeviationResult::maximum), "The maximum.").null_when(infinite);
    d.field("rms", percent(&DeviationResult::rms), "The root mean square.").null_when(infinite);
    d.field("mean", percent(&DeviationResult::mean), "The mean.").null_when(infinite);
    const auto bound = [](const DeviationResult& r) {
        const auto length = r.bound();
        return length ? std::optional(r.percent(*length)) : std::nullopt;
    };
    d.field("bound", bound, "The bound.").null_when(uncertified);
}

} // namespace

void declare_deviation_fields(DeclareFields<DeviationResult>& d) {
    d.field("maximum", &DeviationResult::maximum, "The largest distance from either surface to the other.")
        .unit("scene units")
        .null_when(infinite);
    d.field("rms", &DeviationResult::rms, "The larger root mean square distance of both directions.")
        .unit("scene units")
        .null_when(infinite);
    d.field("mean", &DeviationResult::mean, "The larger mean distance of both directions.")
        .unit("scene units")
        .null_when(infinite);
    d.field("bound", &DeviationResult::bound,
            "A guaranteed upper bound: no point of either surface is farther than this.")
        .unit("scene units")
        .null_when(uncertified);
    d.field("diagonal", &DeviationResult::diagonal,
            "The diagonal of the bounding box of the reference surface.")
        .unit("scene units")
        .null_when("the diagonal is outside the range of 64-bit floats");
    const auto self = [](const DeviationResult& r) -> const DeviationResult& { return r; };
    d.object("percent", self, "The deviation in percent of the diagonal.", declare_percent);
    d.field("seed", &DeviationResult::seed, "The seed of the sample positions.");
    d.object("forward", &DeviationResult::forward, "From the first surface (the input) to the second.",
             declare_way);
    d.object("backward", &DeviationResult::backward, "From the second surface (the result) to the first.",
             declare_way);
}

const Fields& deviation_fields() {
    static const Fields all = fields_of<DeviationResult>(declare_deviation_fields);
    return all;
}

Json deviation_json(const DeviationResult& deviation) { return deviation_fields().json(&deviation); }

} // namespace facetmill
