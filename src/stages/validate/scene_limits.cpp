#include "stages/validate/scene_limits.hpp"

#include "base/math/random.hpp"
#include "base/text/glob.hpp"
#include "base/text/words.hpp"
#include "mesh/primitives_in_use.hpp"
#include "report/contents.hpp"
#include "stage/assertions.hpp"
#include "stages/validate/check_evidence.hpp"
#include "stages/validate/document_contents.hpp"
#include "stages/validate/material_ranges.hpp"

#include <algorithm>
#include <bit>
#include <fmt/format.h>
#include <set>

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

/// An item whose numbers must all be within a limit.
struct Extent {
    report::EvidenceEntry entry;
    double least = 0, largest = 0;
};

/// Checks each item, with the items outside of the limit as evidence.
LimitCheck check_limit(const char* name, const std::optional<CountLimit>& bound,
                       const std::vector<Extent>& items) {
    LimitCheck limit;
    report::Check& check = limit.check;
    check.name = name;
    check.expected = expectation(*bound);
    check.min = bound->min;
    check.max = bound->max;
    check.found_words = "within the limit";
    double worst = 0, excess = 0;
    std::size_t bad = 0;
    report::CheckEvidence evidence;
    for (const Extent& item : items) {
        const double below = bound->min ? *bound->min - item.least : 0,
                     above = bound->max ? item.largest - *bound->max : 0;
        const double beyond = std::max(below, above);
        if (!(beyond > 0)) continue;
        ++bad;
        if (evidence.size() < max_evidence) evidence.push_back(item.entry);
        if (beyond <= excess) continue;
        excess = beyond;
        worst = above >= below ? item.largest : item.least;
    }
    check.passed = bad == 0;
    if (check.passed) return limit;
    check.found = worst;
    check.found_words = fmt::format("{:.4g}", worst);
    check.evidence = std::move(evidence);
    check.locations = bad;
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

std::vector<Share> parts_of(const Limited& l) {
    std::vector<Share> shares;
    for (const auto& part : l.scene.parts) shares.push_back({{.of = Of::part, .name = part.name}});
    return shares;
}

std::vector<Share> materials_of(const Limited& l) {
    std::vector<Share> shares;
    for (const auto& m : l.scene.materials) shares.push_back({{.of = Of::material, .name = m.name}});
    return shares;
}

std::vector<Share> bytes_of(const Limited& l) {
    std::vector<Share> shares;
    for (const auto& file : l.files)
        shares.push_back({{.of = Of::bytes,
                           .name = file.path,
                           .amount = static_cast<double>(file.bytes),
                           .is_count = true},
                          file.bytes});
    return shares;
}

/// Each primitive of a node is a draw call; the instances of a node share it.
std::vector<Share> draw_calls_of(const Limited& l) {
    std::vector<Share> shares;
    std::set<std::pair<int, int>> drawn;
    for (const auto& part : l.scene.parts) {
        if (part.node >= 0 && !drawn.emplace(part.document, part.node).second) continue;
        const auto used = primitives_in_use(part.mesh);
        const auto calls = static_cast<std::size_t>(std::count(used.begin(), used.end(), true));
        const std::size_t amount = std::max(calls, std::size_t{part.mesh.vertex_count() > 0});
        shares.push_back(
            {{.of = Of::part, .name = part.name, .amount = static_cast<double>(amount), .is_count = true},
             amount});
    }
    return shares;
}

std::vector<Share> texture_pixels(const Limited& l) {
    std::vector<Share> shares;
    for (const auto& i : images_of(l.scene))
        shares.push_back({{.of = Of::image,
                           .name = i.name,
                           .width = i.width,
                           .height = i.height,
                           .amount = static_cast<double>(i.pixels()),
                           .is_count = true},
                          i.pixels()});
    return shares;
}

report::EvidenceEntry entry_of(const DocumentImage& i) {
    return {.of = Of::image, .name = i.name, .width = i.width, .height = i.height};
}

std::vector<Extent> texture_sides(const Limited& l) {
    std::vector<Extent> all;
    for (const auto& i : images_of(l.scene))
        if (i.width > 0)
            all.push_back({entry_of(i), static_cast<double>(std::min(i.width, i.height)),
                           static_cast<double>(std::max(i.width, i.height))});
    return all;
}

std::vector<Share> odd_textures(const Limited& l) {
    std::vector<Share> shares;
    for (const auto& i : images_of(l.scene))
        if (i.width > 0 && !(std::has_single_bit(i.width) && std::has_single_bit(i.height)))
            shares.push_back({entry_of(i)});
    return shares;
}

std::vector<Extent> base_colours(const Limited& l) {
    std::vector<Extent> all;
    for (const MaterialRange& m : *l.materials)
        all.push_back({{.of = Of::material, .name = m.name}, m.darkest, m.brightest});
    return all;
}

std::vector<Share> partial_metals(const Limited& l) {
    std::vector<Share> shares;
    for (const MaterialRange& m : *l.materials)
        if (m.partly_metal) shares.push_back({{.of = Of::material, .name = m.name}});
    return shares;
}

std::vector<Share> moved_roots(const Limited& l) {
    std::vector<Share> shares;
    for (const std::string& name : moved_root_nodes(l.scene))
        shares.push_back({{.of = Of::part, .name = name}});
    return shares;
}

/// The distance of the origin from the centre of the bounding box or of its bottom, whichever is nearer, in
/// percent of the diagonal.
std::vector<Extent> pivot_of(const Limited& l) {
    const Box box = l.scene.bounds();
    if (box.empty() || !(box.diagonal() > 0)) return {};
    Vec3 bottom = box.centre();
    const std::size_t up = l.scene.up == UpAxis::z ? 2 : 1;
    bottom[up] = box.min[up];
    const double distance = 100 * std::min(length(box.centre()), length(bottom)) / box.diagonal();
    return {{{.of = Of::part, .name = l.scene.parts.front().name}, distance, distance}};
}

/// In metres. Numbers without a unit count as metres, as readers of glTF take them.
std::vector<Extent> longest_side(const Limited& l) {
    const Box box = l.scene.bounds();
    if (box.empty()) return {};
    const double unit = metres(l.scene.unit);
    const double side = box.longest_side() * (unit > 0 ? unit : 1);
    return {{{.of = Of::part, .name = l.scene.parts.front().name}, side, side}};
}

std::vector<Word> names_of(const Limited& l) {
    std::vector<Word> words;
    for (const auto& part : l.scene.parts) words.push_back({part.name, {.of = Of::part, .name = part.name}});
    return words;
}

std::vector<Word> extension_names(const Limited& l) {
    std::vector<Word> words;
    for (const auto& e : extensions_of(l.scene))
        words.push_back({e.name, {.of = Of::extension, .name = e.name, .document = e.document}});
    return words;
}

/// A limit: its option, the given value, and its subjects (shares of a number, or words).
template <class Given, class Entry>
struct Limit {
    const char* name;
    LimitsOf of;
    Given SceneLimits::*given;
    const char* help;
    std::vector<Entry> (*entries)(const Limited&);
};
template <class Given, class Entry>
Limit(const char*, LimitsOf, Given SceneLimits::*, const char*, std::vector<Entry> (*)(const Limited&))
    -> Limit<Given, Entry>;

/// Calls look with each limit. The limits are not in property_table, because patterns are not numbers, and
/// geometry/ does not depend on documents and images.
template <class Look>
void each_limit(Look&& look) {
    using L = SceneLimits;
    constexpr LimitsOf scene = LimitsOf::scene, file = LimitsOf::file;
    look(Limit{"parts", scene, &L::parts, "The number of parts. A bare number is the maximum (10).",
               parts_of});
    look(Limit{"materials", scene, &L::materials, "The number of materials.", materials_of});
    look(Limit{"primitives", scene, &L::primitives,
               "The number of draw calls of the scene: a primitive of a node is one.", draw_calls_of});
    look(Limit{"texture_sides", scene, &L::texture_sides,
               "The sides of each PNG, JPEG and WebP image, in pixels: {min: 512, max: 2048}.",
               texture_sides});
    look(Limit{"odd_textures", scene, &L::odd_textures,
               "The number of images with a side that is no power of two.", odd_textures});
    look(Limit{"base_colours", scene, &L::base_colours,
               "The brightest channel of base colours, of factors and of texels, from 0 to 255 in sRGB. "
               "Colours that reflect light like real materials are within {min: 30, max: 240}.",
               base_colours});
    look(Limit{"partial_metals", scene, &L::partial_metals,
               "The number of materials that are neither metal nor non-metal: metalness from 0.1 to 0.9 in "
               "their factor, or in more than a twentieth of their texels.",
               partial_metals});
    look(Limit{"moved_roots", scene, &L::moved_roots,
               "1 if the only root node with meshes has a translation, a rotation or a scale. Otherwise 0.",
               moved_roots});
    look(Limit{"pivot", scene, &L::pivot,
               "The distance of the origin from the centre of the bounding box, or of its bottom, whichever "
               "is nearer, in percent of its diagonal.",
               pivot_of});
    look(Limit{"longest_side", scene, &L::longest_side,
               "The longest side of the scene's bounding box in metres. Numbers without a unit are metres.",
               longest_side});
    look(Limit{
        "bytes", file, &L::bytes,
        "The size of each file written before this check, with its buffers and images. Give a number of "
        "bytes, or a unit: 10MB or 500kB (1000 bytes each), or 1.5MiB, 500KiB or 500K (1024 bytes each).",
        bytes_of});
    look(Limit{"draw_calls", file, &L::draw_calls,
               "The number of draw calls (primitives of nodes) in each file written before this check.",
               draw_calls_of});
    look(Limit{"texture_pixels", file, &L::texture_pixels,
               "The total number of pixels in all PNG, JPEG and WebP images of each file written before "
               "this check.",
               texture_pixels});
    look(Limit{"names", scene, &L::names,
               "Patterns for part names. The name of every part must match one of them.", names_of});
    look(Limit{"extensions", scene, &L::extensions, "Names or patterns of the allowed glTF extensions.",
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

bool SceneLimits::need_whole_scene() const {
    SceneLimits others = *this;
    others.bytes.reset();
    return others.any();
}

std::string SceneLimits::of_files() const {
    std::string first;
    each_limit([&](const auto& limit) {
        if (first.empty() && limit.of == LimitsOf::file && is_given(this->*limit.given))
            first = fmt::format("limits.{}", limit.name);
    });
    return first;
}

void require_written(const SceneLimits& limits, const Context& context) {
    const std::string option = limits.of_files();
    if (option.empty() || !context.trail().written.empty()) return;
    throw Error(ErrorKind::stage, "E-LIMITS",
                fmt::format("'{}' limits written files, and no file was written before it", option),
                "give validate the same `when` as write", context.where());
}

std::vector<LimitCheck> check_limits(const SceneLimits& limits, LimitsOf of, const Limited& of_what) {
    std::vector<LimitCheck> checks;
    each_limit([&](const auto& limit) {
        const auto& given = limits.*limit.given;
        if (limit.of == of && is_given(given))
            checks.push_back(check_limit(limit.name, given, limit.entries(of_what)));
    });
    return checks;
}

} // namespace facetmill::validate_stage
