// Bodies for models that show none: what joints and inertias say of them.
#pragma once

#include "draw/robot/body_shapes.hpp"

namespace chainreel {

// Limbs as capsules from joint to joint, as thick as their mass has it at the density of water; bodies that carry several limbs
// as rounded boxes around their joints, and what lies between two of these as wide as they are; a foot where the mass of a last
// link lies beside its limb; a head above two arms that nothing else stands on. A joint is a ball; one that turns about an upright axis on the world has a plinth. Nothing for chains with
// sliding joints, which bars with rails show better, nor where no link has any length.
BodyShapes made_bodies(const Chain& chain);

}  // namespace chainreel
