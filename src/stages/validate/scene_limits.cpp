#include "stages/validate/scene_limits.hpp"

#include "base/math/random.hpp"
#include "base/text/glob.hpp"
#include "base/text/words.hpp"
#include "report/contents.hpp"
#include "stage/assertions.hpp"
#include "stages/validate/check_evidence.hpp"
#include "stages/validate/document_contents.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::validate_stage {

namespace {

using Of = report::EvidenceEntry::Of;

/// An item that counts towards a limit.
struct Share {
    report::EvidenceEntry entry;
    std::size_t amount = 1;
};

/// Checks the sum of the shares, with the largest shares as evidence.
template <class Limits>
LimitCheck check_limit(const char* name, const std::optional<Limits>& bounds, std::vector<Share> shares) {
    const Bound& bound = *bounds;
    double sum = 0;
    for (const Share& s : shares) sum += static_cast<double>(s.amount);
    LimitCheck limit;
    report::Check& check = limit.check;
    check.name = name;
    check.expected = expectation(bound);
    check.found = static_cast<std::int64_t>(sum);
    check.min = bound.min;
    check.max = bound.max;
    check.passed = holds(bound, sum);
    if (check.passed) return limit;
    std::stable_sort(shares.begin(), shares.end(),
                     [](const Share& a, const Share& b) { return a.amount > b.amount; });
    shares.resize(std::min(shares.size(), max_evidence));
    check.evidence.emplace();
    for (Share& s : shares) check.evidence->push_back(std::move(s.entry));
    return limit;
}

/// A word that must match a pattern, and the evidence if it does not.
struct Word {
    std::string text;
    report::EvidenceEntry entry;
};

LimitCheck check_limit(const char* name, const std::vector<std::string>& patterns,
                       const std::vector<Word>& words) {
    LimitCheck limit;
    report::Check& check = limit.check;
    check.name = name;
    check.expected = join_texts(patterns);
    std::vector<std::string> bad;
    report::CheckEvidence evidence;
    for (const Word& w : words) {
        if (std::any_of(patterns.begin(), patterns.end(),
                        [&](const auto& p) { return glob_matches(p, w.text); }))
            continue;
        if (evidence.size() < max_evidence) evidence.push_back(w.entry);
        if (std::find(bad.begin(), bad.end(), w.text) == bad.end()) bad.push_back(w.text);
        std::uint64_t key = 8;
        const Json told = report::evidence_json(w.entry); // baselines identify the entry by this text
        for (const char letter : told.dump(-1, ' ', false, Json::error_handler_t::replace))
            key = hashed(key, static_cast<unsigned char>(letter));
        limit.keys.push_back(key);
    }
    std::sort(limit.keys.begin(), limit.keys.end());
    check.passed = bad.empty();
    const std::size_t more = bad.size() > max_evidence ? bad.size() - max_evidence : 0;
    bad.resize(bad.size() - more);
    check.found = bad;
    if (check.passed) check.found_words = "nothing else";
    if (more > 0) check.found_words = fmt::format("{} and {} more", join_texts(bad), more);
    if (check.passed) return limit;
    check.evidence = std::move(evidence);
    check.locations = limit.keys.size();
    return limit;
}

std::vector<Share> parts_of(const Scene& scene) {
    std::vector<Share> shares;
    for (const auto& part : scene.parts) shares.push_back({{.of = Of::part, .name = part.name}});
    return shares;
}

std::vector<Share> materials_of(const Scene& scene) {
    std::vector<Share> shares;
    for (const auto& m : scene.materials) shares.push_back({{.of = Of::material, .name = m.name}});
    return shares;
}

std::vector<Share> documents_bytes(const Scene& scene) {
    std::vector<Share> shares;
    for (const auto& b : bytes_of(scene))
        shares.push_back(
            {{.of = Of::bytes, .name = b.name, .amount = static_cast<double>(b.bytes), .is_count = true},
             b.bytes});
    return shares;
}

std::vector<Share> texture_pixels(const Scene& scene) {
    std::vector<Share> shares;
    for (const auto& i : images_of(scene))
        shares.push_back({{.of = Of::image,
                           .name = i.name,
                           .width = i.width,
                           .height = i.height,
                           .amount = static_cast<double>(i.pixels()),
                           .is_count = true},
                          i.pixels()});
    return shares;
}

std::vector<Word> names_of(const Scene& scene) {
    std::vector<Word> words;
    for (const auto& part : scene.parts) words.push_back({part.name, {.of = Of::part, .name = part.name}});
    return words;
}

std::vector<Word> extension_names(const Scene& scene) {
    std::vector<Word> words;
    for (const auto& e : extensions_of(scene))
        words.push_back({e.name, {.of = Of::extension, .name = e.name, .document = e.document}});
    return words;
}

/// A limit: its option, the given value, and its subjects (shares of a number, or words).
template <class Given, class Entry>
struct Limit {
    const char* name;
    Given SceneLimits::*given;
    const char* help;
    std::vector<Entry> (*entries)(const Scene& scene);
};
template <class Given, class Entry>
Limit(const char*, Given SceneLimits::*, const char*, std::vector<Entry> (*)(const Scene&))
    -> Limit<Given, Entry>;

/// Calls look with each limit. The limits are not in property_table, because patterns are not numbers, and
/// geometry/ does not depend on documents and images.
template <class Look>
void each_limit(Look&& look) {
    using L = SceneLimits;
    look(Limit{"parts", &L::parts, "The number of parts. A bare number is the maximum (10).", parts_of});
    look(Limit{"materials", &L::materials, "The number of materials.", materials_of});
    look(Limit{"bytes", &L::documents_bytes,
               "The size of the glTF documents as loaded, with buffers and images. Give a number of bytes, "
               "or a unit: 10MB or 500kB (1000 bytes each), or 1.5MiB, 500KiB or 500K (1024 bytes each).",
               documents_bytes});
    look(Limit{"texture_pixels", &L::texture_pixels,
               "The total number of pixels in all PNG, JPEG and WebP images.", texture_pixels});
    look(Limit{"names", &L::names, "Patterns for part names. The name of every part must match one of them.",
               names_of});
    look(Limit{"extensions", &L::extensions, "Names or patterns of the allowed glTF extensions.",
               extension_names});
}

template <class Bound>
bool is_given(const std::optional<Bound>& bound) {
    return bound.has_value();
}
bool is_given(const std::vector<std::string>& patterns) { return !patterns.empty(); }

} // namespace

bool SceneLimits::any() const {
    bool any = false;
    each_limit([&](const auto& limit) { any |= is_given(this->*limit.given); });
    return any;
}

void declare_limits(Declare<SceneLimits>& d) {
    each_limit([&](const auto& limit) { d.option(limit.name, limit.given, limit.help); });
}

std::vector<LimitCheck> check_limits(const SceneLimits& limits, const Scene& scene) {
    std::vector<LimitCheck> checks;
    each_limit([&](const auto& limit) {
        const auto& given = limits.*limit.given;
        if (is_given(given)) checks.push_back(check_limit(limit.name, given, limit.entries(scene)));
    });
    return checks;
}

} // namespace facetmill::validate_stage
