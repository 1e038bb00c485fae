#include "stages/bake/options.hpp"

#include "stage/options/synonyms.hpp"

namespace facetmill::bake_stage {

void declare_bake(Declare<BakeOptions>& d) {
    d.option("size", &BakeOptions::size, "The sides of the square textures, in pixels.")
        .also_called("resolution texture texture_size max_size")
        .between(4, 8192)
        .primary();
    d.option("from", &BakeOptions::from, "The mesh file to take values from. Default: the scene as loaded.")
        .also_called("source high high_poly selected_to_active")
        .also_called(with_synonyms);
    d.option("distance", &BakeOptions::distance,
             "How far rays reach to both sides of the surface. Default: a little more than the measured "
             "distance of the surfaces.")
        .also_called("cage cage_extrusion ray_distance max_ray_distance")
        .above(0);
    d.choice<Facing>("facing", &BakeOptions::facing,
                     {{"auto", Facing::automatic, "same if most faces of the source agree with the surface"},
                      {"same", Facing::same, "faces that look in the direction of the surface"},
                      {"any", Facing::any, "all faces, also from behind"}},
                     "The faces of the source that rays may hit.");
    d.option("samples", &BakeOptions::samples, "Samples along each side of a texel: 2 casts four rays.")
        .also_called("supersampling antialiasing")
        .between(1, 4);
    d.option("dilation", &BakeOptions::dilation, "Texels that the border of each chart grows.")
        .also_called("margin padding gutter bleed")
        .between(0, 256);
    d.option("occlusion_rays", &BakeOptions::occlusion_rays,
             "Rays to the sky for the occlusion of 4 x 4 texels. 0: occlusion only from textures.")
        .also_called("ao ao_samples ambient_occlusion")
        .between(0, 2048);
    d.option("occlusion_distance", &BakeOptions::occlusion_distance,
             "How far occluders are looked for. Default: unlimited.")
        .above(0);
    d.option("height", &BakeOptions::height,
             "The PNG file for heights along the normal: black is the lowest, white the highest.")
        .also_called("displacement");
    d.option("position", &BakeOptions::position,
             "The PNG file for positions: 0 to 1 along each side of the bounding box.");
    d.option("thickness", &BakeOptions::thickness,
             "The PNG file for the thickness of the source: white is the thickest.");
}

} // namespace facetmill::bake_stage
