#pragma once
// Commands of the command line: one file each, with an entry in commands().

#include "cli/arguments.hpp"
#include "cli/console.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace facetmill::cli {

/// The name of a CommandLine's text in messages.
inline constexpr const char* command_line_name = "command line";

/// The arguments as a text that messages can point into: "facetmill run a.yaml --ouput-dir out".
class CommandLine {
  public:
    explicit CommandLine(std::vector<std::string> arguments);
    const std::vector<std::string>& arguments() const { return arguments_; }
    Mark mark(std::size_t argument) const;
    /// The mark of the first argument that starts with this text, or of the whole line.
    Mark find(const std::string& start) const;
    /// The mark of an option's value, as a separate argument or after "=", or of the whole line.
    Mark value(const std::string& text) const;

  private:
    std::vector<std::string> arguments_;
    std::vector<Mark> marks_;
    Mark whole_;
};

/// The input of a command.
struct Invocation {
    const CommandLine& line;
    std::size_t rest =
        0; ///< for pipe and render: index of the first argument that is not an option of the command
};

struct Command {
    std::string name, about;
    std::string examples; ///< examples and further text for the end of --help
    /// The text after the options in the usage line of --help; options are then only read up to the first
    /// other word. Empty: options may be anywhere.
    std::string the_rest{};
    /// Declares the arguments. The returned function runs the command after parsing, and returns the exit
    /// code.
    std::function<std::function<int(const Invocation&)>(Arguments&, Console&)> declare;
    bool rest_is_stages = false; ///< pipe: its other arguments are stages
    const char* stage = nullptr; ///< the stage whose options the command also takes and --help lists; or null
};

/// All commands, in the order of --help.
const std::vector<Command>& commands();

[[nodiscard]] Command convert_command();
[[nodiscard]] Command view_command();
[[nodiscard]] Command fix_command();
[[nodiscard]] Command run_command();
[[nodiscard]] Command batch_command();
[[nodiscard]] Command export_command();
[[nodiscard]] Command plan_command();
[[nodiscard]] Command pipe_command();
[[nodiscard]] Command new_command();
[[nodiscard]] Command check_command();
[[nodiscard]] Command info_command();
[[nodiscard]] Command render_command();
[[nodiscard]] Command diff_command();
[[nodiscard]] Command stages_command();
[[nodiscard]] Command schema_command();
[[nodiscard]] Command formats_command();
[[nodiscard]] Command cache_command();
[[nodiscard]] Command explain_command();
[[nodiscard]] Command docs_command();
[[nodiscard]] Command completions_command();

/// Adds --quiet, -v and --log.
void add_message_options(Arguments& arguments, Console& console);

/// Runs the whole program and returns the exit code. Throws Error. Leaves quiet, colours and so on in
/// console for the caller.
[[nodiscard]] int program(std::vector<std::string> arguments, Console& console);

/// The version; with --json also the libraries, and the sandbox support of this system.
[[nodiscard]] std::string version_text(bool json);

} // namespace facetmill::cli
