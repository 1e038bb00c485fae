#include "pipeline/document.hpp"

#include "base/text/words.hpp"
#include "pipeline/yaml_faults.hpp"

#include <fmt/format.h>
#include <map>
#include <set>
#include <sstream>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

namespace facetmill::pipeline {

namespace {

constexpr std::size_t max_nodes = 100'000; ///< with all aliases expanded
constexpr std::size_t deepest = 64;

/// Stops parsing after a problem that makes the rest useless.
struct Stop {};

/// Stops parsing at an unquoted expression, bytes [begin, end) of the text: the rest is then parsed as if it
/// were quoted.
struct Unquoted {
    std::size_t begin, end;
    Diagnostic why;
};

struct Size {
    std::size_t nodes = 1, depth = 1;
};

Size size_of(const Value& value) {
    Size all;
    const auto add = [&](const Value& child) {
        const Size s = size_of(child);
        all.nodes += s.nodes;
        all.depth = std::max(all.depth, s.depth + 1);
    };
    for (const auto& item : value.items) add(item);
    for (const auto& entry : value.entries) add(entry.value);
    return all;
}

/// Builds our tree from yaml-cpp's events.
class Builder : public YAML::EventHandler {
  public:
    /// unknown: positions of texts that represent any value.
    Builder(const SourceIndex& source, std::size_t skipped, const std::set<std::size_t>& unknown,
            Problems& problems)
        : source_(source), skipped_(skipped), unknown_(unknown), problems_(problems) {}

    Value root;
    bool second_document = false; ///< set before the parser looks for a second document

    /// The state for error messages after a parser failure.
    ReadSoFar read_so_far() const {
        ReadSoFar read{quoted_, {}};
        if (!stack_.empty() && stack_.back().flow) read.open = stack_.back().value.mark;
        return read;
    }

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (!second_document) return;
        const std::string mesh = hint_for_no_pipeline(source_.name());
        problems_.add(source_.mark(offset(mark)), "E-YAML", "a second document begins here",
                      !mesh.empty() ? mesh
                                    : "one file holds one pipeline; remove the '---' or make two files");
        throw Stop{};
    }
    void OnDocumentEnd() override {}

    void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        Value value;
        const std::size_t at = content(mark);
        const char c = at < source_.text().size() ? source_.text()[at] : '\n';
        if (c == '~' || c == 'n' || c == 'N')
            value.mark = source_.mark(at, c == '~' ? 1 : 4);
        else if (!stack_.empty() && stack_.back().value.is_list())
            value.mark = empty_item_mark(source_, at);
        complete(std::move(value), anchor);
    }

    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  const std::string& text) override {
        const std::size_t at = content(mark);
        if (tag == "?") refuse_unquoted(at, text);
        if (tag != "?") note_quotes(at);
        Value value = Value::scalar(text, scalar_mark(source_, at, text, tag == "?"), tag != "?");
        if (tag != "?" && tag != "!") apply_tag(tag, value, mark);
        value.deferred = unknown_.contains(at);
        complete(std::move(value), anchor);
    }

    void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        const Mark where = alias_mark(source_, offset(mark));
        const auto found = anchors_.find(anchor);
        if (found == anchors_.end()) {
            problems_.add(where, "E-YAML", "an alias inside its own content");
            throw Stop{};
        }
        grow(found->second.size, where);
        Value copy = found->second.value;
        copy.anchor = copy.mark;
        copy.mark = where;
        add(std::move(copy));
    }

    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                         YAML::EmitterStyle::value style) override {
        open(Value::list({}, source_.mark(content(mark))), tag, mark, anchor, style);
    }
    void OnSequenceEnd() override { close(); }

    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                    YAML::EmitterStyle::value style) override {
        open(Value::map({}, source_.mark(content(mark))), tag, mark, anchor, style);
    }
    void OnMapEnd() override {
        for (const auto& merged : stack_.back().merges) merge(stack_.back(), merged);
        close();
    }

  private:
    struct Frame {
        Value value;
        YAML::anchor_t anchor = 0;
        bool flow = false;
        std::optional<Value> key;                 ///< in a map: key of the next value
        std::map<std::string, std::size_t> index; ///< in a map: index of the entry by key
        std::vector<Value> merges;                ///< in a map: values of <<
    };
    struct Anchored {
        Value value;
        Size size;
    };

    std::size_t offset(const YAML::Mark& mark) const {
        return static_cast<std::size_t>(std::max(0, mark.pos)) + skipped_;
    }

    /// The start of a node's content: yaml-cpp's mark is at its anchor or tag.
    std::size_t content(const YAML::Mark& mark) const { return content_at(source_.text(), offset(mark)); }

    /// YAML reads `${x}` in braces or brackets as "$" and a map; replaces its error by a clear message.
    void refuse_unquoted(std::size_t at, const std::string& text) {
        const bool in_flow = !stack_.empty() && stack_.back().flow;
        const auto end = in_flow ? end_of_unquoted(source_.text(), at, text) : std::nullopt;
        if (!end) return;
        const std::string written = source_.text().substr(at, *end - at);
        throw Unquoted{at,
                       *end,
                       {Severity::error, "E-UNQUOTED",
                        fmt::format("inside {{}} and [] an expression must be quoted, found {}", written),
                        source_.mark(at, source_.characters(at, *end)),
                        fmt::format("write \"{}\"", written)}};
    }

    /// Without a closing quote, the parser reads to the end of the file, across all following stages.
    void note_quotes(std::size_t at) {
        if (at >= source_.text().size() || (source_.text()[at] != '"' && source_.text()[at] != '\'')) return;
        const auto end = end_of_quoted(source_.text(), at);
        if (end) {
            quoted_ = {at, *end};
            return;
        }
        problems_.add(source_.mark(at), "E-YAML", "the quote is never closed",
                      "close the quote on the same line");
        throw Stop{};
    }

    /// mark: the node's mark, which starts with the tag.
    void apply_tag(const std::string& tag, Value& value, const YAML::Mark& mark) {
        constexpr std::string_view core = "tag:yaml.org,2002:";
        const std::string_view name = tag.starts_with(core) ? std::string_view(tag).substr(core.size()) : "";
        if (name == "str" && value.is_scalar())
            value.quoted = true;
        else if ((name == "int" || name == "float" || name == "bool") && value.is_scalar())
            value.quoted = false;
        else if (name == "null" && value.is_scalar()) {
            value.kind = Value::Kind::null;
            value.text.clear();
        } else if (!((name == "seq" && value.is_list()) || (name == "map" && value.is_map())))
            refuse_tag(name.empty() ? tag : fmt::format("!!{}", name), mark);
    }

    void refuse_tag(const std::string& tag, const YAML::Mark& mark) {
        const std::string& text = source_.text();
        std::size_t at = offset(mark); // an anchor may precede it
        while (at < text.size() && text[at] == '&')
            at = std::min(text.find_first_not_of(' ', text.find(' ', at)), text.size());
        problems_.add(source_.mark(at, source_.characters(at, std::min(at + tag.size(), text.size()))),
                      "E-YAML", fmt::format("the tag {} is not supported here", tag), tag_hint(tag));
    }

    /// Counts values before they are added.
    void grow(Size size, const Mark& where) {
        nodes_ += size.nodes;
        if (nodes_ > max_nodes || stack_.size() + size.depth > deepest) {
            problems_.add(
                where, "E-EXPANSION",
                nodes_ > max_nodes
                    ? fmt::format("with all aliases expanded, the file has more than {} values", max_nodes)
                    : fmt::format("nested more than {} levels deep", deepest));
            throw Stop{};
        }
    }

    void open(Value value, const std::string& tag, const YAML::Mark& mark, YAML::anchor_t anchor,
              YAML::EmitterStyle::value style) {
        grow({}, value.mark);
        if (tag != "?" && tag != "!" && !tag.empty()) apply_tag(tag, value, mark);
        Frame frame;
        frame.value = std::move(value);
        frame.anchor = anchor;
        frame.flow = style == YAML::EmitterStyle::Flow || (!stack_.empty() && stack_.back().flow);
        stack_.push_back(std::move(frame));
    }

    void close() {
        Frame frame = std::move(stack_.back());
        stack_.pop_back();
        if (frame.anchor) anchors_[frame.anchor] = {frame.value, size_of(frame.value)};
        add(std::move(frame.value));
    }

    void complete(Value value, YAML::anchor_t anchor) {
        grow({}, value.mark);
        if (anchor) anchors_[anchor] = {value, {}};
        add(std::move(value));
    }

    /// Stores a finished value: as the root, an item, a key, or the value of a key.
    void add(Value value) {
        if (stack_.empty()) {
            root = std::move(value);
            return;
        }
        Frame& frame = stack_.back();
        if (frame.value.is_list()) {
            frame.value.items.push_back(std::move(value));
        } else if (!frame.key) {
            if (!value.is_scalar())
                problems_.add(value.mark.known() ? value.mark : frame.value.mark, "E-YAML",
                              fmt::format("a key must be a text, found {}", value.described()),
                              value.is_map() ? "the value of a param is written \"${name}\", not {{name}}"
                                             : "");
            frame.key = std::move(value);
        } else {
            Value key = std::move(*frame.key);
            frame.key.reset();
            if (!value.mark.known()) value.mark = key.mark;
            if (key.is_scalar()) add_entry(frame, std::move(key), std::move(value));
        }
    }

    void add_entry(Frame& frame, Value key, Value value) {
        if (key.text == "<<" && !key.quoted) {
            value.mark = key.mark;
            if (!frame.merges.empty())
                problems_.add(key.mark, "E-DUPLICATE", "the key '<<' occurs twice",
                              "several maps are merged by <<: [*a, *b]");
            frame.merges.push_back(std::move(value));
            return;
        }
        const auto [at, is_new] = frame.index.emplace(key.text, frame.value.entries.size());
        if (is_new) {
            frame.value.entries.push_back({std::move(key.text), key.mark, std::move(value)});
            return;
        }
        problems_.add(key.mark, "E-DUPLICATE", fmt::format("the key '{}' occurs twice", key.text),
                      fmt::format("the first is at {}", to_string(frame.value.entries[at->second].key_mark)));
    }

    /// YAML's merge key: the map's own keys win, then the earlier of several merged maps.
    void merge(Frame& frame, const Value& merged) {
        if (merged.is_list()) {
            for (const auto& one : merged.items) merge(frame, one);
            return;
        }
        if (!merged.is_map()) {
            problems_.add(merged.mark, "E-YAML",
                          fmt::format("'<<' merges a map or a list of maps, found {}", merged.described()),
                          "write it as <<: *name, with &name at the map to merge");
            return;
        }
        grow(size_of(merged), merged.mark);
        for (const auto& entry : merged.entries)
            if (frame.index.emplace(entry.key, frame.value.entries.size()).second)
                frame.value.entries.push_back(entry);
    }

    const SourceIndex& source_;
    std::size_t skipped_; ///< bytes of the text before yaml-cpp's part
    const std::set<std::size_t>& unknown_;
    Problems& problems_;
    std::vector<Frame> stack_;
    std::map<YAML::anchor_t, Anchored> anchors_;
    std::optional<Extent> quoted_; ///< the last quoted text
    std::size_t nodes_ = 0;
};

/// Parses the text: the source with placeholders for unknown texts. Throws Unquoted.
Value parse_text(const std::string& text, const SourceIndex& index, const std::set<std::size_t>& unknown,
                 Problems& problems) {
    const std::size_t mark_bytes = text.size() - without_byte_order_mark(text).size();
    std::istringstream stream(text.substr(mark_bytes));
    Builder builder(index, mark_bytes, unknown, problems);
    try {
        YAML::Parser parser(stream);
        parser.HandleNextDocument(builder);
        Value root = std::move(builder.root);
        builder.second_document = true;
        parser.HandleNextDocument(builder);
        if (!root.mark.known()) root.mark = index.mark(0);
        return root;
    } catch (const Stop&) {
    } catch (const YAML::Exception& e) {
        const std::size_t at =
            e.mark.is_null() ? 0 : static_cast<std::size_t>(std::max(0, e.mark.pos)) + mark_bytes;
        problems.add(Error(ErrorKind::usage, {yaml_fault(index, at, e.msg, builder.read_so_far())}));
    }
    return {};
}

} // namespace

Value parse_yaml(std::shared_ptr<const SourceText> source, Problems& problems) {
    const SourceIndex index(std::move(source));
    if (!check_text(index, problems)) return {};
    constexpr std::size_t max_unquoted = 100; // the rest is reported by the next run
    std::string text = index.text();
    std::set<std::size_t> unknown;
    std::vector<Diagnostic> found;
    Value root;
    for (bool whole = false; !whole && unknown.size() < max_unquoted;) {
        Problems of_this_parse;
        try {
            root = parse_text(text, index, unknown, of_this_parse);
            whole = true;
            found.insert(found.end(), of_this_parse.all().begin(), of_this_parse.all().end());
        } catch (const Unquoted& unquoted) {
            const std::size_t size = unquoted.end - unquoted.begin;
            text.replace(unquoted.begin, size, size, 'x');
            unknown.insert(unquoted.begin);
            found.push_back(unquoted.why);
        }
    }
    if (!found.empty()) problems.add(Error(ErrorKind::usage, std::move(found)));
    return root;
}

} // namespace facetmill::pipeline
