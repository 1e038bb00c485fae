#include "cli/arguments.hpp"

#include "base/error.hpp"
#include "base/math/numbers.hpp"
#include "base/text/spelling.hpp"
#include "base/text/words.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

namespace facetmill::cli {

namespace {

/// CLI11's formatter, whose usage line shows only the declared arguments.
class Help : public CLI::Formatter {
  public:
    explicit Help(std::string the_rest) : the_rest_(std::move(the_rest)) {}

    std::string make_usage(const CLI::App* app, std::string name) const override {
        std::string line = CLI::Formatter::make_usage(app, std::move(name));
        if (!the_rest_.empty()) line.insert(line.find_last_not_of('\n') + 1, " " + the_rest_);
        return line;
    }

  private:
    std::string the_rest_;
};

/// The error for a negative number, or empty.
std::string negative(const std::string& text) {
    const auto number = parse_real(text);
    if (number && *number >= 0) return {};
    return fmt::format("expected a number of 0 or more, found '{}'", text);
}

/// Refuses a text that is not a choice. CLI11's own check has different messages.
CLI::Validator one_of(const Argument& a) {
    return CLI::Validator(
        [called = a.names, choices = a.choices](const std::string& text) -> std::string {
            if (std::find(choices.begin(), choices.end(), text) != choices.end()) return {};
            const std::string name = std::string(split_at_commas(called).back());
            throw NotAChoice(
                fmt::format("{} must be one of {}, found '{}'", name, fmt::join(choices, ", "), text), text,
                did_you_mean(text, choices));
        },
        fmt::format("{{{}}}", fmt::join(a.choices, ",")));
}

/// Checks each value between commas: it must be a choice, if the argument has choices.
CLI::Validator for_each_value(const Argument& a) {
    const CLI::Validator each = one_of(a);
    const bool any = a.choices.empty();
    return CLI::Validator(
        [=](const std::string& text) -> std::string {
            const auto values = split_at_commas(text);
            if (values.empty() || std::find(values.begin(), values.end(), "") != values.end())
                return fmt::format("expected a value before and after each comma, found '{}'", text);
            for (const auto value : values)
                if (!any) each(std::string(value));
            return {};
        },
        any ? "" : each.get_description());
}

/// Splits comma-separated words into values.
std::vector<std::string> separated(const std::vector<std::string>& words) {
    std::vector<std::string> values;
    for (const std::string& word : words)
        for (const auto value : split_at_commas(word)) values.emplace_back(value);
    return values;
}

CLI::Option* make(CLI::App& app, const Argument& a) {
    if (const auto* flag = std::get_if<bool*>(&a.target)) return app.add_flag(a.names, **flag, a.help);
    if (const auto* call = std::get_if<std::function<void(const std::string&)>>(&a.target))
        return app.add_option_function<std::string>(a.names, *call, a.help);
    if (const auto* list = std::get_if<std::vector<std::string>*>(&a.target)) {
        CLI::Option* option = app.add_option(a.names, **list, a.help);
        if (a.at_commas && !a.in_one_word) option->delimiter(','); // CLI11 drops empty values
        if (a.names.starts_with("-") && (!a.at_commas || a.in_one_word)) option->allow_extra_args(false);
        return option;
    }
    if (const auto* number = std::get_if<int*>(&a.target)) return app.add_option(a.names, **number, a.help);
    if (const auto* number = std::get_if<std::size_t*>(&a.target))
        return app.add_option(a.names, **number, a.help);
    if (const auto* number = std::get_if<double*>(&a.target))
        return app.add_option(a.names, **number, a.help);
    return app.add_option(a.names, *std::get<std::string*>(a.target), a.help);
}

void declare(CLI::App& app, const Argument& a) {
    CLI::Option* option = make(app, a);
    if (a.needed) option->required();
    if (!a.value.empty()) option->type_name(a.value);
    if (a.in_one_word)
        option->check(for_each_value(a));
    else if (!a.choices.empty())
        option->check(one_of(a));
    if (a.range) option->check(CLI::Range(a.range->first, a.range->second));
    if (a.at_least_0) option->check(negative);
    if (a.is_hidden)
        option->group("");
    else if (!a.heading.empty())
        option->group(a.heading);
}

/// The error for an option without its value, or empty.
std::string lacking_value(const Arguments& arguments, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const Argument* a = words[i].starts_with("-") ? arguments.find(words[i]) : nullptr;
        if (!a || a->is_flag() || (i + 1 < words.size() && !words[i + 1].starts_with("-"))) continue;
        return fmt::format("{} is followed by {}, found {}", words[i],
                           a->value.empty() ? "a value" : a->value,
                           i + 1 < words.size() ? "'" + words[i + 1] + "'" : "nothing");
    }
    return {};
}

} // namespace

Argument::Target written_file(const std::string& option, const std::string& ending, const std::string& id,
                              const std::string& example, std::function<void(const std::string&)> take) {
    return [=, take = std::move(take)](const std::string& path) {
        if (!path.ends_with(ending))
            throw Error(
                ErrorKind::usage, id,
                fmt::format("{} is followed by the {} file to write, found '{}'", option, ending, path),
                example);
        take(path);
    };
}

Argument& Arguments::add(std::string names, Argument::Target target, std::string help) {
    return all_.emplace_back(Argument{std::move(names), std::move(target), std::move(help)});
}

std::vector<std::string> Arguments::long_names() const {
    std::vector<std::string> names{"help"};
    for (const auto& a : all_)
        for (const auto name : split_at_commas(a.names))
            if (name.starts_with("--")) names.emplace_back(name.substr(2));
    return names;
}

const Argument* Arguments::find(const std::string& name) const {
    for (const auto& a : all_)
        for (const auto known : split_at_commas(a.names))
            if (known == name) return &a;
    return nullptr;
}

Parsed Arguments::parse(const std::string& command, const std::string& about, std::vector<std::string> words,
                        const std::string& the_rest) const {
    CLI::App app{about, command};
    app.formatter(std::make_shared<Help>(the_rest));
    app.allow_extras();
    app.set_help_flag("-h,--help", "Prints this help and exits.");
    for (const auto& a : all_) declare(app, a);
    std::vector<std::string> reversed(words.rbegin(), words.rend()); // CLI11 expects the reversed order
    try {
        app.parse(reversed);
    } catch (const CLI::CallForHelp&) {
        return {true, app.help("facetmill"), {}};
    } catch (const CLI::ArgumentMismatch& e) {
        const std::string lacks = lacking_value(*this, words);
        throw std::invalid_argument(lacks.empty() ? e.what() : lacks);
    } catch (const CLI::ParseError& e) {
        throw std::invalid_argument(e.what());
    }
    for (const auto& a : all_)
        if (a.in_one_word) {
            auto& list = *std::get<std::vector<std::string>*>(a.target);
            list = separated(list);
        }
    return {false, {}, app.remaining()};
}

void add_threads_option(Arguments& arguments, int& threads, const char* help) {
    arguments.add("-j,--threads", &threads, help).between(1, 4096);
}

} // namespace facetmill::cli
