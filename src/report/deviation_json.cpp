#include "report/deviation_json.hpp"
#include "base/point_json.hpp"

namespace facetmill::report {

namespace {

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
Json number(const std::optional<double>& x) { return x ? number(*x) : Json(nullptr); }

Json directed_json(const DirectedDeviation& d) {
    Json at = nullptr;
    if (std::isfinite(d.maximum) && d.vertices > 0)
        at = {{"from", point_json(d.from)},
              {"to", point_json(d.to)},
              {"face", d.face == none ? Json(nullptr) : Json(d.face)}};
    return {{"samples", d.samples},
            {"vertices", d.vertices},
            {"maximum", number(d.maximum)},
            {"rms", number(d.rms)},
            {"mean", number(d.mean)},
            {"bound", number(d.bound)},
            {"at", at}};
}

} // namespace

Json deviation_json(const DeviationResult& deviation) {
    const auto percent = [&](double x) { return number(deviation.percent(x)); };
    const auto bound = deviation.bound();
    return {{"maximum", number(deviation.maximum())},
            {"rms", number(deviation.rms())},
            {"mean", number(deviation.mean())},
            {"bound", number(bound)},
            {"diagonal", number(deviation.diagonal)},
            {"percent",
             {{"maximum", percent(deviation.maximum())},
              {"rms", percent(deviation.rms())},
              {"mean", percent(deviation.mean())},
              {"bound", bound ? percent(*bound) : Json(nullptr)}}},
            {"seed", deviation.seed},
            {"forward", directed_json(deviation.forward)},
            {"backward", directed_json(deviation.backward)}};
}

} // namespace facetmill::report
