// Steps that a method chooses can become so small that the end of the run is out of reach, and yet not small enough to be lost.
#pragma once

namespace chainreel {

class Headway {
 public:
  static constexpr long kSteps = 1 << 17;

  // After each step: how far the last kSteps steps came, s, where that is hopeless: at their pace the run would need 100,000 times as
  // many more, or 1,000 times where they are shorter on average than any machine's motion asks for. 0 otherwise.
  double hopeless(long steps, double now, double duration) {
    if (steps % kSteps != 0) return 0;
    const double done = now - before_;
    before_ = now;
    const double patience = done < kShortStep * kSteps ? kDoubtful : kHopeless;
    return done * patience < duration - now ? done : 0;
  }

 private:
  static constexpr double kHopeless = 1e5, kDoubtful = 1e3;
  static constexpr double kShortStep = 1e-6;  // s

  double before_ = 0;  // the time at which that was looked at last
};

}  // namespace chainreel
