// The texts that `chainreel init` writes; @NAME@ stands for the name that the user chose, and behind #@ stands a key whose
// meaning and unit the table of keys says.
#pragma once

namespace chainreel {

inline constexpr char kStarterScene[] = R"(# A scene: what moves, what drives it, and what the film shows. All keys: chainreel help scene
title: "@NAME@"
model: @NAME@.urdf            #@model
gravity: [0, -9.81, 0]        #@gravity
start:
  q: [-60deg, 40deg]          #@start.q
  qd: [0, 0]                  #@start.qd
parameters: {k: 0.2}          #@parameters
torque:                       #@torque
  - 0
  - -k * qd2                  # t, q1.., qd1.., x_G y_G z_G, xd_G yd_G zd_G, the parameters
duration: 5                   #@duration
method: auto                  #@method
accuracy: 0.1 px              #@accuracy
draw: [+ellipse, +legend]     #@draw
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
