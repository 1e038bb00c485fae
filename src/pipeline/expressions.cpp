#include "pipeline/expressions.hpp"

#include "base/text/spelling.hpp"
#include "io/packing.hpp"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace facetmill::pipeline {

namespace {

std::string hint_of_expression(std::string_view inside) {
    const std::size_t first = inside.find_first_not_of(' ');
    const std::string_view bare =
        first == std::string_view::npos ? "" : inside.substr(first, inside.find_last_not_of(' ') - first + 1);
    if (bare != inside && is_variable_name(bare.substr(0, bare.find('.'))))
        return fmt::format("write ${{{}}}, without blanks", bare);
    if (inside.find_first_of("+-*/()") != std::string_view::npos)
        return "an expression cannot calculate: give the result as another param";
    return "for a literal ${ write $${";
}

bool is_name_character(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

/// The expression at text[at] == "${": its contents, and the position after it.
struct Found {
    std::string_view inside;
    std::size_t end = 0;
};

class Resolver {
  public:
    Resolver(const Scope& scope, Problems& problems) : scope_(scope), problems_(problems) {}

    Value value(const Value& v) {
        if (v.is_scalar()) return scalar(v);
        Value out = v;
        for (auto& item : out.items) item = value(item);
        std::vector<Value::Entry> kept;
        for (auto& entry : out.entries) {
            Value inner = value(entry.value);
            if (inner.is_null() && !inner.deferred && !entry.value.is_null())
                continue; // an optional parameter without a value
            kept.push_back({std::move(entry.key), std::move(entry.key_mark), std::move(inner)});
        }
        out.entries = std::move(kept);
        return out;
    }

  private:
    Value scalar(const Value& v) {
        if (v.text.find("${") == std::string::npos) return v;
        if (v.text.starts_with("${")) {
            const auto found = expression(v, 0);
            if (!found) return deferred(v);
            if (found->end == v.text.size()) return exact(v, found->inside);
        }
        return mixed(v);
    }

    /// After a problem, the value fits any type, so that each mistake is reported once.
    static Value deferred(const Value& v) {
        Value out = v;
        out.deferred = true;
        return out;
    }

    std::optional<Found> expression(const Value& v, std::size_t at) {
        const std::size_t close = v.text.find('}', at);
        if (close != std::string::npos)
            return Found{std::string_view(v.text).substr(at + 2, close - at - 2), close + 1};
        problems_.add(mark_within(v.mark, std::string_view(v.text).substr(at)), "E-EXPRESSION",
                      "'${' is never closed by '}'", "for a literal ${ write $${");
        return {};
    }

    Value exact(const Value& v, std::string_view inside) {
        const auto found = evaluate(v, inside);
        if (!found) return deferred(v);
        Value out = *found;
        out.anchor = out.mark;
        out.mark = v.mark;
        return out;
    }

    Value mixed(const Value& v) {
        Value out = v;
        out.text.clear();
        out.quoted = false; // "${n}%" is a ratio when n is a number
        for (std::size_t at = 0; at < v.text.size();) {
            if (v.text.compare(at, 3, "$${") == 0) {
                out.text += "${";
                at += 3;
            } else if (v.text.compare(at, 2, "${") == 0) {
                const auto found = expression(v, at);
                if (!found) return deferred(v);
                append(v, found->inside, out);
                at = found->end;
            } else {
                out.text += v.text[at++];
            }
        }
        return out;
    }

    void append(const Value& v, std::string_view inside, Value& out) {
        const auto found = evaluate(v, inside);
        if (!found || found->deferred) {
            out.text += fmt::format("${{{}}}", inside); // as shown by plan
            out.deferred = true;
            return;
        }
        if (!found->is_scalar() && !found->is_null()) {
            fail(v, inside, "E-EXPRESSION",
                 fmt::format("'{}' is {}, which cannot be used inside a text", inside, found->described()));
            out.deferred = true;
            return;
        }
        const Variable* variable = find_variable(scope_, inside);
        out.text += variable && variable->from_file ? safe_name(found->text) : found->text;
    }

    std::optional<Value> evaluate(const Value& v, std::string_view inside) {
        const auto dot = inside.find('.');
        const std::string name(inside.substr(0, dot));
        const Variable* variable = find_variable(scope_, name);
        if (!is_variable_name(name)) {
            fail(v, inside, "E-EXPRESSION",
                 fmt::format("expected ${{name}} or ${{name.property}}, found ${{{}}}", inside),
                 hint_of_expression(inside));
            return {};
        }
        if (!variable) {
            std::vector<std::string> names;
            for (const auto& known : scope_) names.push_back(known.name);
            fail(v, inside, "E-VARIABLE", fmt::format("there is no variable '{}'", name),
                 names.empty() ? "declare it under params" : suggestion(name, names));
            return {};
        }
        return dot == std::string_view::npos ? variable->value
                                             : property(v, *variable, inside.substr(dot + 1), inside);
    }

    std::optional<Value> property(const Value& v, const Variable& variable, std::string_view name,
                                  std::string_view inside) {
        const auto text = [&](std::string t) { return Value::scalar(std::move(t), v.mark, true); };
        const std::string& path = variable.value.text;
        if (name == "index") {
            if (variable.index) return Value::scalar(std::to_string(*variable.index), v.mark);
            fail(v, inside, "E-EXPRESSION",
                 fmt::format("'{}' has no index: only the variables of a foreach have one", variable.name));
            return {};
        }
        const std::vector<std::string> properties = {"stem", "name", "dir", "ext", "index"};
        if (std::find(properties.begin(), properties.end(), name) == properties.end()) {
            fail(v, inside, "E-EXPRESSION", fmt::format("variables have no '.{}'", name),
                 suggestion(name, properties));
            return {};
        }
        if (variable.value.deferred) return variable.value;
        if (!variable.value.is_scalar()) {
            fail(
                v, inside, "E-EXPRESSION",
                fmt::format("'{}' is {}, which has no .{}", variable.name, variable.value.described(), name));
            return {};
        }
        const auto shown = [&](std::string t) {
            return text(variable.from_file ? safe_name(t) : std::move(t));
        };
        if (name == "stem") return shown(stem_of(path));
        if (name == "ext") {
            const std::string ext = extension_of(path);
            return text(variable.from_file && !ext.empty() ? "." + safe_name(ext.substr(1)) : ext);
        }
        if (name == "name") return shown(std::filesystem::path(path).filename().generic_string());
        const std::string dir = std::filesystem::path(path).parent_path().generic_string();
        return shown(dir.empty() ? "." : dir);
    }

    void fail(const Value& v, std::string_view inside, const char* id, std::string message,
              std::string hint = {}) {
        problems_.add(mark_within(v.mark, fmt::format("${{{}}}", inside)), id, std::move(message),
                      std::move(hint));
    }

    const Scope& scope_;
    Problems& problems_;
};

} // namespace

const Variable* find_variable(const Scope& scope, std::string_view name) {
    for (const auto& variable : scope)
        if (variable.name == name) return &variable;
    return nullptr;
}

bool is_variable_name(std::string_view text) {
    return !text.empty() && !(text[0] >= '0' && text[0] <= '9') && text[0] != '-' &&
           std::all_of(text.begin(), text.end(), is_name_character);
}

Value resolved(const Value& value, const Scope& scope, Problems& problems) {
    return Resolver(scope, problems).value(value);
}

bool is_name_from_file(const Value& value, const Scope& scope) {
    if (!value.is_scalar() || !value.text.starts_with("${") || !value.text.ends_with("}")) return false;
    const Variable* variable =
        find_variable(scope, std::string_view(value.text).substr(2, value.text.size() - 3));
    return variable && variable->from_file;
}

bool is_deferred(const Value& value) {
    if (value.deferred) return true;
    return std::any_of(value.items.begin(), value.items.end(), is_deferred) ||
           std::any_of(value.entries.begin(), value.entries.end(),
                       [](const auto& e) { return is_deferred(e.value); });
}

Mark mark_within(const Mark& mark, std::string_view piece, std::size_t from) {
    if (!mark.known() || mark.line == 0 || mark.column == 0) return mark;
    const std::string& text = mark.source->text;
    std::size_t at = 0;
    for (int line = 1; line < mark.line && at != std::string::npos; ++line) at = text.find('\n', at) + 1;
    const auto is_lead = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
    for (int column = 1; column < mark.column && at < text.size(); ++column) // columns count characters
        do ++at;
        while (at < text.size() && !is_lead(text[at]));
    const std::size_t found = text.find(piece, at + from);
    if (found == std::string::npos || text.substr(at, found - at).find('\n') != std::string::npos)
        return mark;
    Mark inner = mark;
    inner.column +=
        static_cast<int>(std::count_if(text.begin() + static_cast<std::ptrdiff_t>(at),
                                       text.begin() + static_cast<std::ptrdiff_t>(found), is_lead));
    inner.length = static_cast<int>(std::count_if(piece.begin(), piece.end(), is_lead));
    return inner;
}

namespace {
/// The file's name, and the length of its stem.
std::pair<std::string, std::size_t> split_name(const std::string& path) {
    const std::string name = path == "-" ? "stdin" : std::filesystem::path(path).filename().generic_string();
    std::string stem = io::without_packing(name).generic_string();
    if (const auto dot = stem.rfind('.'); dot != std::string_view::npos && dot > 0)
        stem = stem.substr(0, dot);
    return {name, stem.size()};
}
} // namespace

std::string stem_of(const std::string& path) {
    const auto [name, stem] = split_name(path);
    return name.substr(0, stem);
}

std::string extension_of(const std::string& path) {
    const auto [name, stem] = split_name(path);
    return name.substr(stem);
}

std::string safe_name(const std::string& name) {
    std::string out;
    for (const char c : name) {
        const bool safe = is_name_character(c) || c == '.' || static_cast<unsigned char>(c) >= 0x80;
        out += safe ? c : '_';
    }
    if (out.empty()) return "unnamed";
    if (out.front() == '.' || out.front() == '-') out.front() = '_';
    return out.substr(0, 200);
}

} // namespace facetmill::pipeline
