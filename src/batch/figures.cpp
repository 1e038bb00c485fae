#include "batch/figures.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"

#include <fmt/format.h>

namespace facetmill::batch {

namespace {

std::string faces_phrase(const Figures& f) {
    if (f.faces_in + f.faces_out == 0) return {};
    return fmt::format("{} -> {} {}", grouped(f.faces_in), grouped(f.faces_out),
                       noun_for(f.faces_out, "face"));
}

std::string size_phrase(const Figures& f) { return f.bytes > 0 ? sized(f.bytes) : ""; }

constexpr Column all_columns[] = {
    {"faces_in", "faces in", "Faces of the first loaded scene.", &Figures::faces_in, grouped, nullptr},
    {"faces_out", "faces out", "Faces of the final scene.", &Figures::faces_out, grouped, faces_phrase},
    {"bytes", "size", "The size of all outputs except reports, in bytes.", &Figures::bytes, sized,
     size_phrase},
};

} // namespace

std::span<const Column> columns() { return all_columns; }

Figures figures_of(const report::RunRecord& record) {
    Figures figures;
    for (const auto& stage : record.stages) {
        if (!stage.after) continue;
        if (figures.faces_in == 0) figures.faces_in = stage.after->faces;
        figures.faces_out = stage.after->faces;
    }
    for (const auto& file : record.outputs) figures.bytes += file.bytes;
    return figures;
}

} // namespace facetmill::batch
