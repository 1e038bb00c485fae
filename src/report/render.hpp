#pragma once
// Renderers of a run's record.

#include "base/text/markup.hpp"
#include "geometry/inspect/inspect.hpp"
#include "report/record.hpp"

namespace facetmill::report {

/// A property's value by its kind; none if it does not apply or was not requested.
[[nodiscard]] Found property_value(const Property& property, const Properties& properties);
/// The value as JSON; null for none.
[[nodiscard]] Json property_json(const Property& property, const Properties& properties);
/// The rows of the table to print for these properties, in order, without the box and the properties of
/// scenes only.
[[nodiscard]] std::vector<const Property*> told_properties(const Properties& properties);
[[nodiscard]] Json properties_json(
    const Properties& properties); ///< numbers and truths of property_table(), null where not applicable
/// All properties of a scene: properties_json plus unit, up, attributes, materials and parts.
[[nodiscard]] Json scene_json(const Scene& scene, const Properties& properties);
[[nodiscard]] Json to_json(const RunRecord& record); ///< the report; its schema is schema()
[[nodiscard]] Json schema();                         ///< JSON Schema (2020-12) of the report
/// Times, memory and threads: data that differs between runs, and is therefore in no report.
[[nodiscard]] Json timings_json(const RunRecord& record);
[[nodiscard]] Json timings_schema();
[[nodiscard]] Json info_schema();                           ///< JSON Schema of `info --json`
[[nodiscard]] std::string to_text(const RunRecord& record); ///< the report for people
/// The result for a terminal: with times and memory, without warnings and errors, which were printed when
/// they occurred.
[[nodiscard]] Painted to_terminal(const RunRecord& record, bool colour);
/// A self-contained page. view: contents of its 3D view (report/viewer.hpp), or null.
[[nodiscard]] std::string to_html(const RunRecord& record, const Json& view = nullptr);
/// A page with times, memory and threads, which differ between runs.
[[nodiscard]] std::string to_html_with_times(const RunRecord& record, const Json& view = nullptr);
[[nodiscard]] std::string to_markdown(const RunRecord& record); ///< for the description of a change
[[nodiscard]] std::string to_junit(const RunRecord& record);    ///< checks as test cases
/// Renders the format of a report's file name (form_of). The same inputs always give the same text. Throws a
/// usage error (E-REPORT) otherwise.
[[nodiscard]] std::string render_for(const std::string& path, const RunRecord& record,
                                     const Json& view = nullptr);

} // namespace facetmill::report
