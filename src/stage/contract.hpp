#pragma once
// What the common key `ensure` takes: assertions on properties, and a limit on the deviation from what
// entered.

#include "geometry/deviation/deviation.hpp"
#include "stage/assertions.hpp"
#include "stage/context.hpp"

#include <array>

namespace facetmill {

/// ensure: {deviation: {max: 0.5%}}, or short: {deviation: 0.5%}.
struct DeviationLimits {
    enum class From { stage, load };
    std::optional<Length> max, rms, mean;
    From from = From::stage; ///< compared with what entered the step, or with the scene as last loaded
    std::optional<std::int64_t> samples; ///< all of them are averaged; without, as many as that takes
    std::int64_t seed = 1;
    bool certify = false;

    DeviationSettings settings() const;
};
/// Where max, rms and mean were written.
using LimitMarks = std::array<Mark, 3>;

void declare_deviation(Declare<DeviationLimits>& d);
/// Adds E-MISSING when no length is limited.
void verify_deviation(const DeviationLimits& limits, const Mark& where, Problems& problems);

struct Contract {
    Assertions assertions;
    std::optional<DeviationLimits> deviation;
    LimitMarks deviation_at{};
};
bool parse_contract(const Value& value, Contract& out, Problems& problems);
Json contract_schema();
/// ... and of what a contract on the deviation adds to the result of its stage, under "deviation".
Json contract_result_schema();
/// "max 0.5%, rms 0.1%", for plans.
std::string to_string(const DeviationLimits& limits);

/// Measures how far the scene is from `before` and makes a check of every limit, with the place of the
/// maximum as evidence. The whole measurement goes into the stage's result under "deviation".
void check_deviation(const DeviationLimits& limits, const LimitMarks& where, const Surface& before,
                     const Scene& scene, Context& context);

} // namespace facetmill
