#include "support/battery.hpp"

#include <cmath>
#include <cstdio>

#include "support/chains.hpp"

namespace chainreel::test {
namespace {

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

// One part of a torque; `i` is the joint, 1 for the first.
std::string part(Random& random, int i, double duration) {
  const std::string j = std::to_string(i);
  const double size = random.between(2, 30) * (random.below(2) == 0 ? 1 : -1);
  const double begin = random.between(0.05, 0.8) * duration;
  const std::string f = number(size), t0 = number(begin);
  switch (random.below(9)) {
    case 0:  // a push of 2 to 50 ms
      return number(2 * size) + "*(t>" + t0 + ")*(t<" + number(begin + random.between(0.002, 0.05)) + ")";
    case 1:  // a jump
      return f + "*(t>=" + t0 + ")";
    case 2:  // a ramp between two levels
      return f + "*min(1, max(0, (t-" + t0 + ")*" + number(random.between(2, 40)) + "))";
    case 3:
      return f + "*abs(t-" + t0 + ")";
    case 4:  // half waves
      return f + "*max(0, sin(" + number(random.between(5, 30)) + "*t))";
    case 5:  // a spring with a gap
      return "-" + number(std::abs(size)) + "*(max(0, q" + j + "-0.3) + min(0, q" + j + "+0.3))";
    case 6:  // feedback that is cut off
      return "max(-8, min(8, " + number(2 * std::abs(size)) + "*(0.5-q" + j + ") - 2*qd" + j + "))";
    case 7:  // drag
      return "-0.5*abs(qd" + j + ")*qd" + j;
    default:  // dry friction
      return "-" + number(0.1 * std::abs(size)) + "*((qd" + j + ">0)-(qd" + j + "<0))";
  }
}

}  // namespace

std::string CorneredScene::text() const {
  std::string all = model + " q0";
  for (const double x : q0) all += " " + number(x);
  all += " qd0";
  for (const double x : qd0) all += " " + number(x);
  for (const std::string& one : torque) all += " | " + one;
  return all + " | " + number(duration) + " s";
}

CorneredScene cornered_scene(std::uint64_t seed) {
  Random random(seed);
  CorneredScene scene;
  const int kind = random.below(3);
  scene.model = kind == 0 ? "pp" : kind == 1 ? "rr" : "rrr";
  const int n = kind == 2 ? 3 : 2;
  const bool from_rest = random.below(3) == 0;
  for (int i = 1; i <= n; ++i) {
    // At rest it hangs straight down.
    scene.q0.push_back(from_rest ? (kind > 0 && i == 1 ? -1.5707963267948966 : 0)
                                 : random.between(-1.5, 1.5));
    scene.qd0.push_back(from_rest ? 0 : random.between(-2, 2));
    std::string torque = part(random, i, scene.duration);
    if (random.below(2) == 0) torque += " + " + part(random, i, scene.duration);
    scene.torque.push_back(torque);
  }
  return scene;
}

}  // namespace chainreel::test
