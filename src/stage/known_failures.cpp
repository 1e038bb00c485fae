#include "stage/known_failures.hpp"

#include "base/json.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <optional>

namespace facetmill {

namespace {

std::optional<double> number_in(std::string_view text) {
    double x = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return x;
}

/// The last number of "at most 5", "2", "1 to 5", "at most 5mm (0.005)"; a failure beyond it is too large,
/// before it too small.
std::optional<double> limit_in(const std::string& expected) {
    std::string_view text(expected);
    if (const auto space = text.rfind(' '); space != text.npos) text.remove_prefix(space + 1);
    if (text.starts_with('(') && text.ends_with(')')) text = text.substr(1, text.size() - 2);
    return number_in(text);
}

} // namespace

KnownFailures KnownFailures::read(const std::filesystem::path& path) {
    const io::Input input = io::Input::open(path);
    const auto bytes = input.bytes();
    const Json json = Json::parse(reinterpret_cast<const char*>(bytes.data()),
                                  reinterpret_cast<const char*>(bytes.data()) + bytes.size(), nullptr, false);
    const auto refuse = [&] {
        return Error(ErrorKind::malformed, "E-BASELINE",
                     fmt::format("'{}' is no baseline of validate", path.string()),
                     "write one with update_baseline: true");
    };
    if (!json.is_object() || !json.contains("failures") || !json["failures"].is_array()) throw refuse();
    KnownFailures known;
    for (const auto& f : json["failures"]) {
        Failure failure;
        for (const auto& [name, slot] : {std::pair{"check", &failure.check},
                                         {"part", &failure.part},
                                         {"expected", &failure.expected},
                                         {"found", &failure.found}}) {
            if (!f.is_object() || !f.contains(name) || !f[name].is_string()) throw refuse();
            *slot = f[name].get<std::string>();
        }
        if (f.contains("places") && f["places"].is_number_unsigned()) failure.places = f["places"];
        known.failures_.push_back(std::move(failure));
    }
    return known;
}

void KnownFailures::write(io::Outputs& outputs, const std::filesystem::path& path) const {
    Json list = Json::array();
    for (const auto& f : failures_)
        list.push_back({{"check", f.check},
                        {"part", f.part},
                        {"expected", f.expected},
                        {"found", f.found},
                        {"places", f.places ? Json(*f.places) : Json()}});
    const std::string text = Json{{"failures", std::move(list)}}.dump(2) + "\n";
    outputs.add(path, {reinterpret_cast<const std::byte*>(text.data()), text.size()});
}

void KnownFailures::add(const report::Check& check) {
    failures_.push_back({check.name, check.part, check.expected, check.found, check.places});
}

bool KnownFailures::waives(const report::Check& check) const {
    for (const auto& f : failures_) {
        if (f.check != check.name || f.part != check.part) continue;
        if (f.places && check.places && *check.places > *f.places) continue;
        if (f.found == check.found) return true;
        const auto before = number_in(f.found), now = number_in(check.found),
                   limit = limit_in(check.expected);
        if (!before || !now || !limit) continue;
        if (*now > *limit ? *now <= *before : *now >= *before) return true;
    }
    return false;
}

std::size_t KnownFailures::mended(const KnownFailures& now) const {
    return static_cast<std::size_t>(std::count_if(failures_.begin(), failures_.end(), [&](const Failure& f) {
        return std::none_of(now.failures_.begin(), now.failures_.end(),
                            [&](const Failure& g) { return f.check == g.check && f.part == g.part; });
    }));
}

} // namespace facetmill
