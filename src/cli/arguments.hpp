#pragma once
// The declared arguments of a command. Only arguments.cpp includes the parser (CLI11), so that commands
// compile without it.

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace facetmill::cli {

/// A flag, an option with a value, or a positional argument, and the variable that it sets.
struct Argument {
    using Target = std::variant<bool*, int*, std::size_t*, double*, std::string*, std::vector<std::string>*,
                                std::function<void(const std::string&)>>;
    std::string names; ///< "-j,--threads"; "MESH" for a positional one
    Target target;
    std::string help;
    bool needed = false, is_hidden = false, at_commas = false, in_one_word = false;
    std::string heading{}; ///< in --help; empty: the default heading
    std::string value{};   ///< the name of its value in --help and messages: "FILE.png"; empty: by its type
    std::vector<std::string> choices{};
    std::vector<std::string> (*suggestions)() = nullptr; ///< for completions; other values are valid too
    std::optional<std::pair<int, int>> range{};
    bool at_least_0 = false;

    Argument& required() {
        needed = true;
        return *this;
    }
    Argument& hidden() {
        is_hidden = true;
        return *this;
    }
    Argument& under(std::string title) {
        heading = std::move(title);
        return *this;
    }
    Argument& followed_by(std::string what) {
        value = std::move(what);
        return *this;
    }
    Argument& one_of(std::vector<std::string> names) {
        choices = std::move(names);
        return *this;
    }
    Argument& suggests(std::vector<std::string> (*names)()) {
        suggestions = names;
        return *this;
    }
    Argument& between(int min, int max) {
        range = {min, max};
        return *this;
    }
    Argument& not_negative() {
        at_least_0 = true;
        return *this;
    }
    /// A list whose values are a single argument, so that the next argument is not part of it; values may
    /// not be empty.
    Argument& separated_by_commas_alone() {
        at_commas = in_one_word = true;
        return *this;
    }
    /// A list whose values may also be separated by commas.
    Argument& separated_by_commas() {
        at_commas = true;
        return *this;
    }
    bool is_flag() const { return std::holds_alternative<bool*>(target); }
};

/// A value that must name a file to write with this ending. An input after the option can thus not be taken
/// for the value and overwritten. The target throws a usage error (the id), which shows the example.
[[nodiscard]] Argument::Target written_file(const std::string& option, const std::string& ending,
                                            const std::string& id, const std::string& example,
                                            std::function<void(const std::string&)> take);

/// The result of parsing besides values.
struct Parsed {
    bool help_wanted = false;
    std::string help;                ///< the text of --help, if requested
    std::vector<std::string> extras; ///< words that belong to no argument
};

/// An invalid choice: what() gives the error with all choices.
struct NotAChoice : std::invalid_argument {
    NotAChoice(const std::string& why, std::string found, std::string meant)
        : std::invalid_argument(why), value(std::move(found)), hint(std::move(meant)) {}
    std::string value, hint; ///< the hint names the nearest choice; empty: none is similar
};

class Arguments {
  public:
    /// Declares an argument. Use the returned reference at once, because the next declaration may move the
    /// argument.
    Argument& add(std::string names, Argument::Target target, std::string help);
    /// In declaration order, including positional arguments.
    const std::vector<Argument>& all() const { return all_; }
    /// The long names of options, without their dashes.
    std::vector<std::string> long_names() const;
    /// The option of this name ("-j", "--threads"), or null.
    const Argument* find(const std::string& name) const;
    /// Reads words into the targets. the_rest: the text after the options in the usage line of --help.
    /// Throws std::invalid_argument with the reason for invalid words; NotAChoice for invalid choices.
    Parsed parse(const std::string& command, const std::string& about, std::vector<std::string> words,
                 const std::string& the_rest = {}) const;

  private:
    std::vector<Argument> all_;
};

/// -j,--threads, from 1 to 4096. help: the help text of this command.
void add_threads_option(Arguments& arguments, int& threads, const char* help);

} // namespace facetmill::cli
