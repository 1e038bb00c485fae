#pragma once
// The figures of an asset: the numeric columns in the summary of a batch. JSON, its schema, HTML, Markdown,
// text and the journal use columns().

#include "report/record.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace facetmill::batch {

struct Figures {
    std::uint64_t faces_in = 0, faces_out = 0, bytes = 0;
};

struct Column {
    const char* key;   ///< key in JSON
    const char* title; ///< title in tables
    const char* help;  ///< help in the schema
    std::uint64_t Figures::*value;
    std::string (*cell)(std::uint64_t);
    std::string (*phrase)(const Figures&); ///< in the asset's line of a text; null or empty: none
};

/// In the order of the tables.
[[nodiscard]] std::span<const Column> columns();
[[nodiscard]] Figures figures_of(const report::RunRecord& record);

} // namespace facetmill::batch
