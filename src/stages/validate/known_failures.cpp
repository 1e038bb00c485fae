#include "stages/validate/known_failures.hpp"

#include "base/json.hpp"
#include "base/math/random.hpp"
#include "report/contents.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <iterator>

namespace facetmill::validate_stage {

namespace {

using Keys = std::vector<std::uint64_t>;

constexpr int form = 1;

std::optional<double> number_of(const report::Found& found) {
    if (const auto* count = std::get_if<std::int64_t>(&found)) return static_cast<double>(*count);
    const auto* number = std::get_if<double>(&found);
    return number ? std::optional(*number) : std::nullopt;
}

/// Whether the new value is no worse. If the values are not numbers, only locations decide.
bool is_no_worse(const Failure& before, const Failure& now) {
    if (before.found == now.found) return true;
    const auto was = number_of(before.found), is = number_of(now.found);
    if (!was && !is) return now.locations() > 0;
    if (!was || !is) return false;
    return now.max && *is > *now.max ? *is <= *was : *is >= *was;
}

std::uint64_t hash_of(std::span<const std::uint64_t> keys) {
    std::uint64_t h = keys.size();
    for (const std::uint64_t key : keys) h = hashed(h, key);
    return h;
}

/// The number of leading keys to write: the lowest distinct keys, with repeats.
std::size_t listed(const Keys& keys) {
    std::size_t different = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        different += i == 0 || keys[i] != keys[i - 1];
        if (different > KnownFailures::max_known) return i;
    }
    return keys.size();
}

Json keys_json(std::span<const std::uint64_t> keys) {
    Json list = Json::array();
    for (std::size_t i = 0, end = 0; i < keys.size(); i = end) {
        while (end < keys.size() && keys[end] == keys[i]) ++end;
        std::string text = fmt::format("{:016x}", keys[i]);
        if (end - i > 1) text += fmt::format(" x{}", end - i);
        list.push_back(std::move(text));
    }
    return list;
}

std::optional<std::uint64_t> hexadecimal(std::string_view text) {
    std::uint64_t key = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), key, 16);
    if (text.size() != 16 || error != std::errc() || end != text.data() + text.size()) return {};
    return key;
}

/// Reads "0123456789abcdef x3"; false for invalid text, or for more keys than a check can have.
bool read_key(const Json& json, Keys& keys) {
    if (!json.is_string()) return false;
    const auto& text = json.get_ref<const std::string&>();
    const auto key = hexadecimal(std::string_view(text).substr(0, 16));
    std::size_t count = 1;
    if (text.size() > 16) {
        const char* const end = text.data() + text.size();
        if (text.size() < 19 || text.compare(16, 2, " x") != 0) return false;
        const auto read = std::from_chars(text.data() + 18, end, count);
        if (read.ec != std::errc() || read.ptr != end) return false;
    }
    constexpr std::size_t max_count = std::size_t{1} << 28;
    if (!key || count == 0 || count > max_count || keys.size() + count > max_count) return false;
    keys.insert(keys.end(), count, *key);
    return true;
}

bool read_failure(const Json& json, Failure& failure) {
    if (!json.is_object()) return false;
    for (const auto& [name, slot] : {std::pair{"check", &failure.check},
                                     {"part", &failure.part},
                                     {"component", &failure.component},
                                     {"expected", &failure.expected}}) {
        if (!json.contains(name) || !json[name].is_string()) return false;
        *slot = json[name].get<std::string>();
    }
    auto found = json.contains("found") ? report::found_of(json["found"]) : std::nullopt;
    if (!found) return false;
    failure.found = *std::move(found);
    if (!json.contains("locations") || !json["locations"].is_number_unsigned()) return false;
    if (!json.contains("known") || !json["known"].is_array()) return false;
    for (const auto& key : json["known"])
        if (!read_key(key, failure.keys)) return false;
    std::sort(failure.keys.begin(), failure.keys.end());
    const auto locations = json["locations"].get<std::size_t>();
    if (locations < failure.keys.size()) return false;
    failure.more = locations - failure.keys.size();
    if (failure.more == 0) return true;
    if (!json.contains("more") || !json["more"].is_string()) return false;
    const auto more = hexadecimal(json["more"].get_ref<const std::string&>());
    failure.more_hash = more.value_or(0);
    return more.has_value();
}

/// Adds the locations of `now` that are new since `before`.
void add_fresh(const Failure& before, const Failure& now, KnownFailures::Verdict& verdict) {
    auto end = now.keys.end(); // the end of the keys that the file would list
    if (before.more > 0)
        end = before.keys.empty() ? now.keys.begin()
                                  : std::upper_bound(now.keys.begin(), now.keys.end(), before.keys.back());
    std::set_difference(now.keys.begin(), end, before.keys.begin(), before.keys.end(),
                        std::back_inserter(verdict.keys));
    verdict.fresh = verdict.keys.size();
    const auto beyond = static_cast<std::size_t>(now.keys.end() - end);
    if (beyond > before.more)
        verdict.fresh += beyond - before.more;
    else if (beyond > 0 && beyond == before.more && hash_of({end, now.keys.end()}) != before.more_hash)
        ++verdict.fresh;
}

} // namespace

KnownFailures KnownFailures::read(const std::filesystem::path& path) {
    const io::Input input = io::Input::open(path);
    const auto bytes = input.bytes();
    const Json json =
        parse_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, Broken::discarded);
    const auto refuse = [&](const char* what = "is not a baseline of validate") {
        return Error(ErrorKind::malformed, "E-BASELINE", fmt::format("'{}' {}", path.generic_string(), what),
                     "write one with update_baseline: true");
    };
    if (!json.is_object() || !json.contains("failures") || !json["failures"].is_array()) throw refuse();
    if (!json.contains("facetmill_baseline") || !json["facetmill_baseline"].is_number_integer())
        throw refuse();
    if (json["facetmill_baseline"].get<std::int64_t>() != form)
        throw refuse("is a baseline of a version that this facetmill cannot read");
    KnownFailures known;
    for (const auto& f : json["failures"]) {
        if (!read_failure(f, known.failures_.emplace_back())) throw refuse();
    }
    return known;
}

void KnownFailures::write(io::Outputs& outputs, const std::filesystem::path& path) const {
    Json list = Json::array();
    for (const auto& f : failures_) {
        const std::size_t count = listed(f.keys);
        Json entry = {{"check", f.check},
                      {"part", f.part},
                      {"component", f.component},
                      {"expected", f.expected},
                      {"found", report::found_json(f.found)},
                      {"locations", f.keys.size()},
                      {"known", keys_json({f.keys.data(), count})}};
        if (count < f.keys.size())
            entry["more"] = fmt::format("{:016x}", hash_of({f.keys.data() + count, f.keys.size() - count}));
        list.push_back(std::move(entry));
    }
    const std::string text = Json{{"facetmill_baseline", form}, {"failures", std::move(list)}}.dump(
                                 1, ' ', false, Json::error_handler_t::replace) +
                             "\n";
    outputs.add(path, {reinterpret_cast<const std::byte*>(text.data()), text.size()});
}

KnownFailures::Verdict KnownFailures::judge(const Failure& now) const {
    Verdict best;
    best.fresh = now.locations();
    best.keys = now.keys;
    for (const auto& before : failures_) {
        if (!before.is_like(now)) continue;
        Verdict verdict;
        add_fresh(before, now, verdict);
        verdict.known = true;
        verdict.waived = verdict.fresh == 0 && is_no_worse(before, now);
        if (!best.known || verdict.waived || (!best.waived && verdict.fresh < best.fresh))
            best = std::move(verdict);
    }
    return best;
}

KnownFailures::Gone KnownFailures::gone(const KnownFailures& now) const {
    Gone gone;
    for (const auto& before : failures_) {
        const auto like = std::find_if(now.failures_.begin(), now.failures_.end(),
                                       [&](const Failure& f) { return f.is_like(before); });
        if (like == now.failures_.end()) {
            ++gone.failures;
            continue;
        }
        Keys away;
        std::set_difference(before.keys.begin(), before.keys.end(), like->keys.begin(), like->keys.end(),
                            std::back_inserter(away));
        gone.locations += away.size();
    }
    return gone;
}

} // namespace facetmill::validate_stage
