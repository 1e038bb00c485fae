#pragma once
// Finds the best choice: it measures curves, predicts choices from them, and tries these as real files.

#include "stages/fit/model.hpp"

namespace facetmill::fit_stage {

/// A choice with its real file.
struct Candidate {
    Choice choice;
    std::size_t bytes = 0, triangles = 0;
    double error = 0; ///< mean squared difference
};

class Search {
  public:
    /// The scene, the options and the context must outlive it.
    Search(const Scene& scene, const FitOptions& o, Context& context);

    /// The best choice, or the choice nearest to the limits. It tries at most 120 files and pictures. other:
    /// a search with another compression, whose measured images are taken.
    [[nodiscard]] Candidate best(const Search* other = nullptr);

    const Trials& trials() const { return trials_; }
    const report::Likeness& original() const { return original_; }
    std::size_t trial_count() const { return tried_; }
    bool fits(const Candidate& c) const;
    /// Whether a is to be preferred. A candidate that fits is better than one that does not.
    [[nodiscard]] bool better(const Candidate& a, const Candidate& b) const;

  private:
    /// The finest choice for images of a role with this longest side.
    [[nodiscard]] ImageChoice largest(std::size_t longest) const;
    void measure_ratios();
    void measure_bits();
    void measure_images(bool of_normals);
    [[nodiscard]] std::vector<MeasuredBits> measured_bits(const std::vector<int>& ladder, int Bits::*member,
                                                          const Scene& scene, const report::Likeness& like);
    [[nodiscard]] Candidate tried(const Choice& choice);
    /// Tries up to this many new files.
    void try_choices(const Model& model, std::size_t rounds, std::optional<Candidate>& best);
    double aim_error() const { return o_.look ? o_.look->value * o_.look->value : 1; }

    const Scene& scene_;
    const FitOptions& o_;
    Trials trials_;
    report::Likeness original_;
    Curves curves_;
    std::vector<Candidate> known_;
    using Documents = std::vector<std::shared_ptr<const Document>>;
    Documents proxies_, last_images_; ///< the documents of the scene with other images
    ImageChoice last_colours_, last_normals_;
    std::size_t tried_ = 0;
    double correction_ = 1; ///< of the limit, because predictions err
};

} // namespace facetmill::fit_stage
