// Inputs and outputs on a page: bytes by kind, digests, the results of reading back.

#include "base/text/markup.hpp"
#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "report/glance.hpp"
#include "report/html_parts.hpp"
#include "report/html_sections.hpp"
#include "report/html_stages.hpp"

#include <fmt/format.h>

namespace facetmill::report {

namespace {

std::string kind_cells(const std::optional<io::ByteKinds>& kinds) {
    if (!kinds) return number_cell("-") + number_cell("-") + number_cell("-");
    return number_cell(sized(kinds->geometry)) + number_cell(sized(kinds->textures)) +
           number_cell(sized(kinds->json));
}

std::string rows_of(const std::vector<FileRecord>& files) {
    std::string rows;
    for (const FileRecord& f : files)
        rows +=
            fmt::format("<tr>{}{}{}{}</tr>\n", cell(path_code(f.path)), number_cell(sized(f.bytes)),
                        kind_cells(f.kinds), cell("<span class=\"digest\">" + code(f.sha256) + "</span>"));
    if (files.size() < 2) return rows;
    const ByteSum sum = sum_of(files);
    return rows + fmt::format("<tr class=\"sum\">{}{}{}{}</tr>\n", cell("total"),
                              number_cell(sized(sum.bytes)), kind_cells(sum.kinds), cell(""));
}

std::string before_and_after(const RunRecord& record) {
    if (record.inputs.empty() || record.outputs.empty()) return {};
    const ByteSum in = sum_of(record.inputs), out = sum_of(record.outputs);
    const auto row = [](const char* what, std::uint64_t before, std::uint64_t after) {
        return fmt::format("<tr><th scope=\"row\">{}</th>{}{}{}</tr>\n", what, number_cell(sized(before)),
                           number_cell(sized(after)), number_cell(part_of_before(before, after)));
    };
    return table("Bytes", heads({"kind", "#inputs", "#outputs", "#ratio"}),
                 row("geometry", in.kinds.geometry, out.kinds.geometry) +
                     row("textures", in.kinds.textures, out.kinds.textures) +
                     row("JSON", in.kinds.json, out.kinds.json) + row("total", in.bytes, out.bytes));
}

std::string read_back_tables(const std::vector<FileRecord>& outputs) {
    std::string out;
    for (const FileRecord& f : outputs)
        if (f.read_back.is_object())
            out += fmt::format(
                "<details><summary>{} read back: {} faces, {} vertices, positions within {} of the scene"
                "</summary>{}</details>\n",
                path_code(f.path), grouped(f.read_back.value("faces", std::uint64_t{0})),
                grouped(f.read_back.value("vertices", std::uint64_t{0})),
                readable(f.read_back.value("position_error", 0.0)),
                subtable("Read back", heads({"name", "value"}), value_rows(f.read_back), "h3"));
    return out;
}

} // namespace

std::string file_sections(const RunRecord& record) {
    const auto columns = {"file", "#size", "#geometry", "#textures", "#JSON", "SHA-256"};
    return before_and_after(record) + table("Outputs", heads(columns), rows_of(record.outputs)) +
           read_back_tables(record.outputs) + table("Inputs", heads(columns), rows_of(record.inputs));
}

} // namespace facetmill::report
