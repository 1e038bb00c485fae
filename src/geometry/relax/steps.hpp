#pragma once
// One simultaneous step of each method of relax.

#include "geometry/relax/relax.hpp"

#include <functional>

namespace facetmill {

/// Computes all new positions from all old ones; from and to must differ.
using RelaxStep = std::function<void(const std::vector<Vec3>& from, std::vector<Vec3>& to)>;

/// The step of the settings' method. start: where the surface is before the first step (hc). What is given
/// must outlive the step.
[[nodiscard]] RelaxStep relax_step(const Mesh& mesh, const Neighbourhoods& near,
                                   const RelaxSettings& settings, const std::vector<Vec3>& start);

/// to = from moved by lambda (times the mask) towards the neighbours' mean.
void umbrella_step(const std::vector<Vec3>& from, std::vector<Vec3>& to, const VertexLists& near,
                   double lambda, const std::vector<double>& mask);

[[nodiscard]] RelaxStep cotangent_step(const Mesh& mesh, const Neighbourhoods& near,
                                       const RelaxSettings& settings);
[[nodiscard]] RelaxStep implicit_step(const Neighbourhoods& near, const RelaxSettings& settings);

/// The lambda that is used: the given one, or the method's own.
[[nodiscard]] double relax_lambda(const RelaxSettings& settings);

} // namespace facetmill
