#pragma once
// The words of a one-liner, read from left to right.

#include "cli/command.hpp"

namespace facetmill::cli {

/// A position in the words of a command line.
class PipeWords {
  public:
    /// The limit for brackets, and for dots in a key. A branch takes three of the 64 levels that a pipeline
    /// file may have.
    static constexpr int deepest = 20;

    PipeWords(const CommandLine& line, std::size_t first, Problems& problems)
        : line_(&line), at_(first), problems_(&problems) {}

    bool done() const { return at_ >= all().size(); }
    bool at_end_of_step() const;
    /// The current word. Valid as long as the command line.
    const std::string& word() const { return all()[at_]; }
    /// The word that is `back` words before the current one, or null.
    const std::string* before(std::size_t back) const;
    void next() { ++at_; }
    void previous() { --at_; }
    void skip_all() { at_ = all().size(); }
    const std::string& take() { return all()[at_++]; }

    /// The mark of the current word, or of the last one at the end.
    Mark mark() const { return mark_before(0); }
    Mark mark_before(std::size_t back) const;
    /// The mark of the current word from this byte on.
    Mark inside(std::size_t offset) const;
    Problems& problems() const { return *problems_; }
    /// Adds a problem of syntax (E-PIPE) at the current word.
    void wrong(std::string message, std::string hint = {}) const;

  private:
    const std::vector<std::string>& all() const { return line_->arguments(); }

    const CommandLine* line_;
    std::size_t at_;
    Problems* problems_;
};

[[nodiscard]] bool is_bracket(const std::string& word);
/// A word such as "--ratio". "--" alone is none.
[[nodiscard]] bool is_option(const std::string& word);
/// The name of a stage, or branch, foreach, include.
[[nodiscard]] bool is_step(const std::string& word);

} // namespace facetmill::cli
