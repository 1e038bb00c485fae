#include "stage/read_recorded.hpp"

#include "base/hash.hpp"
#include "base/progress.hpp"
#include "diff/conversion.hpp"
#include "io/convert.hpp"
#include "mesh/power_scale.hpp"

#include <fmt/format.h>

namespace facetmill {

void record_input(Context& context, const std::string& path, std::size_t bytes, std::string sum,
                  io::Span contents) {
    context.record_input({path, bytes, std::move(sum), {}, io::byte_kinds(path, bytes, contents)});
}

namespace {

void record_input(Context& context, const std::string& path, io::Span bytes) {
    record_input(context, path, bytes.size(), sha256(bytes), bytes);
}

/// Records the checksum of the bytes read, because the file may have been replaced since.
void record_neighbour(Context& context, const io::ReadFile& file) {
    if (!file.sha256.empty())
        return record_input(context, file.path.generic_string(), file.bytes, file.sha256);
    context.mark_uncacheable(); // the file may differ now from the bytes that the reader saw
    record_input(context, file.path.generic_string(), io::Input::open(file.path).stored());
}

} // namespace

std::pair<Scene, io::ReadLog> read_recorded(const std::filesystem::path& path,
                                            const io::ReadSettings& settings, const io::Codec* codec,
                                            Context& context) {
    ProgressSteps steps({1, 2, 8});
    const io::Input input = io::Input::open(path);
    steps.next();
    record_input(context, input.name(), input.stored());
    steps.next();
    io::ReadLog log;
    Scene scene = io::read_scene(input, settings, log, codec);
    for (const auto& w : log.warnings)
        context.warn(w.id, fmt::format("{}: {}", input.name(), w.message), w.hint);
    for (const auto& file : log.files) record_neighbour(context, file);
    for (const auto& file : log.absent) context.record_absent(file.generic_string());
    if (log.unrepeatable || !input.is_as_opened()) context.mark_uncacheable();
    return {std::move(scene), std::move(log)};
}

namespace {

/// Warns (W-UNITS) if one scene has no unit, and one is so small relative to the other that it is invisible
/// in a comparison.
void warn_of_sizes(const std::string& name, Unit others, const Scene& other, const Scene& scene,
                   Context& context) {
    constexpr double apart = 100; // at this ratio, the smaller scene has 8 of 800 pixels
    const double mine = diagonal(scene.bounds()), its = diagonal(other.bounds());
    if (!(mine > 0 && its > 0) || (mine < apart * its && its < apart * mine)) return;
    if (others != Unit::unknown && scene.unit != Unit::unknown) return;
    context.warn("W-UNITS",
                 fmt::format("{}: '{}' is {:.4g} times as large as the scene: are they in different units?",
                             context.name(), name, its / mine),
                 fmt::format("use transform: {{scale: {:.4g}}} before this stage to match the size of '{}'",
                             its / mine, name));
}

/// Warns if the boxes are equal in another unit or after a rotation of the axes. Returns whether it did.
bool warn_of_convention(const std::string& name, const report::Origin& origin, const Scene& other,
                        const Scene& scene, Context& context) {
    const std::string hint = report::conversion_hint(scene, other, origin);
    if (hint.empty()) return false;
    context.warn("W-CONVENTION",
                 fmt::format("{}: '{}' is the same shape as the scene in another unit or up axis",
                             context.name(), name),
                 hint);
    return true;
}

} // namespace

Scene read_beside(const PathText& path, const Scene& scene, Context& context, bool compares) {
    io::ReadSettings settings;
    settings.asset_roots = context.places().asset_roots;
    Scene other = read_recorded(context.places().input(path.text), settings, nullptr, context).first;
    const io::Convention its{other.unit, other.up}, own{scene.unit, scene.up};
    const report::Origin origin{own, its, io::convert(other, own)};
    if (!compares || !warn_of_convention(path.text, origin, other, scene, context))
        warn_of_sizes(path.text, its.unit, other, scene, context);
    return other;
}

} // namespace facetmill
