#pragma once
// The value of the common key `ensure`: assertions on properties, and a limit on the deviation from the
// input.

#include "geometry/deviation/deviation.hpp"
#include "stage/assertions.hpp"
#include "stage/context.hpp"

#include <array>

namespace facetmill {

/// The limits of ensure: {deviation: {max: 0.5%}}, or short: {deviation: 0.5%}.
struct DeviationLimits {
    enum class From { stage, load };
    std::optional<Length> max, rms, mean;
    From from = From::stage; ///< compares with the input of the step, or with the scene as last loaded
    std::optional<std::int64_t> samples; ///< averages exactly this many; without it, as many as necessary
    std::int64_t seed = 1;
    bool certify = false;

    DeviationSettings settings() const;
};
/// The marks of max, rms and mean.
using LimitMarks = std::array<Mark, 3>;

void declare_deviation(Declare<DeviationLimits>& d);
/// Adds E-MISSING if no length is limited.
void verify_deviation(const DeviationLimits& limits, const Mark& where, Problems& problems);

struct Contract {
    Assertions assertions;
    std::optional<DeviationLimits> deviation;
    LimitMarks deviation_at{};
};
bool parse_contract(const Value& value, Contract& out, Problems& problems);
[[nodiscard]] Json contract_schema();
/// The schema of the data that a deviation contract adds to its stage's result, under "deviation".
[[nodiscard]] Json contract_result_schema();
/// The limits as text for plans: "max 0.5%, rms 0.1%".
[[nodiscard]] std::string to_string(const DeviationLimits& limits);

/// Measures the deviation of the scene from `before`, and makes a check of every limit, with the position of
/// the maximum as evidence. Stores the complete measurement in the stage's result under "deviation".
void check_deviation(const DeviationLimits& limits, const LimitMarks& where, const Surface& before,
                     const Scene& scene, Context& context);

} // namespace facetmill
