// Prepares a batch before it runs: plans, files, memory.

#include "base/hash.hpp"
#include "base/text/spelling.hpp"
#include "batch/batch.hpp"
#include "batch/journal.hpp"
#include "io/outputs/output_files.hpp"
#include "io/packing.hpp"
#include "pipeline/document.hpp"
#include "pipeline/rehearsal.hpp"
#include "platform/build_id.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fstream>

namespace facetmill::batch {

namespace fs = std::filesystem;

namespace {

std::string digest_of(const std::string& text) { return sha256(std::as_bytes(std::span(text))); }

/// The pipeline without comments and blanks.
std::string content_of(const std::string& text) {
    Problems ignored; // planning has reported them
    return pipeline::emit_yaml(
        pipeline::parse_yaml(std::make_shared<const SourceText>(SourceText{"", text}), ignored));
}

std::vector<std::string> asset_roots_in(const pipeline::Plan& plan) {
    std::vector<std::string> folders;
    for (const auto& folder : pipeline::asset_roots_of(plan.steps, plan.places))
        folders.push_back(folder.generic_string());
    return folders;
}

/// A digest of everything that a result depends on except the inputs' contents: this program, the pipeline,
/// and the resolved plan. The pipeline's text is included because values that depend on part names are not in
/// the plan.
std::string options_digest(const std::string& pipeline, const pipeline::Plan& plan,
                           const Settings& settings) {
    const Json all = {{"build", build_id()},
                      {"pipeline", pipeline},
                      {"plan", pipeline::describe_json(plan)},
                      {"allowed", plan.allowed},
                      {"asset_roots", asset_roots_in(plan)},
                      {"strict", settings.strict}};
    return digest_of(all.dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// True if the file is compressed, so that its contents are much larger.
bool is_packed(const fs::path& file) {
    const std::string extension = file.extension().generic_string();
    if (extension == ".drc" || io::packing_named(file) != io::Packing::none) return true;
    if (extension != ".glb" && extension != ".gltf") return false;
    std::string head(1 << 20, '\0'); // the document comes first
    std::ifstream stream(file, std::ios::binary);
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
    return head.find("KHR_draco_mesh_compression") != head.npos ||
           head.find("EXT_meshopt_compression") != head.npos;
}

/// Estimated memory per input byte: 70,000 faces in a binary PLY of 1.3 MB needed 48 MB in quickstart, which
/// quadruples the faces.
std::uint64_t memory_for(const std::vector<fs::path>& inputs) {
    constexpr std::uint64_t least = 16 << 20, per_byte = 48, per_packed_byte = 300;
    std::uint64_t bytes = least;
    for (const auto& input : inputs) {
        std::error_code error;
        const auto size = fs::file_size(input, error);
        if (!error) bytes += size * (is_packed(input) ? per_packed_byte : per_byte);
    }
    return bytes;
}

/// The files of all assets, compared without case.
class FileOwners {
  public:
    explicit FileOwners(Problems& problems) : problems_(problems) {}

    void add_other(const fs::path& path) {
        const auto [first, is_new] = owners_.try_emplace(key(path), Owner{"the batch itself", path, {}, {}});
        if (is_new || io::is_stream(path)) return;
        problems_.add({}, "E-DUPLICATE-OUTPUT",
                      fmt::format("the batch would write '{}' twice", path.generic_string()),
                      "give each report its own name");
    }

    /// beside: additional output files that an input refers to; assets in the same folder share them.
    void add(const Asset& asset, const std::vector<fs::path>& outputs, const std::vector<fs::path>& beside) {
        for (const auto& path : outputs) claim(asset, path, false);
        for (const auto& path : beside) claim(asset, path, true);
    }

    void check_input(const fs::path& input, const std::string& reader) {
        if (input != "-") return check_read(input, reader);
        problems_.add({}, "E-DUPLICATE-INPUT", "standard input cannot be read by each asset",
                      "give the file as a param, or by its path in the pipeline");
    }

    /// Adds a problem if an asset would write this input file.
    void check_read(const fs::path& path, const std::string& reader) {
        const auto owner = owners_.find(key(path));
        if (path == "-" || owner == owners_.end() || io::identity(owner->second.path) != io::identity(path))
            return;
        if (owner->second.beside) return; // a texture copied onto itself stays unchanged
        problems_.add(
            {}, "E-OVERWRITE",
            fmt::format("'{}' would overwrite an input of {}", owner->second.path.generic_string(), reader),
            "write elsewhere with --output-dir");
    }

  private:
    struct Owner {
        std::string name;
        fs::path path, input;
        std::optional<fs::path> beside; ///< the folder of the input that refers to it
    };

    static std::string key(const fs::path& path) { return lower_case(io::identity(path).generic_string()); }

    void claim(const Asset& asset, const fs::path& path, bool beside) {
        if (io::is_stream(path) && path != "/dev/null") return refuse_stream(asset, path);
        const Owner mine{asset.name, path, asset.input,
                         beside ? std::optional(asset.input.parent_path()) : std::optional<fs::path>()};
        const auto [first, is_new] = owners_.emplace(key(path), mine);
        if (is_new || first->second.name == asset.name || (beside && first->second.beside == mine.beside))
            return;
        const Owner& other = first->second;
        const bool same = other.path.lexically_normal() == path.lexically_normal();
        problems_.add({}, "E-DUPLICATE-OUTPUT",
                      same ? fmt::format("'{}' is written for {} and for {}", path.generic_string(),
                                         other.name, asset.name)
                           : fmt::format("'{}' for {} and '{}' for {} are the same file if case is ignored",
                                         other.path.generic_string(), other.name, path.generic_string(),
                                         asset.name),
                      hint_of(other.input, asset.input));
    }

    /// The parts of the input names that are missing in the output names.
    static std::string hint_of(const fs::path& one, const fs::path& other) {
        const auto lower = [](const fs::path& path) { return lower_case(path.generic_string()); };
        const bool are_two = !one.empty() && !other.empty() && one != other;
        if (are_two && lower(one) == lower(other))
            return "the input names differ only in case: rename or exclude one of them";
        if (are_two && one.filename() != other.filename() && lower(one.stem()) == lower(other.stem()))
            return "the input names differ only in the suffix: use write: \"${input.name}.glb\" to keep the "
                   "suffix; to exclude files that are not meshes, give the suffix in the pattern: --input "
                   "'scans/**/*.ply'";
        return "use a param that differs between assets in the output names: write: \"${input.stem}.glb\"; "
               "--base sets the folder "
               "that is mirrored";
    }

    void refuse_stream(const Asset& asset, const fs::path& path) {
        problems_.add(
            {}, "E-DUPLICATE-OUTPUT",
            fmt::format("'{}' cannot take the outputs of a batch ({})", path.generic_string(), asset.name),
            "write files");
    }

    Problems& problems_;
    std::map<std::string, Owner> owners_;
};

} // namespace

Prepared prepare(const std::vector<Asset>& assets, const Settings& settings, Problems& problems) {
    const std::string pipeline = content_of(settings.pipeline_text);
    Prepared out;
    Problems collisions;
    FileOwners owners(collisions);
    owners.add_other(Journal::path_in(settings.output_dir, settings.pipeline));
    for (const auto& path : settings.others) owners.add_other(path);
    for (const auto& asset : assets) {
        Problems of_asset;
        const auto plan = settings.plan(asset, of_asset);
        for (const auto& d : of_asset.all()) // the run reports warnings
            if (d.severity == Severity::error) problems.add(d.where, d.id, d.message, d.hint);
        if (of_asset.any_errors()) continue;
        out.allowed = plan.allowed; // equal in all plans
        const auto headers =
            settings.rehearse ? pipeline::rehearsed_headers(plan) : pipeline::read_headers(plan);
        owners.add(asset, pipeline::planned_outputs(plan), headers.more_outputs);
        if (auto missing = pipeline::missing_inputs(plan); !missing.empty()) {
            const auto inputs = pipeline::inputs_of_steps(plan);
            for (auto& d : missing) out.missing.push_back(pipeline::about_input(inputs, std::move(d)));
        }
        Work work{
            asset, pipeline::planned_inputs(plan, headers), pipeline::planned_outputs(plan, headers), {}, 0};
        work.digest = options_digest(pipeline, plan, settings);
        work.asset_roots = pipeline::asset_roots_of(plan.steps, plan.places);
        work.memory = memory_for(work.inputs);
        out.works.push_back(std::move(work));
    }
    for (const auto& work : out.works)
        for (const auto& input : work.inputs) owners.check_input(input, work.asset.name);
    for (const auto& asset : assets) // includes assets whose plans failed
        if (!asset.input.empty()) owners.check_read(asset.input, asset.name);
    for (const auto& path : settings.read) owners.check_read(path, "the batch itself");
    out.files_collide = collisions.any_errors();
    for (const auto& d : collisions.all()) problems.add(d.where, d.id, d.message, d.hint);
    return out;
}

} // namespace facetmill::batch
