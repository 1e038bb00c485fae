#pragma once
// The step of each method of relax, which moves all vertices simultaneously.

#include "geometry/relax/relax.hpp"

#include <functional>

namespace facetmill {

/// Computes all new positions from all old ones; from and to must differ.
using RelaxStep = std::function<void(const std::vector<Vec3>& from, std::vector<Vec3>& to)>;

/// The step of the settings' method. start: the surface before the first step (for hc). The arguments must
/// outlive the step.
[[nodiscard]] RelaxStep relax_step(const Mesh& mesh, const Neighbourhoods& near,
                                   const RelaxSettings& settings, const std::vector<Vec3>& start);

/// Sets `to` to `from` moved by lambda (times the mask) towards the neighbours' mean.
void umbrella_step(const std::vector<Vec3>& from, std::vector<Vec3>& to, const VertexLists& near,
                   double lambda, const std::vector<double>& mask);

[[nodiscard]] RelaxStep cotangent_step(const Mesh& mesh, const Neighbourhoods& near,
                                       const RelaxSettings& settings);
[[nodiscard]] RelaxStep implicit_step(const Neighbourhoods& near, const RelaxSettings& settings);

/// The lambda in use: the given value, or the method's default.
[[nodiscard]] double relax_lambda(const RelaxSettings& settings);

} // namespace facetmill
