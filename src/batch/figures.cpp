#include "batch/figures.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace facetmill::batch {

namespace {

std::string faces_phrase(const Figures& f) {
    if (f.faces_in + f.faces_out == 0) return {};
    return fmt::format("{} -> {} {}", grouped(f.faces_in), grouped(f.faces_out),
                       noun_for(f.faces_out, "face"));
}

std::string size_phrase(const Figures& f) { return f.bytes > 0 ? sized(f.bytes) : ""; }

std::uint64_t whole(double count) { return static_cast<std::uint64_t>(std::clamp(count, 0.0, 0x1p53)); }
std::string grouped_cell(double count) { return grouped(whole(count)); }
std::string sized_cell(double count) { return sized(whole(count)); }
std::string readable_cell(double value) { return readable(value); }

/// A count that every asset has.
Column counted_column(const char* key, const char* title, const char* help, std::uint64_t Figures::*member,
                      std::string (*cell)(double), std::string (*phrase)(const Figures&)) {
    return {key,
            title,
            help,
            true,
            false,
            [member](const Figures& f) { return std::optional(static_cast<double>(f.*member)); },
            [member](Figures& f, std::optional<double> value) { f.*member = whole(value.value_or(0)); },
            cell,
            phrase};
}

Column model_column(std::size_t i) {
    const ModelColumn& column = model_columns()[i];
    return {column.name.data(),
            column.title.data(),
            column.help.data(),
            column.is_count(),
            true,
            [i](const Figures& f) {
                return i < f.model.values.size() ? f.model.values[i] : std::optional<double>();
            },
            [i](Figures& f, std::optional<double> value) {
                f.model.values.resize(model_columns().size());
                f.model.values[i] = value;
            },
            column.is_count() ? grouped_cell : readable_cell,
            nullptr};
}

std::vector<Column> all_columns() {
    std::vector<Column> all{
        counted_column("faces_in", "faces in", "Faces of the first loaded scene.", &Figures::faces_in,
                       grouped_cell, nullptr),
        counted_column("faces_out", "faces out", "Faces of the final scene.", &Figures::faces_out,
                       grouped_cell, faces_phrase),
        counted_column("bytes", "size", "The size of all outputs except reports, in bytes.", &Figures::bytes,
                       sized_cell, size_phrase),
    };
    for (std::size_t i = 0; i < model_columns().size(); ++i) all.push_back(model_column(i));
    return all;
}

} // namespace

std::span<const Column> columns() {
    static const std::vector<Column> all = all_columns();
    return all;
}

Figures figures_of(const report::RunRecord& record) {
    Figures figures;
    for (const auto& stage : record.stages) {
        if (!stage.after) continue;
        if (figures.faces_in == 0) figures.faces_in = stage.after->faces;
        figures.faces_out = stage.after->faces;
    }
    for (const auto& file : record.outputs) figures.bytes += file.bytes;
    figures.model = record.model;
    return figures;
}

} // namespace facetmill::batch
