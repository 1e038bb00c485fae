#include "io/threemf/slicer.hpp"

#include "io/text.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace facetmill::io::threemf {

namespace {

/// The attribute as a number; `none` if it is absent or no number, because no specification describes these
/// files.
std::uint32_t number(const Element& e, std::string_view attribute) {
    const std::string_view text = trimmed(e.find(attribute).value_or(""));
    std::uint32_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && stop == text.data() + text.size() ? value : none;
}

/// Keeps the triangles without a mark, and the vertices that they use.
void keep_unmarked(Object& object, const std::vector<bool>& marked) {
    std::vector<Index> number_of(object.positions.size(), none);
    std::vector<Vec3> positions;
    std::vector<Index> corners;
    std::vector<Properties> triangles;
    for (std::size_t f = 0; f < marked.size(); ++f) {
        if (marked[f]) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const Index vertex = object.corners[3 * f + k];
            if (number_of[vertex] == none) {
                number_of[vertex] = static_cast<Index>(positions.size());
                positions.push_back(object.positions[vertex]);
            }
            corners.push_back(number_of[vertex]);
        }
        if (!object.triangles.empty()) triangles.push_back(object.triangles[f]);
    }
    object.positions = std::move(positions);
    object.corners = std::move(corners);
    object.triangles = std::move(triangles);
}

} // namespace

SlicerVolumes::SlicerVolumes(Archive& archive, const std::string& name) {
    const auto read = [&](const char* path, auto reader) {
        try {
            if (const auto xml = archive.file(path)) (this->*reader)(*xml, name + path);
        } catch (const Error& e) {
            if (e.kind() != ErrorKind::malformed) throw;
            faults_.push_back(fmt::format("the slicer's settings in '{}' cannot be read, so volumes that are "
                                          "not printed are read as parts: {}",
                                          path, e.what()));
        }
    };
    read("/Metadata/Slic3r_PE_model.config", &SlicerVolumes::read_ranges);
    read("/Metadata/model_settings.config", &SlicerVolumes::read_components);
}

void SlicerVolumes::read_ranges(Span xml, const std::string& name) {
    std::uint32_t object = none;
    bool in_volume = false;
    const auto start = [&](const Element& e) {
        if (e.name == "object") {
            object = number(e, "id");
            in_volume = false; // an object has metadata before its volumes
        } else if (e.name == "volume") {
            in_volume = true;
            ranges_[object].push_back({number(e, "firstid"), number(e, "lastid"), ""});
        } else if (e.name == "metadata" && in_volume) {
            std::string& purpose = ranges_[object].back().purpose;
            const auto key = e.find("key"), value = e.find("value");
            if (key == "volume_type" && value != "ModelPart")
                purpose = value.value_or("");
            else if (key == "modifier" && value == "1") // before PrusaSlicer 1.42
                purpose = "ParameterModifier";
        }
    };
    read_xml(xml, name, {start, [] {}, {}});
}

void SlicerVolumes::read_components(Span xml, const std::string& name) {
    std::uint32_t object = none;
    const auto start = [&](const Element& e) {
        if (e.name == "object") object = number(e, "id");
        if (e.name != "part") return;
        const std::string_view subtype = e.find("subtype").value_or("normal_part");
        if (subtype != "normal_part") components_[{object, number(e, "id")}] = subtype;
    };
    read_xml(xml, name, {start, [] {}, {}});
}

void SlicerVolumes::remove_from(std::map<std::uint32_t, Object>& objects,
                                std::map<std::string, std::size_t>& left_out) const {
    for (const auto& [id, ranges] : ranges_) {
        const auto found = objects.find(id);
        if (found == objects.end()) continue;
        Object& object = found->second;
        std::vector<bool> marked(object.corners.size() / 3, false);
        std::map<std::string, std::size_t> purposes;
        for (const Range& range : ranges) {
            if (range.purpose.empty() || range.first >= marked.size()) continue;
            const std::size_t end = std::min(marked.size(), std::size_t{range.last} + 1);
            for (std::size_t f = range.first; f < end; ++f) marked[f] = true;
            ++purposes[range.purpose];
        }
        if (std::find(marked.begin(), marked.end(), false) == marked.end() || purposes.empty()) continue;
        keep_unmarked(object, marked);
        for (const auto& [purpose, count] : purposes) left_out[purpose] += count;
    }
}

const std::string* SlicerVolumes::purpose(std::uint32_t object, std::uint32_t component) const {
    const auto found = components_.find({object, component});
    return found == components_.end() ? nullptr : &found->second;
}

} // namespace facetmill::io::threemf
