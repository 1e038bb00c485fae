#pragma once
// The figures of an asset: the numeric columns in the summary of a batch. JSON, its schema, HTML, Markdown,
// text, the table of models and the journal use columns().

#include "report/record.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace facetmill::batch {

struct Figures {
    std::uint64_t faces_in = 0, faces_out = 0, bytes = 0;
    ModelRow model; ///< measured for tables of models
};

struct Column {
    const char* key;   ///< key in JSON, and heading of the table of models
    const char* title; ///< title in tables for people
    const char* help;  ///< help in the schema
    bool is_count = true;
    bool of_model = false; ///< a measure of the model, which may be missing
    std::function<std::optional<double>(const Figures&)> value;
    std::function<void(Figures&, std::optional<double>)> set;
    std::string (*cell)(double);
    std::string (*phrase)(const Figures&); ///< in the asset's line of a text; null or empty: none
};

/// In the order of the tables.
[[nodiscard]] std::span<const Column> columns();
[[nodiscard]] Figures figures_of(const report::RunRecord& record);

} // namespace facetmill::batch
