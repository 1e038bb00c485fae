#pragma once
// A command of the command line: one file each, one entry in commands().

#include "cli/arguments.hpp"
#include "cli/console.hpp"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace facetmill::cli {

/// The name of the text that a CommandLine is.
inline constexpr const char* command_line_name = "command line";

/// The arguments as a text that messages can point into: "facetmill run a.yaml --ouput-dir out".
class CommandLine {
  public:
    explicit CommandLine(std::vector<std::string> arguments);
    const std::vector<std::string>& arguments() const { return arguments_; }
    Mark mark(std::size_t argument) const;
    /// The mark of the first argument that starts with this text, or of the line as a whole.
    Mark find(const std::string& start) const;
    /// The mark of this value of an option, an argument of its own or after "=", or of the line as a whole.
    Mark value(const std::string& text) const;

  private:
    std::vector<std::string> arguments_;
    std::vector<Mark> marks_;
    Mark whole_;
};

/// What a command's work gets.
struct Invocation {
    const CommandLine& line;
    std::size_t rest =
        0; ///< for pipe and render: index of the first argument that is not an option of the command
};

struct Command {
    std::string name, about;
    std::string examples; ///< worked examples and whatever else --help says at its end
    /// What stands behind the options, as the usage line of --help shows it: these are read only up to the
    /// first other word. Empty: options may stand anywhere.
    std::string the_rest{};
    /// Declares the arguments; what it returns is called after they are read, for the exit code.
    std::function<std::function<int(const Invocation&)>(Arguments&, Console&)> declare;
    bool rest_is_stages = false; ///< pipe: what it takes are stages
    const char* stage = nullptr; ///< whose options it takes, which --help then tells; or null
};

/// In the order of --help.
const std::vector<Command>& commands();

Command run_command();
Command batch_command();
Command export_command();
Command plan_command();
Command pipe_command();
Command new_command();
Command check_command();
Command info_command();
Command render_command();
Command diff_command();
Command stages_command();
Command schema_command();
Command formats_command();
Command cache_command();
Command explain_command();
Command docs_command();
Command completions_command();

/// --quiet, -v, --log.
void add_message_options(Arguments& arguments, Console& console);

/// The whole program. Throws Error; the exit code is returned. quiet, colours and so on are left in console
/// for whoever catches.
int program(std::vector<std::string> arguments, Console& console);

/// Version; with --json also the libraries, and what this system has for the sandbox.
std::string version_text(bool json);

} // namespace facetmill::cli
