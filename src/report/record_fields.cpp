#include "report/record_fields.hpp"

#include "facetmill_version.hpp"
#include "report/contents.hpp"
#include "report/render.hpp"
#include "report/schema_forms.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace report {
namespace {
/// A value that is already JSON.
struct AsItIs {
    const Json* json = nullptr;
};
} // namespace
} // namespace report

template <>
struct FieldType<report::AsItIs> {
    static constexpr const char* name = "anything";
    static Json schema() { return Json::object(); }
    static Json json(const report::AsItIs& value) { return *value.json; }
};

template <>
struct FieldType<report::Found> {
    static constexpr const char* name = "value";
    static Json schema() {
        return {{"type", {"integer", "number", "boolean", "string", "object", "array", "null"}}};
    }
    static Json json(const report::Found& value) { return report::found_json(value); }
};

template <>
struct FieldType<report::CheckEvidence> {
    static constexpr const char* name = "list of objects";
    static Json schema() { return fields::schema_of_type("array"); }
    static Json json(const report::CheckEvidence& value) { return report::evidence_json(value); }
};

template <>
struct FieldType<std::vector<report::ResolvedLength>> {
    static constexpr const char* name = "lengths by option";
    static Json schema() { return fields::schema_of_type("object"); }
    static Json json(const std::vector<report::ResolvedLength>& value) {
        return report::resolved_json(value);
    }
};

namespace report {

namespace {

std::optional<std::string> unless_empty(std::string text) {
    return text.empty() ? std::nullopt : std::optional(std::move(text));
}

template <class R>
auto unless_empty(std::string R::*member) {
    return [member](const R& record) { return unless_empty(record.*member); };
}

template <class R>
auto as_it_is(Json R::*member) {
    return [member](const R& record) { return AsItIs{&(record.*member)}; };
}

void declare_change(DeclareFields<PartChange>& d) {
    d.field("part", &PartChange::part, "");
    d.embed(&PartChange::change, [](DeclareFields<AttributeChange>& c) {
        using Kind = AttributeChange::Kind;
        c.field("attribute", &AttributeChange::attribute, "");
        c.choice("domain", &AttributeChange::domain, domain_choices(), "");
        std::vector<NamedChoice<Kind>> kinds;
        for (const Kind kind : {Kind::kept, Kind::interpolated, Kind::recomputed, Kind::dropped})
            kinds.push_back({to_string(kind), kind, ""});
        c.choice("change", &AttributeChange::kind, kinds, "");
        c.field("why", unless_empty(&AttributeChange::why), "The reason.")
            .null_when("the change needs no reason");
    });
}

void declare_stage(DeclareFields<StageRecord>& d) {
    const auto brief = [](DeclareFields<Brief>& b) { b.fields = brief_fields(); };
    d.field("name", &StageRecord::name, "The name of the step, unique in the run.");
    d.field("stage", &StageRecord::stage, "");
    d.field("path", &StageRecord::path, "The position in the pipeline, for example stages[5].branch.far[0].");
    d.field("skipped", &StageRecord::skipped,
            "Whether the stage was skipped because its condition (when) was false.");
    refer(d.object("before", &StageRecord::before, "", brief), "brief");
    refer(d.object("after", &StageRecord::after, "", brief), "brief");
    d.field("options", as_it_is(&StageRecord::options), "All options, including defaults.").field().schema =
        fields::schema_of_type("object");
    d.field("resolved", &StageRecord::resolved,
            "Lengths that depend on the scene, such as percentages, in scene units.");
    d.list("attribute_changes", &StageRecord::attribute_changes, "The change of each attribute.",
           declare_change);
    refer(d.list("warnings", &StageRecord::warnings, "The warnings of the stage.",
                 declare_diagnostic<Diagnostic>),
          "diagnostic");
    d.field("result", as_it_is(&StageRecord::result), "The results of the stage.").field().schema =
        fields::schema_of_type("object");
}

void declare_check(DeclareFields<Check>& d) {
    d.field("name", &Check::name, "The name of the property.");
    d.field("stage", &Check::stage, "");
    d.field("passed", &Check::passed, "");
    d.choice(
        "severity", &Check::severity,
        {{"error", Severity::error, ""}, {"warning", Severity::warning, ""}, {"note", Severity::note, ""}},
        "");
    d.field("expected", &Check::expected, "");
    d.field("found", &Check::found,
            "The value: a number, true or false, a word, a box {min, max} or a list of names. Null when the "
            "property does not apply.");
    d.field("hint", unless_empty(&Check::hint), "A stage that may fix it.")
        .null_when("the check passed, or no stage fixes it");
    d.field("part", unless_empty(&Check::part), "The checked part.").null_when("the whole scene was checked");
    d.field("file", unless_empty(&Check::file), "The written file that was read back and checked.")
        .null_when("the scene in memory was checked");
    d.field(
        "where", [](const Check& c) { return unless_empty(facetmill::to_string(c.where)); },
        "The position in the pipeline file.");
    d.field("waived", &Check::waived,
            "Whether the baseline lists this failure, so that it does not fail the run.");
    d.field("locations", &Check::locations, "The number of failing locations.")
        .null_when("locations are not counted, or the check passed");
    d.field("new_locations", &Check::fresh, "The number of failing locations that are not in the baseline.")
        .null_when("there is no baseline");
    d.field("evidence", &Check::evidence, "The first locations, or the worst values.")
        .null_when("the check passed");
}

/// read_back: true for outputs.
void declare_file(DeclareFields<FileRecord>& d, bool read_back) {
    d.field("path", &FileRecord::path, "");
    d.field("bytes", &FileRecord::bytes, "");
    d.field("sha256", &FileRecord::sha256, "").field().schema["pattern"] = "^([0-9a-f]{64})?$";
    d.object("contents", &FileRecord::kinds, "The bytes of the file by content.",
             [](DeclareFields<io::ByteKinds>& k) {
                 k.field("geometry", &io::ByteKinds::geometry, "Bytes of meshes, animations and skins.");
                 k.field("textures", &io::ByteKinds::textures, "Bytes of images.");
                 k.field("json", &io::ByteKinds::json, "Bytes of JSON or of a material file.");
             })
        .null_when("the file does not belong to a mesh");
    if (read_back)
        d.field("read_back", as_it_is(&FileRecord::read_back), "The result of reading the written file back");
}

void declare_run(DeclareFields<RunRecord>& d) {
    declare_format(d);
    declare_tool(d);
    d.field("pipeline", &RunRecord::pipeline, "");
    d.field("about", unless_empty(&RunRecord::about), "The purpose, as written in the pipeline.")
        .null_when("the pipeline does not state it");
    d.field(
        "passed", [](const RunRecord& r) { return r.exit_code == 0; }, "");
    d.field("exit_code", &RunRecord::exit_code, "");
    refer(d.list("errors", &RunRecord::errors, "The errors of the run.", declare_diagnostic<RunError>),
          "diagnostic");
    refer(d.list("warnings", &RunRecord::warnings, "Warnings that are not listed with a stage.",
                 declare_diagnostic<Diagnostic>),
          "diagnostic");
    d.field("params", as_it_is(&RunRecord::params), "").field().schema = fields::schema_of_type("object");
    d.list("inputs", &RunRecord::inputs, "The files that were read.",
           [](DeclareFields<FileRecord>& f) { declare_file(f, false); });
    refer(d.list("stages", &RunRecord::stages, "The stages, in the order in which they ran.", declare_stage),
          "stage");
    refer(d.list("checks", &RunRecord::checks, "The checks of validate and ensure.", declare_check), "check");
    d.list("outputs", &RunRecord::outputs, "The files that were written. Empty when the run failed.",
           [](DeclareFields<FileRecord>& f) { declare_file(f, true); });
    d.field(
         "properties", as_it_is(&RunRecord::final_properties),
         "The properties of the final scene, or of the scene that failed a check. Null when a stage failed.")
        .field()
        .schema = {{"anyOf", Json::array({reference("scene"), typed("null")})}};
}

void declare_timings(DeclareFields<RunRecord>& d) {
    declare_format(d);
    d.field("pipeline", &RunRecord::pipeline, "");
    d.field("seconds", &RunRecord::seconds, "");
    d.field("peak_memory", &RunRecord::peak_memory, "The peak memory of the run, in bytes.");
    d.field("threads", &RunRecord::threads, "");
    d.list("stages", &RunRecord::stages, "The stages, in the order of the report.",
           [](DeclareFields<StageRecord>& s) {
               s.field("name", &StageRecord::name, "");
               s.field("seconds", &StageRecord::seconds, "");
               s.field("peak_memory", &StageRecord::peak_memory,
                       "The peak memory of the process up to the end of the stage, in bytes.");
           });
}

} // namespace

void refer(FieldRef ref, const char* definition) {
    Field& field = ref.field();
    if (field.is_list)
        field.schema = {{"type", "array"}, {"items", reference(definition)}};
    else
        field.schema = reference(definition);
    field.null_when.clear();
}

const Fields& tool_fields() {
    static const Fields fields = fields_of<Tool>([](DeclareFields<Tool>& d) {
        d.field(
             "name", [](const Tool&) { return std::string("facetmill"); }, "")
            .field()
            .schema = {{"const", "facetmill"}};
        d.field(
            "version", [](const Tool&) { return std::string(FACETMILL_VERSION); }, "");
    });
    return fields;
}

const Fields& diagnostic_fields() {
    static const Fields fields = fields_of<Diagnostic>([](DeclareFields<Diagnostic>& d) {
        d.field("id", &Diagnostic::id, "");
        d.field("message", &Diagnostic::message, "");
        d.field(
            "where", [](const Diagnostic& it) { return unless_empty(facetmill::to_string(it.where)); },
            "The position in a file.");
        d.field(
            "hint", [](const Diagnostic& it) { return unless_empty(it.hint); }, "How to solve the problem.");
    });
    return fields;
}

const Fields& stage_fields() {
    static const Fields fields = fields_of<StageRecord>(declare_stage);
    return fields;
}

const Fields& check_fields() {
    static const Fields fields = fields_of<Check>(declare_check);
    return fields;
}

const Fields& run_fields() {
    static const Fields fields = fields_of<RunRecord>(declare_run);
    return fields;
}

const Fields& timings_fields() {
    static const Fields fields = fields_of<RunRecord>(declare_timings);
    return fields;
}

Json timings_json(const RunRecord& record) { return timings_fields().json(&record); }

Json to_json(const RunRecord& record) { return run_fields().json(&record); }

} // namespace report

} // namespace facetmill
