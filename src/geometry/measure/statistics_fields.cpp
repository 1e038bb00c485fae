#include "geometry/measure/statistics_fields.hpp"

#include "base/text/readable_numbers.hpp"

#include <fmt/format.h>

namespace facetmill {

std::function<void(DeclareFields<Statistics>&)> statistics_fields(std::string unit, double factor) {
    return [=](DeclareFields<Statistics>& d) {
        d.field("count", &Statistics::count, "The number of values.");
        const auto declare = [&](const char* name, double Statistics::*member, const char* help) {
            const auto get = [=](const Statistics& s) {
                return s.count > 0 ? std::optional(s.*member * factor) : std::nullopt;
            };
            d.field(name, get, help).unit(unit).only_when("count is above 0");
        };
        declare("minimum", &Statistics::minimum, "The least.");
        declare("maximum", &Statistics::maximum, "The maximum.");
        declare("mean", &Statistics::mean, "The mean.");
        declare("median", &Statistics::median,
                "The median; for an even count, the upper of the two middle values.");
        declare("deviation", &Statistics::deviation, "The standard deviation.");
    };
}

std::string range_text(const char* name, const Statistics& s, double factor) {
    if (s.count == 0) return "";
    return fmt::format("{} {} to {} (mean {})", name, readable(s.minimum * factor),
                       readable(s.maximum * factor), readable(s.mean * factor));
}

} // namespace facetmill
