#include "report/record_fields.hpp"
#include "report/render.hpp"

namespace facetmill::report {

Json timings_json(const RunRecord& record) { return timings_fields().json(&record); }

Json to_json(const RunRecord& record) { return run_fields().json(&record); }

} // namespace facetmill::report
