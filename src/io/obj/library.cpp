// The statements of .mtl files. Wavefront Technologies, "MTL material format", 1995. The statements of
// physically based materials (Pr, Pm, norm, map_RMA ...) follow Exocortex, "Extending the MTL format for
// PBR", 2016.

#include "base/hash.hpp"
#include "base/ordered_set.hpp"
#include "base/text/spelling.hpp"
#include "io/encoding.hpp"
#include "io/images/image_files.hpp"
#include "io/obj/materials.hpp"
#include "io/text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace facetmill::io::obj {

namespace fs = std::filesystem;

namespace {

void warn(ReadLog& log, const std::string& name, std::string message, std::string hint = {}) {
    log.warnings.push_back(
        {Severity::warning, "W-MTL", std::move(message), file_mark(name), std::move(hint)});
}

double fraction(double x) { return std::clamp(x, 0.0, 1.0); }

/// Reads at most `most` numbers, and nothing after them.
std::vector<double> take_numbers(Text& text, std::size_t most) {
    std::vector<double> numbers;
    while (numbers.size() < most) {
        Text ahead = text;
        const std::string_view word = ahead.word_on_line();
        const char* at = word.data();
        double number = 0;
        if (word.empty() || !scan_real(at, word.data() + word.size(), number) ||
            at != word.data() + word.size() || !std::isfinite(number))
            break;
        numbers.push_back(number);
        text = ahead;
    }
    return numbers;
}

/// The keyword of a texture statement without "map_", in lower case.
std::string map_key(std::string_view word) {
    const std::string key = lower_case(std::string(word.starts_with("map_") ? word.substr(4) : word));
    return key == "opacity" ? "d" : key;
}

bool is_map(std::string_view word) {
    static const std::set<std::string_view> others{"bump", "norm", "disp", "decal", "refl"};
    return word.starts_with("map_") || others.count(word) > 0;
}

class LibraryReader {
  public:
    /// folder: the library's folder, relative to the OBJ file.
    LibraryReader(const Input& library, fs::path folder, std::map<std::string, Description>& out)
        : all_(as_text(library.bytes())), text_(all_, library.name(), "E-MTL", '#'),
          folder_(std::move(folder)), out_(out) {}

    void read() {
        do {
            take_comment();
            statement(text_.word_on_line());
        } while (text_.next_line());
    }

  private:
    /// Reads facetmill's own statements from a comment, which other programs ignore.
    void take_comment() {
        std::string_view line = all_.substr(text_.offset());
        line = line.substr(0, line.find_first_of("\r\n"));
        if (!current_ || !line.starts_with('#')) return;
        line.remove_prefix(std::min(line.find_first_not_of(' ', 1), line.size()));
        if (line.starts_with(double_sided_comment)) current_->double_sided = true;
        if (!line.starts_with(name_comment)) return;
        line.remove_prefix(name_comment.size());
        current_->name = line.starts_with(' ') ? line.substr(1) : line; // other blanks belong to the name
    }

    void statement(std::string_view word) {
        if (word == "newmtl") {
            current_ = &out_[std::string(text_.rest_of_line())];
        } else if (!current_ || word.empty()) {
            return;
        } else if (word == "Kd") {
            colour(word, current_->diffuse);
        } else if (word == "Ks") {
            colour(word, current_->specular);
        } else if (word == "Ke") {
            colour(word, current_->emission);
        } else if (word == "d" || word == "Tr") {
            opacity(word == "Tr");
        } else if (word == "Ns") {
            number(current_->shininess);
        } else if (word == "Pr") {
            number(current_->roughness);
        } else if (word == "Pm") {
            number(current_->metalness);
        } else if (word == "illum") {
            if (const auto n = take_numbers(text_, 1); !n.empty())
                current_->illumination = static_cast<int>(std::clamp(n[0], 0.0, 10.0));
        } else if (is_map(word)) {
            map(word);
        } else if (word == "Ps" || word == "Pc" || word == "Pcr" || word == "aniso" || word == "anisor") {
            if (const auto n = take_numbers(text_, 1); !n.empty() && n[0] != 0)
                current_->left_out.emplace_back(word);
        }
    }

    /// A single number is grey. Other kinds of colours (spectral, xyz) are not read.
    void colour(std::string_view word, std::optional<Colour>& to) {
        const auto n = take_numbers(text_, 3);
        if (n.empty()) {
            current_->left_out.emplace_back(word);
            return;
        }
        to = Colour{n[0], n.size() > 1 ? n[1] : n[0], n.size() > 2 ? n[2] : n[0]};
        for (double& c : *to) c = std::max(c, 0.0);
    }

    void number(std::optional<double>& to) {
        if (const auto n = take_numbers(text_, 1); !n.empty()) to = n[0];
    }

    void opacity(bool inverted) {
        Text ahead = text_;
        if (ahead.word_on_line() == "-halo") return;
        const auto n = take_numbers(text_, 1);
        // MeshLab wrote Tr 1 for opaque materials, and no author wants an invisible material.
        if (inverted && !n.empty() && n[0] >= 1) return;
        if (!n.empty()) current_->opacity = inverted ? 1 - fraction(n[0]) : fraction(n[0]);
    }

    void map(std::string_view word) {
        Map map;
        while (true) {
            Text ahead = text_;
            const std::string_view option = ahead.word_on_line();
            if (!option.starts_with('-') || option.size() < 2) break;
            const Text before = text_;
            text_ = ahead;
            if (take_option(option, map)) continue;
            text_ = before;
            break;
        }
        map.file = text_.rest_of_line();
        if (map.file.size() > 1 && map.file.front() == '"' && map.file.back() == '"')
            map.file = map.file.substr(1, map.file.size() - 2);
        if (map.file.empty()) return;
        std::string path = map.file;
        std::replace(path.begin(), path.end(), '\\', '/');
        const auto relative = fs::path(path).has_root_path()
                                  ? std::nullopt
                                  : relative_path_of((folder_ / path).generic_string());
        if (relative) map.relative = *relative;
        current_->maps[map_key(word)] = std::move(map);
    }

    /// False if the word is not an option, and so starts a file name.
    bool take_option(std::string_view option, Map& map) {
        if (option == "-s" || option == "-o") {
            const auto n = take_numbers(text_, 3);
            auto& to = option == "-s" ? map.scale : map.offset;
            for (std::size_t i = 0; i < std::min<std::size_t>(n.size(), 2); ++i) to[i] = n[i];
        } else if (option == "-clamp") {
            map.clamp = text_.word_on_line() == "on";
        } else if (option == "-bm") {
            if (const auto n = take_numbers(text_, 1); !n.empty()) map.strength = n[0];
        } else if (option == "-mm") {
            const auto n = take_numbers(text_, 2);
            if (n != std::vector<double>{0, 1}) current_->left_out.emplace_back(option);
        } else if (option == "-t" || option == "-boost" || option == "-texres") {
            take_numbers(text_, option == "-t" ? 3 : 1);
            current_->left_out.emplace_back(option);
        } else if (option == "-blendu" || option == "-blendv" || option == "-cc" || option == "-type" ||
                   option == "-imfchan") {
            text_.word_on_line(); // filters and channels: glTF's defaults match the usual values
        } else {
            return false;
        }
        return true;
    }

    std::string_view all_;
    Text text_;
    fs::path folder_;
    std::map<std::string, Description>& out_;
    Description* current_ = nullptr;
};

} // namespace

std::vector<std::string> library_names(const Input& input, const std::string& text) {
    std::vector<std::string> names;
    const auto whole = input.path().empty() ? std::nullopt : relative_path_of(text);
    const auto file = whole ? path_below(input, *whole) : std::nullopt;
    std::error_code ignored;
    if (file && fs::exists(*file, ignored)) return {text};
    constexpr std::string_view suffix = ".mtl", blanks = " \t";
    const std::string lower = lower_case(text);
    std::size_t first = 0;
    for (std::size_t at = 0; (at = lower.find(suffix, at)) != std::string::npos;) {
        at += suffix.size();
        const std::size_t next = std::min(lower.find_first_not_of(blanks, at), lower.size());
        if (next == at && next < lower.size()) continue; // not the end of a name
        names.push_back(text.substr(first, at - first));
        first = at = next;
    }
    if (first < text.size()) names.push_back(text.substr(first));
    return names;
}

std::map<std::string, Description> read_libraries(const Input& input, const std::vector<Event>& events,
                                                  ReadLog& log) {
    OrderedSet<std::string> names;
    for (const auto& e : events)
        if (e.kind == Event::Kind::library)
            for (const std::string& name : library_names(input, e.text)) names.add(name);
    std::map<std::string, Description> all;
    for (const std::string& name : names.all()) {
        const auto path = input.path().empty() ? std::nullopt : relative_path_of(name);
        const auto file = path ? path_below(input, *path) : std::nullopt;
        if (!file) {
            log.unrepeatable |= path.has_value(); // a link may point elsewhere in the next run
            warn(log, input.name(),
                 fmt::format("the material file {} is not in the folder of the mesh and is not read",
                             in_quotes(name)),
                 hint_for_asset_root(input, path));
            continue;
        }
        try {
            const Input library = in_utf8(input.beside(*path));
            log.files.push_back({*file, library.stored().size(), sha256(library.stored())});
            LibraryReader(library, path->parent_path(), all).read();
            log.unrepeatable |= !library.is_as_opened();
        } catch (const Error& error) {
            std::error_code ignored;
            if (fs::exists(*file, ignored))
                log.unrepeatable = true; // the next run may be able to read the file
            else
                log.absent.push_back(*file);
            warn(
                log, input.name(),
                fmt::format("only the names of materials are kept: {}", error.diagnostics().front().message));
        }
    }
    return all;
}

} // namespace facetmill::io::obj
