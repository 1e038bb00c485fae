#include "report/record_fields.hpp"

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
        c.field("why", unless_empty(&AttributeChange::why), "The reason.").null_when("it needs none");
    });
}

void declare_stage(DeclareFields<StageRecord>& d) {
    const auto brief = [](DeclareFields<Brief>& b) { b.fields = brief_fields(); };
    d.field("name", &StageRecord::name, "Unique in the run");
    d.field("stage", &StageRecord::stage, "");
    d.field("path", &StageRecord::path, "Where in the pipeline: stages[5].branch.far[0]");
    d.field("skipped", &StageRecord::skipped, "Its `when` did not hold");
    refer(d.object("before", &StageRecord::before, "", brief), "brief");
    refer(d.object("after", &StageRecord::after, "", brief), "brief");
    d.field("options", as_it_is(&StageRecord::options), "As they held: given, or by default").field().schema =
        fields::schema_of_type("object");
    d.field("resolved", &StageRecord::resolved, "Lengths that depended on the scene");
    d.list("attribute_changes", &StageRecord::attribute_changes, "What each attribute went through",
           declare_change);
    refer(d.list("warnings", &StageRecord::warnings, "What the stage warned of",
                 declare_diagnostic<Diagnostic>),
          "diagnostic");
    d.field("result", as_it_is(&StageRecord::result), "What the stage itself reports").field().schema =
        fields::schema_of_type("object");
}

void declare_check(DeclareFields<Check>& d) {
    d.field("name", &Check::name, "The property");
    d.field("stage", &Check::stage, "");
    d.field("passed", &Check::passed, "");
    d.choice(
        "severity", &Check::severity,
        {{"error", Severity::error, ""}, {"warning", Severity::warning, ""}, {"note", Severity::note, ""}},
        "");
    d.field("expected", &Check::expected, "");
    d.field("found", &Check::found,
            "A number, a truth, a word, a box {min, max} or names; null: it does not apply");
    d.field("hint", unless_empty(&Check::hint), "The stage that fixes it.")
        .null_when("it held, or no stage does");
    d.field("part", unless_empty(&Check::part), "The part that it refers to.").null_when("that is the scene");
    d.field("file", unless_empty(&Check::file), "The written file that was read back and judged.")
        .null_when("the scene was judged");
    d.field(
        "where", [](const Check& c) { return unless_empty(facetmill::to_string(c.where)); },
        "Its position in the pipeline.");
    d.field("waived", &Check::waived, "It failed, and the baseline lists the failure");
    d.field("locations", &Check::locations, "The number of locations that violate it.")
        .null_when("they are not counted, or it held");
    d.field("new_locations", &Check::fresh, "The number of them that are not in the baseline.")
        .null_when("there is no baseline");
    d.field("evidence", &Check::evidence, "The first locations, or the worst values.").null_when("it held");
}

/// read_back: true for outputs.
void declare_file(DeclareFields<FileRecord>& d, bool read_back) {
    d.field("path", &FileRecord::path, "");
    d.field("bytes", &FileRecord::bytes, "");
    d.field("sha256", &FileRecord::sha256, "").field().schema["pattern"] = "^([0-9a-f]{64})?$";
    d.object("contents", &FileRecord::kinds, "What its bytes are spent on.",
             [](DeclareFields<io::ByteKinds>& k) {
                 k.field("geometry", &io::ByteKinds::geometry, "Bytes of meshes, animations and skins.");
                 k.field("textures", &io::ByteKinds::textures, "Bytes of images.");
                 k.field("json", &io::ByteKinds::json, "Bytes of JSON, or of a file of materials.");
             })
        .null_when("it is not a file of a mesh");
    if (read_back)
        d.field("read_back", as_it_is(&FileRecord::read_back), "The result of reading the written file back");
}

void declare_run(DeclareFields<RunRecord>& d) {
    declare_format(d);
    declare_tool(d);
    d.field("pipeline", &RunRecord::pipeline, "");
    d.field("about", unless_empty(&RunRecord::about), "What the pipeline says it is for.")
        .null_when("it does not say");
    d.field(
        "passed", [](const RunRecord& r) { return r.exit_code == 0; }, "");
    d.field("exit_code", &RunRecord::exit_code, "");
    refer(d.list("errors", &RunRecord::errors, "Why it failed", declare_diagnostic<RunError>), "diagnostic");
    refer(d.list("warnings", &RunRecord::warnings, "Of the run as a whole", declare_diagnostic<Diagnostic>),
          "diagnostic");
    d.field("params", as_it_is(&RunRecord::params), "").field().schema = fields::schema_of_type("object");
    d.list("inputs", &RunRecord::inputs, "Files that were read",
           [](DeclareFields<FileRecord>& f) { declare_file(f, false); });
    refer(d.list("stages", &RunRecord::stages, "In the order they ran", declare_stage), "stage");
    refer(d.list("checks", &RunRecord::checks, "What validate and ensure asked", declare_check), "check");
    d.list("outputs", &RunRecord::outputs, "Files that were written; none when the run failed",
           [](DeclareFields<FileRecord>& f) { declare_file(f, true); });
    d.field("properties", as_it_is(&RunRecord::final_properties),
            "Of the scene at the end; null when the run failed before it")
        .field()
        .schema = {{"anyOf", Json::array({reference("scene"), typed("null")})}};
}

void declare_timings(DeclareFields<RunRecord>& d) {
    declare_format(d);
    d.field("pipeline", &RunRecord::pipeline, "");
    d.field("seconds", &RunRecord::seconds, "");
    d.field("peak_memory", &RunRecord::peak_memory, "Bytes");
    d.field("threads", &RunRecord::threads, "");
    d.list("stages", &RunRecord::stages, "In the order of the report's stages",
           [](DeclareFields<StageRecord>& s) {
               s.field("name", &StageRecord::name, "");
               s.field("seconds", &StageRecord::seconds, "");
               s.field("peak_memory", &StageRecord::peak_memory, "Bytes, of the process until its end");
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
            "The place that it is about.");
        d.field(
            "hint", [](const Diagnostic& it) { return unless_empty(it.hint); }, "What to do about it.");
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
