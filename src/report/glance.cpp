#include "report/glance.hpp"

#include "base/text/readable_numbers.hpp"

#include <cmath>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

/// The view's own deviation, or the deviation of a stage with the same result; null without a measurement.
const DeviationView* deviation_of(const OutputView& view, const RunRecord& record) {
    if (view.deviation) return &*view.deviation;
    for (const StageRecord& stage : record.stages)
        if (stage.deviation && !view.same_as.empty() && stage.name == view.same_as) return &*stage.deviation;
    return nullptr;
}

} // namespace

ByteSum sum_of(const std::vector<FileRecord>& files) {
    ByteSum sum;
    for (const FileRecord& file : files) {
        sum.bytes += file.bytes;
        if (!file.kinds) continue;
        sum.kinds.geometry += file.kinds->geometry;
        sum.kinds.textures += file.kinds->textures;
        sum.kinds.json += file.kinds->json;
    }
    return sum;
}

std::string part_of_before(std::uint64_t before, std::uint64_t after) {
    if (before == 0) return "-";
    return percentage(100.0 * static_cast<double>(after) / static_cast<double>(before));
}

std::optional<FaceCounts> face_counts(const RunRecord& record) {
    std::optional<FaceCounts> out;
    for (const auto& stage : record.stages) {
        if (!stage.after) continue;
        if (!out) out = {stage.after->faces, 0};
        out->last = stage.after->faces;
    }
    return out;
}

std::size_t warning_count(const RunRecord& record) {
    std::size_t count = record.warnings.size();
    for (const auto& stage : record.stages) count += stage.warnings.size();
    return count;
}

std::string deviation_text(const RunRecord& record) {
    const DeviationView* worst = nullptr;
    for (const OutputView& view : record.views)
        if (const DeviationView* own = deviation_of(view, record);
            own && (!worst || std::abs(own->worst_distance) > std::abs(worst->worst_distance)))
            worst = own;
    if (!worst) return {};
    const double most = std::abs(worst->worst_distance);
    const char* uncounted =
        worst->caps > 0 ? "caps and removed parts not counted" : "removed parts not counted";
    if (!(worst->diagonal > 0)) return fmt::format("from {}: {:.4g} ({})", worst->from, most, uncounted);
    constexpr double float_step = 1.0 / (1 << 24); // half the relative distance of 32-bit floats
    const bool is_rounding = most > 0 && most < float_step * worst->diagonal;
    return fmt::format("from {}: {} of the diagonal{} ({})", worst->from,
                       percentage(100 * most / worst->diagonal),
                       is_rounding ? ", less than the rounding of 32-bit floats" : "", uncounted);
}

} // namespace facetmill::report
