// facetmill diff for two folders.

#include "batch/batch.hpp"
#include "cli/command_steps.hpp"
#include "cli/diff_files.hpp"
#include "diff/folders.hpp"
#include "io/codec.hpp"
#include "io/outputs/outputs.hpp"
#include "report/scene_picture.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

using report::FolderPair;

/// The index page; empty: none. The pages of pairs are in a folder next to it.
std::string index_of(const DiffOptions& options) {
    const auto found = std::find_if(options.reports.begin(), options.reports.end(),
                                    [](const std::string& path) { return path.ends_with(".html"); });
    return found == options.reports.end() ? std::string() : *found;
}

/// "sub/a.glb" -> "changes/sub/a.glb.html", relative to the folder of the index.
std::string page_of(const std::string& index, const std::string& path) {
    return (folder_of_pages(index).filename() / (path + ".html")).generic_string();
}

void tell_one_side(const std::filesystem::path& file, bool is_a, bool with_picture,
                   const io::ReadSettings& settings, FolderPair& pair) {
    io::ReadLog log;
    const io::Input input = io::Input::open(file);
    const Scene scene = io::read_scene(input, settings, log);
    (is_a ? pair.faces_a : pair.faces_b) = scene.face_count();
    (is_a ? pair.bytes_a : pair.bytes_b) = input.stored().size();
    if (with_picture) (is_a ? pair.picture_a : pair.picture_b) = report::small_picture(scene, pair.not_drawn);
}

class FolderDiff {
  public:
    FolderDiff(const DiffOptions& options, const CommandLine& line, const Console& console)
        : options_(options), line_(line), console_(console), index_(index_of(options)) {}

    FolderPair pair_of(const report::PairedPaths& paths) const {
        FolderPair pair;
        pair.paths = paths;
        const std::filesystem::path a = std::filesystem::path(options_.a) / paths.a,
                                    b = std::filesystem::path(options_.b) / paths.b;
        try {
            if (!paths.a.empty() && !paths.b.empty())
                compare(a.generic_string(), b.generic_string(), pair);
            else
                only_one(paths.a.empty() ? b : a, paths.b.empty(), pair);
        } catch (const Error& e) {
            if (e.kind() == ErrorKind::output || e.kind() == ErrorKind::usage) throw;
            console_.diagnostics(e);
            pair.outcome = FolderPair::Outcome::failed;
            pair.exit_code = static_cast<int>(e.kind());
            pair.verdict = e.what();
        }
        return pair;
    }

  private:
    void compare(const std::string& a, const std::string& b, FolderPair& pair) const {
        const ComparedFiles files = compared_files(options_, a, b, line_, console_);
        report::tell(files.comparison, pair);
        pair.exit_code = files.comparison.differs() ? static_cast<int>(ErrorKind::check) : 0;
        if (index_.empty()) return;
        pair.page = page_of(index_, pair.paths.path());
        const auto pictures = report::comparison_pictures(files.a, files.b, a, b);
        const auto text = report::to_html(files.comparison, a, b, pictures);
        io::write_now(std::filesystem::path(index_).parent_path() / pair.page,
                      std::as_bytes(std::span(text)));
        pair.picture_a = report::small_picture(files.a, pair.not_drawn);
        pair.picture_b = report::small_picture(files.b, pair.not_drawn);
        tell_not_drawn(pair.not_drawn, console_);
    }

    void only_one(const std::filesystem::path& file, bool in_a, FolderPair& pair) const {
        pair.outcome = in_a ? FolderPair::Outcome::removed : FolderPair::Outcome::added;
        pair.exit_code = static_cast<int>(ErrorKind::check);
        pair.verdict = in_a ? "only in the first folder" : "only in the second folder";
        tell_one_side(file, in_a, !index_.empty(), read_settings(options_.asset_roots), pair);
        tell_not_drawn(pair.not_drawn, console_);
    }

    const DiffOptions& options_;
    const CommandLine& line_;
    const Console& console_;
    std::string index_;
};

void write_folder_reports(const DiffOptions& options, const report::FolderComparison& all) {
    for (const auto& path : options.reports) {
        const std::string text = path.ends_with(".md") ? report::to_markdown(all, options.a, options.b)
                                                       : report::to_html(all, options.a, options.b);
        io::write_now(path, std::as_bytes(std::span(text)));
    }
}

} // namespace

std::filesystem::path folder_of_pages(const std::string& index) {
    return std::filesystem::path(index).replace_extension();
}

int diff_of_folders(const DiffOptions& options, const CommandLine& line, const Console& console) {
    const FolderDiff diff(options, line, console);
    report::FolderComparison all;
    int code = 0;
    const auto pairs = report::pairs_in(options.a, options.b);
    CommandSteps steps(console, pairs.size());
    for (const auto& paths : pairs) {
        steps.next(paths.path());
        all.pairs.push_back(diff.pair_of(paths));
        code = batch::worse_exit_code(code, all.pairs.back().exit_code);
    }
    steps.done();
    if (options.json)
        print(report::to_json(all, options.a, options.b).dump(2, ' ', false, Json::error_handler_t::replace) +
              "\n");
    else
        show(report::to_text(all, options.a, options.b, options.all));
    write_folder_reports(options, all);
    return code;
}

} // namespace facetmill::cli
