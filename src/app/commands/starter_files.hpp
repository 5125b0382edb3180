// The scene that `chainreel init` writes for a chain in numbers; @WORDS@ stand for what is its own, and behind #@ stands
// a key whose meaning and unit the table of keys says.
#pragma once

namespace chainreel {

inline constexpr char kStarterScene[] = R"(# A scene: what moves, what drives it, and what the film shows. All keys: chainreel help scene
title: "@NAME@"
model: "@NAME@.urdf"          #@model
@GRAVITY@
start:
  q: @Q@          #@start.q
  qd: @QD@                  #@start.qd
parameters: {k: 0.2}          #@parameters
torque:                       #@torque
@TORQUE@
duration: 5                   #@duration
method: auto                  #@method
accuracy: 0.1 px              #@accuracy
draw: [+ellipse, +legend]     #@draw
video: {width: 1280, height: 720, fps: 60}
)";

}  // namespace chainreel
