// The texts that `chainreel init` writes; @NAME@ stands for the name that the user chose.
#pragma once

namespace chainreel {

inline constexpr char kStarterScene[] = R"(# A scene: what moves, what drives it, and what the film shows.
title: "@NAME@"
model: @NAME@.urdf            # relative to this file
gravity: [0, -9.81, 0]        # m/s^2 in world x (right), y (up), z (to the viewer)
start:
  q: [-60deg, 40deg]          # one number a joint; radians, or degrees with deg
  qd: [0, 0]                  # rad/s
parameters: {k: 0.2}          # names that expressions may use
torque:                       # one number or expression a joint, N m
  - 0
  - -k * qd2                  # t, q1.., qd1.., x_G y_G z_G, xd_G yd_G zd_G, the parameters
duration: 5                   # s
method: auto                  # the cheapest within `accuracy:`, or a row of `chainreel methods`
accuracy: 0.1 px              # or m, rad, relative
draw: [+ellipse, +legend]     # edits the default layers: chain, trail, time, title, torque_label
video: {width: 1280, height: 720, fps: 60}
)";

inline constexpr char kStarterModel[] = R"(<?xml version="1.0"?>
<!-- Two uniform rods of 1 m and 1 kg, hinged about z; lengths in m, masses in kg. -->
<robot name="@NAME@">
  <link name="base"/>
  <link name="upper">
    <inertial>
      <origin xyz="0.5 0 0"/>
      <mass value="1"/>
      <inertia ixx="0.0002" ixy="0" ixz="0" iyy="0.0834" iyz="0" izz="0.0833333333333333"/>
    </inertial>
    <visual>
      <origin xyz="0.5 0 0"/>
      <geometry><box size="1 0.06 0.06"/></geometry>
    </visual>
  </link>
  <link name="lower">
    <inertial>
      <origin xyz="0.5 0 0"/>
      <mass value="1"/>
      <inertia ixx="0.0002" ixy="0" ixz="0" iyy="0.0834" iyz="0" izz="0.0833333333333333"/>
    </inertial>
    <visual>
      <origin xyz="0.5 0 0"/>
      <geometry><box size="1 0.06 0.06"/></geometry>
    </visual>
  </link>
  <link name="gripper"/>

  <joint name="shoulder" type="continuous">
    <parent link="base"/>
    <child link="upper"/>
    <axis xyz="0 0 1"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="upper"/>
    <child link="lower"/>
    <origin xyz="1 0 0"/>
    <axis xyz="0 0 1"/>
  </joint>
  <joint name="tip" type="fixed">
    <parent link="lower"/>
    <child link="gripper"/>
    <origin xyz="1 0 0"/>
  </joint>
</robot>
)";

}  // namespace chainreel
