#pragma once
// Files that fit tries: it runs the stages simplify, textures and write separately, on copies of the scene.

#include "diff/likeness.hpp"
#include "stages/fit/options.hpp"

namespace facetmill::fit_stage {

/// The size and quality of the images of a role. Side 0: the images are not changed.
struct ImageChoice {
    std::size_t side = 0;
    int quality = 0;
    bool operator==(const ImageChoice&) const = default;
};

struct Bits {
    int position = 16, normal = 12, uv = 14;
    bool operator==(const Bits&) const = default;
};

/// What fit decides.
struct Choice {
    double keep = 1; ///< ratio of triangles
    Bits bits;
    ImageChoice colours, normals; ///< other images follow the colours
    bool operator==(const Choice&) const = default;
};

/// A file in memory, as a reader gets it.
struct TrialFile {
    std::size_t bytes = 0; ///< with its neighbours
    Scene decoded;
};

/// Makes the scene and the file of a choice.
class Trials {
  public:
    /// The scene, the options and the context must outlive it.
    Trials(const Scene& scene, const FitOptions& o, Context& context)
        : scene_(scene), o_(o), context_(context) {}

    /// The scene with this ratio of triangles. changes: receives the changes of attributes.
    [[nodiscard]] Scene simplified(double keep, std::vector<report::PartChange>* changes = nullptr) const;
    /// The scene with smaller images.
    [[nodiscard]] Scene with_images(Scene scene, const ImageChoice& colours,
                                    const ImageChoice& normals) const;
    /// The decoded file of a scene. final_order: triangles in the order of the final file, which takes time.
    [[nodiscard]] TrialFile file(const Scene& scene, const Bits& bits, bool final_order) const;
    /// Writes the file for good, among the outputs of the run.
    void write(Scene scene, const Bits& bits) const;

  private:
    Value options_of_write(const std::string& path, const Bits& bits, bool final_order) const;

    const Scene& scene_;
    const FitOptions& o_;
    Context& context_;
};

/// The files that the stage write makes with these options.
[[nodiscard]] StageFiles files_of_fit(const FitOptions& o);

/// The longest sides of the images of a role that materials use, and the bytes of all images.
struct ImageSides {
    std::size_t colours = 0, normals = 0;
    std::size_t bytes = 0;
};
[[nodiscard]] ImageSides image_sides(const Scene& scene);

} // namespace facetmill::fit_stage
