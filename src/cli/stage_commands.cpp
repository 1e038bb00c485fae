#include "cli/stage_commands.hpp"

#include "base/text/markup.hpp"
#include "io/codec.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>

namespace facetmill::cli {

namespace {

/// Separates files from the stage's own arguments.
class StageWords {
  public:
    explicit StageWords(const StageInfo& stage) : stage_(stage) {}

    void read(const std::vector<std::string>& words) {
        for (std::size_t i = 1; i < words.size(); ++i) {
            const std::string& word = words[i];
            const bool more = i + 1 < words.size();
            if (word == "-o" || word == "--output" || word == "--out") {
                if (more) out_ = words[++i];
            } else if (word == "-h" || word == "--help" || word == "--") {
                continue;
            } else if (more && word.starts_with("--") && means_report(word.substr(2))) {
                own_ += " --report " + for_shell(words[++i]);
            } else if (word.starts_with("--")) {
                const Option* option = add_option(word);
                const bool alone =
                    !option || option->kind == OptionKind::boolean || word.find('=') != word.npos;
                if (!alone && more && !words[i + 1].starts_with("--")) taken_ += " " + for_shell(words[++i]);
            } else if (is_mesh(word) && !takes_file())
                meshes_.push_back(word);
            else
                taken_ += (names_result(stage_, word) ? " --path " : " ") + for_shell(word);
        }
        // Without -o, the last file is the output, if the input does not need it. A stage that loads needs
        // no input.
        const std::size_t to_load = stage_.loads ? 0 : 1;
        if (out_.empty() && !stage_.tells && !stage_.checks && meshes_.size() > to_load) {
            out_ = meshes_.back();
            meshes_.pop_back();
        }
    }

    std::string line() const {
        std::string text = "facetmill pipe" + own_;
        if (!stage_.loads) {
            text += meshes_.empty() ? " load IN" : " load";
            for (const std::string& mesh : meshes_) text += " " + for_shell(mesh);
            text += " !";
        }
        text += fmt::format(" {}{}", stage_.name, taken_.empty() ? " ..." : taken_);
        if (!out_.empty() || (!stage_.checks && !stage_.tells))
            text += fmt::format(" ! write {}", out_.empty() ? "OUT" : for_shell(out_));
        return text;
    }

  private:
    /// Adds the option under its name in the stage; null if it does not exist.
    const Option* add_option(const std::string& word) {
        const auto end = std::min(word.find('='), word.size());
        std::string name = word.substr(2, end - 2);
        const auto called = options_of_same_value(name, stage_.options->known_names());
        if (!stage_.options->find(name) && !called.empty()) name = called.front();
        taken_ += " " + for_shell("--" + name + word.substr(end));
        return stage_.options->find(name);
    }

    /// Whether the next file is a value of the stage itself: a file that it loads, or that it writes after a
    /// mesh is loaded.
    bool takes_file() const {
        const Option* primary = stage_.options->primary();
        return (stage_.loads || !meshes_.empty()) && primary && primary->one == OptionKind::path;
    }

    static bool is_mesh(const std::string& word) {
        std::error_code ignored;
        return !word.starts_with('-') &&
               (io::codec_for(word) || std::filesystem::is_regular_file(word, ignored));
    }

    const StageInfo& stage_;
    std::vector<std::string> meshes_; ///< to load
    std::string out_, taken_, own_;   ///< own_: options of pipe itself
};

} // namespace

bool names_result(const StageInfo& stage, const std::string& word) {
    const Option* path = stage.options->find("path");
    const std::string suffix = std::filesystem::path(word).extension().generic_string();
    return path && !path->primary && suffix.size() > 1 &&
           std::all_of(suffix.begin() + 1, suffix.end(), [](unsigned char c) { return std::isalpha(c); });
}

std::string as_pipe(std::string_view stage, const std::vector<std::string>& words) {
    StageWords read(*stage_named(stage));
    read.read(words);
    return fmt::format("{}; facetmill {} --help lists its options", read.line(), stage);
}

} // namespace facetmill::cli
