// How figures of a model without a scene are seen: what the flags --azimuth, --elevation, --distance, --fit,
// --links and --mesh-up say.
#pragma once

#include "app/scene_flags.hpp"
#include "draw/poses.hpp"
#include "model/read_chain.hpp"

namespace chainreel {

// Sets camera and shapes of `figure`; `chain` was read from `model` with `options`. Throws Error (usage)
// naming the flag, or of the mesh that cannot be read.
void set_view(PoseFigureOptions& figure, const FlagValues& flags, const std::string& model,
              const Chain& chain, const ModelOptions& options);

}  // namespace chainreel
