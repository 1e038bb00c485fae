#include "report/contents.hpp"
#include "report/diagnostics_json.hpp"
#include "report/render.hpp"

namespace facetmill::report {

namespace {

const char* to_string(Severity severity) {
    return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "note";
}

Json files_json(const std::vector<FileRecord>& files, bool read_back) {
    Json all = Json::array();
    for (const auto& f : files) {
        Json one = {{"path", f.path}, {"bytes", f.bytes}, {"sha256", f.sha256}};
        if (read_back) one["read_back"] = f.read_back;
        all.push_back(std::move(one));
    }
    return all;
}

Json brief_json(const std::optional<Brief>& brief) { return brief ? brief_fields().json(&*brief) : Json(); }

Json stage_json(const StageRecord& stage) {
    Json changes = Json::array();
    for (const auto& [part, change] : stage.attribute_changes)
        changes.push_back({{"part", part},
                           {"attribute", change.attribute},
                           {"domain", to_string(change.domain)},
                           {"change", to_string(change.kind)},
                           {"why", text_or_null(change.why)}});
    return {{"name", stage.name},
            {"stage", stage.stage},
            {"path", stage.path},
            {"skipped", stage.skipped},
            {"before", brief_json(stage.before)},
            {"after", brief_json(stage.after)},
            {"resolved", resolved_json(stage.resolved)},
            {"attribute_changes", std::move(changes)},
            {"warnings", diagnostics_json(stage.warnings)},
            {"result", stage.result}};
}

Json check_json(const Check& check) {
    return {{"name", check.name},
            {"stage", check.stage},
            {"passed", check.passed},
            {"severity", to_string(check.severity)},
            {"expected", check.expected},
            {"found", found_json(check.found)},
            {"hint", text_or_null(check.hint)},
            {"part", text_or_null(check.part)},
            {"where", text_or_null(facetmill::to_string(check.where))},
            {"waived", check.waived},
            {"locations", check.locations ? Json(*check.locations) : Json()},
            {"new_locations", check.fresh ? Json(*check.fresh) : Json()},
            {"evidence", evidence_json(check.evidence)}};
}

} // namespace

Json timings_json(const RunRecord& record) {
    Json stages = Json::array();
    for (const auto& stage : record.stages)
        stages.push_back({{"name", stage.name}, {"seconds", stage.seconds}});
    return {{"format", 1},
            {"pipeline", record.pipeline},
            {"seconds", record.seconds},
            {"peak_memory", record.peak_memory},
            {"threads", record.threads},
            {"stages", std::move(stages)}};
}

Json to_json(const RunRecord& record) {
    Json stages = Json::array(), checks = Json::array();
    for (const auto& stage : record.stages) stages.push_back(stage_json(stage));
    for (const auto& check : record.checks) checks.push_back(check_json(check));
    return {{"format", 1},
            {"tool", {{"name", "facetmill"}, {"version", FACETMILL_VERSION}}},
            {"pipeline", record.pipeline},
            {"about", text_or_null(record.about)},
            {"passed", record.exit_code == 0},
            {"exit_code", record.exit_code},
            {"errors", diagnostics_json(record.errors)},
            {"warnings", diagnostics_json(record.warnings)},
            {"params", record.params},
            {"inputs", files_json(record.inputs, false)},
            {"stages", std::move(stages)},
            {"checks", std::move(checks)},
            {"outputs", files_json(record.outputs, true)},
            {"properties", record.final_properties}};
}

} // namespace facetmill::report
