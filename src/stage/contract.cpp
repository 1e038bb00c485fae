#include "stage/contract.hpp"

#include "base/math/numbers.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "geometry/deviation/deviation_fields.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "stage/bind_pose.hpp"
#include "stage/crossing_faces.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

const Declaration& deviation_declaration() {
    static const Declaration declaration = [] {
        Declare<DeviationLimits> d;
        declare_deviation(d);
        return std::move(d.declaration);
    }();
    return declaration;
}

/// The value as text: "0.0123 (0.51 % of the diagonal)".
std::string found_text(const DeviationResult& measured, double value) {
    if (!std::isfinite(value)) return "nothing to compare with";
    return fmt::format("{:.6g} ({} of the diagonal)", value, percentage(measured.percent(value), 4));
}

report::EvidenceEntry evidence_of(const DirectedDeviation& way, bool forward) {
    report::EvidenceEntry entry;
    entry.at = way.from;
    entry.nearest = way.to;
    entry.side = forward ? "what entered" : "what left";
    return entry;
}

} // namespace

DeviationSettings DeviationLimits::settings() const {
    DeviationSettings settings{.seed = static_cast<std::uint64_t>(seed), .certify = certify};
    if (samples) {
        settings.samples = static_cast<std::size_t>(*samples);
        settings.mean_error = 0;
    }
    return settings;
}

void declare_deviation(Declare<DeviationLimits>& d) {
    using From = DeviationLimits::From;
    d.option("max", &DeviationLimits::max,
             "The limit of the largest distance from each surface to the other.")
        .at_least(0)
        .primary();
    d.option("rms", &DeviationLimits::rms, "The limit of the root mean square distance, weighted by area.")
        .at_least(0);
    d.option("mean", &DeviationLimits::mean, "The limit of the mean distance, weighted by area.").at_least(0);
    d.choice<From>(
        "from", &DeviationLimits::from,
        {{"stage", From::stage, "the input of the step"}, {"load", From::load, "the scene as last loaded"}},
        "The scene to compare with. The stage ensure always uses load.");
    d.option("samples", &DeviationLimits::samples,
             "The number of sample points in each direction. All of them are measured, and all vertices as "
             "well. Default: 100000, and then rms and mean use only the samples that they need.")
        .between(0, 1e9);
    d.option("seed", &DeviationLimits::seed, "The seed of the sample positions.").at_least(0);
    d.option("certify", &DeviationLimits::certify,
             "Compares max with a guaranteed upper bound instead of the largest sample.");
}

void verify_deviation(const DeviationLimits& limits, const Mark& where, Problems& problems) {
    if (!limits.max && !limits.rms && !limits.mean)
        problems.add(where, "E-MISSING", "deviation needs a limit: max, rms or mean",
                     "deviation: {max: 0.5%}");
}

bool parse_contract(const Value& value, Contract& out, Problems& problems) {
    bool good = parse_assertions(value, out.assertions, "ensure", problems, {"deviation"});
    const auto* entry = value.is_map() && !value.deferred ? value.find_entry("deviation") : nullptr;
    if (!entry) return good;
    const char* const names[] = {"max", "rms", "mean"};
    for (std::size_t i = 0; i < out.deviation_at.size(); ++i) {
        const Value* limit = entry->value.is_map() ? entry->value.find(names[i]) : nullptr;
        out.deviation_at[i] = limit ? limit->mark : entry->value.mark;
    }
    DeviationLimits& limits = out.deviation.emplace();
    good &= deviation_declaration().parse(entry->value, &limits, "deviation", problems);
    if (!good || entry->value.deferred) return good;
    verify_deviation(limits, entry->key_mark, problems);
    return limits.max || limits.rms || limits.mean;
}

Json contract_schema() {
    Json schema = assertions_schema();
    Json deviation = deviation_declaration().schema();
    deviation["description"] =
        "The largest distance between the result of the step and its input, in both directions.";
    schema["properties"]["deviation"] = std::move(deviation);
    return schema;
}

Json contract_result_schema() {
    Json schema = deviation_fields().schema();
    schema["description"] =
        "The deviation from the compared scene. Present only when ensure limits the deviation.";
    return schema;
}

std::string to_string(const DeviationLimits& limits) {
    std::string text;
    const auto add = [&](const char* name, const std::optional<Length>& limit) {
        if (limit) append_item(text, fmt::format("{} {}", name, limit->text));
    };
    add("max", limits.max);
    add("rms", limits.rms);
    add("mean", limits.mean);
    if (limits.certify) text += ", certified";
    return limits.from == DeviationLimits::From::load ? text + " from load" : text;
}

void check_deviation(const DeviationLimits& limits, const LimitMarks& where, const Surface& before,
                     const Scene& scene, Context& context) {
    const DeviationResult measured =
        deviation(before, surface_or_points_of(scene, filled_surface), limits.settings());
    std::vector<std::string> moving;
    for (const Part& part : scene.parts)
        if (part.changed && has_poses(part)) moving.push_back(part.name);
    warn_of_rest_pose("ensure", moving, context);
    name_fans(scene, context);
    context.result()["deviation"] = deviation_json(measured);
    const auto check = [&](std::size_t which, const std::string& name, const std::optional<Length>& limit,
                           double value, const std::string& words) {
        if (!limit) return;
        report::Check c;
        c.name = name;
        c.where = where[which];
        // A percentage without a reference refers to the diagonal of the comparison scene.
        const bool of_reference = limit->kind == Length::Kind::percent && limit->of == Length::Of::stage;
        const double most =
            of_reference ? limit->amount / 100 * measured.diagonal : context.resolve(*limit, scene, name);
        c.expected = fmt::format("at most {}", limit->text);
        if (limit->kind != Length::Kind::scene) c.expected += fmt::format(" ({:.6g})", most);
        if (std::isfinite(value)) c.found = value;
        c.found_words = words;
        c.max = most;
        c.passed = value <= most;
        const bool forward = measured.forward.maximum >= measured.backward.maximum;
        if (!c.passed && std::isfinite(value))
            c.evidence =
                report::CheckEvidence{evidence_of(forward ? measured.forward : measured.backward, forward)};
        context.check(std::move(c));
    };
    const double maximum = measured.maximum();
    if (const auto bound = measured.bound())
        check(0, "deviation", limits.max, *bound,
              fmt::format("certainly at most {}, measured {}", found_text(measured, *bound),
                          found_text(measured, maximum)));
    else
        check(0, "deviation", limits.max, maximum, found_text(measured, maximum));
    check(1, "deviation.rms", limits.rms, measured.rms(), found_text(measured, measured.rms()));
    check(2, "deviation.mean", limits.mean, measured.mean(), found_text(measured, measured.mean()));
}

} // namespace facetmill
