// The JSON documents of a batch: their declarations, and their schema.

#include "batch/causes.hpp"
#include "batch/words.hpp"
#include "io/rows.hpp"
#include "report/record_fields.hpp"
#include "report/schema_forms.hpp"

namespace facetmill::batch {

namespace {

using report::refer;

/// An asset of a batch with its outcome.
struct AssetOutcome {
    const Asset* asset;
    const Outcome* out;
};

std::vector<AssetOutcome> outcomes_of(const Summary& summary, const std::vector<std::size_t>& order) {
    std::vector<AssetOutcome> all;
    all.reserve(order.size());
    for (const std::size_t i : order) all.push_back({&summary.assets[i], &summary.outcomes[i]});
    return all;
}

/// A getter of a member of the outcome.
template <class T>
auto of_outcome(T Outcome::*member) {
    return [member](const AssetOutcome& one) -> const T& { return one.out->*member; };
}
std::string asset_name(const AssetOutcome& one) { return one.asset->name; }

constexpr const char* not_measured = "the model was not measured, or has no such value";

void declare_column(DeclareFields<AssetOutcome>& d, const Column& column) {
    const auto count = [&column](const AssetOutcome& one) -> std::optional<std::uint64_t> {
        const auto value = column.value(one.out->figures);
        return value ? std::optional(static_cast<std::uint64_t>(*value)) : std::nullopt;
    };
    if (!column.of_model) {
        d.field(
            column.key, [count](const AssetOutcome& one) { return count(one).value_or(0); }, column.help);
    } else if (column.is_count) {
        d.field(column.key, count, column.help).null_when(not_measured);
    } else {
        d.field(
             column.key, [&column](const AssetOutcome& one) { return column.value(one.out->figures); },
             column.help)
            .null_when(not_measured);
    }
}

void declare_asset(DeclareFields<AssetOutcome>& d) {
    using Verdict = Outcome::Verdict;
    std::vector<NamedChoice<Verdict>> verdicts;
    for (const Verdict v : {Verdict::ok, Verdict::failed, Verdict::interrupted, Verdict::not_run})
        verdicts.push_back({verdict_word(v), v, ""});
    d.field("asset", asset_name, "The input, or the name of the row in the table.");
    d.field(
         "path",
         [](const AssetOutcome& one) {
             const std::string path =
                 one.asset->of_archive ? one.asset->name : one.asset->input.generic_string();
             return path.empty() ? std::nullopt : std::optional(path);
         },
         "The input file; in an archive, after the name of the archive.")
        .null_when("the row of the table has no input");
    d.choice("verdict", of_outcome(&Outcome::verdict), verdicts, "");
    d.field("exit_code", of_outcome(&Outcome::exit_code), "");
    d.field(
         "error",
         [](const AssetOutcome& one) {
             return one.out->errors.empty() ? std::nullopt : std::optional(one.out->errors.front().id);
         },
         "The id of the first error.")
        .null_when("the asset has no errors");
    d.field(
         "customer",
         [](const AssetOutcome& one) {
             return one.out->customer.empty() ? std::nullopt : std::optional(one.out->customer);
         },
         "Why the model was rejected, in plain words for its owner.")
        .null_when("the model was not rejected");
    for (const Column& column : columns()) declare_column(d, column);
    d.field(
         "unit",
         [](const AssetOutcome& one) {
             const ModelRow& model = one.out->figures.model;
             return model.measured() ? std::optional(model.unit) : std::nullopt;
         },
         "The unit of lengths, areas and volumes, or unknown.")
        .null_when(not_measured);
    d.field("outputs", of_outcome(&Outcome::outputs), "The written files, relative to the output folder.");
    d.list("files", of_outcome(&Outcome::files), "The written files with their sizes.",
           [](DeclareFields<OutcomeFile>& f) {
               f.field("path", &OutcomeFile::path, "");
               f.field("bytes", &OutcomeFile::bytes, "");
               f.field("faces", &OutcomeFile::faces, "").null_when("the file is not a mesh");
               f.field("draw_calls", &OutcomeFile::draw_calls, "")
                   .null_when("the file is not a glTF file, or no page was made");
               f.field("pixels", &OutcomeFile::pixels, "The pixels of its images.")
                   .null_when("the file has no images, or no page was made");
           });
    d.field("deviation", of_outcome(&Outcome::deviation),
            "The largest deviation that stages report, in percent of the diagonal.")
        .null_when("no stage measured a deviation");
    d.field("reports", of_outcome(&Outcome::reports),
            "The asset's own reports, relative to the output folder.");
    refer(d.list("errors", of_outcome(&Outcome::errors), "The errors of the asset.",
                 report::declare_diagnostic<Diagnostic>),
          "diagnostic");
    // Without marks, which are unknown for skipped assets.
    d.list("warnings", of_outcome(&Outcome::warnings), "The warnings of the asset.",
           [](DeclareFields<Diagnostic>& w) {
               w.field("id", &Diagnostic::id, "");
               w.field("message", &Diagnostic::message, "");
           });
}

void declare_counts(DeclareFields<Summary>& d) {
    using Verdict = Outcome::Verdict;
    const auto with = [](Verdict verdict) {
        return [verdict](const Summary& summary) { return count(summary, verdict); };
    };
    d.field(
        "assets", [](const Summary& summary) { return summary.assets.size(); }, "");
    d.field("ok", with(Verdict::ok), "");
    d.field("failed", with(Verdict::failed), "");
    d.field("interrupted", with(Verdict::interrupted), "");
    d.field("not_run", with(Verdict::not_run), "");
}

bool is_passed(const Summary& summary) {
    return summary.exit_code == 0 && count(summary, Outcome::Verdict::ok) == summary.assets.size();
}

void declare_cause(DeclareFields<Cause>& d) {
    d.choice("severity", &Cause::severity,
             std::vector<NamedChoice<Severity>>{{"error", Severity::error, ""},
                                                {"warning", Severity::warning, ""},
                                                {"note", Severity::note, ""}},
             "");
    d.field("id", &Cause::id, "");
    d.field("about", &Cause::about, "The property of a check, or the warning that --strict made an error.");
    d.field("assets", &Cause::assets, "The number of assets.");
    d.field("messages", &Cause::messages, "The number of messages.");
    d.field("first_asset", &Cause::first_asset, "The first asset in the order of the inputs.");
    d.field("first_message", &Cause::first_message, "Its message.");
}

const Fields& asset_fields() {
    static const Fields fields = fields_of<AssetOutcome>(declare_asset);
    return fields;
}

const Fields& summary_fields() {
    static const Fields fields = fields_of<Summary>([](DeclareFields<Summary>& d) {
        report::declare_format(d);
        report::declare_tool(d);
        d.field("pipeline", &Summary::pipeline, "");
        d.field("passed", is_passed, "Whether all assets are ok and the batch has no errors.");
        d.field("exit_code", &Summary::exit_code, "The most severe exit code of all assets.");
        d.object(
            "counts", [](const Summary& summary) -> const Summary& { return summary; }, "", declare_counts);
        refer(d.list("errors", &Summary::errors, "The errors of the batch itself.",
                     report::declare_diagnostic<Diagnostic>),
              "diagnostic");
        d.list(
            "causes", [](const Summary& summary) { return causes_of(summary); },
            "The errors and warnings by cause: errors first, then by the number of assets.", declare_cause);
        d.list(
             "assets",
             [](const Summary& summary) {
                 return summary.by_cause ? std::nullopt
                                         : std::optional(outcomes_of(summary, worst_first(summary)));
             },
             "The assets, the most severe failures first.", declare_asset)
            .only_when("--summary by-id is not given");
    });
    return fields;
}

} // namespace

void write_rows(const std::string& path, const Summary& summary,
                const std::function<void(std::string_view)>& put) {
    const io::RowFormat format = io::row_format(path);
    for (std::size_t i = 0; i < summary.assets.size(); ++i) {
        const AssetOutcome one{&summary.assets[i], &summary.outcomes[i]};
        const Json row = io::flat_row(asset_fields().json(&one));
        if (i == 0) put(io::row_heading(row, format));
        put(io::row_line(row, format));
    }
}

Json to_json(const Summary& summary) { return summary_fields().json(&summary); }

Json summary_schema() {
    Json out = summary_fields().schema();
    out["$schema"] = report::schema_dialect;
    out["title"] = "facetmill batch";
    out["$defs"] = {{"diagnostic", report::diagnostic_fields().schema()}};
    return out;
}

} // namespace facetmill::batch
