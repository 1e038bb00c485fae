// Reads the shapes of USDZ files that facetmill wrote, so that written files can be checked.

#include "base/math/numbers.hpp"
#include "io/gltf/document/nodes.hpp"
#include "io/text.hpp"
#include "io/threemf/zip.hpp"
#include "io/usd/usd.hpp"
#include "mesh/transform.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>

namespace facetmill::io::usd {

namespace {

constexpr std::size_t no_prim = SIZE_MAX;

/// A prim of the layer. Texts point into the layer.
struct Prim {
    std::string_view type, name, metadata;
    std::size_t parent = no_prim;
    bool is_class = false;
    std::map<std::string_view, std::string_view> values; ///< by the name of the property
};

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view last_word(std::string_view text) {
    const std::size_t blank = text.find_last_of(' ');
    return blank == text.npos ? text : text.substr(blank + 1);
}

/// Takes a text layer apart into its prims, parents before children.
class Parser {
  public:
    Parser(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

    std::vector<Prim> prims() {
        std::vector<Prim> all;
        std::size_t open = no_prim;
        at_ = text_.find('\n'); // after the line "#usda 1.0"
        skip_blanks();
        if (peek() == '(') (void)balanced();
        for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
            if (peek() == '}') {
                if (open == no_prim) fail("a brace closes nothing");
                ++at_;
                open = all[open].parent;
            } else if (starts("def ") || starts("class ")) {
                all.push_back(prim(open));
                open = all.size() - 1;
            } else {
                if (open == no_prim) fail("a property is outside of all prims");
                property(all[open]);
            }
        }
        if (open != no_prim) fail("it ends inside a prim");
        return all;
    }

  private:
    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ErrorKind::malformed, "E-USDZ",
                    fmt::format("the layer of '{}' cannot be read at byte {}: {}", name_, at_, why),
                    "facetmill reads only USDZ files that it wrote: export other files as glTF (.glb)",
                    file_mark(name_));
    }
    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    bool starts(std::string_view word) const { return text_.substr(at_).starts_with(word); }
    void skip_blanks() {
        while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    }

    /// The text up to and without the next character of the set.
    std::string_view until(std::string_view ends) {
        const std::size_t begin = at_;
        at_ = std::min(text_.find_first_of(ends, at_), text_.size());
        return text_.substr(begin, at_ - begin);
    }

    /// A text in quotes, brackets or other pairs, with them.
    std::string_view balanced() {
        const std::size_t begin = at_;
        std::size_t depth = 0;
        do {
            if (at_ >= text_.size()) fail("a bracket is not closed");
            const char c = text_[at_++];
            if (c == '"' || c == '@') {
                while (at_ < text_.size() && text_[at_] != c) at_ += text_[at_] == '\\' ? 2 : 1;
                ++at_;
            } else if (c == '(' || c == '[' || c == '{') {
                ++depth;
            } else if (c == ')' || c == ']' || c == '}') {
                if (depth == 0) fail("a bracket was not opened");
                --depth;
            }
        } while (depth > 0);
        if (at_ > text_.size()) fail("a text is not closed");
        return text_.substr(begin, at_ - begin);
    }

    Prim prim(std::size_t parent) {
        Prim one;
        one.parent = parent;
        one.is_class = starts("class ");
        one.type = last_word(without_blanks(until("\"\n")));
        if (peek() != '"') fail("a prim has no name");
        const std::string_view quoted = balanced();
        one.name = quoted.substr(1, quoted.size() - 2);
        skip_blanks();
        if (peek() == '(') one.metadata = balanced();
        skip_blanks();
        if (peek() != '{') fail("a prim has no contents");
        ++at_;
        return one;
    }

    void property(Prim& to) {
        const std::string_view declaration = without_blanks(until("=\n"));
        if (peek() != '=') return;
        ++at_;
        while (peek() == ' ') ++at_;
        const bool encloses = std::string_view("([{\"@").find(peek()) != std::string_view::npos;
        const std::string_view value = encloses ? balanced() : until("\n");
        to.values[last_word(declaration)] = value;
        while (peek() == ' ') ++at_;
        if (peek() == '(') (void)balanced();
    }

    std::string_view text_;
    std::string name_;
    std::size_t at_ = 0;
};

/// All numbers of a value.
std::vector<double> numbers(const Prim& prim, const char* property) {
    const auto found = prim.values.find(property);
    std::vector<double> all;
    if (found == prim.values.end()) return all;
    constexpr std::string_view between = "()[], \n";
    std::string_view text = found->second;
    while (true) {
        text.remove_prefix(std::min(text.find_first_not_of(between), text.size()));
        if (text.empty()) return all;
        const std::string_view one = text.substr(0, text.find_first_of(between));
        const auto value = parse_real(one);
        if (!value) return {};
        all.push_back(*value);
        text.remove_prefix(one.size());
    }
}

/// The indices of a value, each below the limit; none if one is not.
std::optional<std::vector<Index>> indices(const Prim& prim, const char* property, std::size_t limit) {
    std::vector<Index> all;
    for (const double x : numbers(prim, property)) {
        if (!(x >= 0 && x < static_cast<double>(limit))) return {};
        all.push_back(static_cast<Index>(x));
    }
    return all;
}

Transform local_transform(const Prim& prim) {
    constexpr std::size_t rows = 4;
    if (const auto m = numbers(prim, "xformOp:transform"); m.size() == rows * rows) {
        Transform t;
        for (std::size_t r = 0; r < 3; ++r)
            for (std::size_t c = 0; c < rows; ++c) t.m[r][c] = m[rows * c + r];
        return t;
    }
    const auto vector = [&](const char* name, double otherwise) {
        const auto v = numbers(prim, name);
        return v.size() == 3 ? Vec3{v[0], v[1], v[2]} : Vec3{otherwise, otherwise, otherwise};
    };
    const auto q = numbers(prim, "xformOp:orient");
    const std::array<double, 4> turn =
        q.size() == rows ? std::array<double, 4>{q[1], q[2], q[3], q[0]} : std::array<double, 4>{0, 0, 0, 1};
    return gltf::transform_of(vector("xformOp:translate", 0), turn, vector("xformOp:scale", 1));
}

class Reader {
  public:
    Reader(std::vector<Prim> prims, const std::string& name, std::size_t most)
        : prims_(std::move(prims)), name_(name), most_(most), worlds_(prims_.size()), hidden_(prims_.size()) {
        for (std::size_t i = 0; i < prims_.size(); ++i) {
            const std::size_t parent = prims_[i].parent;
            worlds_[i] = local_transform(prims_[i]);
            hidden_[i] = prims_[i].is_class;
            if (parent == no_prim) continue;
            worlds_[i] = worlds_[parent] * worlds_[i];
            hidden_[i] = hidden_[i] || hidden_[parent];
            if (prims_[parent].is_class) shared_.emplace(prims_[i].name, i);
            if (prims_[i].type == "Mesh") meshes_[parent].push_back(i);
        }
    }

    std::vector<Part> parts() {
        std::vector<Part> all;
        for (std::size_t i = 0; i < prims_.size(); ++i) {
            if (hidden_[i]) continue;
            const auto own = meshes_.find(i);
            if (own != meshes_.end()) add(own->second, i, i, all);
            if (const auto found = shared_.find(referred(prims_[i])); found != shared_.end())
                if (const auto of = meshes_.find(found->second); of != meshes_.end())
                    add(of->second, i, prims_[i].parent, all);
        }
        return all;
    }

  private:
    /// The name of the shared mesh that the prim refers to.
    static std::string_view referred(const Prim& prim) {
        const std::size_t arc = prim.metadata.find("references = <");
        if (arc == prim.metadata.npos) return {};
        std::string_view path = prim.metadata.substr(arc);
        path = path.substr(0, path.find('>'));
        return path.substr(path.find_last_of('/') + 1);
    }

    /// named: the prim with the name of the node.
    void add(const std::vector<std::size_t>& meshes, std::size_t at, std::size_t named,
             std::vector<Part>& all) {
        Part part;
        if (named != no_prim) part.name = prims_[named].name;
        part.transform = worlds_[at];
        for (const std::size_t mesh : meshes) append(part.mesh, mesh_of(prims_[mesh]));
        weld_exact(part.mesh);
        all.push_back(std::move(part));
    }

    Mesh mesh_of(const Prim& prim) {
        const auto refuse = [&](const char* why) {
            throw Error(ErrorKind::malformed, "E-USDZ",
                        fmt::format("the mesh '{}' of '{}' {}", prim.name, name_, why), "export it again",
                        file_mark(name_));
        };
        Mesh mesh;
        const auto points = numbers(prim, "points");
        used_ += points.size() / 3;
        if (used_ > most_) beyond_limit(name_, "too many vertices");
        mesh.positions.reserve(points.size() / 3);
        for (std::size_t i = 0; i + 2 < points.size(); i += 3)
            mesh.positions.push_back({points[i], points[i + 1], points[i + 2]});
        const auto corners = indices(prim, "faceVertexIndices", mesh.positions.size());
        if (!corners) refuse("has indices beyond its points");
        placed_ += corners->size();
        if (placed_ > most_placed) beyond_limit(name_, "its references repeat too many faces");
        const auto sizes = numbers(prim, "faceVertexCounts");
        if (std::any_of(sizes.begin(), sizes.end(), [](double size) { return size != 3; }) ||
            3 * sizes.size() != corners->size())
            refuse("has faces that are not triangles");
        mesh.corners = *corners;
        return mesh;
    }

    std::vector<Prim> prims_;
    const std::string& name_;
    static constexpr std::size_t most_placed = std::size_t{1} << 28; // corners: 1 GiB of indices
    std::size_t most_, used_ = 0, placed_ = 0;
    std::vector<Transform> worlds_;
    std::vector<bool> hidden_;
    std::map<std::size_t, std::vector<std::size_t>> meshes_; ///< by their parents
    std::map<std::string_view, std::size_t> shared_;
};

} // namespace

Scene read(const Input& input, const ReadSettings& settings, ReadLog& log) {
    threemf::Archive archive(input.bytes(), input.name());
    std::string path;
    for (const std::string& entry : archive.paths())
        if (entry.ends_with(".usda")) path = entry;
    const auto layer = path.empty() ? std::nullopt : archive.file("/" + path);
    if (!layer || !as_text(*layer).starts_with("#usda 1.0\n"))
        throw Error(ErrorKind::malformed, "E-USDZ", fmt::format("'{}' has no text layer", input.name()),
                    "facetmill reads only USDZ files that it wrote: export other files as glTF (.glb)",
                    file_mark(input.name()));
    Scene scene;
    scene.unit = settings.unit.value_or(Unit::m);
    scene.up = settings.up.value_or(UpAxis::y);
    scene.parts =
        Reader(Parser(as_text(*layer), input.name()).prims(), input.name(), settings.max_vertices).parts();
    log.warnings.push_back(
        {Severity::warning, "W-SKIPPED",
         fmt::format("'{}' is USDZ: materials, normals and texture coordinates are not read", input.name()),
         file_mark(input.name()), "load the file that it was made from"});
    return scene;
}

int sniff(Span bytes) {
    constexpr std::size_t name_at = 30, near = 300;
    const std::string_view begin = as_text(bytes.first(std::min(bytes.size(), near)));
    if (!begin.starts_with("PK\3\4") || begin.size() < name_at) return 0;
    for (const char* suffix : {".usda", ".usdc"})
        if (begin.find(suffix, name_at) != begin.npos) return 2;
    return 0;
}

} // namespace facetmill::io::usd
