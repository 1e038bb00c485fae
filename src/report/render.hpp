#pragma once
// Renderers of a run's record.

#include "base/text/markup.hpp"
#include "geometry/inspect/inspect.hpp"
#include "report/record.hpp"

namespace facetmill::report {

/// One value by the property's kind; none where it does not apply or was not asked for.
Found property_value(const Property& property, const Properties& properties);
/// The same as JSON; null of none.
Json property_json(const Property& property, const Properties& properties);
/// The rows of the table that are told of these properties, in order, but for the box and what only scenes
/// have.
std::vector<const Property*> told_properties(const Properties& properties);
Json properties_json(
    const Properties& properties); ///< numbers and truths of property_table(), null where not applicable
/// All properties of a scene: properties_json plus unit, up, attributes, materials and parts.
Json scene_json(const Scene& scene, const Properties& properties);
Json to_json(const RunRecord& record); ///< the report; its schema is schema()
Json schema();                         ///< JSON Schema (2020-12) of the report
/// Times, memory and threads, which vary from run to run and are therefore in no report.
Json timings_json(const RunRecord& record);
Json timings_schema();
Json info_schema();                           ///< ... and of `info --json`
std::string to_text(const RunRecord& record); ///< the report for people
/// The summary for a terminal: with times and memory, without warnings and errors, which were printed when
/// they occurred.
Painted to_terminal(const RunRecord& record, bool colour);
/// One self-contained page. view: the contents of its 3D view (report/viewer.hpp), or null.
std::string to_html(const RunRecord& record, const Json& view = nullptr);
/// ... with times, memory and threads, which vary from run to run.
std::string to_html_with_times(const RunRecord& record, const Json& view = nullptr);
std::string to_markdown(const RunRecord& record); ///< for the description of a change
std::string to_junit(const RunRecord& record);    ///< checks as test cases
/// The renderer for a report's file name (form_of). The same inputs give the same text, in any run. Throws
/// usage (E-REPORT) otherwise.
std::string render_for(const std::string& path, const RunRecord& record, const Json& view = nullptr);

} // namespace facetmill::report
