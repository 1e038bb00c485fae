// Finds the assets of a batch.

#include "base/text/glob.hpp"
#include "base/text/words.hpp"
#include "batch/archives.hpp"
#include "batch/table.hpp"
#include "io/bytes.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace facetmill::batch {

namespace fs = std::filesystem;

namespace {

constexpr const char* input_param = "input";

/// The folder part of a pattern before its first wildcard; for a file, its folder.
fs::path fixed_prefix(const fs::path& pattern) {
    fs::path prefix;
    for (const auto& component : pattern.parent_path()) {
        if (is_glob(component.generic_string())) break;
        prefix /= component;
    }
    return prefix;
}

/// For a pattern without matches.
std::string hint_for_pattern(const std::string& pattern, const fs::path& fixed) {
    std::error_code unknown;
    if (!fixed.empty() && !fs::is_directory(fixed, unknown))
        return fmt::format("there is no folder '{}'", fixed.generic_string());
    if (pattern.find("**") != pattern.npos) return {};
    const fs::path below = fixed / "**" / fs::path(pattern).lexically_relative(fixed.empty() ? "." : fixed);
    return fmt::format("--input '{}' also searches the folders below", below.generic_string());
}

bool holds_something(const fs::path& folder) {
    std::error_code error;
    return fs::directory_iterator(folder, error) != fs::directory_iterator() && !error;
}

/// The folder of the input relative to the base; empty outside it.
fs::path mirrored(const fs::path& input, const fs::path& base) {
    const auto whole = [](const fs::path& folder) {
        return (folder.empty() ? fs::current_path() : fs::absolute(folder)).lexically_normal();
    };
    const fs::path near = whole(input.parent_path() / ".").lexically_relative(whole(base / "."));
    if (near.empty() || near == "." || *near.begin() == "..") return {};
    return near.has_filename() ? near : near.parent_path(); // no slash at its end
}

class AssetFinder {
  public:
    explicit AssetFinder(const Sources& sources) : sources_(sources) {}

    std::vector<Asset> find() {
        for (const auto& pattern : sources_.patterns) add_pattern(pattern);
        for (const auto& list : sources_.lists) add_list(list);
        for (const auto& archive : sources_.archives) add_archive(archive);
        if (!sources_.table.empty()) add_table();
        if (!missing_.empty()) throw Error(ErrorKind::missing, std::move(missing_));
        return std::move(assets_);
    }

  private:
    void add_pattern(const std::string& pattern) {
        std::error_code ignored;
        const bool is_file = fs::exists(pattern, ignored); // a name may look like a pattern
        const fs::path base = sources_.base.empty()
                                  ? (is_file ? fs::path(pattern).parent_path() : fixed_prefix(pattern))
                                  : fs::path(sources_.base);
        auto files = expand_glob(pattern);
        if (!is_file && !is_glob(pattern)) files.clear();
        if (files.empty()) add_nothing(pattern);
        for (const auto& file : files) add_file(file, base);
    }

    /// A pattern without matches is allowed if earlier assets must be pruned. If the folder itself is
    /// unreadable (its disk is missing), that is no reason to prune.
    void add_nothing(const std::string& pattern) {
        const fs::path fixed = fixed_prefix(pattern);
        const fs::path folder = fixed.empty() ? fs::path(".") : fixed;
        std::string hint = is_glob(pattern) ? hint_for_pattern(pattern, fixed) : "";
        if (was_there(pattern)) {
            if (holds_something(folder)) return;
            hint =
                fmt::format("nothing is pruned while '{}' is missing or empty; mount its disk if it has one",
                            folder.generic_string());
        }
        missing_.push_back({Severity::error, "E-FILE", fmt::format("no file matches '{}'", pattern),
                            sources_.place(pattern), std::move(hint)});
    }

    /// True if an earlier batch found an asset with this pattern.
    bool was_there(const std::string& pattern) const {
        return sources_.former &&
               std::any_of(sources_.former->begin(), sources_.former->end(),
                           [&](const std::string& name) { return glob_matches_path(pattern, name); });
    }

    void add_file(const fs::path& file, const fs::path& base) {
        if (!seen_.insert(fs::absolute(file).lexically_normal()).second) return;
        assets_.push_back({file.generic_string(),
                           file,
                           mirrored(file, base),
                           false,
                           false,
                           {{input_param, file.generic_string()}},
                           {},
                           {}});
    }

    void add_archive(const std::string& archive) {
        const fs::path folder = unpack_folder(sources_.output_dir, archive);
        const auto meshes = unpack_archive(archive, folder);
        if (meshes.empty())
            missing_.push_back({Severity::error, "E-FILE", fmt::format("'{}' holds no meshes", archive),
                                sources_.place(archive), "facetmill formats lists the formats of meshes"});
        const std::string shown = archive == "-" ? "stdin" : archive;
        for (const auto& mesh : meshes) {
            add_file(folder / mesh, folder);
            assets_.back().name = fmt::format("{}/{}", shown, mesh);
            assets_.back().of_archive = true;
        }
    }

    /// Adds names, one per line, or terminated by NUL as `find -print0` writes them.
    void add_list(const std::string& list) {
        const auto input = io::Input::open(list);
        std::string_view text = io::as_text(input.bytes());
        const bool nul = text.find('\0') != text.npos;
        if (!nul) text = without_byte_order_mark(text);
        bool any = false;
        while (!text.empty()) {
            const auto end = std::min(text.find(nul ? '\0' : '\n'), text.size());
            std::string name(text.substr(0, end));
            if (!nul && name.ends_with('\r')) name.pop_back();
            if (!name.empty()) add_file(name, sources_.base);
            any = any || !name.empty();
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        if (!any)
            missing_.push_back({Severity::error, "E-FILE", fmt::format("'{}' lists no files", list),
                                sources_.place(list), "write one name per line, or end each name with NUL"});
    }

    void add_table() {
        const auto rows = read_params_table(sources_.table);
        std::map<std::string, int> uses;
        for (const auto& row : rows) ++uses[name_of(row)];
        for (std::size_t r = 0; r < rows.size(); ++r) {
            Asset asset;
            asset.name = name_of(rows[r]);
            if (uses[asset.name] > 1) asset.name += fmt::format(" (row {})", r + 1);
            asset.of_table = true;
            for (const auto& cell : rows[r]) {
                if (cell.param == input_param) asset.input = cell.text;
                asset.defines.emplace_back(cell.param, cell.text);
                asset.defined_at[cell.param] = cell.where;
                if (cell.list) asset.lists[cell.param] = *cell.list;
            }
            if (!asset.input.empty()) asset.folder = mirrored(asset.input, sources_.base);
            assets_.push_back(std::move(asset));
        }
    }

    /// The asset's input, otherwise its first cell.
    static std::string name_of(const Row& row) {
        for (const auto& cell : row)
            if (cell.param == input_param) return cell.text;
        return row.front().text;
    }

    const Sources& sources_;
    std::set<fs::path> seen_;
    std::vector<Asset> assets_;
    std::vector<Diagnostic> missing_;
};

} // namespace

std::vector<Asset> find_assets(const Sources& sources) { return AssetFinder(sources).find(); }

} // namespace facetmill::batch
